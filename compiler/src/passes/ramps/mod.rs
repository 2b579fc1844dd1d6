//! Forward differences: whole polynomials in the column as ramps.
//!
//! An int that is a polynomial in the column, its coefficients the same for the
//! whole row or pass, takes an addition for each degree from one column to the next
//! ([`crate::flow::ramp`]), where Horner's scheme takes a multiplication for
//! each. The additions are taken at every pixel, so whether they pay depends on
//! how many pixels need the value; the plan decides ([`crate::plan`]).
//!
//! What is exact in 32 bits without wrapping, as the ranges prove of every
//! operation of the polynomial where it is computed, is the same modulo 2^32;
//! so a ramp may wrap at columns where nobody needs it and is right where
//! somebody does.

mod lines;
pub mod phase;
#[cfg(test)]
mod phase_tests;
pub mod runs;

use super::interlace::passes;
use super::rate::rates;
use super::rebuild::rebuild_old;
use crate::flow::build::Builder;
use crate::flow::graph::*;
use crate::range::Ranges;
use crate::source::Span;
use slowlight_routine::{Op, Range, Type, Value};

/// The highest degree.
const DEGREE: usize = 2;

/// Whole numbers within this are exact.
const WHOLE: f64 = i32::MAX as f64;

/// Values that could be ramps: of those that are polynomials, what something
/// else than another of them reads.
pub fn sites(graph: &Graph, ranges: &Ranges) -> Vec<NodeId> {
    let known = Degrees::of(graph, ranges);
    let reached = graph.reached();
    let mut read = vec![false; graph.nodes.len()];
    for id in graph.ids().filter(|id| reached[id.0 as usize]) {
        if known.at(id).is_none() {
            for operand in graph.references(id) {
                read[operand.0 as usize] = true;
            }
        }
    }
    graph.roots().for_each(|id| read[id.0 as usize] = true);
    let site = |id: &NodeId| {
        let axis = matches!(graph.node(*id), Node::Axis(_));
        !axis && read[id.0 as usize] && known.at(*id).is_some_and(|degree| degree > 0)
    };
    graph.ids().filter(site).collect()
}

/// The graph with ramps at some sites; none where a coefficient might not be exact.
pub fn ramps(graph: &Graph, ranges: &Ranges, at: &[NodeId]) -> Option<Graph> {
    let known = Degrees::of(graph, ranges);
    let mut exact = true;
    let made = rebuild_old(graph, &mut |builder, made, id, span| {
        if !at.contains(&id) {
            return None;
        }
        let mut put = Put {
            graph,
            ranges,
            known: &known,
            stride: passes(graph),
            builder,
            made,
            span,
        };
        let found = put.coefficients(id).and_then(|parts| put.ramp(&parts));
        exact &= found.is_some();
        found
    });
    exact.then_some(made)
}

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

    /// c0 + c1 x + c2 x² is c0 + (c1 + c2) x + 2 c2 x(x-1)/2.
    fn ramp(&mut self, parts: &[Part]) -> Option<NodeId> {
        let stride = self.stride;
        match *parts {
            [a] => Some(a.0),
            [a, b] => Some(self.builder.ramp(a.0, b.0, stride, self.span)),
            [a, b, c] => {
                let first = self.both(Op::IntAdd, b, c)?;
                let twice = self.both(Op::IntAdd, c, c)?;
                let step = self.builder.ramp(first.0, twice.0, stride, self.span);
                Some(self.builder.ramp(a.0, step, stride, self.span))
            }
            _ => None,
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::eval::native::Native;
    use crate::eval::random::Random;
    use crate::flow::verify::verify;
    use crate::passes::schedule::schedule;
    use crate::range::{Slack, ranges};

    const AT: Span = Span {
        file: 0,
        start: 0,
        end: 0,
        within: None,
        effect: None,
    };

    fn line(b: &mut Builder, random: &mut Random, axis: Axis) -> NodeId {
        let axis = b.axis(axis, AT);
        let [by, more] = [0, 0].map(|_| Value::Int(random.below(81) as i32 - 40));
        let [by, more] = [by, more].map(|n| b.constant(n, AT));
        let product = b.apply(Op::IntMul, &[axis, by], AT);
        let op = [Op::IntAdd, Op::IntSub][random.below(2) as usize];
        b.apply(op, &[product, more], AT)
    }

    /// The low bits of a polynomial of the second degree at most, written in some way.
    fn picture(seed: u64) -> Graph {
        let mut random = Random::new(seed);
        let mut b = Builder::new();
        let (x, again) = (Axis::X, random.below(2) == 0);
        let lines = [x, x, Axis::Y, Axis::Y].map(|axis| line(&mut b, &mut random, axis));
        let other = if again { lines[0] } else { lines[1] };
        let product = b.apply(Op::IntMul, &[lines[0], other], AT);
        let rest = b.apply(Op::IntMul, &[lines[1], lines[2]], AT);
        let minus = b.apply(Op::IntNeg, &[rest], AT);
        let sum = b.apply(Op::IntSub, &[product, minus], AT);
        let sum = b.apply(Op::IntAdd, &[lines[3], sum], AT);
        let mask = b.constant(Value::Int(255), AT);
        let ink = b.apply(Op::BitAnd, &[sum, mask], AT);
        let image = Image {
            block: (1, 1),
            width: 133,
            height: 20,
            palette: vec![[0; 3]; 256],
        };
        b.finish(image, ink, None)
    }

    #[test]
    fn polynomials_are_the_same_in_steps() {
        for seed in 0..60 {
            let graph = picture(seed);
            let found = ranges(&graph, &schedule(&graph), &Slack::exact());
            let sites = sites(&graph, &found);
            assert_eq!(sites.len(), 1, "{graph}");
            let stepped = ramps(&graph, &found, &sites).unwrap();
            verify(&stepped).unwrap();
            let count = |g: &Graph| {
                let ramp = |n: &&Node| matches!(n, Node::Ramp { .. });
                g.nodes.iter().filter(ramp).count()
            };
            assert!((1..=2).contains(&count(&stepped)), "{stepped}");
            let (mut before, mut after) = (Native::new(&graph), Native::new(&stepped));
            for y in 0..20 {
                for x in 0..133 {
                    assert_eq!(before.pixel(x, y), after.pixel(x, y), "{seed}: {stepped}");
                }
            }
        }
    }

    #[test]
    fn what_may_saturate_is_left_alone() {
        let mut b = Builder::new();
        let x = b.axis(Axis::X, AT);
        let y = b.axis(Axis::Y, AT);
        let large = b.constant(Value::Int(2_000_000_000), AT);
        let grown = b.apply(Op::IntMul, &[y, large], AT);
        let sum = b.apply(Op::IntAdd, &[grown, x], AT);
        let image = Image {
            block: (1, 1),
            width: 9,
            height: 9,
            palette: vec![[0; 3]; 2],
        };
        let graph = b.finish(image, sum, None);
        let found = ranges(&graph, &schedule(&graph), &Slack::exact());
        assert_eq!(sites(&graph, &found), []);
    }
}
