//! Stratified samples of a picture's rows: bands that stand for all of it.

use super::planned::Planned;
use super::work;
use slowlight_compiler::plan::Plan;
use slowlight_compiler::targets::Target;

/// Predicted cycles from which on rows are looked at first: less is run whole in no time.
pub const LONG: f64 = 1e8;

/// The bands' share of the rows is one in so many, each; the first whose rows take little work
/// enough, or the last.
const SHARES: [u32; 4] = [24, 48, 96, 192];

/// What three bands may take, as [`work`] counts it.
const MOST: f64 = 6e8;

/// What it takes to estimate a plan that takes long.
const ESTIMATED: f64 = 5e8;

/// Whether rows should be looked at before the whole is run. Where pixels hang on others,
/// more rows than those are computed, so the whole is run.
pub fn pays(planned: &Planned) -> bool {
    let plan = &planned.plan;
    let rows = plan.rows.1 - plan.rows.0 + 1;
    !plan.graph.is_in_order() && rows >= SHARES[0] && planned.cycles() > LONG
}

/// The bands of a plan: the dearer, the fewer of its rows.
pub fn bands_of(planned: &Planned) -> [(u32, u32); 3] {
    let plan: &Plan = &planned.plan;
    let work = work::of_cycles(plan.target, planned.cycles());
    bands(plan.rows, share(3.0 * work, MOST))
}

/// What a first look takes at a plan of so many cycles, once it is made.
pub fn of_look(target: &Target, cycles: f64) -> f64 {
    let all = work::of_cycles(target, cycles);
    match cycles > LONG {
        true => ESTIMATED + 3.0 * all / f64::from(share(3.0 * all, MOST)),
        false => all,
    }
}

/// The share of rows, one in so many, that takes no more than so much of what all rows take; the
/// least share that is looked at where none does.
pub fn share(all: f64, most: f64) -> u32 {
    let mut shares = SHARES.into_iter();
    let fits = shares.find(|share| all / f64::from(*share) <= most);
    fits.unwrap_or(SHARES[SHARES.len() - 1])
}

/// The bands, each of one row in so many: first and last row.
pub fn bands((first, last): (u32, u32), share: u32) -> [(u32, u32); 3] {
    let count = last - first + 1;
    let high = count.div_ceil(share);
    [1, 3, 5].map(|sixth| {
        let top = first
            + (count * sixth / 6)
                .saturating_sub(high / 2)
                .min(count - high);
        (top, top + high - 1)
    })
}
