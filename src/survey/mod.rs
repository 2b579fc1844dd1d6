//! A survey: several scenes tuned on several machines, as one document that says what
//! accuracy costs in time.
//!
//! The document is a pure function of the program, the scenes and the options: what a host
//! is comes into one line, and no figure depends on it. Every row has the options by which
//! it is had again, and the digest of the program that they make, so that a reader, or a
//! test, sees whether the document is still true.

pub mod by_scene;
pub mod document;
pub mod part;
pub mod section;

use crate::failure::{Failure, Outcome};
use crate::progress::Progress;
use crate::scene::{Changes, Scene};
use crate::target_args::ScreenArgs;
use crate::tune::cache::Cache;
use crate::tune::choice::{Base, Choice};
use crate::tune::effort::Effort;
use crate::tune::explore::{Found, explore};
use crate::tune::goal::Measure;
use crate::tune::marks;
use crate::tune::rows::Look;
use crate::tune::search::Search;
use crate::tune::tell::Told;
use by_scene::ByScene;
use part::Shard;
use section::Section;
use slowlight_compiler::targets::Target;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

/// What is surveyed.
pub struct Survey {
    /// The scenes' files.
    pub scenes: Vec<PathBuf>,
    /// The machines.
    pub targets: Vec<&'static Target>,
    /// The error that decides.
    pub measure: Measure,
    /// Settings tried in each format.
    pub settings: ByScene,
    /// Cycles after which a machine is given up.
    pub limit: ByScene,
    /// Whether what was measured before is looked up.
    pub cached: bool,
    /// The part that is done; all where there is none.
    pub shard: Option<Shard>,
}

impl Survey {
    /// Those of [`Survey::all`] that are of this part, with their places.
    fn own(&self) -> impl Iterator<Item = (usize, Base)> {
        let all = self.all().enumerate();
        all.filter(|(place, _)| self.shard.is_none_or(|shard| shard.has(*place)))
    }

    /// Each scene on each machine, in the document's order.
    fn all(&self) -> impl Iterator<Item = Base> {
        (self.scenes.iter())
            .flat_map(|path| (self.targets.iter()).map(move |target| base(path, target)))
    }
}

/// Tunes each scene on each machine, or those that are of this part; answers their sections with
/// their places in the document.
///
/// # Errors
/// Where a scene is wrong, or the user interrupts.
pub fn survey(asked: &Survey) -> Outcome<Vec<(usize, Section)>> {
    let all: Vec<Base> = asked.all().collect();
    for numbers in [&asked.settings, &asked.limit] {
        if let Some(name) = numbers.stranger(&all) {
            return Err(Failure::Usage(format!(
                "--{} {name}=...: no scene here is called {name}, on any machine here",
                numbers.option
            )));
        }
    }
    // A scene that is wrong should be told of before an hour's work.
    for path in &asked.scenes {
        let scene = Scene::open(path, &Changes::default())?;
        scene.warn();
        for target in &asked.targets {
            marks::of_scene(&scene, &base(path, target))?;
        }
    }
    let count = asked.own().count();
    let progress = Progress::new("scenes, machines", count as u64);
    let mut sections = Vec::new();
    for (place, base) in asked.own() {
        sections.push((place, tuned(asked, &base)?));
        progress.step(1);
    }
    Ok(sections)
}

/// A scene as it is, on a machine as it usually is.
fn base(path: &Path, target: &'static Target) -> Base {
    Base {
        path: path.to_owned(),
        changes: Changes::default(),
        target,
        screen: ScreenArgs::default(),
    }
}

/// One scene on one machine.
fn tuned(asked: &Survey, base: &Base) -> Outcome<Section> {
    let scene = Scene::open(&base.path, &base.changes)?;
    let marks = marks::of_scene(&scene, base)?;
    let search = Search {
        base: base.clone(),
        measure: asked.measure,
        live: false,
        smaller: false,
        settings: usize::try_from(asked.settings.of(base)).unwrap_or(usize::MAX),
        limit: asked.limit.of(base),
        by_line: false,
        effort: Effort::ALL,
        cache: match asked.cached {
            true => Cache::of_user(),
            false => Cache::none(),
        },
    };
    let found = Arc::new(Mutex::new(Found::default()));
    let mut hear = |choice: &Choice, look: &Look, whole: bool| search.tell(choice, look, whole);
    explore(&search, scene, &found, &mut hear)?;
    let mut found = found.lock().map(|f| f.clone()).unwrap_or_default();
    // Threads find them in any order.
    found.failed.sort();
    let mut told = Told::new(base, asked.measure, &found);
    told.marks = marks;
    Ok(Section::new(&told, &search))
}
