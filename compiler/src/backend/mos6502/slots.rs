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
    /// What a neighbour left.
    Neighbour(Neighbour),
    /// Where not all pixels are traced.
    Sampling(Sampling),
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

/// What goes over rows of which not all pixels are traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Sampling {
    /// Pointers to what the neighbours above and below left, and to the row's own.
    Up,
    Down,
    Own,
    /// The key row above the band, its last row, and the last of all.
    Band,
    Till,
    End,
    /// How far neighbours are from the row.
    Reach,
    /// Whether the row is drawn.
    Seen,
}

impl Sampling {
    /// All of them, in their order.
    pub const ALL: [Sampling; 8] = [
        Sampling::Up,
        Sampling::Down,
        Sampling::Own,
        Sampling::Band,
        Sampling::Till,
        Sampling::End,
        Sampling::Reach,
        Sampling::Seen,
    ];

    /// Its name in a program.
    pub fn name(self) -> &'static str {
        match self {
            Sampling::Up => "kept_above",
            Sampling::Down => "kept_below",
            Sampling::Own => "kept_here",
            Sampling::Band => "band",
            Sampling::Till => "band_till",
            Sampling::End => "rows_till",
            Sampling::Reach => "reach",
            Sampling::Seen => "row_seen",
        }
    }

    /// Whether it is a pointer.
    pub fn points(self) -> bool {
        matches!(self, Sampling::Up | Sampling::Down | Sampling::Own)
    }

    /// Its bytes.
    pub fn bytes(self) -> u16 {
        match self {
            Sampling::Reach | Sampling::Seen => 1,
            _ => 2,
        }
    }
}

/// A run begins at its first column.
pub(super) fn of_axis(axis: Axis) -> Slot {
    match axis {
        Axis::Run => Slot::Axis(Axis::X),
        axis => Slot::Axis(axis),
    }
}
