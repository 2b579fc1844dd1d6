//! The page without a server: what one worker of the browser's does, one call for one wish.
//!
//! Nothing here reads a file or starts a thread; a wish that is no longer wanted ends with its
//! worker.

use super::board::{Board, Pictures, Task, Wish};
use super::frontier;
use super::machine::{self, Kept};
use super::native;
use super::run::{self, Run};
use super::shown::Shown;
use crate::failure::Outcome;
use crate::interrupt::Job;
use crate::machine::File;
use crate::scene::{Changes, Precision, Scene};
use crate::target_args::ScreenArgs;
use crate::trial;
use serde::Deserialize;
use slowlight_compiler::planner::PlannedScene;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use web_time::Instant;

/// Who hears what was found.
pub trait Tell {
    /// What is shown, as JSON.
    fn shown(&self, json: &str);
    /// A picture as a PNG, or the costs as JSON, by the name that a server has it under.
    fn bytes(&self, name: &str, bytes: &[u8]);
    /// A file of a program.
    fn file(&self, name: &str, bytes: &[u8]);
}

/// A wish as the page says it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Asked {
    serial: u64,
    name: String,
    text: String,
    set: BTreeMap<String, Vec<f64>>,
    /// The machine that something is wanted of, where it is.
    run: Option<AskedRun>,
}

/// A machine as the page says it.
#[derive(Deserialize)]
struct AskedRun {
    panel: usize,
    serial: u64,
    #[serde(flatten)]
    asked: run::Asked,
}

/// A worker.
#[derive(Default)]
pub struct Alone {
    kept: Kept,
    shown: Shown,
    pictures: Pictures,
    /// The scene that was read last, to be drawn again with other values.
    read: Option<(String, String, Scene)>,
}

/// What the machines' pictures are called.
const MACHINES: [&str; run::MOST] = ["1/machine.png", "2/machine.png"];
const DIFFERENCES: [&str; run::MOST] = ["1/difference.png", "2/difference.png"];

/// What is shown, with who hears of it.
struct Heard<'t, T> {
    inner: RefCell<(Shown, Pictures)>,
    tell: &'t T,
}

impl<T: Tell> Board for Heard<'_, T> {
    fn show(&self, change: impl FnOnce(&mut Shown, &mut Pictures)) {
        let mut inner = self.inner.borrow_mut();
        let (shown, pictures) = &mut *inner;
        let before = pictures.clone();
        change(shown, pictures);
        let all = [
            ("native.png", &before.native, &pictures.native),
            ("costs", &before.costs, &pictures.costs),
        ];
        let views = |k: usize| {
            let (before, now) = (&before.machines[k], &pictures.machines[k]);
            [
                (MACHINES[k], &before.machine, &now.machine),
                (DIFFERENCES[k], &before.difference, &now.difference),
            ]
        };
        let all = all.into_iter().chain((0..run::MOST).flat_map(views));
        for (name, before, now) in all {
            if !Arc::ptr_eq(before, now) {
                self.tell.bytes(name, now);
            }
        }
        // A number that JSON cannot hold is left out by serde: there is nothing to say of it.
        if let Ok(text) = serde_json::to_string(shown) {
            self.tell.shown(&text);
        }
    }

    fn show_of(&self, _: u64, change: impl FnOnce(&mut Shown, &mut Pictures)) {
        self.show(change);
    }

    fn show_run(&self, _: &Run, change: impl FnOnce(&mut Shown, &mut Pictures)) {
        self.show(change);
    }
}

impl Alone {
    /// Reads a wish's scene, says what is wrong with it, and draws it.
    ///
    /// # Errors
    /// Where the wish itself is none.
    pub fn draw(&mut self, wish: &str, tell: &impl Tell) -> Result<bool, String> {
        let (name, wish) = wished(wish)?;
        let board = self.board(tell);
        let drawn = self
            .scene(&name, &wish)
            .and_then(|scene| native::drawn(&board, &wish, &Job::default(), scene));
        let right = drawn.is_ok();
        if let Err(failure) = drawn {
            native::refused(&board, &wish, failure);
        }
        (self.shown, self.pictures) = board.inner.into_inner();
        Ok(right)
    }

    /// Runs a wish's program, counts its lines' cycles (`costs`), makes its files (`build`) or
    /// searches for what accuracy costs in time (`tune`).
    ///
    /// # Errors
    /// Where the wish itself is none.
    pub fn work(&mut self, task: &str, wish: &str, tell: &impl Tell) -> Result<(), String> {
        let task = match task {
            "run" => Task::Run,
            "costs" => Task::Costs,
            "build" => Task::Build,
            "tune" => Task::Tune,
            other => return Err(format!("no task `{other}`")),
        };
        let (name, wish) = wished(wish)?;
        if matches!(task, Task::Build) {
            // What was built before is shown by the page.
            self.shown.built = None;
        }
        let board = self.board(tell);
        let read = self.scene(&name, &wish).and_then(|scene| {
            let usual = scene.graph(None, Precision::NATIVE)?;
            Ok(native::set(scene, usual, &wish.set)?.0)
        });
        let run = wish.runs.first().ok_or("no machine")?;
        let before = (self.shown.panels.get(run.panel)).map(|panel| panel.machine.stage);
        match read {
            Ok(scene) => {
                let build = |plan: &PlannedScene, screen: &ScreenArgs| built(plan, screen, tell);
                let more = (&mut self.kept, &build as machine::Build<'_>);
                if task == Task::Tune {
                    board.show(|shown, _| frontier::begun(shown, run));
                }
                let done = machine::done(&board, run, &scene, task, more);
                machine::ended(&board, run, (task, before.unwrap_or_default()), done);
            }
            Err(failure) => native::refused(&board, &wish, failure),
        }
        (self.shown, self.pictures) = board.inner.into_inner();
        Ok(())
    }

    fn board<'t, T: Tell>(&self, tell: &'t T) -> Heard<'t, T> {
        Heard {
            inner: RefCell::new((self.shown.clone(), self.pictures.clone())),
            tell,
        }
    }

    /// The wish's scene, which stands alone.
    fn scene(&mut self, name: &str, wish: &Wish) -> Outcome<Scene> {
        if let Some((of, text, scene)) = &self.read
            && of == name
            && **text == *wish.text
        {
            return Ok(scene.clone());
        }
        self.read = None;
        let mut used =
            |_: &str, path: &str| Err(format!("{path} is a file, and this page has none"));
        let named = (name, &*wish.text);
        let scene = Scene::of_text(named, Path::new(name), &Changes::default(), &mut used)?;
        self.read = Some((name.to_owned(), wish.text.to_string(), scene.clone()));
        Ok(scene)
    }
}

fn wished(wish: &str) -> Result<(String, Wish), String> {
    let asked: Asked = serde_json::from_str(wish).map_err(|e| e.to_string())?;
    let run = |asked: AskedRun| Run::asked(asked.panel, asked.serial, asked.asked);
    let wish = Wish {
        serial: asked.serial,
        at: Instant::now(),
        text: asked.text.into(),
        set: asked.set,
        runs: asked.run.map(run).transpose()?.into_iter().collect(),
    };
    Ok((asked.name, wish))
}

/// Makes the program's files; answers their names.
fn built(plan: &PlannedScene, screen: &ScreenArgs, tell: &impl Tell) -> Outcome<Vec<String>> {
    let made = trial::build_for(plan, screen.machine(plan.target))?;
    let files: Vec<&File> = made.files().collect();
    files.iter().for_each(|f| tell.file(&f.name, &f.bytes));
    Ok(files.iter().map(|f| f.name.clone()).collect())
}
