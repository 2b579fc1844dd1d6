//! The desk between page and workers: what is wanted, and what is shown of it.
//!
//! A new wish stops what works for an older one. Each change of what is shown has a number,
//! by which a page asks for what it has not seen.

use super::file::SceneFile;
use crate::interrupt::Job;
use crate::live::board::{Board, Pictures, Task, Wish};
use crate::live::shown::{Chosen, File, Shown, Stage};
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
    /// The machine.
    pub target: Option<&'static Target>,
    /// A format, or none.
    pub format: Option<Option<String>>,
    /// A mode, or none.
    pub mode: Option<Option<String>>,
}

struct Inner {
    wish: Wish,
    /// Goes up with each text.
    revision: u64,
    shown: Shown,
    version: u64,
    pictures: Pictures,
    drawing: Job,
    running: Job,
    /// The wish's scene, once it is read, right and drawn.
    ready: Option<(Wish, Arc<Scene>)>,
    /// What the machines' worker is to do; runs come by themselves.
    tasks: Vec<Task>,
    /// What it does, and for which wish.
    doing: Option<(Task, u64)>,
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
            target,
            format: None,
            mode: None,
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
            running: Job::default(),
            ready: None,
            tasks: vec![Task::Run],
            doing: None,
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
        let Inner { wish, revision, .. } = &mut *inner;
        wish.serial += 1;
        wish.at = Instant::now();
        let mut by = None;
        if let Some((text, page)) = change.text
            && *wish.text != *text
        {
            wish.text = text.into();
            *revision += 1;
            by = Some(page);
        }
        if let Some(set) = change.set {
            wish.set = set;
        }
        if let Some(target) = change.target {
            wish.target = target;
            (wish.format, wish.mode) = (None, None);
        }
        if let Some(format) = change.format {
            wish.format = format;
        }
        if let Some(mode) = change.mode {
            wish.mode = mode;
        }
        let serial = wish.serial;
        let by = by.unwrap_or_else(|| inner.shown.text.by.clone());
        inner.chosen(&by);
        inner.drawing.stop();
        inner.running.stop();
        inner.tasks = vec![Task::Run];
        let saved = self.file.holds(&inner.wish.text);
        inner.shown.file.saved = saved;
        self.seen(inner);
        serial
    }

    /// Asks the machines' worker for something, once it has done what it does now.
    pub fn ask(&self, task: Task) {
        let mut inner = self.lock();
        let is_done_now = inner.doing == Some((task, inner.wish.serial));
        if !is_done_now && !inner.tasks.contains(&task) {
            inner.tasks.push(task);
        }
        self.seen(inner);
    }

    /// Stops what goes on.
    pub fn stop(&self) {
        let mut inner = self.lock();
        inner.drawing.stop();
        inner.running.stop();
        inner.tasks.clear();
        if !matches!(inner.shown.machine.stage, Stage::Done | Stage::Wrong) {
            inner.shown.machine.stage = Stage::Stopped;
        }
        self.seen(inner);
    }

    /// No more work: all who wait go home.
    pub fn end(&self) {
        let mut inner = self.lock();
        inner.ends = true;
        inner.drawing.stop();
        inner.running.stop();
        self.seen(inner);
    }

    fn seen(&self, mut inner: MutexGuard<'_, Inner>) {
        inner.version += 1;
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
    pub fn next_task(&self) -> Option<(Task, Wish, Arc<Scene>, Job)> {
        let mut inner = self.lock();
        inner.doing = None;
        loop {
            if inner.ends {
                return None;
            }
            let rested = inner.wish.at.elapsed();
            let Inner {
                ready, wish, tasks, ..
            } = &mut *inner;
            let ready = ready.as_ref();
            let current = ready.filter(|(ready, _)| ready.serial == wish.serial);
            match current {
                Some((wish, scene)) if rested >= REST && !tasks.is_empty() => {
                    let found = (tasks.remove(0), wish.clone(), scene.clone());
                    let job = Job::default();
                    inner.running = job.clone();
                    inner.doing = Some((found.0, found.1.serial));
                    return Some((found.0, found.1, found.2, job));
                }
                Some(_) if !tasks.is_empty() => {
                    let waited = self.changed.wait_timeout(inner, REST - rested);
                    inner = waited.unwrap_or_else(|e| e.into_inner()).0;
                }
                _ => {
                    let waited = self.changed.wait(inner);
                    inner = waited.unwrap_or_else(|e| e.into_inner());
                }
            }
        }
    }

    /// The file's text has changed on disk; where the page's was not saved, that is only said.
    /// `force` takes it all the same.
    pub fn file_changed(&self, text: &str, was: &str, force: bool) {
        let unsaved = *self.wanted().text != *was;
        if unsaved && !force {
            return self.show(|shown, _| shown.file.elsewhere = true);
        }
        self.wish(Change {
            text: Some((text.to_owned(), "file".to_owned())),
            ..Change::default()
        });
        self.show(|shown, _| {
            shown.file.elsewhere = false;
            shown.file.wrong = None;
        });
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
}

impl Inner {
    /// What was chosen is shown.
    fn chosen(&mut self, by: &str) {
        let wish = &self.wish;
        self.shown.text.revision = self.revision;
        by.clone_into(&mut self.shown.text.by);
        self.shown.chosen = Chosen {
            serial: wish.serial,
            target: wish.target.name.to_owned(),
            format: wish.format.clone(),
            mode: wish.mode.clone(),
            set: wish.set.clone(),
        };
    }
}
