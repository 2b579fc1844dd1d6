//! Slots: what a program keeps in memory, by what it is.

use super::moved::Moved;
use crate::ir::graph::*;
use crate::ir::tree::Place;

/// Something that the program keeps in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Slot {
    /// A value, carried value or scratch place of the tree.
    Value(Place),
    /// A value with so many fraction bits instead of its own.
    Moved(Moved),
    /// A param, made a real (or what it is) at the start.
    Param(u32),
    /// The pixel's column or row.
    Axis(Axis),
    /// Where the block that is drawn stands on the screen.
    Block(Axis),
    /// The turns that a loop has left.
    Turns(LoopId),
    /// First and last row to draw.
    Rows(bool),
    /// Which param is being made.
    Which,
    /// A pass's first column, and the last of a run.
    PassFirst,
    RunEnd,
    /// What earlier pixels sent to this one.
    Received,
    /// A value's array by columns.
    Column(NodeId),
    /// A pointer into a row of errors.
    Errors(u32),
    /// Where a screen is memory: the byte whose pixels are gathered, a pointer to where
    /// it goes, and where the row began.
    ScreenByte,
    ScreenAt,
    ScreenLine,
}

/// A run begins at its first column.
pub(super) fn of_axis(axis: Axis) -> Slot {
    match axis {
        Axis::Run => Slot::Axis(Axis::X),
        axis => Slot::Axis(axis),
    }
}
