//! What each effect costs on a machine, and what the picture owes to it.
//!
//! A called effect is left out (`--without`), and everything is done again: planning,
//! running, both evaluations. What that changes is the effect's, whatever it calls
//! included. An effect that is not called is shown to cost nothing: its item is
//! taken out of its file, and the program is compiled once more.

use crate::auto_format;
use crate::digest;
use crate::draw::Window;
use crate::explain::{Counted, count_lines};
use crate::failure::Outcome;
use crate::jobs;
use crate::measure;
use crate::progress::Progress;
use crate::scene::{Precision, Scene};
use crate::target_args::ScreenArgs;
use crate::trial::{self, Trial};
use serde::Serialize;
use slowlight_compiler::ir::graph::Graph;
use slowlight_compiler::passes::pixel_blocks::pixel_blocks;
use slowlight_compiler::plan::Plan;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::report::effects::{Effect, Own, Seen, Turns, effects, own, turns, watch};
use slowlight_compiler::targets::Target;

/// Rows and columns of the sample that is watched in the model.
const GRID: u32 = 48;

/// A scene's effects on a target.
pub struct Effects {
    /// The whole scene's trial.
    pub whole: Trial,
    /// The same, by lines.
    pub counted: Counted,
    /// Pixels watched in the model.
    pub watched: usize,
    /// The effects, the scene's first.
    pub rows: Vec<Row>,
    /// What is saved where the ink is known without the whole shade.
    pub known: Known,
}

/// What is saved where the ink is known without the whole shade: against the same program
/// with every shade in full.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Known {
    /// Cycles less.
    pub cycles_saved: i64,
    /// Inks that differ: none but by rounding elsewhere, as each is another program.
    pub inks_changed: Option<usize>,
}

/// An effect.
pub struct Row {
    /// Which.
    pub effect: Effect,
    /// What is known of it.
    pub found: Found,
}

/// What is known of an effect.
pub enum Found {
    /// It is called.
    Called(Box<Called>),
    /// It is not: the digests of the program from the compiler as it is, and from one
    /// without that effect; none where something else needs it.
    Absent([Option<String>; 2]),
}

/// A called effect.
pub struct Called {
    /// What is less without it: code, tables, variables; what is not known is absent.
    pub sizes: [Option<i64>; 3],
    /// Cycles less without it.
    pub cycles: i64,
    /// What of the program is its own.
    pub own: Own,
    /// The machine's cycles of its own at each pixel, and where rows begin, in any order;
    /// none where they cannot be told apart.
    pub pixels: Option<Vec<u64>>,
    /// What the model shows.
    pub seen: Seen,
    /// Its loops, as the scene has them.
    pub turns: Turns,
    /// What the picture loses without it.
    pub loss: Loss,
}

impl Called {
    /// What an effect costs that is not called.
    pub fn nothing() -> Called {
        Called {
            sizes: [Some(0); 3],
            cycles: 0,
            own: Own::default(),
            pixels: None,
            seen: Seen::default(),
            turns: Turns::default(),
            loss: Loss {
                rmse: 0.0,
                psnr: None,
                pixels: Some(0),
            },
        }
    }
}

/// How far a picture is from that without an effect.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Loss {
    /// Of the native shades.
    rmse: f64,
    /// In dB; null where the shades are equal.
    psnr: Option<f64>,
    /// Inks that differ on the machine; null where nothing is drawn, or in other inks.
    pixels: Option<usize>,
}

impl Loss {
    /// Inks that differ on the machine.
    pub fn pixels(&self) -> Option<usize> {
        self.pixels
    }

    /// In dB.
    pub fn psnr(&self) -> Option<f64> {
        self.psnr
    }
}

/// A job: one effect to look at.
struct Job<'s> {
    scene: &'s Scene,
    target: &'static Target,
    screen: &'s ScreenArgs,
    limit: u64,
    whole: &'s Trial,
    digest: &'s str,
}

/// Looks at all effects.
///
/// # Errors
/// Where the scene, with or without one of them, does not compile, fit or end by itself.
pub fn look(
    scene: &Scene,
    target: &'static Target,
    screen: &ScreenArgs,
    limit: u64,
) -> Outcome<Effects> {
    let plan = auto_format::plan(screen, scene, target)?.said();
    // Everything else is held against that, in its format.
    let screen = &screen.like(&plan);
    let mut counted = count_lines(scene, plan.clone(), screen, limit)?;
    let computed = Window::of(&plan).count();
    let pixels = sample(&plan);
    let (mut seen, watched) = watch(&plan, &pixels);
    let pixels = &pixels[..watched];
    let mut turns = turns(&as_written(scene, &plan, screen)?, pixels);
    let mut own = own(counted.measured());
    let digest = digest::program(&plan);
    let all = effects(&scene.checked, &plan.graph);
    let whole = tried(scene, plan, screen, limit)?;
    let job = Job {
        scene,
        target,
        screen,
        limit,
        whole: &whole,
        digest: &digest,
    };
    let known = job.known()?;
    let progress = Progress::new("effects", all.len() as u64);
    let done = jobs::each(&all, |effect| {
        let found = match effect.calls {
            0 => job.absent(effect),
            _ => job.called(effect),
        };
        progress.step(1);
        found
    })?;
    drop(progress);
    let mut rows = Vec::new();
    for (effect, found) in all.into_iter().zip(done) {
        let mut found = found?;
        if let Found::Called(called) = &mut found {
            called.pixels = counted.stretches.as_mut().map(|all| {
                let mut own = all.remove(&effect.number).unwrap_or_default();
                // At all other pixels it did nothing.
                own.resize(own.len().max(computed), 0);
                own
            });
            called.own = own.remove(&effect.number).unwrap_or_default();
            called.seen = seen.remove(&effect.number).unwrap_or_default();
            called.seen.cycles.resize(watched, 0);
            called.turns = turns.remove(&effect.number).unwrap_or_default();
        }
        rows.push(Row { effect, found });
    }
    Ok(Effects {
        whole,
        counted,
        watched,
        rows,
        known,
    })
}

/// The graph that a plan was made from, before anything was done to it.
fn as_written(scene: &Scene, plan: &Plan, screen: &ScreenArgs) -> Outcome<Graph> {
    let inks = Some(plan.mode.inks);
    let graph = scene.graph_within(inks, Precision::NATIVE, &[], screen.limits())?;
    Ok(pixel_blocks(&graph, plan.graph.image.block))
}

/// A plan's program on its machine.
fn tried(scene: &Scene, plan: PlannedScene, screen: &ScreenArgs, limit: u64) -> Outcome<Trial> {
    let loaded = trial::build_for(&plan, screen.machine(plan.target))?.loaded;
    trial::run(scene, plan, &[], loaded, limit)
}

impl Job<'_> {
    /// What an effect that is called costs, by leaving it out.
    fn called(&self, effect: &Effect) -> Outcome<Found> {
        let scene = self.scene.leaving_out(&effect.name);
        let plan = self.screen.plan(&scene, self.target, &[])?;
        let without = tried(&scene, plan, self.screen, self.limit)?;
        let (with, less) = (&self.whole.run, &without.run);
        let sizes = [
            (with.sizes.code, less.sizes.code),
            (with.sizes.tables, less.sizes.tables),
            (with.sizes.ram, less.sizes.ram),
        ];
        Ok(Found::Called(Box::new(Called {
            sizes: sizes.map(|(with, less)| Some(change(with?, less?))),
            cycles: change(with.cycles, less.cycles),
            own: Own::default(),
            pixels: None,
            seen: Seen::default(),
            turns: Turns::default(),
            loss: self.loss(&without),
        })))
    }

    fn loss(&self, without: &Trial) -> Loss {
        let rmse = measure::rmse(&self.whole.native.pixels, &without.native.pixels);
        Loss {
            rmse,
            psnr: measure::psnr(rmse),
            pixels: self.changed(without),
        }
    }

    /// Inks of another picture that are not the whole's; none where they cannot be compared.
    fn changed(&self, other: &Trial) -> Option<usize> {
        let inks = |trial: &Trial| trial.plan.graph.image.palette.len();
        let (with, less) = self.whole.picture.as_ref().zip(other.picture.as_ref())?;
        let same = inks(self.whole) == inks(other) && with.inks.len() == less.inks.len();
        let pairs = with.inks.iter().zip(&less.inks);
        same.then(|| pairs.filter(|(a, b)| a != b).count())
    }

    /// The program that computes every shade in full, beside this one.
    fn known(&self) -> Outcome<Known> {
        let screen = ScreenArgs {
            every_shade: true,
            ..self.screen.clone()
        };
        let plan = screen.plan(self.scene, self.target, &[])?;
        if digest::program(&plan) == self.digest {
            return Ok(Known {
                cycles_saved: 0,
                inks_changed: Some(0),
            });
        }
        let full = tried(self.scene, plan, &screen, self.limit)?;
        Ok(Known {
            cycles_saved: change(full.run.cycles, self.whole.run.cycles),
            inks_changed: self.changed(&full),
        })
    }

    /// What an effect that is not called costs: the program of a compiler without it.
    fn absent(&self, effect: &Effect) -> Outcome<Found> {
        let digest = match self.scene.without_item(effect.span) {
            Some(scene) => {
                let plan = self.screen.plan(&scene, self.target, &[])?;
                Some(digest::program(&plan))
            }
            None => None,
        };
        Ok(Found::Absent([Some(self.digest.to_owned()), digest]))
    }
}

fn change(with: u64, without: u64) -> i64 {
    let whole = |n: u64| i64::try_from(n).unwrap_or(i64::MAX);
    whole(with).saturating_sub(whole(without))
}

/// Pixels evenly over what is drawn, row by row.
fn sample(plan: &Plan) -> Vec<(i32, i32)> {
    let window = Window::of(plan);
    match plan.graph.is_in_order() {
        // Pixels want those before them.
        true => window.grid(GRID),
        false => window.grid_coarse_first(GRID),
    }
}

/// The middle value and that which one in a hundred exceeds.
pub fn quantiles(values: &[u64]) -> [u64; 2] {
    let mut sorted = values.to_vec();
    sorted.sort_unstable();
    [50, 99].map(|percent| {
        let at = (sorted.len() * percent).div_ceil(100).saturating_sub(1);
        sorted.get(at).copied().unwrap_or(0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_values() {
        assert_eq!(quantiles(&[]), [0, 0]);
        assert_eq!(quantiles(&[7]), [7, 7]);
        let hundred: Vec<u64> = (1..=100).rev().collect();
        assert_eq!(quantiles(&hundred), [50, 99]);
    }

    #[test]
    fn changes_have_signs() {
        assert_eq!(change(5, 3), 2);
        assert_eq!(change(3, 5), -2);
    }
}
