//! Division by multiplication: quotients by one divisor become products with its reciprocal, and
//! those by a constant products with a constant.
//!
//! A product is rounded once more than the quotient was, by the reciprocal. So that this
//! is no more than a last place or two, the divisor has to be bounded away from 0: then its
//! reciprocal has about as many bits as any other value. Where each value has its own point
//! no point is so far to the right that the reciprocal of millions would have bits: there
//! it is of a number about 1, and the products are moved by a power of two, which costs
//! nothing.

use crate::analysis::range::Ranges;
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use slowlight_routine::{Format, Op, Range, Runtime, Value};
use std::collections::BTreeMap;

/// How many times its least magnitude a divisor may be at most.
const SPREAD: f64 = 4.0;

/// Reciprocals of what is less than such a power of two are taken as they are.
const NEAR: i32 = 8;

/// The graph with such products; nothing where there are none, or where divisions are no dearer
/// than products.
pub fn reciprocals(graph: &Graph, ranges: &Ranges, runtime: &Runtime) -> Option<Graph> {
    if !runtime.reciprocals {
        return None;
    }
    let scaled = matches!(runtime.real, Format::Scaled { .. });
    let mut dividends: BTreeMap<NodeId, usize> = BTreeMap::new();
    for id in graph.ids() {
        if let Node::Apply(Op::Div, [dividend, divisor]) = graph.node(id)
            && graph.constant(dividend).is_none()
        {
            *dividends.entry(divisor).or_default() += 1;
        }
    }
    // One over a root is no dearer than the root, and has a place behind the point of its own.
    let inverted = |id: NodeId| {
        runtime.has(Op::ReciprocalRoot) && matches!(graph.node(id), Node::Apply(Op::Sqrt, _))
    };
    let mut done = false;
    let next = rebuild_old(graph, &mut |builder, made, id, span| {
        let Node::Apply(Op::Div, [dividend, divisor]) = graph.node(id) else {
            return None;
        };
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        let (dividend_now, divisor_now) = (new(dividend)?, new(divisor)?);
        let real = |builder: &mut Builder, n: f64| builder.constant(Value::Real(n), span);
        let range = *ranges.result.get(divisor.0 as usize)?;
        let (factor, unit) = match graph.constant(divisor).map(Value::real) {
            Some(constant) if is_far_from_0(Range::point(constant)) => {
                (real(builder, 1.0 / constant), 1.0)
            }
            None if (inverted(divisor)
                || dividends.get(&divisor).is_some_and(|times| *times > 1))
                && is_far_from_0(range) =>
            {
                let unit = match scaled && !inverted(divisor) {
                    true => unit(range),
                    false => 1.0,
                };
                let one = real(builder, unit);
                (builder.apply(Op::Div, &[one, divisor_now], span), unit)
            }
            _ => return None,
        };
        done = true;
        let product = builder.apply(Op::Mul, &[dividend_now, factor], span);
        if unit == 1.0 {
            return Some(product);
        }
        let back = real(builder, 1.0 / unit);
        Some(builder.apply(Op::Mul, &[product, back], span))
    });
    done.then_some(next)
}

/// A power of two about as large as a range's magnitudes; 1 where those are not far from it.
fn unit(range: Range) -> f64 {
    let power = range.magnitude().log2().floor() as i32;
    match power.abs() < NEAR {
        true => 1.0,
        false => f64::from(power).exp2(),
    }
}

/// Whether a range's magnitudes are all of about one size.
fn is_far_from_0(range: Range) -> bool {
    let least = range.lo.max(-range.hi);
    least > 0.0 && range.magnitude() <= SPREAD * least
}
