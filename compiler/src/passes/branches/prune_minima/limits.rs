//! Interval bounds of minima and maxima: what a value must be less than, or greater, and whether
//! it ever is.

use super::Leaf;
use crate::ir::graph::*;
use slowlight_routine::{Op, Range};

impl Leaf {
    /// A range with the sign that its value has.
    pub fn signed(self, range: Range) -> Range {
        match self.negated {
            true => Range::new(-range.hi, -range.lo),
            false => range,
        }
    }
}

/// What a value must be less than, or greater, and between which bounds that is, where they are
/// known.
#[derive(Clone, Copy)]
pub(super) struct Limit {
    pub id: NodeId,
    pub within: Option<Range>,
}

/// Between which bounds the lesser of two values is, or the greater.
pub(super) fn nearer(op: Op, a: Range, c: Range) -> Range {
    match op {
        Op::Min => Range::new(a.lo.min(c.lo), a.hi.min(c.hi)),
        _ => Range::new(a.lo.max(c.lo), a.hi.max(c.hi)),
    }
}

/// Whether most of a limit's range is beyond the end of a value's: where the value is the
/// depth below a ball's surface, say, and the limit how far something else is.
pub(super) fn mostly_beyond(end: f64, is_less: bool, within: Range) -> bool {
    let beyond = if is_less {
        end - within.lo
    } else {
        within.hi - end
    };
    beyond > (within.hi - within.lo) / 2.0
}
