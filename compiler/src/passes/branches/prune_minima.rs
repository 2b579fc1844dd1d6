//! Branch and bound on minima: of many values of which the least or greatest is wanted, the dear
//! ones are worked out only where cheap bounds do not tell that they lose.
//!
//! The distance to a union is the least of many, and all but one of them are thrown away. Of
//! a ball's, sqrt(e) - r, it is known without the root whether it is less than another, a: it
//! is where e < t |t|, with t = a + r. And the root of a sum of squares is no less than any of
//! the squares' own roots, so a box, or a torus by its height, is mostly known to be too far
//! before most of it is computed:
//! ```text
//! min(a, sqrt(u u + v v) - r)   becomes   if |u| < t then (if u u + v v < t |t|
//!                                         then sqrt(u u + v v) - r else a) else a
//! ```
//! What is taken away from a shape is a maximum of a value and the negation of others: it is
//! gone through in the same way, from the value on.
//!
//! All sides are equal over the reals, as roots are monotone; where two values come closer than
//! the roundings of squares, either may be taken. Minima of minima are gone through one
//! after the other, those that are cheap first.

use crate::analysis::range::Ranges;
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use crate::source::Span;
use slowlight_routine::{Op, Runtime, Type};
use std::collections::BTreeSet;

/// How many bounds of a value are asked, at most.
const BOUNDS: usize = 3;

/// How many steps of a value are looked through.
const DEEP: u32 = 6;

/// How many comparisons a value must cost to be dear.
const DEAR: f64 = 6.0;

/// The graph with such minima; nothing where there are none.
pub fn prune_minima(graph: &Graph, ranges: &Ranges, runtime: &Runtime) -> Option<Graph> {
    let site = Site::new(graph, ranges, runtime);
    let mut done = false;
    let next = rebuild_old(graph, &mut |builder, made, id, span| {
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        let put = site.pruned(builder, &new, id, span)?;
        done = true;
        Some(put)
    });
    done.then_some(next)
}

type New<'n> = &'n dyn Fn(NodeId) -> Option<NodeId>;

/// A graph, what its values take by themselves, and what they are never less than.
struct Site<'g> {
    graph: &'g Graph,
    ranges: &'g Ranges,
    /// How many nodes read each.
    reads: Vec<u32>,
    /// Cycles of each node with what nothing else reads of its operands.
    cycles: Vec<f64>,
    /// Those of a comparison.
    comparison: f64,
}

/// A value of which the least or greatest is wanted, and whether it is its negation that is.
#[derive(Clone, Copy)]
struct Leaf {
    id: NodeId,
    negated: bool,
}

/// What is added to a value, each with whether it is taken away.
#[derive(Clone, Debug, Default)]
struct Offset(Vec<(NodeId, bool)>);

impl Offset {
    /// What the value is compared with, where it is with its offset compared with a limit.
    fn limit(&self, b: &mut Builder, new: New<'_>, limit: NodeId, span: Span) -> Option<NodeId> {
        self.0.iter().try_fold(limit, |limit, (node, taken)| {
            let op = if *taken { Op::Add } else { Op::Sub };
            Some(b.apply(op, &[limit, new(*node)?], span))
        })
    }
}

/// A root with what it is added to: sqrt(of), perhaps negated, and an offset.
struct Rooted {
    of: NodeId,
    negated: bool,
    offset: Offset,
}

/// A value that another is never less than: `of`, or its magnitude, and an offset.
#[derive(Clone, Debug)]
struct Bound {
    of: NodeId,
    magnitude: bool,
    offset: Offset,
    /// Whether the other is no less than 0 either, but for the offset.
    rooted: bool,
}

impl<'g> Site<'g> {
    fn new(graph: &'g Graph, ranges: &'g Ranges, runtime: &Runtime) -> Site<'g> {
        let mut reads = vec![0; graph.nodes.len()];
        let reached = graph.reached();
        for id in graph.ids().filter(|id| reached[id.0 as usize]) {
            // A square reads one value.
            let operands: BTreeSet<NodeId> = graph.references(id).into_iter().collect();
            operands
                .into_iter()
                .for_each(|of| reads[of.0 as usize] += 1);
        }
        graph.roots().for_each(|id| reads[id.0 as usize] += 1);
        let least = |op: Op| {
            let of = runtime.routines.iter().filter(|routine| routine.op == op);
            of.map(|routine| f64::from(routine.cycles))
                .fold(f64::INFINITY, f64::min)
        };
        let mut cycles: Vec<f64> = Vec::with_capacity(graph.nodes.len());
        for id in graph.ids() {
            let own = match graph.node(id) {
                Node::Apply(op, _) => least(op),
                _ => 0.0,
            };
            let operands: BTreeSet<NodeId> = graph.node(id).operands().collect();
            let alone = operands.iter().filter(|of| reads[of.0 as usize] == 1);
            let below: f64 = alone.map(|of| cycles[of.0 as usize]).sum();
            cycles.push(own + below);
        }
        Site {
            graph,
            ranges,
            reads,
            cycles,
            comparison: least(Op::Less),
        }
    }

    fn is_read_once(&self, id: NodeId) -> bool {
        self.reads[id.0 as usize] == 1
    }

    /// Whether a value is worth some questions: what somebody else reads is at hand.
    fn is_dear(&self, id: NodeId) -> bool {
        self.is_read_once(id) && self.cycles[id.0 as usize] > DEAR * self.comparison
    }

    fn is_cheap(&self, id: NodeId) -> bool {
        self.graph.ty(id) == Type::Real && !self.is_dear(id)
    }

    /// A value as a root and what is added to it, if nothing else reads the root.
    fn rooted(&self, id: NodeId) -> Option<Rooted> {
        let (mut at, mut negated, mut offset) = (id, false, Offset::default());
        for _ in 0..DEEP {
            let Node::Apply(op, [a, c]) = self.graph.node(at) else {
                return None;
            };
            if op == Op::Sqrt {
                let fits = self.is_read_once(at) && self.is_no_less_than_0(a);
                return fits.then_some(Rooted {
                    of: a,
                    negated,
                    offset,
                });
            }
            let (on, off) = match (op, self.is_cheap(a), self.is_cheap(c)) {
                (Op::Neg, ..) => (a, None),
                (Op::Add | Op::Sub, false, true) => (a, Some((c, op == Op::Sub))),
                (Op::Add | Op::Sub, true, false) => (c, Some((a, false))),
                _ => return None,
            };
            offset
                .0
                .extend(off.map(|(node, taken)| (node, taken != negated)));
            negated ^= op == Op::Neg || op == Op::Sub && on == c;
            at = on;
        }
        None
    }

    fn is_no_less_than_0(&self, id: NodeId) -> bool {
        (self.ranges.result.get(id.0 as usize)).is_some_and(|range| range.lo >= 0.0)
    }

    /// Cheap values that a value is never less than.
    fn lower_bounds(&self, id: NodeId) -> Vec<Bound> {
        let mut bounds = self.below(id, DEEP);
        // What takes most of the value tells too late.
        let half = self.cycles[id.0 as usize] / 2.0;
        bounds.retain(|bound| self.cycles[bound.of.0 as usize] < half);
        bounds
    }

    fn below(&self, id: NodeId, deep: u32) -> Vec<Bound> {
        let plain = |of, magnitude, rooted| Bound {
            of,
            magnitude,
            offset: Offset::default(),
            rooted,
        };
        if deep == 0 {
            return Vec::new();
        }
        let Node::Apply(op, [a, c]) = self.graph.node(id) else {
            return Vec::new();
        };
        match op {
            Op::Sqrt => {
                let parts = self.squared(a).into_iter();
                let parts = parts.filter_map(|factor| match self.beside_0(Op::Max, factor) {
                    Some(inner) => self.is_cheap(inner).then(|| plain(inner, false, true)),
                    None => self.is_cheap(factor).then(|| plain(factor, true, true)),
                });
                parts.collect()
            }
            Op::Max => {
                let of = |side: NodeId| match self.is_cheap(side) {
                    true => vec![plain(side, false, false)],
                    false => self.below(side, deep - 1),
                };
                // A constant tells nothing of the value.
                let sides = [a, c].into_iter();
                let sides = sides.filter(|side| self.graph.constant(*side).is_none());
                sides.flat_map(of).collect()
            }
            Op::Add | Op::Sub => {
                let sides = if op == Op::Add {
                    vec![(a, c), (c, a)]
                } else {
                    vec![(a, c)]
                };
                let of = |(side, other): (NodeId, NodeId)| {
                    let mut all = self.below(side, deep - 1);
                    if self.is_cheap(other) {
                        let off = (other, op == Op::Sub);
                        all.iter_mut().for_each(|bound| bound.offset.0.push(off));
                    } else {
                        all.retain(|bound| op == Op::Add && self.is_inside(other, bound));
                    }
                    all
                };
                sides.into_iter().flat_map(of).collect()
            }
            _ => Vec::new(),
        }
    }

    /// The factors of a sum of squares.
    fn squared(&self, sum: NodeId) -> Vec<NodeId> {
        let (mut left, mut factors) = (vec![sum], Vec::new());
        while let Some(id) = left.pop() {
            match self.graph.node(id) {
                Node::Apply(Op::Add, args) => left.extend(args),
                Node::Apply(Op::Mul, [a, c]) if a == c => factors.push(a),
                _ if self.is_no_less_than_0(id) => {}
                _ => return Vec::new(),
            }
        }
        factors
    }

    /// Of a maximum or minimum with 0 the other value.
    fn beside_0(&self, op: Op, id: NodeId) -> Option<NodeId> {
        let Node::Apply(of, [a, c]) = self.graph.node(id) else {
            return None;
        };
        let zero = |id| (self.graph.constant(id)).is_some_and(|value| value.real() == 0.0);
        match (of == op, zero(a), zero(c)) {
            (true, _, true) => Some(a),
            (true, true, _) => Some(c),
            _ => None,
        }
    }

    /// Whether a value is min(m, 0), m the greatest of some values one of which is the bound's
    /// x: as what a box adds inside. With max(x, 0), which the bound is of, it is no less than x:
    /// above 0 it is 0, as m is no less than x, and below it is no less than x itself.
    fn is_inside(&self, id: NodeId, bound: &Bound) -> bool {
        let Some(greatest) = self.beside_0(Op::Min, id) else {
            return false;
        };
        let (mut left, mut found) = (vec![greatest], false);
        while let Some(id) = left.pop() {
            match self.graph.node(id) {
                Node::Apply(Op::Max, args) => left.extend(args),
                _ => found |= id == bound.of,
            }
        }
        found && bound.rooted && !bound.magnitude && bound.offset.0.is_empty()
    }
}

impl Site<'_> {
    /// What stands for a minimum or maximum that is part of no other.
    fn pruned(&self, b: &mut Builder, new: New<'_>, id: NodeId, span: Span) -> Option<NodeId> {
        let Node::Apply(op @ (Op::Min | Op::Max), _) = self.graph.node(id) else {
            return None;
        };
        let mut leaves = Vec::new();
        self.leaves(id, (op, false), true, &mut leaves);
        // As they are written, but cheap ones first.
        let (dear, mut order): (Vec<Leaf>, Vec<Leaf>) =
            leaves.into_iter().partition(|leaf| self.is_dear(leaf.id));
        let first = order.len().max(1);
        order.extend(dear);
        let mut best: Option<NodeId> = None;
        let mut pruned = false;
        for (k, leaf) in order.into_iter().enumerate() {
            let value = match leaf.negated {
                true => b.apply(Op::Neg, &[new(leaf.id)?], span),
                false => new(leaf.id)?,
            };
            best = Some(match best {
                None => value,
                Some(best) if k < first => b.apply(op, &[best, value], span),
                Some(best) => {
                    let made = self.asked(b, new, (op, leaf), (best, value), span);
                    pruned |= made.is_some();
                    made.unwrap_or_else(|| b.apply(op, &[best, value], span))
                }
            });
        }
        best.filter(|_| pruned)
    }

    /// The values of a tree of minima, or of maxima of negations.
    fn leaves(&self, id: NodeId, (op, negated): (Op, bool), is_root: bool, all: &mut Vec<Leaf>) {
        let turned = match op {
            Op::Min => Op::Max,
            _ => Op::Min,
        };
        let inner = is_root || self.is_read_once(id);
        match self.graph.node(id) {
            Node::Apply(of, args) if inner && of == if negated { turned } else { op } => {
                args.iter()
                    .for_each(|arg| self.leaves(*arg, (op, negated), false, all));
            }
            Node::Apply(Op::Neg, [arg, _]) if self.is_read_once(id) => {
                self.leaves(arg, (op, !negated), false, all);
            }
            _ => all.push(Leaf { id, negated }),
        }
    }

    /// The better of the best so far and another value, which is worked out only where its
    /// bounds do not say that it is not; nothing where there are no bounds.
    fn asked(
        &self,
        b: &mut Builder,
        new: New<'_>,
        (op, leaf): (Op, Leaf),
        (best, value): (NodeId, NodeId),
        span: Span,
    ) -> Option<NodeId> {
        // What the leaf itself must be less than, or greater.
        let limit = match leaf.negated {
            true => b.apply(Op::Neg, &[best], span),
            false => best,
        };
        let is_less = (op == Op::Min) != leaf.negated;
        let exact = self.rooted(leaf.id).and_then(|root| {
            let mut limit = root.offset.limit(b, new, limit, span)?;
            if root.negated {
                limit = b.apply(Op::Neg, &[limit], span);
            }
            let size = b.apply(Op::Abs, &[limit], span);
            let square = b.apply(Op::Mul, &[limit, size], span);
            let of = new(root.of)?;
            let sides = if is_less != root.negated {
                [of, square]
            } else {
                [square, of]
            };
            let wins = b.apply(Op::Less, &sides, span);
            Some(b.select(wins, value, best, span))
        });
        let bounds = match is_less {
            true => self.lower_bounds(leaf.id),
            false => Vec::new(),
        };
        if exact.is_none() && bounds.is_empty() {
            return None;
        }
        let mut made = exact.unwrap_or_else(|| b.apply(op, &[best, value], span));
        for bound in bounds.iter().take(BOUNDS).rev() {
            let limit = bound.offset.limit(b, new, limit, span)?;
            let mut of = new(bound.of)?;
            if bound.magnitude {
                of = b.apply(Op::Abs, &[of], span);
            }
            let may = b.apply(Op::Less, &[of, limit], span);
            made = b.select(may, made, best, span);
        }
        Some(made)
    }
}

#[cfg(test)]
mod tests;
