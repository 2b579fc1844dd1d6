//! What accuracy costs in time, as the page is told it: the points of a search that are worth
//! choosing, as they are found.
//!
//! The search is that of `tune`, by the machines' worker. Its points hang on text, values,
//! machine and mode, and not on the format and the options that are chosen meanwhile: one that
//! is taken while others are still to come does not end the search.

use super::board::Board;
use super::run::Run;
use super::shown::{Dot, Frontier, Shown, Stage};
use crate::failure::{Failure, Outcome};
use crate::scene::{Changes, Scene};
use crate::target_args::ScreenArgs;
use crate::trial::LIMIT;
use crate::tune::cache::Cache;
use crate::tune::choice::{Base, Choice, Setting};
use crate::tune::effort::Effort;
use crate::tune::explore::{Found, explore};
use crate::tune::goal::Measure;
use crate::tune::point::Point;
use crate::tune::rows::Look;
use crate::tune::search::{SETTINGS, Search};
use crate::tune::tell::Told;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};

/// A search begins for a run: it is shown, whatever is chosen from here on.
pub fn begun(shown: &mut Shown, run: &Run) {
    if let Some(panel) = shown.panels.get_mut(run.panel) {
        panel.frontier = Frontier {
            serial: run.serial,
            stage: Stage::Running,
            ..Frontier::default()
        };
    }
}

/// Searches for what is worth choosing, and shows it as it is found; that it has [`begun`] is
/// shown already.
///
/// # Errors
/// As [`explore`]; nothing where the scene has become another meanwhile.
pub fn search(board: &impl Board, run: &Run, scene: &Scene) -> Outcome<()> {
    let base = base(run, scene);
    let search = Search {
        base: base.clone(),
        measure: Measure::Pixels,
        live: false,
        smaller: false,
        settings: usize::from(SETTINGS),
        limit: LIMIT,
        by_line: false,
        effort: Effort::times(1),
        cache: Cache::of_user(),
    };
    let found = Arc::new(Mutex::new(Found::default()));
    let tell = || {
        let Ok(found) = found.lock() else {
            return;
        };
        let told = Told::new(&base, search.measure, &found);
        let dots: Vec<Dot> = told
            .frontier()
            .map(|(_, p)| dot(run, p, told.error(p)))
            .collect();
        let (measured, tried) = (told.points.len(), found.tried.max(told.points.len()));
        show(board, run, |frontier| {
            (frontier.points, frontier.measured, frontier.tried) = (dots, measured, tried);
        });
    };
    let mut hear = |_: &Choice, _: &Look, whole: bool| {
        if whole {
            tell();
        }
    };
    explore(&search, scene.clone(), &found, &mut hear)?;
    // How many ways there are is known once all is.
    tell();
    let found = found.lock().map(|found| found.clone()).unwrap_or_default();
    // Of many reasons that of the plainest way: others may be asked for what is not there.
    let plainest = (found.failed.into_iter()).min_by_key(|(choice, _)| {
        let usual = choice.format == run.target.runtime.format;
        (
            choice.setting != Setting::WHOLE,
            !usual,
            base.words(choice).len(),
        )
    });
    match (found.points.is_empty(), plainest) {
        (true, Some((_, why))) => Err(Failure::Wrong(why)),
        _ => Ok(()),
    }
}

/// How a search ended.
pub fn ended(board: &impl Board, run: &Run, done: Outcome<()>) {
    show(board, run, |frontier| {
        (frontier.stage, frontier.wrong) = match done {
            Ok(()) => (Stage::Done, None),
            Err(Failure::Interrupted) => (Stage::Stopped, None),
            Err(other) => (Stage::Wrong, Some(other.reason())),
        };
    });
}

/// Shows something of the search of a run, unless another has begun since.
fn show(board: &impl Board, run: &Run, change: impl FnOnce(&mut Frontier)) {
    board.show(|shown, _| {
        let panel = shown.panels.get_mut(run.panel);
        let known = panel.filter(|panel| panel.frontier.serial == run.serial);
        if let Some(panel) = known {
            change(&mut panel.frontier);
        }
    });
}

/// What stays as the page has it.
fn base(run: &Run, scene: &Scene) -> Base {
    let value = |(name, values): &(String, Vec<f64>)| {
        let values: Vec<String> = values.iter().map(f64::to_string).collect();
        format!("{name}={}", values.join(","))
    };
    Base {
        path: PathBuf::from(format!("{}.scn", scene.name)),
        changes: Changes {
            set: scene.values().iter().map(value).collect(),
            ..Changes::default()
        },
        target: run.target,
        screen: ScreenArgs {
            mode: run.mode.clone(),
            ..ScreenArgs::default()
        },
    }
}

/// A point as the page has it.
fn dot(run: &Run, point: &Point, error: f64) -> Dot {
    let Point { choice, measured } = point;
    // Its options alone: format, mode and values are chosen elsewhere on the page.
    let plain = Base {
        path: PathBuf::new(),
        changes: Changes::default(),
        target: run.target,
        screen: ScreenArgs::default(),
    };
    let mut words = plain.words(choice);
    if words.first().is_some_and(|word| word == "--format") {
        words.drain(..2);
    }
    Dot {
        format: choice.format.clone(),
        options: words.join(" "),
        seconds: measured.seconds,
        cycles: measured.cycles,
        error,
        unlike_native: measured.errors.pixels,
        unlike_model: measured.differs_from_model,
        memory: measured.memory(),
        mode: measured.mode.clone(),
    }
}
