//! A first look: what would take long is run on a few rows before it is run whole.
//!
//! The rows are three bands, in the middle of each third of the picture. What the planner
//! predicts of the bands and of the whole is compared with what the bands took, so that
//! neither a dear band nor what a program does at its start misleads. What others clearly
//! beat by these figures is not run whole; that is all they are for.

use super::bands::{LONG, bands_of};
use super::choice::{Base, Choice};
use super::goal::Measure;
use super::planned::Planned;
use super::point::{Natives, Point};
use crate::draw::Window;
use crate::failure::{Failure, Outcome};
use crate::format::count;
use crate::scene::Scene;
use crate::{estimate, measure, trial};
use serde::{Deserialize, Serialize};

/// By how much another must be cheaper and better, as figures of a few rows are not exact.
const CLEARLY: f64 = 0.8;

/// How many times the limit the planner must expect for it to be believed unseen.
const FAR: f64 = 1.5;

/// What some rows say of a choice.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Look {
    /// Cycles of the whole picture, as far as rows can say.
    pub cycles: f64,
    /// Those of them before the first row, by the planner's figures.
    pub before: f64,
    /// The error on the rows.
    pub error: f64,
    /// How many pixels were looked at.
    pub pixels: f64,
}

impl Look {
    /// The same figures of a whole picture.
    pub fn of(point: &Point, measure: Measure) -> Look {
        Look {
            cycles: point.measured.cycles as f64,
            before: point.measured.before,
            error: measure.of(&point.measured.errors),
            pixels: point.measured.errors.count as f64,
        }
    }

    /// Whether it is so much cheaper and better than another that the whole pictures will
    /// be, too: by a fifth in both, and by more than counts of pixels vary by chance.
    pub fn clearly_beats(&self, other: &Look) -> bool {
        let chance = |look: &Look| 3.0 * (look.error / look.pixels.max(1.0)).sqrt();
        self.cycles < CLEARLY * other.cycles
            && self.error < CLEARLY * other.error
            && self.error + chance(self) < other.error - chance(other)
    }
}

/// Where rows cannot be looked at, the planner's figures say what is not begun at all.
///
/// # Errors
/// Where they are far beyond the limit: what they are.
pub fn hopeless(planned: &Planned, limit: u64) -> Outcome<()> {
    let predicted = planned.cycles();
    if !planned.plan.graph.is_in_order() || predicted <= FAR * limit as f64 {
        return Ok(());
    }
    let (cycles, limit) = (count(predicted as u64), count(limit));
    Err(Failure::Wrong(format!(
        "the planner expects {cycles} cycles, and {limit} are the limit (--limit)"
    )))
}

/// What is expected of a plan that takes long and of which no rows are run alone: nothing of
/// its error.
pub fn unseen(planned: &Planned) -> Option<Look> {
    let whole = planned.plan.graph.is_in_order();
    (whole && planned.cycles() > LONG).then(|| Look {
        cycles: planned.cycles(),
        before: estimate::before(&planned.plan),
        error: 0.0,
        pixels: 0.0,
    })
}

/// Looks at a plan's bands on its machine.
///
/// # Errors
/// As for a run of the whole.
pub fn look(
    base: &Base,
    scene: &Scene,
    natives: &Natives,
    choice: &Choice,
    planned: &Planned,
    (measure, limit): (Measure, u64),
) -> Outcome<Look> {
    let plan = &planned.plan;
    let machine = base.screen(choice).machine(plan.target);
    let (mut took, mut predicted, mut squares, mut pixels) = (0.0, 0.0, 0.0, 0.0);
    for rows in bands_of(planned) {
        let band = planned.band(rows);
        predicted += estimate::cycles_roughly(&band);
        let loaded = trial::build_for(&band, machine)?.loaded;
        let run = trial::ran(scene, &band, loaded, limit)?;
        took += run.cycles as f64;
        let native = natives.of(scene, band.mode.inks, Window::on_screen(&band))?;
        let modelled = planned.modelled(rows, measure == Measure::Rmse)?;
        let tried = trial::held_with(scene, band, run, (*native).clone(), modelled)?;
        let inks = tried.picture.as_ref().map_or(&[][..], |p| &p.inks);
        let levels = tried.plan.graph.image.palette.len();
        let (width, shades) = (native.window.width(), &tried.modelled.pixels);
        let errors = measure::errors(width, inks, shades, &native.pixels, levels);
        let count = errors.count as f64;
        squares += measure.of(&errors).powf(power(measure)) * count;
        pixels += count;
    }
    Ok(Look {
        cycles: took / predicted.max(1.0) * planned.cycles(),
        before: estimate::before(plan),
        error: (squares / pixels.max(1.0)).powf(1.0 / power(measure)),
        pixels,
    })
}

/// Of which power errors are means.
fn power(measure: Measure) -> f64 {
    match measure {
        Measure::Pixels => 1.0,
        Measure::Rmse | Measure::Lowpass => 2.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tune::bands::bands;
    use slowlight_compiler::plan::Goal;
    use slowlight_compiler::planner::plan;

    #[test]
    fn bands_are_inside_and_apart() {
        for (first, last) in [(0, 255), (9, 239), (0, 23), (100, 124)] {
            let bands = bands((first, last), 24);
            assert!(bands[0].0 >= first && bands[2].1 <= last, "{bands:?}");
            assert!(
                bands[0].1 < bands[1].0 && bands[1].1 < bands[2].0,
                "{bands:?}"
            );
        }
    }

    #[test]
    fn what_is_far_beyond_the_limit_is_not_begun() {
        let text = "image 9 x 9 inks black, white;\ndither d(v: real, x: int, y: int) -> ink = \
            { let q = round(v); spread v - q to { (1, 0): 1 }; ink(q) };\n\
            draw (x, y) = d(x / 9, x, y);\n";
        let scene = slowlight_compiler::scene::check("spread", text);
        let graph = scene.lower(&Default::default()).expect("a graph");
        let target = slowlight_compiler::targets::find("jack").expect("a target");
        let goal = Goal {
            name: "spread".to_owned(),
            mode: target.modes[0],
            rows: None,
            plot: true,
        };
        let plan = plan(&graph, target, &goal).expect("a plan");
        let planned = Planned::new(plan);
        let predicted = planned.cycles() as u64;
        assert!(hopeless(&planned, predicted).is_ok());
        assert!(hopeless(&planned, predicted / 4).is_err());
    }

    #[test]
    fn few_pixels_prove_little() {
        let look = |cycles, error, pixels| Look {
            cycles,
            before: 0.0,
            error,
            pixels,
        };
        // 4 of 16,000 pixels, or 15.
        let (few, more) = (look(1e8, 4.0 / 16e3, 16e3), look(2e8, 9.0 / 16e3, 16e3));
        assert!(!few.clearly_beats(&more) && !more.clearly_beats(&few));
        let many = look(2e8, 0.2, 16e3);
        assert!(few.clearly_beats(&many));
        assert!(!many.clearly_beats(&few));
        assert!(!look(1.9e8, 0.0, 16e3).clearly_beats(&many));
    }
}
