//! Correlated operands: sums and differences of which one operand is made of the other one, so
//! that their ranges by themselves say too little: what a floor leaves, and interpolation.

use super::Walk;
use crate::analysis::points::Points;
use crate::ir::graph::*;
use crate::ir::interval::interval;
use slowlight_routine::{Op, Range};

/// How far from 0 to 1 a factor may be that something is interpolated by.
const BEYOND: f64 = 1.0;

/// a + (b - a) * u.
#[derive(Clone, Copy)]
pub(super) struct Interpolation {
    from: NodeId,
    to: NodeId,
    by: NodeId,
    difference: NodeId,
    product: NodeId,
}

/// A sum as an interpolation.
pub(super) fn interpolation(graph: &Graph, [a, c]: [NodeId; 2]) -> Option<Interpolation> {
    let found = |from: NodeId, product: NodeId, difference: NodeId, by: NodeId| {
        let Node::Apply(Op::Sub, [to, taken]) = graph.node(difference) else {
            return None;
        };
        (taken == from).then_some(Interpolation {
            from,
            to,
            by,
            difference,
            product,
        })
    };
    [(a, c), (c, a)].into_iter().find_map(|(from, product)| {
        let Node::Apply(Op::Mul, [x, y]) = graph.node(product) else {
            return None;
        };
        found(from, product, x, y).or_else(|| found(from, product, y, x))
    })
}

impl Walk<'_> {
    /// Whether a value is another one's floor, exactly, as a difference of both reads them: what
    /// is left is from 0 to 1.
    pub(super) fn is_floor(&self, rest: NodeId, floor: NodeId, of: NodeId) -> bool {
        let Node::Apply(Op::ToReal, [int, _]) = self.graph.node(floor) else {
            return false;
        };
        let Node::Apply(Op::Floor, [real, _]) = self.graph.node(int) else {
            return false;
        };
        // Neither is beyond what ints are, nor is the int rounded.
        let all = self.read(real);
        real == of
            && match &self.slack.points {
                None => self.slack.is_placed() && self.slack.is_exact(Op::ToReal, all),
                Some(points) => self.is_floor_at(points, [rest, floor, int, of], all),
            }
    }

    /// The same where reals have points: both read the same digits, or the difference fewer of
    /// them, in which whole numbers are what they were; and neither ends where a format does.
    fn is_floor_at(
        &self,
        points: &Points,
        [rest, floor, int, of]: [NodeId; 4],
        all: Range,
    ) -> bool {
        let [whole, below] = points.scales(rest).args;
        let floored = points.scales(int).args[0];
        let whole_numbers = [
            floored,
            below,
            points.own(floor),
            points.scales(floor).args[0],
        ];
        let exact = Range::new(all.lo.floor(), all.hi.floor());
        let held = self.read(floor);
        let read = [
            points.operand(self.graph, rest, 0, all),
            points.operand(self.graph, rest, 1, held),
        ];
        let unit = Points::unit(whole);
        let same = |a: Range, b: Range| a.lo == b.lo && a.hi == b.hi;
        whole >= 0
            && whole_numbers.iter().all(|scale| *scale >= 0)
            && (floored == whole || floored >= points.own(of))
            && all.within(self.slack.ints.lo, self.slack.ints.hi)
            && same(held, exact)
            && same(read[1], exact)
            && read[0].lo <= all.lo + unit
            && read[0].hi >= all.hi - unit
    }

    /// Interpolation by a factor from 0 to 1 leads to nowhere but between its ends.
    ///
    /// With d = b - a as it is rounded and p = d u, the sum a + p is (1 - u) a + u b, and u times
    /// what d is off and what p is off: linear in each, so that it is greatest where each of a, b
    /// and u is at one of its ends. Where d or p ends where its format does, the sum is between
    /// that and a.
    pub(super) fn interpolated(&self, id: NodeId, operands: [NodeId; 2], exact: Range) -> Range {
        let Some(found) = interpolation(self.graph, operands) else {
            return exact;
        };
        let [from, to] = [found.from, found.to].map(|id| self.read(id));
        // As the sum reads it, it ends where it does by itself.
        let (summed, _) = self.operands(id, Op::Add, operands);
        let start = summed[usize::from(operands[1] == found.from)];
        let unit = self.readings(id);
        if start.lo > from.lo + unit || start.hi < from.hi - unit {
            return exact;
        }
        let Node::Apply(_, factors) = self.graph.node(found.product) else {
            return exact;
        };
        let (read, _) = self.operands(found.product, Op::Mul, factors);
        let by = read[usize::from(factors[1] == found.by)];
        if by.lo < -BEYOND || by.hi > 1.0 + BEYOND {
            return exact;
        }
        let at = |u: f64| {
            let part = |range: Range, by: f64| interval(Op::Mul, [range, Range::point(by)], false);
            interval(Op::Add, [part(from, 1.0 - u), part(to, u)], false)
        };
        let between = from.join(at(by.lo)).join(at(by.hi));
        let off = by.magnitude() * self.roundings(found.difference)
            + self.roundings(found.product)
            + self.readings(id);
        match off.is_finite() && between.magnitude().is_finite() {
            true => exact.meet(Range::new(between.lo - off, between.hi + off)),
            false => exact,
        }
    }

    /// How far an operation's result may be from that of its operands: by its own rounding, and
    /// as they are read at other scales.
    fn roundings(&self, id: NodeId) -> f64 {
        let Node::Apply(op, operands) = self.graph.node(id) else {
            return f64::INFINITY;
        };
        let (args, same) = self.operands(id, op, operands);
        let exact = interval(op, args, same);
        let held = self.slack.result(id, op, &args[..op.arity()], exact);
        let off = (held.lo - exact.lo).abs().max((held.hi - exact.hi).abs());
        off + self.readings(id)
    }

    /// How far operands may be off as they are read.
    fn readings(&self, id: NodeId) -> f64 {
        let points = self.slack.points.as_ref();
        points.map_or(0.0, |points| {
            points.scales(id).args.map(Points::unit).iter().sum()
        })
    }
}
