//! A formula's gradient at a point.
//!
//! The formula is worked out a second time with the point in the markers'
//! place, and each value that moves with the point has slopes along x, y and z
//! beside it (forward differentiation, Wengert 1964). A loop is copied with the
//! slopes of what it carries as further carried values, so that a sum of
//! octaves or a fractal has its exact gradient too.

use super::derive::{Formula, Markers};
use super::{Found, Lower};
use crate::ir::graph::{Loop, LoopId, Node, NodeId};
use crate::source::Span;
use rustc_hash::FxHashMap;
use slowlight_routine::Type;
use std::collections::{BTreeMap, BTreeSet};

/// What becomes of a node at the point: its value and its slopes (none: 0).
#[derive(Clone, Copy)]
struct Dual {
    value: NodeId,
    slopes: [Option<NodeId>; 3],
}

/// A copy of a loop.
struct Copied {
    id: LoopId,
    /// Where each carried value's slopes are among those of the copy, if it has any.
    slopes: Vec<Option<u32>>,
    /// Its results, once it is closed.
    results: Vec<Dual>,
}

/// Which nodes of a formula change with the point, by leaps or smoothly.
#[derive(Default)]
struct Moving {
    moved: BTreeSet<NodeId>,
    sloped: BTreeSet<NodeId>,
}

/// A formula on its way to a point.
struct Work {
    moving: Moving,
    known: FxHashMap<NodeId, Dual>,
    loops: FxHashMap<LoopId, Copied>,
}

impl Work {
    fn of(&self, id: NodeId) -> Dual {
        let same = Dual {
            value: id,
            slopes: [None; 3],
        };
        self.known.get(&id).copied().unwrap_or(same)
    }
}

impl Lower<'_> {
    /// The gradient of a formula at a point.
    pub(super) fn gradient(
        &mut self,
        formula: &Formula,
        point: &Markers,
        span: Span,
    ) -> Found<[NodeId; 3]> {
        let nodes = self.reached(formula);
        let moving = self.moving(formula, &nodes);
        let one = self.real(1.0, span);
        let mut work = Work {
            moving,
            known: FxHashMap::default(),
            loops: FxHashMap::default(),
        };
        for (axis, (&marker, &value)) in formula.markers.iter().zip(point).enumerate() {
            let mut slopes = [None; 3];
            slopes[axis] = Some(one);
            work.known.insert(marker, Dual { value, slopes });
        }
        for id in nodes {
            self.step(span)?;
            if work.moving.moved.contains(&id) && !work.known.contains_key(&id) {
                let dual = self.dual(&mut work, id, span)?;
                work.known.insert(id, dual);
            }
        }
        let zero = self.real(0.0, span);
        Ok(work.of(formula.root).slopes.map(|s| s.unwrap_or(zero)))
    }

    /// What the root needs, through loops too, in the order in which it was made.
    fn reached(&self, formula: &Formula) -> BTreeSet<NodeId> {
        let first = formula.markers.iter().min().copied();
        let mut seen = BTreeSet::new();
        let mut todo = vec![formula.root];
        while let Some(id) = todo.pop() {
            // What was made before the markers cannot depend on them.
            if Some(id) < first || !seen.insert(id) {
                continue;
            }
            let node = self.b.node(id);
            todo.extend(node.operands());
            if let Some(inner) = self.own_loop(formula, node) {
                todo.extend(inner.roots());
            }
        }
        seen
    }

    /// The loop that a node belongs to, if it was made after the markers.
    pub(super) fn own_loop(&self, formula: &Formula, node: Node) -> Option<&Loop> {
        match node {
            Node::Carried { of, .. } | Node::Last { of, .. } | Node::Result { of, .. }
                if of.0 >= formula.loops =>
            {
                self.b.loop_of(of)
            }
            _ => None,
        }
    }

    /// Loops pass on what moves, so this goes on until nothing is new.
    fn moving(&self, formula: &Formula, nodes: &BTreeSet<NodeId>) -> Moving {
        let mut found = Moving::default();
        found.moved.extend(formula.markers);
        found.sloped.extend(formula.markers);
        loop {
            let before = (found.moved.len(), found.sloped.len());
            for &id in nodes {
                let node = self.b.node(id);
                let owner = self.own_loop(formula, node);
                let mut needs = node.operands();
                let moved = needs.any(|n| found.moved.contains(&n))
                    || owner.is_some_and(|l| l.roots().any(|n| found.moved.contains(&n)));
                if !moved {
                    continue;
                }
                found.moved.insert(id);
                let sloped = |n: Option<&NodeId>| n.is_some_and(|n| found.sloped.contains(n));
                let slopes = match (node, owner) {
                    (Node::Carried { index, .. } | Node::Last { index, .. }, Some(l)) => {
                        let k = index as usize;
                        sloped(l.init.get(k)) || sloped(l.next.get(k))
                    }
                    (Node::Result { index, .. }, Some(l)) => {
                        let k = index as usize;
                        sloped(l.done.get(k)) || sloped(l.otherwise.get(k))
                    }
                    _ => node.operands().any(|n| sloped(Some(&n))),
                };
                if slopes && self.b.ty(id) == Type::Real {
                    found.sloped.insert(id);
                }
            }
            if before == (found.moved.len(), found.sloped.len()) {
                return found;
            }
        }
    }

    fn dual(&mut self, work: &mut Work, id: NodeId, span: Span) -> Found<Dual> {
        let here = self.at(span);
        Ok(match self.b.node(id) {
            Node::Apply(op, [a, b]) => {
                let (a, b) = (work.of(a), work.of(b));
                let both = [a.value, b.value];
                let args = both.get(..op.arity()).unwrap_or(&both);
                let value = self.b.apply(op, args, here);
                let slopes = [0, 1, 2].map(|k| {
                    let db = b.slopes[k].filter(|_| op.arity() > 1);
                    let some = a.slopes[k].is_some() || db.is_some();
                    some.then(|| self.rule(op, value, both, [a.slopes[k], db], here))?
                });
                Dual { value, slopes }
            }
            Node::Select { cond, yes, no } => {
                let (cond, yes, no) = (work.of(cond).value, work.of(yes), work.of(no));
                let value = self.select(cond, yes.value, no.value, here);
                let slopes = [0, 1, 2].map(|k| {
                    (yes.slopes[k].is_some() || no.slopes[k].is_some()).then(|| {
                        let (y, n) = (self.slope_of(yes, k, here), self.slope_of(no, k, here));
                        self.select(cond, y, n, here)
                    })
                });
                Dual { value, slopes }
            }
            Node::Lookup { table, column, row } => {
                let (column, row) = (work.of(column).value, work.of(row).value);
                let value = self.b.lookup(table, column, row, here);
                Dual {
                    value,
                    slopes: [None; 3],
                }
            }
            Node::Carried { of, index } => {
                self.opened(work, of, span)?;
                self.carried_dual(work, of, index, |l, of, k| l.b.carried(of, k, here))
                    .ok_or_else(|| self.confused(span))?
            }
            Node::Last { of, index } => {
                self.opened(work, of, span)?;
                self.carried_dual(work, of, index, |l, of, k| l.b.last(of, k, here))
                    .ok_or_else(|| self.confused(span))?
            }
            Node::Result { of, index } => {
                self.closed(work, of, span)?;
                let results = work.loops.get(&of).map(|c| &c.results);
                let found = results.and_then(|r| r.get(index as usize));
                found.copied().ok_or_else(|| self.confused(span))?
            }
            _ => work.of(id),
        })
    }

    /// A slope as a node; of what is never needed, there is none either.
    fn slope_of(&mut self, dual: Dual, axis: usize, span: Span) -> NodeId {
        match (dual.slopes[axis], self.b.node(dual.value)) {
            (Some(slope), _) => slope,
            (None, Node::Undefined(_)) => self.b.undefined(Type::Real),
            (None, _) => self.real(0.0, span),
        }
    }

    fn carried_dual(
        &mut self,
        work: &Work,
        of: LoopId,
        index: u32,
        mut node: impl FnMut(&mut Self, LoopId, u32) -> NodeId,
    ) -> Option<Dual> {
        let copy = work.loops.get(&of)?;
        let first = copy.slopes.get(index as usize)?;
        Some(Dual {
            value: node(self, copy.id, index),
            slopes: [0, 1, 2].map(|k| first.map(|first| node(self, copy.id, first + k))),
        })
    }

    /// Opens the copy of a loop, if that is still to do.
    fn opened(&mut self, work: &mut Work, of: LoopId, span: Span) -> Found<()> {
        if work.loops.contains_key(&of) {
            return Ok(());
        }
        let Some(old) = self.b.loop_of(of).cloned() else {
            return Err(self.confused(span));
        };
        let mut list: Vec<(String, Type, NodeId)> = Vec::new();
        let mut further = Vec::new();
        let mut slopes = Vec::new();
        for (k, (name, &ty)) in old.names.iter().zip(&old.types).enumerate() {
            let (Some(&init), Some(next)) = (old.init.get(k), old.next.get(k)) else {
                return Err(self.confused(span));
            };
            let dual = work.of(init);
            list.push((name.clone(), ty, dual.value));
            let sloped = &work.moving.sloped;
            if ty != Type::Real || !(sloped.contains(&init) || sloped.contains(next)) {
                slopes.push(None);
                continue;
            }
            slopes.push(Some((old.names.len() + further.len()) as u32));
            for (axis, label) in ["x", "y", "z"].iter().enumerate() {
                let slope = self.slope_of(dual, axis, span);
                further.push((format!("{name}_by_{label}"), Type::Real, slope));
            }
        }
        list.extend(further);
        let here = self.at(span);
        let id = self.b.open_loop(old.max, &list, here);
        self.loops = id.0 + 1;
        for k in 0..list.len() as u32 {
            self.b.carried(id, k, here);
        }
        let results = Vec::new();
        let copy = Copied {
            id,
            slopes,
            results,
        };
        work.loops.insert(of, copy);
        Ok(())
    }

    /// Closes the copy of a loop, if that is still to do.
    fn closed(&mut self, work: &mut Work, of: LoopId, span: Span) -> Found<()> {
        self.opened(work, of, span)?;
        let Some(old) = self.b.loop_of(of).cloned() else {
            return Err(self.confused(span));
        };
        let Some(copy) = work.loops.get(&of) else {
            return Err(self.confused(span));
        };
        if !copy.results.is_empty() {
            return Ok(());
        }
        let (id, places) = (copy.id, copy.slopes.clone());
        let value = |n: &NodeId| work.of(*n).value;
        let mut next: Vec<NodeId> = old.next.iter().map(value).collect();
        for (n, _) in old.next.iter().zip(&places).filter(|(_, p)| p.is_some()) {
            next.extend([0, 1, 2].map(|k| self.slope_of(work.of(*n), k, span)));
        }
        let mut done: Vec<NodeId> = old.done.iter().map(value).collect();
        let mut elses: Vec<NodeId> = old.otherwise.iter().map(value).collect();
        // The results' slopes follow the results, three each where there are any.
        let sloped = &work.moving.sloped;
        let mut at: BTreeMap<usize, usize> = BTreeMap::new();
        for (k, (d, o)) in old.done.iter().zip(&old.otherwise).enumerate() {
            if sloped.contains(d) || sloped.contains(o) {
                at.insert(k, done.len());
                done.extend([0, 1, 2].map(|k| self.slope_of(work.of(*d), k, span)));
                elses.extend([0, 1, 2].map(|k| self.slope_of(work.of(*o), k, span)));
            }
        }
        let again = work.of(old.again).value;
        let results = self.b.close_loop(id, again, &next, &done, &elses);
        let duals = (0..old.done.len()).filter_map(|k| {
            let slope = |axis: usize| results.get(at.get(&k)? + axis).copied();
            Some(Dual {
                value: *results.get(k)?,
                slopes: [0, 1, 2].map(slope),
            })
        });
        let duals = duals.collect();
        if let Some(copy) = work.loops.get_mut(&of) {
            copy.results = duals;
        }
        Ok(())
    }
}
