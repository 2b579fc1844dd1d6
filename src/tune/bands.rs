//! Stratified samples of a picture's rows: bands that stand for all of it.

use crate::estimate;
use slowlight_compiler::plan::Plan;

/// Predicted cycles from which on rows are looked at first: less is run whole in no time.
const LONG: f64 = 1e8;

/// The bands' share of the rows is one in so many, each.
const SHARE: u32 = 24;

/// Whether rows should be looked at before the whole is run. Where errors spread, all rows
/// are computed in any case.
pub fn pays(plan: &Plan) -> bool {
    let rows = plan.rows.1 - plan.rows.0 + 1;
    plan.graph.diffusion.is_none() && rows >= SHARE && estimate::cycles(plan) > LONG
}

/// The bands: first and last row of each.
pub fn bands((first, last): (u32, u32)) -> [(u32, u32); 3] {
    let count = last - first + 1;
    let high = count.div_ceil(SHARE);
    [1, 3, 5].map(|sixth| {
        let top = first
            + (count * sixth / 6)
                .saturating_sub(high / 2)
                .min(count - high);
        (top, top + high - 1)
    })
}
