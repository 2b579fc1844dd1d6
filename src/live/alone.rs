//! The page without a server: what one worker of the browser's does, one call for one wish.
//!
//! Nothing here reads a file or starts a thread; a wish that is no longer wanted ends with its
//! worker.

use super::board::{Board, Pictures, Task, Wish};
use super::machine::{Kept, Work};
use super::native;
use super::shown::Shown;
use crate::failure::Outcome;
use crate::interrupt::Job;
use crate::machine::File;
use crate::scene::{Changes, Precision, Scene};
use crate::target_args::ScreenArgs;
use crate::trial;
use serde::Deserialize;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::targets;
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
    target: String,
    format: Option<String>,
    mode: Option<String>,
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
            ("machine.png", &before.machine, &pictures.machine),
            ("difference.png", &before.difference, &pictures.difference),
            ("costs", &before.costs, &pictures.costs),
        ];
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

    /// Runs a wish's program, counts its lines' cycles (`costs`) or makes its files (`build`).
    ///
    /// # Errors
    /// Where the wish itself is none.
    pub fn work(&mut self, task: &str, wish: &str, tell: &impl Tell) -> Result<(), String> {
        let task = match task {
            "run" => Task::Run,
            "costs" => Task::Costs,
            "build" => Task::Build,
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
        let before = self.shown.machine.stage;
        match read {
            Ok(scene) => {
                let build = |plan: &PlannedScene, screen: &ScreenArgs| built(plan, screen, tell);
                let work = Work::new(&board, &wish, &scene);
                work.ended((task, before), work.done(task, &mut self.kept, &build));
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
    let target = targets::find(&asked.target);
    let wish = Wish {
        serial: asked.serial,
        at: Instant::now(),
        text: asked.text.into(),
        set: asked.set,
        target: target.ok_or_else(|| format!("no target `{}`", asked.target))?,
        format: asked.format,
        mode: asked.mode,
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
