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
//! gone through in the same way, from the value on. No point is further below a ball's surface
//! than its radius, and where the value is greater than that, which is nearly everywhere, the ball
//! is not asked for at all.
//!
//! All sides are equal over the reals, as roots are monotone; where two values come closer than
//! the roundings of squares, either may be taken. Minima of minima are gone through one
//! after the other, those that are cheap first.

mod bounds;
mod limits;
mod smooth;

use crate::analysis::range::Ranges;
use crate::analysis::rate::invariant_operands;
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use crate::source::Span;
use limits::{Limit, mostly_beyond, nearer};
use slowlight_routine::{Op, Range, Runtime, Type, Value};
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
    /// Which are computed less often than somebody reads them.
    at_hand: Vec<bool>,
    /// Cycles of each node with what nothing else reads of its operands.
    cycles: Vec<f64>,
    /// Those of a comparison.
    comparison: f64,
    /// Whether a minimum or maximum is part of another one.
    joins: Vec<bool>,
}

/// A value of which the least or greatest is wanted, and whether it is its negation that is.
#[derive(Clone, Copy)]
struct Leaf {
    id: NodeId,
    negated: bool,
}

/// What comes of asking a value for whether it is less than a limit.
#[derive(Clone, Copy)]
struct Outcome {
    /// Where it is not.
    lost: NodeId,
    /// Where it is.
    won: NodeId,
    /// In either case.
    undecided: NodeId,
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

fn opposite(op: Op) -> Op {
    match op {
        Op::Min => Op::Max,
        _ => Op::Min,
    }
}

/// Which minima and maxima are read by one other alone, of the same kind or, negated, of the
/// other kind.
fn joins(graph: &Graph, reads: &[u32]) -> Vec<bool> {
    let mut joins = vec![false; graph.nodes.len()];
    let once = |id: NodeId| reads[id.0 as usize] == 1;
    for id in graph.ids() {
        let Node::Apply(op @ (Op::Min | Op::Max), args) = graph.node(id) else {
            continue;
        };
        for arg in args.into_iter().filter(|arg| once(*arg)) {
            let (of, inner) = match graph.node(arg) {
                Node::Apply(Op::Neg, [inner, _]) => (opposite(op), inner),
                _ => (op, arg),
            };
            if once(inner) && matches!(graph.node(inner), Node::Apply(found, _) if found == of) {
                joins[inner.0 as usize] = true;
            }
        }
    }
    joins
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
        let comparison = least(Op::Less);
        let at_hand = invariant_operands(graph);
        let mut cycles: Vec<f64> = Vec::with_capacity(graph.nodes.len());
        for id in graph.ids() {
            let own = match graph.node(id) {
                // They become choices.
                Node::Apply(Op::Min | Op::Max, _) => comparison,
                Node::Apply(op, _) => least(op),
                _ => 0.0,
            };
            let operands: BTreeSet<NodeId> = graph.node(id).operands().collect();
            let alone = |of: &&NodeId| reads[of.0 as usize] == 1 && !at_hand[of.0 as usize];
            let alone = operands.iter().filter(alone);
            let below: f64 = alone.map(|of| cycles[of.0 as usize]).sum();
            cycles.push(own + below);
        }
        let joins = joins(graph, &reads);
        Site {
            graph,
            ranges,
            reads,
            at_hand,
            cycles,
            comparison,
            joins,
        }
    }

    fn is_read_once(&self, id: NodeId) -> bool {
        self.reads[id.0 as usize] == 1
    }

    /// Whether a value is worth some questions: what somebody else reads is at hand, and so is
    /// what does not change from turn to turn.
    fn is_dear(&self, id: NodeId) -> bool {
        self.is_read_once(id) && !self.at_hand[id.0 as usize] && self.takes_long(id)
    }

    fn takes_long(&self, id: NodeId) -> bool {
        self.cycles[id.0 as usize] > DEAR * self.comparison
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
}

impl Site<'_> {
    /// What stands for a minimum or maximum that is part of no other.
    fn pruned(&self, b: &mut Builder, new: New<'_>, id: NodeId, span: Span) -> Option<NodeId> {
        let Node::Apply(op @ (Op::Min | Op::Max), _) = self.graph.node(id) else {
            return self.smoothed(b, new, id, span);
        };
        if self.joins[id.0 as usize] {
            return None;
        }
        let leaves = self.leaves(id, op);
        // What is only cut to a constant mostly wins.
        let constant = |leaf: &&Leaf| self.graph.constant(leaf.id).is_some();
        if leaves.iter().filter(constant).count() + 1 >= leaves.len() {
            return None;
        }
        // As they are written, but cheap ones first.
        let (dear, mut order): (Vec<Leaf>, Vec<Leaf>) =
            leaves.into_iter().partition(|leaf| self.is_dear(leaf.id));
        let first = order.len().max(1);
        order.extend(dear);
        let mut best: Option<NodeId> = None;
        let mut within: Option<Range> = None;
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
                    let either = b.apply(op, &[best, value], span);
                    // What the leaf itself must be less than, or greater.
                    let id = match leaf.negated {
                        true => b.apply(Op::Neg, &[best], span),
                        false => best,
                    };
                    let within = within.map(|range| leaf.signed(range));
                    let limit = Limit { id, within };
                    let outcome = Outcome {
                        lost: best,
                        won: value,
                        undecided: either,
                    };
                    let made = self.asked(b, new, (op, leaf), limit, outcome, span);
                    pruned |= made.is_some();
                    made.unwrap_or(either)
                }
            });
            let range = self.ranges.result.get(leaf.id.0 as usize);
            let range = leaf.signed(range.copied().unwrap_or(Range::ALL));
            within = Some(match within {
                None => range,
                Some(all) => nearer(op, all, range),
            });
        }
        best.filter(|_| pruned)
    }

    /// The values of a tree of minima, or of maxima of negations, as they are written.
    fn leaves(&self, root: NodeId, op: Op) -> Vec<Leaf> {
        let (mut left, mut all) = (vec![(root, false)], Vec::new());
        while let Some((id, negated)) = left.pop() {
            let of = if negated { opposite(op) } else { op };
            match self.graph.node(id) {
                Node::Apply(found, [a, c])
                    if found == of && (id == root || self.joins[id.0 as usize]) =>
                {
                    left.extend([(c, negated), (a, negated)]);
                }
                Node::Apply(Op::Neg, [arg, _]) if self.is_read_once(id) => {
                    left.push((arg, !negated));
                }
                _ => all.push(Leaf { id, negated }),
            }
        }
        all
    }

    /// What comes of a value that must be less than a limit, or greater, and that is worked out
    /// only where its bounds do not say that it is not; nothing where there are no bounds.
    fn asked(
        &self,
        b: &mut Builder,
        new: New<'_>,
        (op, leaf): (Op, Leaf),
        Limit { id: limit, within }: Limit,
        outcome: Outcome,
        span: Span,
    ) -> Option<NodeId> {
        let is_less = (op == Op::Min) != leaf.negated;
        let range = self.ranges.result.get(leaf.id.0 as usize);
        let end = range.zip(within).and_then(|(range, within)| {
            let end = if is_less { range.lo } else { range.hi };
            mostly_beyond(end, is_less, within).then_some(end)
        });
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
            Some(b.select(wins, outcome.won, outcome.lost, span))
        });
        let bounds = match is_less {
            true => self.lower_bounds(leaf.id),
            false => Vec::new(),
        };
        if exact.is_none() && bounds.is_empty() && end.is_none() {
            return None;
        }
        let mut made = exact.unwrap_or(outcome.undecided);
        for bound in bounds.iter().take(BOUNDS).rev() {
            let limit = bound.offset.limit(b, new, limit, span)?;
            let mut of = new(bound.of)?;
            if bound.magnitude {
                of = b.apply(Op::Abs, &[of], span);
            }
            let may = b.apply(Op::Less, &[of, limit], span);
            made = b.select(may, made, outcome.lost, span);
        }
        if let Some(end) = end {
            let end = b.constant(Value::Real(end), span);
            let sides = if is_less { [end, limit] } else { [limit, end] };
            let may = b.apply(Op::Less, &sides, span);
            made = b.select(may, made, outcome.lost, span);
        }
        Some(made)
    }
}

#[cfg(test)]
mod tests;
