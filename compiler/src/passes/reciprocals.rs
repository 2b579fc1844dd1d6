//! Quotients by one divisor become products with its reciprocal, and those by a constant
//! products with a constant.
//!
//! A product is rounded once more than the quotient was, by the reciprocal. So that this
//! is no more than a last place, the divisor has to be bounded away from 0: then its
//! reciprocal has as many bits as any other value.

use super::rebuild::rebuild_old;
use crate::flow::graph::*;
use crate::range::Ranges;
use slowlight_routine::{Op, Range, Value};
use std::collections::BTreeMap;

/// How many times its least magnitude a divisor may be at most.
const SPREAD: f64 = 2.0;

/// The graph with such products; nothing where there are none.
pub fn reciprocals(graph: &Graph, ranges: &Ranges) -> Option<Graph> {
    let mut dividends: BTreeMap<NodeId, usize> = BTreeMap::new();
    for id in graph.ids() {
        if let Node::Apply(Op::Div, [dividend, divisor]) = graph.node(id)
            && graph.constant(dividend).is_none()
        {
            *dividends.entry(divisor).or_default() += 1;
        }
    }
    let mut done = false;
    let next = rebuild_old(graph, &mut |builder, made, id, span| {
        let Node::Apply(Op::Div, [dividend, divisor]) = graph.node(id) else {
            return None;
        };
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        let (dividend_now, divisor_now) = (new(dividend)?, new(divisor)?);
        let factor = match graph.constant(divisor).map(Value::real) {
            Some(constant) if is_far_from_0(Range::point(constant)) => {
                builder.constant(Value::Real(1.0 / constant), span)
            }
            None if dividends.get(&divisor).is_some_and(|times| *times > 1)
                && is_far_from_0(*ranges.result.get(divisor.0 as usize)?) =>
            {
                let one = builder.constant(Value::Real(1.0), span);
                builder.apply(Op::Div, &[one, divisor_now], span)
            }
            _ => return None,
        };
        done = true;
        Some(builder.apply(Op::Mul, &[dividend_now, factor], span))
    });
    done.then_some(next)
}

/// Whether a range's magnitudes are all of about one size.
fn is_far_from_0(range: Range) -> bool {
    let least = range.lo.max(-range.hi);
    least > 0.0 && range.magnitude() <= SPREAD * least
}
