//! Lower bounds of dear values by cheap parts of them.

use super::{DEEP, Offset, Site};
use crate::ir::graph::*;
use slowlight_routine::Op;

/// How many terms of a sum, or values of which one is the greatest, are looked at.
const MANY: usize = 16;

/// A value that another is never less than: `of`, or its magnitude, and an offset.
#[derive(Clone, Debug)]
pub(super) struct Bound {
    pub of: NodeId,
    pub magnitude: bool,
    pub offset: Offset,
    /// Whether the other is no less than 0 either, but for the offset.
    rooted: bool,
}

impl Site<'_> {
    /// Cheap values that a value is never less than.
    pub(super) fn lower_bounds(&self, id: NodeId) -> Vec<Bound> {
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
                let parts = parts.map(|factor| match self.beside_0(Op::Max, factor) {
                    Some(inner) => plain(inner, false, true),
                    None => plain(factor, true, true),
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
            if left.len() + factors.len() > MANY {
                return Vec::new();
            }
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
        for _ in 0..MANY {
            let Some(id) = left.pop() else { break };
            match self.graph.node(id) {
                Node::Apply(Op::Max, args) => left.extend(args),
                _ => found |= id == bound.of,
            }
        }
        found && bound.rooted && !bound.magnitude && bound.offset.0.is_empty()
    }
}
