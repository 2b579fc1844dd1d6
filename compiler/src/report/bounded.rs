//! What is proved of a picture's shades, beside what is measured.

use crate::eval::native::Native;
use crate::plan::Plan;
use crate::plan::error::{Tile, bounds};
use crate::plan::model::ModelRun;

/// About how many pixels are looked at.
const SAMPLE: u32 = 400;

/// How many roundings are followed before the sample is called large enough.
const PATIENCE: u64 = 200_000;

/// How many statements are walked for that, where hardly any rounds.
const WALKED: u64 = 10_000_000;

/// How many statements the two evaluations may run.
const MOST: u64 = 20_000_000;

/// The shades of a sample of pixels, each its own tile.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bounded {
    /// How many pixels were looked at.
    pub looked: usize,
    /// Of how many the shade has a proved bound, and no branch may flip.
    pub proved: usize,
    /// The greatest of those bounds. **Proved.**
    pub bound: f64,
    /// How far those pixels' shades are off at most. **Measured.**
    pub measured: f64,
    /// The median of bound to measured, over the pixels that are off at all.
    pub ratio: Option<f64>,
    /// Pixels that exceed their bound: a fault of ours if there is any.
    pub exceeded: usize,
}

/// Looks at a sample of a plan's pixels. What earlier pixels send is left out.
/// Nothing is looked at where the picture has no shade before its dither.
pub fn bounded(plan: &Plan) -> Bounded {
    let mut plan = plan.clone();
    plan.graph.part_pixels();
    let plan = &plan;
    let Some(shade) = plan.graph.shade else {
        return Bounded::default();
    };
    let (mut native, mut model) = (
        Native::within(&plan.graph, MOST),
        ModelRun::within(plan, MOST),
    );
    let mut made = Bounded::default();
    let mut ratios = Vec::new();
    let (mut followed, mut walked) = (0, 0);
    for (x, y) in sample(plan) {
        if followed > PATIENCE || walked > WALKED {
            break;
        }
        let found = bounds(plan, &Tile::of(plan, (x, x), (y, y)));
        followed += u64::from(found.operations);
        walked += found.walked;
        made.looked += 1;
        let decided = !found.undecided.iter().any(|&id| id < shade);
        let bound = found.of(shade).map_or(f64::INFINITY, |b| b.error);
        if !decided || !bound.is_finite() {
            continue;
        }
        let exact = native.pixel(x as i32, y as i32).shade;
        let off = (model.pixel(x as i32, y as i32).shade - exact).abs();
        if native.spent() || model.spent() {
            break;
        }
        made.proved += 1;
        made.bound = made.bound.max(bound);
        made.measured = made.measured.max(off);
        made.exceeded += usize::from(off > bound);
        if off > 0.0 {
            ratios.push(bound / off);
        }
    }
    ratios.sort_by(f64::total_cmp);
    made.ratio = ratios.get(ratios.len() / 2).copied();
    made
}

/// Pixels all over the picture, in an order of which any beginning is a fair sample.
fn sample(plan: &Plan) -> Vec<(u32, u32)> {
    let (columns, rows) = (plan.columns, plan.rows);
    let (wide, high) = (columns.1 - columns.0 + 1, rows.1 - rows.0 + 1);
    // The golden ratio's multiples fill a row evenly; rows follow one another.
    let step =
        |k: u32, of: u32| ((f64::from(k) * 0.618_033_988_749_895).fract() * f64::from(of)) as u32;
    let count = SAMPLE.min(wide.saturating_mul(high));
    let place = |k: u32| {
        let row = (f64::from(k) * 0.754_877_666_246_692_8).fract() * f64::from(high);
        (columns.0 + step(k, wide), rows.0 + row as u32)
    };
    (0..count).map(place).collect()
}
