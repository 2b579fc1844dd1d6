//! Smooth minima and maxima: one value where the other is further from it than they are rounded.
//!
//! Of a smooth union by a width k,
//! ```text
//! min(a, b) - h h k / 4,  h = max(k - |a - b|, 0) / k
//! ```
//! nothing is left but a where b is no less than a + k: what is taken off is a product with a
//! factor that is 0 then. So b is asked for as it would be of min(a + k, b).

use super::limits::Limit;
use super::{Leaf, New, Outcome, Site};
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::source::Span;
use slowlight_routine::Op;

/// How many factors of what is taken off are looked at.
const FACTORS: usize = 16;

/// The lesser of two values or the greater, and something that is 0 where they are `width` apart.
#[derive(Clone, Copy)]
struct Smooth {
    op: Op,
    sides: [NodeId; 2],
    width: NodeId,
    /// Whether it is its negation.
    negated: bool,
}

impl Site<'_> {
    /// What stands for a smooth minimum or maximum, one side of which is dear.
    pub(super) fn smoothed(
        &self,
        b: &mut Builder,
        new: New<'_>,
        id: NodeId,
        span: Span,
    ) -> Option<NodeId> {
        let smooth = self.smooth(id)?;
        let [x, y] = smooth.sides;
        // What is the end of a chain as it is mostly written.
        let sides = [(x, y), (y, x)];
        let (first, dear) = sides
            .into_iter()
            .find(|(_, dear)| self.is_asked_for(*dear))?;
        let on = match smooth.op {
            Op::Min => Op::Add,
            _ => Op::Sub,
        };
        let best = new(first)?;
        let limit = Limit {
            id: b.apply(on, &[best, new(smooth.width)?], span),
            within: None,
        };
        let leaf = Leaf {
            id: dear,
            negated: false,
        };
        let Node::Apply(op, args) = self.graph.node(id) else {
            return None;
        };
        let value = b.apply(op, &[new(args[0])?, new(args[1])?], span);
        let lost = match smooth.negated {
            true => b.apply(Op::Neg, &[best], span),
            false => best,
        };
        let outcome = Outcome {
            lost,
            won: value,
            undecided: value,
        };
        self.asked(b, new, (smooth.op, leaf), limit, outcome, span)
    }

    /// Whether a value is dear, and read by its extreme and its difference alone; and something is
    /// known of it.
    fn is_asked_for(&self, id: NodeId) -> bool {
        self.reads[id.0 as usize] == 2
            && self.takes_long(id)
            && (self.rooted(id).is_some() || !self.lower_bounds(id).is_empty())
    }

    fn smooth(&self, id: NodeId) -> Option<Smooth> {
        let Node::Apply(off, args) = self.graph.node(id) else {
            return None;
        };
        let pairs = [args, [args[1], args[0]]];
        pairs
            .into_iter()
            .enumerate()
            .find_map(|(k, [extreme, rest])| {
                let Node::Apply(op, sides) = self.graph.node(extreme) else {
                    return None;
                };
                if !matches!((op, off), (Op::Min, Op::Sub) | (Op::Max, Op::Add)) {
                    return None;
                }
                Some(Smooth {
                    op,
                    sides,
                    width: self.vanishes_from(rest, sides)?,
                    negated: off == Op::Sub && k == 1,
                })
            })
    }

    /// How far apart two values are from where on another is 0, as a product with what is 0.
    fn vanishes_from(&self, id: NodeId, sides: [NodeId; 2]) -> Option<NodeId> {
        let mut left = vec![id];
        for _ in 0..FACTORS {
            let Node::Apply(op, [a, c]) = self.graph.node(left.pop()?) else {
                continue;
            };
            match op {
                Op::Mul if a == c => left.push(a),
                Op::Mul => left.extend([a, c]),
                Op::Div => left.push(a),
                Op::Max => {
                    let is_0 = |id| self.graph.constant(id).is_some_and(|c| c.real() == 0.0);
                    let of = match (is_0(a), is_0(c)) {
                        (true, _) => c,
                        (_, true) => a,
                        _ => continue,
                    };
                    if let Some(width) = self.width(of, sides) {
                        return Some(width);
                    }
                }
                _ => {}
            }
        }
        None
    }

    /// k of k - |a - b|.
    fn width(&self, id: NodeId, [x, y]: [NodeId; 2]) -> Option<NodeId> {
        let apply = |id: NodeId| match self.graph.node(id) {
            Node::Apply(op, args) => Some((op, args)),
            _ => None,
        };
        let (Op::Sub, [width, distance]) = apply(id)? else {
            return None;
        };
        let (Op::Abs, [difference, _]) = apply(distance)? else {
            return None;
        };
        let (Op::Sub, [a, c]) = apply(difference)? else {
            return None;
        };
        // Of less than 0 nothing is rounded, but the limit would be beyond the other value.
        let found = [a, c] == [x, y] || [a, c] == [y, x];
        (found && self.is_no_less_than_0(width)).then_some(width)
    }
}
