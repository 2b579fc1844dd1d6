//! Names of the rows that are kept, where a plan does not trace every pixel.

use super::names::Names;
use crate::ir::graph::Neighbour;
use crate::plan::{KeptRows, Plan};

/// The names of what the rows need.
#[derive(Clone)]
pub(super) struct Refined {
    pub rows: KeptRows,
    pub height: u32,
    /// What neighbours left.
    pub neighbours: [String; 3],
    /// The array, and where in it the rows of the neighbours and the pixel itself begin.
    pub kept: String,
    pub up: String,
    pub down: String,
    pub own: String,
    /// The key row above the band, the last row of the band and the last of all, and how far
    /// neighbours are from the row.
    pub band: String,
    pub till: String,
    pub end: String,
    pub reach: String,
}

impl Refined {
    /// Where a plan does not trace every pixel.
    pub fn new(plan: &Plan, names: &mut Names) -> Option<Refined> {
        Some(Refined {
            rows: plan.kept_rows()?,
            height: plan.graph.image.height,
            neighbours: Neighbour::ALL.map(|which| names.fresh(which.name())),
            kept: names.fresh("kept"),
            up: names.fresh("up"),
            down: names.fresh("down"),
            own: names.fresh("own"),
            band: names.fresh("band"),
            till: names.fresh("till"),
            end: names.fresh("end"),
            reach: names.fresh("reach"),
        })
    }
}
