//! The desk between page and workers: what is wanted, and what is shown of it.
//!
//! A new wish stops what works for an older one. Each change of what is shown has a number,
//! by which a page asks for what it has not seen.

mod chosen;

use super::file::SceneFile;
use super::queue::{Errand, Queue};
use super::searched::Searched;
use crate::interrupt::Job;
use crate::live::board::{Board, Pictures, Task, Wish};
use crate::live::frontier;
use crate::live::run::{MOST, Run};
use crate::live::shown::{File, Panel, Shown, Stage, Waits};
use crate::scene::Scene;
use slowlight_compiler::targets::Target;
use std::collections::BTreeMap;
use std::sync::{Arc, Condvar, Mutex, MutexGuard};
use std::time::{Duration, Instant};
use tokio::sync::watch;

/// How long the text must rest before a machine is put to work.
const REST: Duration = Duration::from_millis(350);

/// What a page may change of a wish; what is none stays.
#[derive(Default)]
pub struct Change {
    /// The text, and the page that it is from.
    pub text: Option<(String, String)>,
    /// Values of params.
    pub set: Option<BTreeMap<String, Vec<f64>>>,
    /// The machines, whose places and numbers the desk gives.
    pub runs: Option<Vec<Run>>,
    /// Whether other files that the scene uses are no more what they were.
    pub files: bool,
}

struct Inner {
    wish: Wish,
    /// Goes up with each text.
    revision: u64,
    shown: Shown,
    version: u64,
    pictures: Pictures,
    drawing: Job,
    /// The wish's scene, once it is read, right and drawn.
    ready: Option<(Wish, Arc<Scene>)>,
    /// The last number of a wish or a run.
    last: u64,
    queue: Queue,
    /// How often other files that the scene uses were others.
    files: u64,
    /// What each machine's frontier is of, where there is one.
    searched: [Option<Searched>; MOST],
    ends: bool,
}

/// The desk.
pub struct Desk {
    inner: Mutex<Inner>,
    changed: Condvar,
    /// The number of what is shown, for pages that wait.
    news: watch::Sender<u64>,
    file: SceneFile,
}

impl Desk {
    /// With the text of a file.
    pub fn new(file: SceneFile, target: &'static Target) -> Desk {
        let wish = Wish {
            serial: 1,
            at: Instant::now(),
            text: file.text().into(),
            set: BTreeMap::new(),
            runs: vec![Run {
                panel: 0,
                serial: 1,
                target,
                format: None,
                mode: None,
                options: String::new(),
            }],
        };
        let mut inner = Inner {
            shown: Shown {
                file: File {
                    name: file.name(),
                    directory: file.directory().display().to_string(),
                    saved: true,
                    ..File::default()
                },
                ..Shown::default()
            },
            wish,
            revision: 1,
            version: 1,
            pictures: Pictures::default(),
            drawing: Job::default(),
            ready: None,
            last: 1,
            queue: Queue::new(),
            files: 0,
            searched: Default::default(),
            ends: false,
        };
        inner.chosen("file");
        Desk {
            inner: Mutex::new(inner),
            changed: Condvar::new(),
            news: watch::Sender::new(1),
            file,
        }
    }

    /// The scene's file.
    pub fn file(&self) -> &SceneFile {
        &self.file
    }

    fn lock(&self) -> MutexGuard<'_, Inner> {
        // What a worker left when it panicked is as good as what it wrote before.
        self.inner.lock().unwrap_or_else(|e| e.into_inner())
    }

    /// Takes a wish; answers its number.
    pub fn wish(&self, change: Change) -> u64 {
        let mut inner = self.lock();
        inner.last += 1;
        let serial = inner.last;
        let mut by = None;
        // Without machines of its own it is a wish for all of it, even where that is the same.
        let stopped = inner.shown.native.stage == Stage::Stopped;
        let Inner { wish, revision, .. } = &mut *inner;
        let mut whole = change.runs.is_none() || change.files || stopped;
        let mut other = change.files;
        wish.at = Instant::now();
        if let Some((text, page)) = change.text
            && *wish.text != *text
        {
            wish.text = text.into();
            *revision += 1;
            by = Some(page);
            (whole, other) = (true, true);
        }
        if let Some(set) = change.set
            && wish.set != set
        {
            wish.set = set;
            (whole, other) = (true, true);
        }
        let by = by.unwrap_or_else(|| inner.shown.text.by.clone());
        inner.files += u64::from(change.files);
        if whole {
            inner.wish.serial = serial;
            inner.drawing.stop();
        }
        let runs = change.runs.unwrap_or_else(|| inner.wish.runs.clone());
        inner.runs(runs, serial, (whole, other));
        inner.chosen(&by);
        let saved = self.file.holds(&inner.wish.text);
        inner.shown.file.saved = saved;
        self.seen(inner);
        serial
    }

    /// Asks the machines' worker for something, once it has done what it does now.
    pub fn ask(&self, task: Task, panel: usize) {
        let mut inner = self.lock();
        if let Some(serial) = inner.wish.runs.get(panel).map(|run| run.serial) {
            inner.queue.ask((task, panel), serial);
            self.seen(inner);
        }
    }

    /// Stops what goes on.
    pub fn stop(&self) {
        let mut inner = self.lock();
        inner.drawing.stop();
        inner.queue.clear();
        let Inner { wish, shown, .. } = &mut *inner;
        for (Panel { machine, .. }, run) in shown.panels.iter_mut().zip(&wish.runs) {
            if machine.serial != run.serial {
                *machine = machine.begun(run.serial, Stage::Stopped);
            } else if !matches!(machine.stage, Stage::Done | Stage::Wrong) {
                machine.stage = Stage::Stopped;
            }
        }
        self.seen(inner);
    }

    /// Stops a machine's search alone: what waits for it has its turn.
    pub fn stop_search(&self, panel: usize) {
        let mut inner = self.lock();
        inner.queue.no_more(panel, |task| task == Task::Tune);
        self.seen(inner);
    }

    /// No more work: all who wait go home.
    pub fn end(&self) {
        let mut inner = self.lock();
        inner.ends = true;
        inner.drawing.stop();
        inner.queue.clear();
        self.seen(inner);
    }

    fn seen(&self, mut inner: MutexGuard<'_, Inner>) {
        inner.version += 1;
        let Inner {
            queue,
            shown: Shown { panels, params, .. },
            wish,
            files,
            searched,
            ..
        } = &mut *inner;
        for (k, (panel, of)) in panels.iter_mut().zip(searched).enumerate() {
            panel.frontier.waits = queue.has((Task::Tune, k));
            panel.frontier.stale = of.is_some() && *of != Searched::of(wish, params, *files, k);
            panel.waits = Waits {
                costs: queue.has((Task::Costs, k)),
                build: queue.has((Task::Build, k)),
            };
        }
        let version = inner.version;
        drop(inner);
        // Of two that come here at once, the later number stands.
        self.news.send_if_modified(|news| {
            let later = version > *news;
            *news = version.max(*news);
            later
        });
        self.changed.notify_all();
    }

    fn change(
        &self,
        mut inner: MutexGuard<'_, Inner>,
        change: impl FnOnce(&mut Shown, &mut Pictures),
    ) {
        let Inner {
            shown, pictures, ..
        } = &mut *inner;
        change(shown, pictures);
        self.seen(inner);
    }

    /// What is wanted now.
    pub fn wanted(&self) -> Wish {
        self.lock().wish.clone()
    }

    /// The text that is wanted now, and how often it was another.
    pub fn text(&self) -> (Arc<str>, u64) {
        let inner = self.lock();
        (inner.wish.text.clone(), inner.revision)
    }

    /// The pictures.
    pub fn pictures(&self) -> Pictures {
        self.lock().pictures.clone()
    }

    /// What is shown, with its number.
    pub fn shown(&self) -> (u64, Shown) {
        let inner = self.lock();
        (inner.version, inner.shown.clone())
    }

    /// The number of what is shown, to wait for another.
    pub fn news(&self) -> watch::Receiver<u64> {
        self.news.subscribe()
    }

    /// The next wish to be drawn natively, with the job to work for; none at the end.
    pub fn next_native(&self, after: u64) -> Option<(Wish, Job)> {
        let inner = self.lock();
        let old = |inner: &mut Inner| inner.wish.serial <= after && !inner.ends;
        let waited = self.changed.wait_while(inner, old);
        let mut inner = waited.unwrap_or_else(|e| e.into_inner());
        let job = Job::default();
        inner.drawing = job.clone();
        (!inner.ends).then(|| (inner.wish.clone(), job))
    }

    /// A wish's scene is right and its native picture drawn: machines may run it.
    pub fn ready(&self, wish: Wish, scene: Arc<Scene>) {
        let mut inner = self.lock();
        inner.ready = Some((wish, scene));
        self.seen(inner);
    }

    /// The next thing for a machine, of a wish that has rested; none at the end.
    pub fn next_task(&self) -> Option<Errand> {
        let mut inner = self.lock();
        inner.queue.idle();
        loop {
            if inner.ends {
                return None;
            }
            let rested = inner.wish.at.elapsed();
            let ready = (inner.ready.as_ref())
                .filter(|(ready, _)| ready.serial == inner.wish.serial)
                .map(|(_, scene)| scene.clone());
            let waited = match (ready, inner.queue.is_empty()) {
                (Some(scene), false) if rested >= REST => {
                    let Some((task, panel)) = inner.queue.take() else {
                        continue;
                    };
                    let Some(run) = inner.wish.runs.get(panel).cloned() else {
                        continue;
                    };
                    let job = inner.queue.begin((task, panel), run.serial);
                    if task == Task::Tune {
                        // Before anything else is chosen: from here on it is seen, and stopped.
                        frontier::begun(&mut inner.shown, &run);
                        let Inner {
                            wish, shown, files, ..
                        } = &*inner;
                        let of = Searched::of(wish, &shown.params, *files, panel);
                        inner.searched[panel] = of;
                    }
                    self.seen(inner);
                    return Some(Errand {
                        task,
                        run,
                        scene,
                        job,
                    });
                }
                (Some(_), false) => {
                    let waited = self.changed.wait_timeout(inner, REST - rested);
                    waited.map(|waited| waited.0).map_err(|e| e.into_inner().0)
                }
                _ => self.changed.wait(inner).map_err(|e| e.into_inner()),
            };
            inner = waited.unwrap_or_else(|inner| inner);
        }
    }
}

impl Board for Desk {
    fn show(&self, change: impl FnOnce(&mut Shown, &mut Pictures)) {
        self.change(self.lock(), change);
    }

    fn show_of(&self, serial: u64, change: impl FnOnce(&mut Shown, &mut Pictures)) {
        let inner = self.lock();
        if inner.wish.serial == serial {
            self.change(inner, change);
        }
    }

    fn show_run(&self, run: &Run, change: impl FnOnce(&mut Shown, &mut Pictures)) {
        let inner = self.lock();
        let now = inner.wish.runs.get(run.panel);
        if now.is_some_and(|now| now.serial == run.serial) {
            self.change(inner, change);
        }
    }
}
