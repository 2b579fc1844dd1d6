//! Range-based simplification (correlated value propagation): what the ranges decide needs no
//! computing.
//!
//! A value that can only be one value is a constant; a minimum or maximum that
//! one side always wins is that side; the low bits of what has no others are
//! itself; a select whose condition is decided is its arm.

use crate::analysis::range::Ranges;
use crate::analysis::rate::{Dependence, rates};
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild;
use slowlight_routine::{Op, Range, Type, Value};
use std::cell::LazyCell;

/// Whole numbers within this are no end of an int.
const WHOLE: f64 = i32::MAX as f64;

/// Whether an int has one value, whose low bits are all 1 and the others 0.
fn is_mask(range: Range) -> bool {
    let mask = range.constant().map(|mask| mask as i64);
    mask.is_some_and(|mask| mask >= 0 && mask & (mask + 1) == 0)
}

/// The graph with every decided operation replaced.
///
/// `without_ends`: the ranges of a format without ends. Where an int can be only one value because
/// something is cut at its format's end, that is a fault to be told.
pub fn fold_by_ranges(graph: &Graph, ranges: &Ranges, without_ends: &dyn Fn() -> Ranges) -> Graph {
    let without_ends = LazyCell::new(without_ends);
    // What is worked out once a picture takes nothing, and stays to be looked at.
    let rates = LazyCell::new(|| rates(graph));
    let mut uses = vec![0_u32; graph.nodes.len()];
    let all = graph.ids().flat_map(|id| graph.refers(id));
    all.chain(graph.roots())
        .for_each(|id| uses[id.0 as usize] += 1);
    rebuild(graph, &mut |builder, old, node, span| {
        let Node::Apply(op, [a, b]) = node else {
            return None;
        };
        let at = old.0 as usize;
        let (exact, args) = (*ranges.exact.get(at)?, *ranges.args.get(at)?);
        let [left, right]: [Range; 2] = args;
        let only = match op.result() {
            Type::Bool => exact.constant().map(|value| Value::Bool(value != 0.0)),
            Type::Int => {
                let sure = |value: &f64| {
                    let often = rates.rate(old).iter().any(|by| *by != Dependence::Frame);
                    often && without_ends.exact[at].constant() == Some(*value)
                };
                let value = exact.constant().filter(sure);
                value.map(|value| Value::Int(value as i32))
            }
            Type::Real => None,
        };
        if let Some(value) = only {
            return Some(builder.constant(value, span));
        }
        match op {
            Op::Min | Op::IntMin if left.hi <= right.lo => Some(a),
            Op::Min | Op::IntMin if right.hi <= left.lo => Some(b),
            Op::Max | Op::IntMax if left.lo >= right.hi => Some(a),
            Op::Max | Op::IntMax if right.lo >= left.hi => Some(b),
            Op::Abs | Op::IntAbs if left.lo >= 0.0 => Some(a),
            // A remainder, or the low bits, of what is below the divisor.
            Op::IntMod if left.lo >= 0.0 && left.hi < right.lo => Some(a),
            Op::BitAnd if is_mask(right) && left.within(0.0, right.lo) => Some(a),
            Op::IntAdd | Op::IntSub
                if exact.within(-WHOLE, WHOLE) && left.within(-WHOLE, WHOLE) =>
            {
                // What is added to a sum that nothing else needs joins it.
                let Node::Apply(_, [sum, _]) = graph.node(old) else {
                    return None;
                };
                let Node::Apply(inner @ (Op::IntAdd | Op::IntSub), [of, first]) = builder.node(a)
                else {
                    return None;
                };
                let signed = |op, id| {
                    let value = builder.value(id)?.real();
                    Some(if op == Op::IntSub { -value } else { value })
                };
                let all = signed(inner, first)? + signed(op, b)?;
                let op = if all < 0.0 { Op::IntSub } else { Op::IntAdd };
                (uses[sum.0 as usize] == 1 && all.abs() < WHOLE).then(|| {
                    let by = builder.constant(Value::Int(all.abs() as i32), span);
                    builder.apply(op, &[of, by], span)
                })
            }
            _ => None,
        }
    })
}
