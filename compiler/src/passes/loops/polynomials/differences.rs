//! Strength reduction in loops of equal steps: polynomials in a value that grows by the same at
//! each turn, as sums of their forward differences.
//!
//! A search along a ray goes on by a part of it, so that of `o + t d` nothing is left but a sum:
//! ```text
//! loop (t = a) { .. o + t d .. next(t + s) }
//! is   loop (t = a, p = o + a d) { .. p .. next(t + s, p + s d) }
//! ```
//! and a square's, of the second degree, are two. (Cocke and Kennedy, An algorithm for reduction
//! of operator strength, CACM 1977.) The differences are put together from those of the parts,
//! not subtracted, which would lose what parts have in common.
//!
//! Each turn's sum is rounded, and a difference to begin with. So it is done only where what all
//! turns lose is no more than [`LOST`] of the greatest value on the way, and of a square, which
//! ends near 0 where something is hit, no more than [`SQUARE`] in the scene's own units.

use super::{Loops, Polynomial};
use crate::analysis::range::Ranges;
use crate::analysis::rate::Dependence;
use crate::ir::graph::*;
use crate::passes::rewrite::arena::Arena;
use rustc_hash::{FxHashMap, FxHashSet};
use slowlight_routine::{Format, Op, Runtime, Type};

/// What part of the greatest value the roundings of all turns may come to.
const LOST: f64 = 1.0 / 128.0;

/// What those of a square may come to, were each as great as it can be and all to one side. (What
/// is lost is about a tenth of that: a ball's square of 1 is met within a pixel.)
const SQUARE: f64 = 1.0 / 4.0;

/// The graph with such sums; nothing where there are none that pay.
pub fn forward_differences(graph: &Graph, ranges: &Ranges, runtime: &Runtime) -> Option<Graph> {
    let found = Loops::new(graph, ranges, runtime);
    let moves = moves(graph);
    let mut all: FxHashMap<LoopId, Vec<NodeId>> = FxHashMap::default();
    let differs = |id: NodeId, polynomial: &Polynomial| {
        let by = found.step(polynomial, &moves);
        by.is_some_and(|by| found.differs(id, &by, &moves, &mut FxHashMap::default()))
    };
    let may_be = |id: NodeId, polynomial: &Polynomial| {
        let home = found.home(id);
        home.is_some_and(|of| found.is_exact(of, polynomial)) && differs(id, polynomial)
    };
    for (of, mut candidates) in found.candidates_by(may_be) {
        candidates.sort_unstable();
        let put = found.worth_by(candidates, |_, degree| {
            degree as f64 * found.cycles(Op::Add)
        });
        if !put.is_empty() {
            all.insert(of, put);
        }
    }
    if all.is_empty() {
        return None;
    }
    Reduced::new(&found, &moves).graph(&all)
}

impl Loops<'_> {
    /// Whether the roundings of all turns do not matter. Where each value has digits of its own,
    /// a first difference has so many more that what is lost of it counts as often as what is
    /// lost of the value; in one fixed point it is summed up, too.
    fn is_exact(&self, of: LoopId, polynomial: &Polynomial) -> bool {
        let turns = (self.graph.loops.get(of.0 as usize)).map_or(0, |turns| turns.max);
        let (turns, degree) = (f64::from(turns), polynomial.degree as i32);
        let sums = match self.runtime.real {
            Format::Fixed { .. } => turns.powi(degree),
            _ => turns * f64::from(degree),
        };
        let lost = sums * self.runtime.real.epsilon();
        lost <= LOST && (degree < 2 || lost * self.greatest_term(polynomial) <= SQUARE)
    }

    /// The carried value in which a polynomial is one, and by what it grows at each turn.
    fn step(&self, polynomial: &Polynomial, moves: &[bool]) -> Option<Stepped> {
        let atom = polynomial.atom?;
        let (carried, ahead) = match self.graph.node(atom) {
            Node::Carried { .. } => (atom, None),
            Node::Apply(op @ (Op::Add | Op::Sub), [a, b]) => match self.graph.node(a) {
                Node::Carried { .. } => (a, Some((op, b))),
                _ if op == Op::Add => (b, Some((op, a))),
                _ => return None,
            },
            _ => return None,
        };
        let Node::Carried { of, index } = self.graph.node(carried) else {
            return None;
        };
        let still = |id: NodeId| self.is_still(of, id, moves);
        let turns = self.graph.loops.get(of.0 as usize)?;
        let by = match self.graph.node(*turns.next.get(index as usize)?) {
            Node::Apply(Op::Add, [a, b]) if a == carried => (Op::Add, b),
            Node::Apply(Op::Add, [a, b]) if b == carried => (Op::Add, a),
            Node::Apply(Op::Sub, [a, b]) if a == carried => (Op::Sub, b),
            _ => return None,
        };
        let ahead_is_still = ahead.is_none_or(|(_, id)| still(id));
        (still(by.1) && ahead_is_still).then_some(Stepped {
            atom,
            first: *turns.init.get(index as usize)?,
            ahead,
            by,
        })
    }

    /// Whether a value is the same at each turn of a loop, and may be worked out before it.
    fn is_still(&self, of: LoopId, id: NodeId, moves: &[bool]) -> bool {
        !self.rates.depends(id, Dependence::Loop(of)) && moves[id.0 as usize]
    }

    /// Whether a value's differences can be told before the loop: all else than the stepped value
    /// that it is made of is still.
    fn differs(
        &self,
        id: NodeId,
        by: &Stepped,
        moves: &[bool],
        known: &mut FxHashMap<NodeId, bool>,
    ) -> bool {
        if id == by.atom {
            return true;
        }
        if let Some(known) = known.get(&id) {
            return *known;
        }
        let of = self.home(by.atom);
        let found = match self.graph.node(id) {
            _ if self.home(id) != of => of.is_some_and(|of| self.is_still(of, id, moves)),
            node @ Node::Apply(..) => {
                let mut parts = node.operands();
                parts.all(|part| self.differs(part, by, moves, known))
            }
            _ => false,
        };
        known.insert(id, found);
        found
    }
}

/// Which values nothing of a loop goes into, so that they may be worked out earlier.
fn moves(graph: &Graph) -> Vec<bool> {
    let mut all: Vec<bool> = Vec::with_capacity(graph.nodes.len());
    for id in graph.ids() {
        let node = graph.node(id);
        all.push(match node {
            Node::Const(_) | Node::Param(_) | Node::Axis(_) => true,
            Node::Apply(..) | Node::Select { .. } | Node::Lookup { .. } => {
                node.operands().all(|part| all[part.0 as usize])
            }
            _ => false,
        });
    }
    all
}

/// A carried value that grows by the same at each turn.
#[derive(Clone, Copy)]
struct Stepped {
    /// Itself, or what is as far ahead of it at each turn.
    atom: NodeId,
    /// At the loop's start, without what it is ahead.
    first: NodeId,
    ahead: Option<(Op, NodeId)>,
    by: (Op, NodeId),
}

/// A value at a loop's start, and its differences, as far as there are any.
#[derive(Clone, Copy)]
struct Differences {
    start: NodeId,
    first: Option<NodeId>,
    second: Option<NodeId>,
}

/// The new graph while it is made.
struct Reduced<'l, 'g> {
    loops: &'l Loops<'g>,
    moves: &'l [bool],
    out: Arena<'g>,
    moved: Vec<Option<NodeId>>,
    /// What is carried besides: the value at the start, and what the next turn has.
    carried: FxHashMap<LoopId, Vec<(NodeId, NodeId)>>,
}

impl<'l, 'g> Reduced<'l, 'g> {
    fn new(loops: &'l Loops<'g>, moves: &'l [bool]) -> Reduced<'l, 'g> {
        Reduced {
            loops,
            moves,
            out: Arena::new(loops.graph),
            moved: vec![None; loops.graph.nodes.len()],
            carried: FxHashMap::default(),
        }
    }

    fn graph(mut self, all: &FxHashMap<LoopId, Vec<NodeId>>) -> Option<Graph> {
        let graph = self.loops.graph;
        let mut opened: FxHashSet<LoopId> = FxHashSet::default();
        for id in graph.ids() {
            if let Node::Carried { of, .. } | Node::Last { of, .. } = graph.node(id)
                && opened.insert(of)
                && let Some(put) = all.get(&of)
            {
                self.open(of, put)?;
            }
            self.at(id);
        }
        let mut made = self.out.finish(&self.moved);
        for (of, more) in self.carried {
            let turns = made.loops.get_mut(of.0 as usize)?;
            for (k, (start, next)) in more.into_iter().enumerate() {
                turns.names.push(format!("along{}", k + 1));
                turns.types.push(Type::Real);
                turns.init.push(start);
                turns.next.push(next);
            }
        }
        Some(made)
    }

    /// A value's copy, with what it is made of.
    fn at(&mut self, id: NodeId) -> NodeId {
        if let Some(there) = self.moved[id.0 as usize] {
            return there;
        }
        let node = self.loops.graph.node(id);
        for part in node.operands() {
            self.at(part);
        }
        let moved = &self.moved;
        let node = node.with(|part| moved[part.0 as usize].unwrap_or(NodeId(0)));
        let made = self.out.push(node, id);
        self.moved[id.0 as usize] = Some(made);
        made
    }

    /// Makes what is carried besides, and lets it stand for what it is.
    fn open(&mut self, of: LoopId, put: &[NodeId]) -> Option<()> {
        let turns = self.loops.graph.loops.get(of.0 as usize)?;
        for init in &turns.init {
            self.at(*init);
        }
        let mut known = FxHashMap::default();
        let mut made = Vec::new();
        for id in put {
            let stepped = self.loops.step(&self.loops.of(*id)?, self.moves)?;
            made.push((*id, self.differences(*id, &stepped, &mut known)?));
        }
        // Behind all that they start with.
        let mut more: Vec<(NodeId, NodeId)> = Vec::new();
        for (id, all) in made {
            let carried = turns.init.len() + more.len();
            let carried = |k: usize| Node::Carried {
                of,
                index: (carried + k) as u32,
            };
            let value = self.out.push(carried(0), id);
            let by = match all.second {
                Some(_) => self.out.push(carried(1), id),
                None => all.first?,
            };
            more.push((all.start, self.push(Op::Add, value, by, id)));
            if let Some(second) = all.second {
                more.push((all.first?, self.push(Op::Add, by, second, id)));
            }
            self.moved[id.0 as usize] = Some(value);
        }
        self.carried.insert(of, more);
        Some(())
    }

    fn push(&mut self, op: Op, a: NodeId, b: NodeId, like: NodeId) -> NodeId {
        self.out.push(Node::Apply(op, [a, b]), like)
    }

    fn sum(&mut self, op: Op, [a, b]: [Option<NodeId>; 2], like: NodeId) -> Option<NodeId> {
        match (a, b) {
            (Some(a), Some(b)) => Some(self.push(op, a, b, like)),
            (None, Some(b)) if op == Op::Sub => Some(self.push(Op::Neg, b, b, like)),
            (a, b) => a.or(b),
        }
    }

    /// A product of what there is.
    fn times(&mut self, a: Option<NodeId>, b: Option<NodeId>, like: NodeId) -> Option<NodeId> {
        Some(self.push(Op::Mul, a?, b?, like))
    }

    /// An old value at the loop's start, and its differences from turn to turn.
    fn differences(
        &mut self,
        id: NodeId,
        by: &Stepped,
        known: &mut FxHashMap<NodeId, Differences>,
    ) -> Option<Differences> {
        if let Some(known) = known.get(&id) {
            return Some(*known);
        }
        let made = self.found(id, by, known)?;
        known.insert(id, made);
        Some(made)
    }

    fn found(
        &mut self,
        id: NodeId,
        by: &Stepped,
        known: &mut FxHashMap<NodeId, Differences>,
    ) -> Option<Differences> {
        if id == by.atom {
            return Some(self.atom(by));
        }
        let of = self.loops.home(by.atom)?;
        if self.loops.home(id) != Some(of) {
            let start = self
                .loops
                .is_still(of, id, self.moves)
                .then(|| self.at(id))?;
            return Some(Differences {
                start,
                first: None,
                second: None,
            });
        }
        let Node::Apply(op, [a, b]) = self.loops.graph.node(id) else {
            return None;
        };
        let x = self.differences(a, by, known)?;
        if op == Op::Neg {
            let mut minus = |of: NodeId| self.push(Op::Neg, of, of, id);
            return Some(Differences {
                start: minus(x.start),
                first: x.first.map(&mut minus),
                second: x.second.map(minus),
            });
        }
        let y = self.differences(b, by, known)?;
        let start = self.push(op, x.start, y.start, id);
        let (first, second) = match op {
            Op::Add | Op::Sub => (
                self.sum(op, [x.first, y.first], id),
                self.sum(op, [x.second, y.second], id),
            ),
            Op::Mul => {
                let one = self.times(Some(x.start), y.first, id);
                let other = self.times(x.first, Some(y.start), id);
                let both = self.times(x.first, y.first, id);
                let all = self.sum(Op::Add, [one, other], id);
                let twice = both.map(|both| self.push(Op::Add, both, both, id));
                let left = self.times(Some(x.start), y.second, id);
                let right = self.times(x.second, Some(y.start), id);
                let of_parts = self.sum(Op::Add, [left, right], id);
                (
                    self.sum(Op::Add, [all, both], id),
                    self.sum(Op::Add, [of_parts, twice], id),
                )
            }
            Op::Div => {
                let mut part = |of: NodeId| self.push(Op::Div, of, y.start, id);
                (x.first.map(&mut part), x.second.map(part))
            }
            _ => return None,
        };
        Some(Differences {
            start,
            first,
            second,
        })
    }

    fn atom(&mut self, by: &Stepped) -> Differences {
        let first = self.at(by.first);
        let start = match by.ahead {
            Some((op, ahead)) => {
                let ahead = self.at(ahead);
                self.push(op, first, ahead, by.atom)
            }
            None => first,
        };
        let (op, step) = by.by;
        let step = self.at(step);
        let step = match op {
            Op::Sub => self.push(Op::Neg, step, step, by.atom),
            _ => step,
        };
        Differences {
            start,
            first: Some(step),
            second: None,
        }
    }
}

#[cfg(test)]
mod tests;
