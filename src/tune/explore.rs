//! The search: which choices are tried, in which order, and what is kept.

use super::bands;
use super::cache::Cache;
use super::choice::{Base, Choice, Setting};
use super::goal::{Measure, percent};
use super::planned::Planned;
use super::point::{self, Natives, Point};
use super::prune::{Predictor, is_first};
use super::rows::{self, Look};
use super::settings::{Drafted, Drafts, worthwhile};
use crate::failure::{Failure, Outcome};
use crate::format::{count, duration};
use crate::jobs;
use crate::measure::Errors;
use crate::progress::{self, Progress};
use crate::scene::Scene;
use serde::{Deserialize, Serialize};
use slowlight_compiler::planner::THRIFTS;
use slowlight_compiler::targets;
use std::sync::{Arc, Mutex};

/// What is tuned and how.
pub struct Search {
    /// What stays as the user has it.
    pub base: Base,
    /// The error that decides.
    pub measure: Measure,
    /// Whether params must stay changeable.
    pub live: bool,
    /// Whether to try smaller programs where what is quickest fits, too.
    pub smaller: bool,
    /// How many settings go to the machines.
    pub settings: usize,
    /// Cycles after which a machine is given up.
    pub limit: u64,
    /// Whether to tell what each point's time goes to.
    pub by_line: bool,
    /// What is known from before.
    pub cache: Cache,
}

impl Search {
    /// When a machine is given up, and whether its lines are counted.
    fn how(&self) -> (u64, bool) {
        (self.limit, self.by_line)
    }

    /// Says on a terminal what a choice comes to as soon as that is known.
    fn tell(&self, choice: &Choice, look: &Look, about: &str) {
        let time = duration(look.cycles / self.base.hertz());
        let (error, phrase) = (percent(look.error), self.measure.phrase());
        let options = self.base.words(choice).join(" ");
        progress::say(&format!("{about}{time}, {error} {phrase}: {options}"));
    }

    /// What the figures of a choice depend on: its options, and when a machine is given up.
    fn words(&self, choice: &Choice) -> Vec<String> {
        let mut words = self.base.words(choice);
        words.push(format!("limit {}", self.limit));
        if !self.by_line {
            words.push("not by line".to_owned());
        }
        words
    }
}

/// What was found so far.
#[derive(Clone, Debug, Default)]
pub struct Found {
    /// Choices that were run whole.
    pub points: Vec<Point>,
    /// Settings that were drawn in `f64` only.
    pub drafted: Vec<Drafted>,
    /// Operations of the scene as written, in `f64`.
    pub whole_work: u64,
    /// Choices that others are expected to beat clearly, by figures of other choices.
    pub pruned: Vec<(Choice, Look)>,
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
    let inks = base.screen.mode(base.target, &scenes.live)?.inks;
    let measure = search.measure;
    let error = |errors: &Errors| measure.of(errors);
    let asked = [
        "settings",
        &format!("{measure:?} {inks} {}", search.settings),
    ];
    let mut words = asked.map(str::to_owned).to_vec();
    words.push(base.changes.text());
    let work = || worthwhile(&scenes.live, &natives, inks, &error, search.settings);
    let drafts: Drafts = (search.cache).known_or(&scenes.live, base.target, &words, work)?;
    let settings: Vec<Setting> = drafts.chosen.iter().map(|d| d.setting).collect();
    let (whole, others): (Vec<Choice>, Vec<Choice>) =
        (choices(search, &scenes, &settings).into_iter()).partition(is_first);
    note(found, |f| {
        f.tried = whole.len() + others.len();
        (f.drafted, f.whole_work) = (drafts.left.clone(), drafts.whole_work);
    });
    let begin = |choices: &[Choice], progress: &Progress| {
        let begun = jobs::each(choices, |choice| {
            let begun = begun(search, scenes.of(choice), &natives, choice)?;
            // What takes long is there a second time.
            progress.step(if matches!(begun.first, First::Rows(_)) {
                1
            } else {
                2
            });
            match &begun.first {
                First::Whole(point) => {
                    search.tell(choice, &Look::of(point, measure), "");
                    note(found, |f| f.points.push((**point).clone()));
                }
                First::Not(why) => note(found, |f| f.failed.push((choice.clone(), why.clone()))),
                First::Rows(look) => search.tell(choice, look, "about "),
            }
            Ok(begun)
        })?;
        // What cannot be had is told; all else ends the search.
        begun.into_iter().collect::<Outcome<Vec<Begun>>>()
    };
    let progress = Progress::new("formats", 2 * whole.len() as u64);
    let mut first = begin(&whole, &progress)?;
    drop(progress);
    let looked = |(choice, begun): (_, &Begun)| Some((choice, begun.first.look(measure)?));
    let (others, beaten) = Predictor {
        known: whole.iter().zip(&first).filter_map(looked).collect(),
        drafts: &drafts,
        measure,
    }
    .pruned(others);
    note(found, |f| f.pruned = beaten);
    let long = first.iter().filter(|b| matches!(b.first, First::Rows(_)));
    let progress = Progress::new("choices", (2 * others.len() + long.count()) as u64);
    first.extend(begin(&others, &progress)?);
    let choices = [whole, others].concat();
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
            First::Rows(look) if look.cycles > OVER * search.limit as f64 => {
                progress.step(1);
                let (cycles, limit) = (count(look.cycles as u64), count(search.limit));
                let why = format!(
                    "by three bands of its rows it takes {cycles} cycles, and {limit} are the \
                     limit (--limit)"
                );
                note(found, |f| f.failed.push((choice, why)));
            }
            First::Rows(_) => rest.push((choice, Mutex::new(begun.plan))),
            First::Whole(_) | First::Not(_) => {}
        }
    }
    let each = jobs::each(&rest, |(choice, plan)| {
        let scene = scenes.of(choice);
        let plan = plan.lock().ok().and_then(|mut plan| plan.take());
        let words = search.words(choice);
        let work = || tried(search, scene, &natives, choice, plan);
        let tried: Tried = search.cache.known_or(scene, base.target, &words, work)?;
        progress.step(1);
        if let Ok(point) = &tried {
            search.tell(choice, &Look::of(point, measure), "");
        }
        note(found, |f| match tried {
            Ok(point) => f.points.push(point),
            Err(why) => f.failed.push((choice.clone(), why)),
        });
        Ok(())
    })?;
    each.into_iter().collect::<Outcome<Vec<()>>>()?;
    Ok(())
}

/// By how much a few rows must exceed the limit for the whole not to be run: they may be
/// dearer than others.
const OVER: f64 = 1.25;

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
    plan: Option<Planned>,
}

/// Looks at a choice, or remembers what was seen.
fn begun(search: &Search, scene: &Scene, natives: &Natives, choice: &Choice) -> Outcome<Begun> {
    let (base, measure) = (&search.base, search.measure);
    let mut words = search.words(choice);
    words.push(format!("first {measure:?}"));
    let mut kept = None;
    let work = || {
        let tried = base
            .screen(choice)
            .plan(scene, base.target, &[])
            .map(Planned::new)
            .and_then(|planned| {
                rows::hopeless(&planned.plan, search.limit)?;
                if !bands::pays(&planned.plan) {
                    let point =
                        point::measure(base, scene, natives, choice, planned, search.how())?;
                    return Ok(First::Whole(Box::new(point)));
                }
                let how = (measure, search.limit);
                let look = rows::look(base, scene, natives, choice, &planned, how)?;
                kept = Some(planned);
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

/// Ways to a smaller program: subroutines, or how much less memory is spent on speed.
const SMALLER: [(bool, u8); 5] = {
    let last = THRIFTS as u8 - 1;
    [
        (false, 0),
        (false, last / 3),
        (false, last * 2 / 3),
        (false, last),
        (true, 0),
    ]
};

/// All formats and settings, with params changeable and folded.
fn choices(search: &Search, scenes: &Scenes, settings: &[Setting]) -> Vec<Choice> {
    let has_params = !scenes.live.checked.program.params.is_empty();
    let frozen: &[bool] = match has_params && !search.live {
        true => &[false, true],
        false => &[false],
    };
    let smaller: &[(bool, u8)] = match search.smaller {
        true => &SMALLER,
        false => &SMALLER[..1],
    };
    let mut all = Vec::new();
    for &setting in settings {
        for target in targets::formats(search.base.target) {
            for &frozen in frozen {
                for &(outlined, thrift) in smaller {
                    all.push(Choice {
                        setting,
                        format: target.runtime.format.to_owned(),
                        frozen,
                        outlined,
                        thrift,
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
    plan: Option<Planned>,
) -> Outcome<Tried> {
    let base = &search.base;
    let plan = match plan {
        Some(plan) => Ok(plan),
        None => (base.screen(choice).plan(scene, base.target, &[])).map(Planned::new),
    };
    let measured = |plan| point::measure(base, scene, natives, choice, plan, search.how());
    match plan.and_then(measured) {
        Ok(point) => Ok(Ok(point)),
        Err(Failure::Interrupted) => Err(Failure::Interrupted),
        Err(other) => Ok(Err(other.reason())),
    }
}
