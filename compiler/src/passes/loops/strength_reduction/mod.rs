//! Strength reduction of induction variables: what grows with the column by steps
//! ([`phase`], [`runs`]), and what both share: polynomials in the column with their
//! coefficients.
//!
//! (Whole polynomials in the column were stepped too, once a pixel each, Newton's forward
//! differences: since values of the column stand in arrays ([`crate::passes::loops::scalar_expansion`]) that gained
//! nothing on any scene, and took up to a third more, as what hangs on a step stands in none.)

mod lines;
pub mod phase;
#[cfg(test)]
mod phase_tests;
pub mod runs;

use crate::analysis::range::Ranges;
use crate::analysis::rate::rates;
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::source::Span;
use slowlight_routine::{Op, Range, Type, Value};

/// The highest degree.
const DEGREE: usize = 2;

/// Whole numbers within this are exact.
const WHOLE: f64 = i32::MAX as f64;

/// The degree in the column of every int that is a polynomial in it.
struct Degrees(Vec<Option<usize>>);

impl Degrees {
    fn of(graph: &Graph, ranges: &Ranges) -> Degrees {
        let rates = rates(graph);
        Degrees::by(graph, ranges, &|id| rates.is_still(id), &|_| false)
    }

    /// The same where some values count as the same for all columns, and some
    /// conditions choose between polynomials.
    fn by(
        graph: &Graph,
        ranges: &Ranges,
        still: &dyn Fn(NodeId) -> bool,
        chooses: &dyn Fn(NodeId) -> bool,
    ) -> Degrees {
        let mut known = Degrees(Vec::with_capacity(graph.nodes.len()));
        for id in graph.ids() {
            let degree = match graph.node(id) {
                _ if graph.ty(id) != Type::Int => None,
                _ if still(id) => Some(0),
                Node::Select { cond, yes, no } if chooses(cond) => {
                    known.at(yes).zip(known.at(no)).map(|(a, b)| a.max(b))
                }
                _ => known.degree(graph, ranges, id),
            };
            known.0.push(degree.filter(|d| *d <= DEGREE));
        }
        known
    }

    fn at(&self, id: NodeId) -> Option<usize> {
        self.0.get(id.0 as usize).copied().flatten()
    }

    fn degree(&self, graph: &Graph, ranges: &Ranges, id: NodeId) -> Option<usize> {
        match graph.node(id) {
            Node::Axis(Axis::X) => Some(1),
            Node::Apply(op, [a, b]) => {
                let exact = ranges.exact.get(id.0 as usize)?;
                if !exact.within(-WHOLE, WHOLE) {
                    return None;
                }
                match op {
                    Op::IntAdd | Op::IntSub => Some(self.at(a)?.max(self.at(b)?)),
                    Op::IntMul => Some(self.at(a)? + self.at(b)?),
                    Op::IntNeg => self.at(a),
                    _ => None,
                }
            }
            _ => None,
        }
    }
}

/// A coefficient, and what it stays within.
type Part = (NodeId, Range);

struct Put<'p> {
    graph: &'p Graph,
    ranges: &'p Ranges,
    known: &'p Degrees,
    /// By columns of a pass, or by all of them.
    stride: u32,
    builder: &'p mut Builder,
    made: &'p [Option<NodeId>],
    span: Span,
}

impl Put<'_> {
    fn whole(&mut self, n: i32) -> Part {
        let node = self.builder.constant(Value::Int(n), self.span);
        (node, Range::point(f64::from(n)))
    }

    /// A polynomial's coefficients, the constant one first; none where one of
    /// them might leave 32 bits.
    fn coefficients(&mut self, id: NodeId) -> Option<Vec<Part>> {
        if self.known.at(id)? == 0 {
            let node = self.made.get(id.0 as usize).copied().flatten()?;
            let range = match self.graph.constant(id) {
                Some(value) => Range::point(value.real()),
                None => self.ranges.result.get(id.0 as usize).copied()?,
            };
            return Some(vec![(node, range)]);
        }
        match self.graph.node(id) {
            // n columns of the pass before it make n times the stride.
            Node::Axis(Axis::X) => match self.stride {
                1 => Some(vec![self.whole(0), self.whole(1)]),
                n => {
                    let pass = self.builder.axis(Axis::Pass(n), self.span);
                    let first = (pass, Range::new(0.0, f64::from(n - 1)));
                    Some(vec![first, self.whole(n as i32)])
                }
            },
            Node::Apply(Op::IntNeg, [a, _]) => {
                let (zero, a) = (vec![self.whole(0)], self.coefficients(a)?);
                self.each(Op::IntSub, &zero, &a)
            }
            Node::Apply(op @ (Op::IntAdd | Op::IntSub), [a, b]) => {
                let (a, b) = (self.coefficients(a)?, self.coefficients(b)?);
                self.each(op, &a, &b)
            }
            Node::Apply(Op::IntMul, [a, b]) => {
                let (a, b) = (self.coefficients(a)?, self.coefficients(b)?);
                self.product(&a, &b)
            }
            _ => None,
        }
    }

    fn each(&mut self, op: Op, a: &[Part], b: &[Part]) -> Option<Vec<Part>> {
        let zero = self.whole(0);
        let part = |list: &[Part], k: usize| list.get(k).copied().unwrap_or(zero);
        let degrees = 0..a.len().max(b.len());
        let pairs: Vec<(Part, Part)> = degrees.map(|k| (part(a, k), part(b, k))).collect();
        let parts = pairs.into_iter().map(|(a, b)| self.both(op, a, b));
        parts.collect()
    }

    fn product(&mut self, a: &[Part], b: &[Part]) -> Option<Vec<Part>> {
        let mut all = vec![self.whole(0); a.len() + b.len() - 1];
        for (i, &a) in a.iter().enumerate() {
            for (k, &b) in b.iter().enumerate() {
                let product = self.both(Op::IntMul, a, b)?;
                all[i + k] = self.both(Op::IntAdd, all[i + k], product)?;
            }
        }
        Some(all)
    }

    /// An operation that stays within 32 bits.
    fn both(&mut self, op: Op, a: Part, b: Part) -> Option<Part> {
        let is = |part: Part, n: f64| part.1.constant() == Some(n);
        let found = match op {
            Op::IntAdd if is(a, 0.0) => return Some(b),
            Op::IntAdd | Op::IntSub if is(b, 0.0) => return Some(a),
            Op::IntMul if is(a, 0.0) || is(b, 1.0) => return Some(a),
            Op::IntMul if is(b, 0.0) || is(a, 1.0) => return Some(b),
            Op::IntAdd => Range::new(a.1.lo + b.1.lo, a.1.hi + b.1.hi),
            Op::IntSub => Range::new(a.1.lo - b.1.hi, a.1.hi - b.1.lo),
            _ => {
                let ends = [
                    a.1.lo * b.1.lo,
                    a.1.lo * b.1.hi,
                    a.1.hi * b.1.lo,
                    a.1.hi * b.1.hi,
                ];
                let lo = ends.iter().copied().fold(f64::INFINITY, f64::min);
                let hi = ends.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                Range::new(lo, hi)
            }
        };
        let fits = found.within(-WHOLE, WHOLE);
        fits.then(|| (self.builder.apply(op, &[a.0, b.0], self.span), found))
    }
}
