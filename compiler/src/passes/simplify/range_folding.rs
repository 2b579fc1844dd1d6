//! Range-based simplification (correlated value propagation): what the ranges decide needs no
//! computing.
//!
//! A value that can only be one value is a constant; a minimum or maximum that
//! one side always wins is that side; a select whose condition is decided is
//! its arm.

use crate::analysis::range::Ranges;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild;
use slowlight_routine::{Op, Range, Type, Value};

/// The graph with every decided operation replaced.
pub fn fold_by_ranges(graph: &Graph, ranges: &Ranges) -> Graph {
    rebuild(graph, &mut |builder, old, node, span| {
        let Node::Apply(op, [a, b]) = node else {
            return None;
        };
        let at = old.0 as usize;
        let (exact, args) = (*ranges.exact.get(at)?, *ranges.args.get(at)?);
        let [left, right]: [Range; 2] = args;
        if op.result() == Type::Bool
            && let Some(value) = exact.constant()
        {
            return Some(builder.constant(Value::Bool(value != 0.0), span));
        }
        match op {
            Op::Min | Op::IntMin if left.hi <= right.lo => Some(a),
            Op::Min | Op::IntMin if right.hi <= left.lo => Some(b),
            Op::Max | Op::IntMax if left.lo >= right.hi => Some(a),
            Op::Max | Op::IntMax if right.lo >= left.hi => Some(b),
            Op::Abs | Op::IntAbs if left.lo >= 0.0 => Some(a),
            _ => None,
        }
    })
}
