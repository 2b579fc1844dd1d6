//! The search: which choices are tried, in which order, and what is kept.

use super::cache::Cache;
use super::choice::{Base, Choice, Setting};
use super::goal::Measure;
use super::point::{self, Natives, Point};
use super::rows::{self, Look};
use super::settings::worthwhile;
use crate::failure::{Failure, Outcome};
use crate::jobs;
use crate::measure::Errors;
use crate::progress::Progress;
use crate::scene::Scene;
use serde::{Deserialize, Serialize};
use slowlight_compiler::plan::Plan;
use slowlight_compiler::target;
use std::sync::{Arc, Mutex};

/// What is tuned and how.
pub struct Search {
    /// What stays as the user has it.
    pub base: Base,
    /// The error that decides.
    pub measure: Measure,
    /// Whether params must stay changeable.
    pub live: bool,
    /// Whether to try subroutines for what a program has several times, where it fits
    /// without, too.
    pub outlined: bool,
    /// How many settings go to the machines.
    pub settings: usize,
    /// Cycles after which a machine is given up.
    pub limit: u64,
    /// What is known from before.
    pub cache: Cache,
}

/// What was found so far.
#[derive(Clone, Debug, Default)]
pub struct Found {
    /// Choices that were run whole.
    pub points: Vec<Point>,
    /// Choices that others clearly beat on some rows, and what these said.
    pub left: Vec<(Choice, Look)>,
    /// Choices that cannot be had, and why.
    pub failed: Vec<(Choice, String)>,
    /// How many choices there were.
    pub tried: usize,
}

/// The scene with its params changeable, and folded.
struct Scenes {
    live: Scene,
    frozen: Scene,
}

impl Scenes {
    fn of(&self, choice: &Choice) -> &Scene {
        match choice.frozen {
            true => &self.frozen,
            false => &self.live,
        }
    }
}

/// Searches; what is found goes to `found` as it is found, so that it can be told
/// whenever the user has had enough.
///
/// # Errors
/// Where the scene is wrong, or the user interrupts: what was found until then stays.
pub fn explore(search: &Search, found: &Arc<Mutex<Found>>) -> Outcome<()> {
    let base = &search.base;
    let live = Scene::open(&base.path, &base.changes)?;
    live.warn();
    let frozen = Scene::open(&base.path, &base.changes(true))?;
    let scenes = Scenes { live, frozen };
    let natives = Natives::default();
    let inks = base.screen.mode(base.target, scenes.live.size())?.inks;
    let measure = search.measure;
    let error = |errors: &Errors| measure.of(errors);
    let asked = [
        "settings",
        &format!("{measure:?} {inks} {}", search.settings),
    ];
    let mut words = asked.map(str::to_owned).to_vec();
    words.push(base.changes.text());
    let work = || worthwhile(&scenes.live, &natives, inks, &error, search.settings);
    let settings: Vec<Setting> =
        (search.cache).known_or(&scenes.live, base.target, &words, work)?;
    let choices = choices(search, &scenes, &settings);
    note(found, |f| f.tried = choices.len());
    let progress = Progress::new("choices", 2 * choices.len() as u64);
    let first = jobs::each(&choices, |choice| {
        let begun = begun(search, scenes.of(choice), &natives, choice)?;
        // What takes long is there a second time.
        progress.step(if matches!(begun.first, First::Rows(_)) {
            1
        } else {
            2
        });
        match &begun.first {
            First::Whole(point) => note(found, |f| f.points.push((**point).clone())),
            First::Not(why) => note(found, |f| f.failed.push((choice.clone(), why.clone()))),
            First::Rows(_) => {}
        }
        Ok(begun)
    })?;
    // What cannot be had is told; all else ends the search.
    let first: Vec<Begun> = first.into_iter().collect::<Outcome<_>>()?;
    let looks: Vec<Option<Look>> = first.iter().map(|b| b.first.look(measure)).collect();
    let beaten = |look: &Look| {
        looks
            .iter()
            .flatten()
            .any(|other| other.clearly_beats(look))
    };
    let mut rest = Vec::new();
    for (choice, begun) in choices.into_iter().zip(first) {
        match begun.first {
            First::Rows(look) if beaten(&look) => {
                progress.step(1);
                note(found, |f| f.left.push((choice, look)));
            }
            First::Rows(_) => rest.push((choice, Mutex::new(begun.plan))),
            First::Whole(_) | First::Not(_) => {}
        }
    }
    let each = jobs::each(&rest, |(choice, plan)| {
        let scene = scenes.of(choice);
        let plan = plan.lock().ok().and_then(|mut plan| plan.take());
        let words = base.words(choice);
        let work = || tried(search, scene, &natives, choice, plan);
        let tried: Tried = search.cache.known_or(scene, base.target, &words, work)?;
        progress.step(1);
        note(found, |f| match tried {
            Ok(point) => f.points.push(point),
            Err(why) => f.failed.push((choice.clone(), why)),
        });
        Ok(())
    })?;
    each.into_iter().collect::<Outcome<Vec<()>>>()?;
    Ok(())
}

/// What a first look at a choice came to.
#[derive(Clone, Serialize, Deserialize)]
enum First {
    /// It is quick, so it was run whole.
    Whole(Box<Point>),
    /// It takes long, so some rows were run.
    Rows(Look),
    /// It cannot be had.
    Not(String),
}

impl First {
    fn look(&self, measure: Measure) -> Option<Look> {
        match self {
            First::Whole(point) => Some(Look::of(point, measure)),
            First::Rows(look) => Some(*look),
            First::Not(_) => None,
        }
    }
}

/// The same with the plan, where one was made and is needed again: planning takes long.
struct Begun {
    first: First,
    plan: Option<Plan>,
}

/// Looks at a choice, or remembers what was seen.
fn begun(search: &Search, scene: &Scene, natives: &Natives, choice: &Choice) -> Outcome<Begun> {
    let (base, measure) = (&search.base, search.measure);
    let mut words = base.words(choice);
    words.push(format!("first {measure:?}"));
    let mut kept = None;
    let work = || {
        let tried = base
            .screen(choice)
            .plan(scene, base.target, &[])
            .and_then(|plan| {
                if !rows::pays(&plan) {
                    let point = point::measure(base, scene, natives, choice, plan, search.limit)?;
                    return Ok(First::Whole(Box::new(point)));
                }
                let how = (measure, search.limit);
                let look = rows::look(base, scene, natives, choice, &plan, how)?;
                kept = Some(plan);
                Ok(First::Rows(look))
            });
        match tried {
            Err(Failure::Interrupted) => Err(Failure::Interrupted),
            Err(other) => Ok(First::Not(other.reason())),
            Ok(first) => Ok(first),
        }
    };
    let first = search.cache.known_or(scene, base.target, &words, work)?;
    Ok(Begun { first, plan: kept })
}

fn note(found: &Mutex<Found>, write: impl FnOnce(&mut Found)) {
    if let Ok(mut found) = found.lock() {
        write(&mut found);
    }
}

/// All formats and settings, with params changeable and folded.
fn choices(search: &Search, scenes: &Scenes, settings: &[Setting]) -> Vec<Choice> {
    let has_params = !scenes.live.checked.program.params.is_empty();
    let frozen: &[bool] = match has_params && !search.live {
        true => &[false, true],
        false => &[false],
    };
    let outlined: &[bool] = match search.outlined {
        true => &[false, true],
        false => &[false],
    };
    let mut all = Vec::new();
    for &setting in settings {
        for target in target::formats(search.base.target) {
            for &frozen in frozen {
                for &outlined in outlined {
                    all.push(Choice {
                        setting,
                        format: target.runtime.format.to_owned(),
                        frozen,
                        outlined,
                    });
                }
            }
        }
    }
    all
}

/// A choice's point, or why it cannot be had.
type Tried = Result<Point, String>;

fn tried(
    search: &Search,
    scene: &Scene,
    natives: &Natives,
    choice: &Choice,
    plan: Option<Plan>,
) -> Outcome<Tried> {
    let base = &search.base;
    let plan = match plan {
        Some(plan) => Ok(plan),
        None => base.screen(choice).plan(scene, base.target, &[]),
    };
    let measured = |plan| point::measure(base, scene, natives, choice, plan, search.limit);
    match plan.and_then(measured) {
        Ok(point) => Ok(Ok(point)),
        Err(Failure::Interrupted) => Err(Failure::Interrupted),
        Err(other) => Ok(Err(other.reason())),
    }
}
