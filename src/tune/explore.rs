//! The search: which choices are tried, in which order, and what is kept.

use super::bands;
use super::choice::{Choice, Setting};
use super::choices::choices;
use super::effort;
use super::goal::Measure;
use super::looked::{Begun, First, Tried, begun, tried};
use super::planned::Planned;
use super::point::{Natives, Point};
use super::prune::{Predictor, is_first};
use super::rows::Look;
use super::search::Search;
use super::settings::{Asked, Drafted, Drafts, quick_block, worthwhile};
use super::work;
use crate::failure::Outcome;
use crate::fit::TOO_DEAR;
use crate::format::count;
use crate::jobs;
use crate::measure::Errors;
use crate::progress::Progress;
use crate::scene::{Precision, Scene};
use slowlight_compiler::passes::simplify::function_tables::has_periods;
use std::sync::{Arc, Mutex};

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
    /// Choices that would have taken too much work beside the others, and what is expected.
    pub beyond: Vec<(Choice, Look)>,
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

/// Who hears what a choice comes to as soon as that is known, and whether that is of the whole
/// picture: then its point is among what was found.
pub type Hear<'h> = &'h mut dyn FnMut(&Choice, &Look, bool);

impl Scenes {
    fn of(&self, choice: &Choice) -> &Scene {
        match choice.frozen {
            true => &self.frozen,
            false => &self.live,
        }
    }
}

/// A search as it goes on.
struct Going<'s> {
    search: &'s Search,
    scenes: &'s Scenes,
    natives: &'s Natives,
    found: &'s Mutex<Found>,
}

/// A choice that is to be run whole, what is known of it, and its plan.
type Rest = (Choice, Look, Mutex<Option<Planned>>);

/// Searches; what is found goes to `found` as it is found, so that it can be told
/// whenever the user has had enough. The scene is as the search's base changes it.
///
/// # Errors
/// Where the scene is wrong, or the user interrupts: what was found until then stays.
pub fn explore(
    search: &Search,
    scene: Scene,
    found: &Arc<Mutex<Found>>,
    hear: Hear<'_>,
) -> Outcome<()> {
    let frozen = scene.frozen();
    let scenes = Scenes {
        live: scene,
        frozen,
    };
    let going = Going {
        search,
        scenes: &scenes,
        natives: &Natives::default(),
        found,
    };
    let quick = going.quick(hear)?;
    let drafts = going.drafts()?;
    let settings: Vec<Setting> = drafts.chosen.iter().map(|d| d.setting).collect();
    let folds = going.folds();
    let first = |choice: &Choice| is_first(choice, folds);
    let (whole, mut others): (Vec<Choice>, Vec<Choice>) =
        (choices(search, (folds, going.has_functions()?), &settings).into_iter()).partition(first);
    let quick: Vec<(Choice, Begun)> = quick.into_iter().collect();
    others.retain(|choice| quick.iter().all(|(quick, _)| quick != choice));
    note(found, |f| {
        f.tried = whole.len() + others.len() + quick.len();
        (f.drafted, f.whole_work) = (drafts.left.clone(), drafts.whole_work);
    });
    let progress = Progress::new("formats", whole.len() as u64);
    let mut seen = going.begin(whole, &progress, hear)?;
    drop(progress);
    let others = going.worth_a_look(others, &seen, &drafts);
    let progress = Progress::new("choices", others.len() as u64);
    seen.extend(going.begin(others, &progress, hear)?);
    seen.extend(quick);
    drop(progress);
    going.run_whole(going.worth_a_run(seen), hear)
}

impl Going<'_> {
    fn measure(&self) -> Measure {
        self.search.measure
    }

    /// Whether params are folded wherever it does not matter: it is quicker.
    fn folds(&self) -> bool {
        let has_params = !self.scenes.live.checked.program.params.is_empty();
        has_params && !self.search.live
    }

    /// Whether the scene has functions that tables may hold.
    fn has_functions(&self) -> Outcome<bool> {
        let graph = self.scenes.live.graph(None, Precision::NATIVE)?;
        Ok(has_periods(&graph))
    }

    /// A coarse picture, which is there at once: something to look at while settings are
    /// drawn.
    fn quick(&self, hear: Hear<'_>) -> Outcome<Option<(Choice, Begun)>> {
        let Some(block) = quick_block(self.scenes.live.size()) else {
            return Ok(None);
        };
        let setting = Setting {
            block,
            ..Setting::WHOLE
        };
        let choice = Choice {
            setting,
            format: self.search.base.target.runtime.format.to_owned(),
            tables: None,
            frozen: self.folds(),
            outlined: false,
            thrift: 0,
        };
        let begun = self.look(&choice)?;
        self.heard(&choice, &begun.first, hear);
        // Why it cannot be had is said of the whole picture.
        Ok(matches!(begun.first, First::Whole(_)).then_some((choice, begun)))
    }

    /// The settings that are worth a machine's time, or what is remembered of them.
    fn drafts(&self) -> Outcome<Drafts> {
        let Search { base, measure, .. } = self.search;
        let scene = &self.scenes.live;
        let asked = Asked {
            inks: base.screen.mode(base.target, scene)?.inks,
            most: self.search.settings,
            operations: self.search.effort.drafts(),
        };
        let words = ["settings", &format!("{measure:?} {asked:?}")];
        let mut words = words.map(str::to_owned).to_vec();
        words.push(base.changes.text());
        let error = |errors: &Errors| measure.of(errors);
        let work = || worthwhile(scene, self.natives, &error, &asked);
        (self.search.cache).known_or(scene, base.target, &words, work)
    }

    /// A first look at a choice.
    fn look(&self, choice: &Choice) -> Outcome<Begun> {
        begun(self.search, self.scenes.of(choice), self.natives, choice)
    }

    /// What was seen is kept, where it is a point, and told.
    fn heard(&self, choice: &Choice, first: &First, hear: Hear<'_>) {
        match first {
            First::Whole(point) => {
                note(self.found, |f| f.points.push((**point).clone()));
                hear(choice, &Look::of(point, self.measure()), true);
            }
            First::Rows(look) if look.pixels > 0.0 => hear(choice, look, false),
            First::Rows(_) | First::Not(_) | First::Dear => {}
        }
    }

    /// First looks at choices.
    fn begin(
        &self,
        choices: Vec<Choice>,
        progress: &Progress,
        hear: Hear<'_>,
    ) -> Outcome<Vec<(Choice, Begun)>> {
        let look = |choice: &Choice| self.look(choice);
        let begun = jobs::each_told(&choices, look, |choice, begun| {
            progress.step(1);
            let Ok(begun) = begun else {
                return;
            };
            self.heard(choice, &begun.first, hear);
            let why = match &begun.first {
                First::Not(why) => why.as_str(),
                First::Dear => TOO_DEAR,
                First::Whole(_) | First::Rows(_) => return,
            };
            note(self.found, |f| {
                f.failed.push((choice.clone(), why.to_owned()))
            });
        })?;
        // What cannot be had is told; all else ends the search.
        let begun = begun.into_iter().collect::<Outcome<Vec<Begun>>>()?;
        Ok(choices.into_iter().zip(begun).collect())
    }

    /// The choices that may reach the frontier by what is predicted, as many as work allows,
    /// the quickest first.
    fn worth_a_look(
        &self,
        others: Vec<Choice>,
        seen: &[(Choice, Begun)],
        drafts: &Drafts,
    ) -> Vec<Choice> {
        let target = self.search.base.target;
        let looked = |(choice, begun): &'_ (Choice, Begun)| {
            Some((choice.clone(), begun.first.look(self.measure())?))
        };
        let predictor = Predictor {
            known: seen.iter().filter_map(looked).collect(),
            drafts,
            measure: self.measure(),
        };
        let begun = |choice: &Choice| {
            let mut seen = seen.iter();
            Some(&seen.find(|(known, _)| known.format == choice.format)?.1)
        };
        // A format whose plan takes too much does so in other settings.
        let dear = |choice: &Choice| begun(choice).is_some_and(|b| matches!(b.first, First::Dear));
        let others = others.into_iter().filter(|c| !dear(c)).collect();
        let (others, beaten) = predictor.pruned(others);
        let there: Vec<Look> = predictor.known.iter().map(|(_, look)| *look).collect();
        let others: Vec<(Choice, Option<Look>)> = others
            .into_iter()
            .map(|choice| (predictor.predict(&choice), choice))
            .map(|(look, choice)| (choice, look))
            .collect();
        let sorted = effort::by_worth(others, |(_, look)| *look, &there);
        let cost = |(choice, look): &(Choice, Option<Look>)| {
            let cycles = look.map_or(0.0, |look| look.cycles);
            begun(choice).map_or(0.0, |b| b.planning) + bands::of_look(target, cycles)
        };
        // Of memory, too, several ways are tried.
        let most = self.search.effort.looks() * if self.search.smaller { 3.0 } else { 1.0 };
        let (mut taken, left) = effort::within(sorted, cost, most);
        let cycles = |look: &Option<Look>| look.map_or(0.0, |look| look.cycles);
        taken.sort_by(|(_, a), (_, b)| cycles(a).total_cmp(&cycles(b)));
        note(self.found, |f| {
            f.pruned = beaten;
            let left = left.into_iter();
            f.beyond = left
                .filter_map(|(choice, look)| Some((choice, look?)))
                .collect();
        });
        taken.into_iter().map(|(choice, _)| choice).collect()
    }

    /// What of that which takes long is to be run whole, the quickest first.
    fn worth_a_run(&self, seen: Vec<(Choice, Begun)>) -> Vec<Rest> {
        let Search { base, limit, .. } = self.search;
        let measure = self.measure();
        let looks = |(_, begun): &(Choice, Begun)| begun.first.look(measure);
        let looks: Vec<Look> = seen.iter().filter_map(looks).collect();
        let mut there = Vec::new();
        let mut rest: Vec<Rest> = Vec::new();
        for (choice, begun) in seen {
            match begun.first {
                First::Rows(look) if looks.iter().any(|other| other.clearly_beats(&look)) => {
                    note(self.found, |f| f.left.push((choice, look)));
                }
                First::Rows(look) if look.cycles > OVER * *limit as f64 => {
                    let why = over(&look, *limit);
                    note(self.found, |f| f.failed.push((choice, why)));
                }
                First::Rows(look) => rest.push((choice, look, Mutex::new(begun.plan))),
                First::Whole(point) => there.push(Look::of(&point, measure)),
                First::Not(_) | First::Dear => {}
            }
        }
        let sorted = effort::by_worth(rest, |(_, look, _)| Some(*look), &there);
        let cost = |(_, look, _): &Rest| work::of_cycles(base.target, look.cycles);
        let (mut taken, left) = effort::within(sorted, cost, self.search.effort.wholes());
        taken.sort_by(|(_, a, _), (_, b, _)| a.cycles.total_cmp(&b.cycles));
        let left = left.into_iter().map(|(choice, look, _)| (choice, look));
        note(self.found, |f| f.beyond.extend(left));
        taken
    }

    /// Runs whole pictures.
    fn run_whole(&self, rest: Vec<Rest>, hear: Hear<'_>) -> Outcome<()> {
        let base = &self.search.base;
        let cycles = |look: &Look| (look.cycles / 1e6) as u64;
        let all = rest.iter().map(|(_, look, _)| cycles(look)).sum();
        let progress = Progress::new("whole pictures", all);
        let work = |(choice, _, plan): &Rest| {
            let scene = self.scenes.of(choice);
            let plan = plan.lock().ok().and_then(|mut plan| plan.take());
            let words = self.search.words(choice);
            let work = || tried(self.search, scene, self.natives, choice, plan);
            (self.search.cache).known_or(scene, base.target, &words, work)
        };
        let each = jobs::each_told(&rest, work, |(choice, look, _), tried| {
            progress.step(cycles(look));
            let Ok(tried) = tried else {
                return;
            };
            note(self.found, |f| match tried {
                Ok(point) => f.points.push(point.clone()),
                Err(why) => f.failed.push((choice.clone(), why.clone())),
            });
            if let Ok(point) = tried {
                hear(choice, &Look::of(point, self.measure()), true);
            }
        })?;
        each.into_iter().collect::<Outcome<Vec<Tried>>>()?;
        Ok(())
    }
}

/// By how much a few rows must exceed the limit for the whole not to be run: they may be
/// dearer than others.
const OVER: f64 = 1.25;

/// What is said of a choice that takes more.
fn over(look: &Look, limit: u64) -> String {
    let (cycles, limit) = (count(look.cycles as u64), count(limit));
    format!(
        "by three bands of its rows it takes {cycles} cycles, and {limit} are the limit (--limit)"
    )
}

fn note(found: &Mutex<Found>, write: impl FnOnce(&mut Found)) {
    if let Ok(mut found) = found.lock() {
        write(&mut found);
    }
}
