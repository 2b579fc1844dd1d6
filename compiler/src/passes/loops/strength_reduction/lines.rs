//! Affine induction variables: values that are affine in the column, worked out in a graph or in
//! numbers.

use super::Degrees;
use crate::analysis::range::Ranges;
use crate::analysis::rate::{Rates, rates};
use crate::ir::graph::*;
use crate::passes::algebra::polynomial::rounding_samples::{Follow, Rounded, applied};
use slowlight_routine::Op;

/// A line a x + b: a (none where it is 0) and b.
pub type Line<V> = (Option<V>, V);

/// Where lines are worked out: in a graph, or in numbers.
pub trait Lines {
    type Value: Copy;
    /// What is the same for a row, as a real.
    fn row(&mut self, id: NodeId) -> Option<Self::Value>;
    /// An int that is affine in the column, as reals.
    fn whole(&mut self, id: NodeId) -> Option<Line<Self::Value>>;
    /// An operation on reals.
    fn apply(&mut self, op: Op, a: Self::Value, b: Self::Value) -> Self::Value;
}

impl Find<'_> {
    pub fn is_line(&self, id: NodeId, deep: u32) -> bool {
        let line = |id: NodeId| self.is_line(id, deep + 1);
        match self.graph.node(id) {
            _ if deep > 20 => false,
            _ if self.is_row(id) => true,
            Node::Apply(Op::ToReal, [a, _]) => self.degrees.at(a) == Some(1),
            Node::Apply(Op::Add | Op::Sub, [a, b]) => line(a) && line(b),
            Node::Apply(Op::Neg, [a, _]) => line(a),
            Node::Apply(Op::Mul, [a, b]) => line(a) && self.is_row(b) || line(b) && self.is_row(a),
            Node::Apply(Op::Div, [a, b]) => line(a) && self.is_row(b),
            _ => false,
        }
    }

    /// A line, worked out somewhere.
    pub fn line<L: Lines>(&self, lines: &mut L, id: NodeId) -> Option<Line<L::Value>> {
        if self.is_row(id) {
            return Some((None, lines.row(id)?));
        }
        match self.graph.node(id) {
            Node::Apply(Op::ToReal, [a, _]) => lines.whole(a),
            Node::Apply(op @ (Op::Add | Op::Sub), [a, b]) => {
                let (a, b) = (self.line(lines, a)?, self.line(lines, b)?);
                let slope = match (a.0, b.0) {
                    (Some(a), Some(b)) => Some(lines.apply(op, a, b)),
                    (None, Some(b)) if op == Op::Sub => Some(lines.apply(Op::Neg, b, b)),
                    (a, b) => a.or(b),
                };
                Some((slope, lines.apply(op, a.1, b.1)))
            }
            Node::Apply(Op::Neg, [a, _]) => {
                let a = self.line(lines, a)?;
                let mut minus = |x| lines.apply(Op::Neg, x, x);
                Some((a.0.map(&mut minus), minus(a.1)))
            }
            Node::Apply(op @ (Op::Mul | Op::Div), [a, b]) => {
                let (a, by) = if self.is_row(b) { (a, b) } else { (b, a) };
                let (a, by) = (self.line(lines, a)?, lines.row(by)?);
                let mut each = |x| lines.apply(op, x, by);
                Some((a.0.map(&mut each), each(a.1)))
            }
            _ => None,
        }
    }
}

/// Lines in numbers, with their roundings, at a sample.
pub struct Numbers<'n, 'g> {
    pub find: &'n Find<'g>,
    pub follow: Follow<'n, Graph>,
}

impl Lines for Numbers<'_, '_> {
    type Value = Rounded;

    fn row(&mut self, id: NodeId) -> Option<Rounded> {
        self.follow.value(id, 0)
    }

    fn whole(&mut self, id: NodeId) -> Option<Line<Rounded>> {
        // Exact, so that their values do not matter here, only that lines add up.
        let graph = self.find.graph;
        let exact = |value| Rounded { value, off: 0.0 };
        match graph.node(id) {
            _ if self.find.is_row(id) => Some((None, self.follow.value(id, 0)?)),
            Node::Axis(Axis::X) => Some((Some(exact(1.0)), exact(0.0))),
            Node::Apply(op, [a, b]) => {
                let a = self.whole(a)?;
                let b = if op.arity() > 1 { self.whole(b)? } else { a };
                let value = |part: Option<Rounded>| part.map_or(0.0, |p| p.value);
                let (slope, start) = match op {
                    Op::IntAdd => (value(a.0) + value(b.0), a.1.value + b.1.value),
                    Op::IntSub => (value(a.0) - value(b.0), a.1.value - b.1.value),
                    Op::IntNeg => (-value(a.0), -a.1.value),
                    Op::IntMul => (
                        value(a.0) * b.1.value + value(b.0) * a.1.value,
                        a.1.value * b.1.value,
                    ),
                    _ => return None,
                };
                Some((Some(exact(slope)), exact(start)))
            }
            _ => None,
        }
    }

    fn apply(&mut self, op: Op, a: Rounded, b: Rounded) -> Rounded {
        applied(op, a, b)
    }
}

/// Where parities are looked for.
pub struct Find<'g> {
    pub(super) graph: &'g Graph,
    pub(super) ranges: &'g Ranges,
    pub(super) rates: Rates,
    pub(super) degrees: Degrees,
}

impl<'g> Find<'g> {
    pub(super) fn of(graph: &'g Graph, ranges: &'g Ranges) -> Find<'g> {
        Find {
            graph,
            ranges,
            rates: rates(graph),
            degrees: Degrees::of(graph, ranges),
        }
    }

    pub fn is_row(&self, id: NodeId) -> bool {
        self.rates.is_still(id)
    }
}
