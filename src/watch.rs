//! An incremental build loop: a work that is done again whenever a scene's files are saved, of
//! which the newest text stops what goes on for an older one.

use crate::diagnostics;
use crate::digest;
use crate::draw::STACK;
use crate::failure::{Failure, Outcome};
use crate::files;
use crate::interrupt::{self, Job};
use crate::output::remark;
use crate::scene::{Changes, Scene, is_standard_input};
use notify_debouncer_mini::notify::{RecommendedWatcher, RecursiveMode};
use notify_debouncer_mini::{DebounceEventResult, Debouncer, new_debouncer};
use slowlight_compiler::source::Sources;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// How long writes to a file must rest before it is read: editors write in several steps.
const REST: Duration = Duration::from_millis(60);

/// How often it is looked whether Ctrl-C was pressed.
const LOOK: Duration = Duration::from_millis(20);

/// How long the work may take to notice it.
const PATIENCE: Duration = Duration::from_millis(700);

/// What is done again: it says itself what it finds.
pub type Work = Arc<dyn Fn() -> Outcome<()> + Send + Sync>;

/// Does the work, and again each time that the scene or a file that it uses is saved with
/// another text, until Ctrl-C. What fails is said, and is no end.
///
/// # Errors
/// Where the scene is standard input, files cannot be watched, or no thread is to be had.
pub fn each_save(scene: &Path, changes: &Changes, work: &Work) -> Outcome<()> {
    if is_standard_input(scene) {
        let message = "--watch watches a file, and standard input is none";
        return Err(Failure::Usage(message.to_owned()));
    }
    // What was never there is a wrong name, not a scene that is about to be saved.
    files::read_text(scene)?;
    // Ctrl-C is how it ends, and what it waits for.
    let _attentive = interrupt::writing();
    let mut watched = Watched::new()?;
    let mut first = true;
    loop {
        let texts = watched.files(scene, changes);
        let job = Job::default();
        let mut going = Some(begun(&job, work)?);
        if std::mem::take(&mut first) {
            remark(&format!(
                "{}: saved, it is run again; Ctrl-C ends this",
                scene.display()
            ));
        }
        let mut fresh = true;
        loop {
            if interrupt::ends() {
                job.stop();
                let since = Instant::now();
                while going.as_ref().is_some_and(|g| !g.is_finished()) && since.elapsed() < PATIENCE
                {
                    std::thread::sleep(LOOK);
                }
                return Ok(());
            }
            if going.as_ref().is_some_and(JoinHandle::is_finished)
                && let Some(Ok(Err(failure))) = going.take().map(JoinHandle::join)
                && !matches!(failure, Failure::Interrupted)
            {
                let _ = diagnostics::report(&failure);
            }
            // What was saved while the files were opened may have been told of before.
            let told = watched.news.recv_timeout(LOOK).is_ok();
            if !told && !std::mem::take(&mut fresh) {
                continue;
            }
            if let Some(name) = changed(&texts) {
                job.stop();
                // Planning is not stopped between two plans: then this is a second or two late.
                let _ = going.take().map(JoinHandle::join);
                remark(&format!("\n{} was saved", name.display()));
                break;
            }
        }
    }
}

/// Begins the work on a thread.
fn begun(job: &Job, work: &Work) -> Outcome<JoinHandle<Outcome<()>>> {
    let (job, work) = (job.clone(), work.clone());
    let thread = std::thread::Builder::new().stack_size(STACK);
    thread
        .spawn(move || job.doing(|| work()))
        .map_err(|e| Failure::Wrong(format!("cannot start a thread: {e}")))
}

/// What files hold, by their digests.
type Texts = BTreeMap<PathBuf, String>;

/// What a file holds; none where it is not to be read, as between two steps of an editor.
fn text(path: &Path) -> Option<String> {
    let bytes = std::fs::read(path).ok()?;
    Some(digest::bytes(&bytes))
}

/// A file that holds something else now.
fn changed(texts: &Texts) -> Option<&Path> {
    let mut paths = texts.iter();
    let other = paths.find(|(path, known)| text(path).is_some_and(|now| now != **known));
    other.map(|(path, _)| path.as_path())
}

/// The directories of a scene's files, and who tells of what happens there.
struct Watched {
    watching: Debouncer<RecommendedWatcher>,
    directories: BTreeSet<PathBuf>,
    news: Receiver<()>,
}

impl Watched {
    fn new() -> Outcome<Watched> {
        let (told, news): (Sender<()>, Receiver<()>) = channel();
        let heard = move |_: DebounceEventResult| {
            // Nobody listens any more: it ends.
            let _ = told.send(());
        };
        let watching = new_debouncer(REST, heard).map_err(cannot)?;
        Ok(Watched {
            watching,
            directories: BTreeSet::new(),
            news,
        })
    }

    /// The scene's own files as they are now, all of which are watched from now on.
    fn files(&mut self, scene: &Path, changes: &Changes) -> Texts {
        let mut texts = match Scene::open(scene, changes) {
            Ok(read) => own(&read.checked.sources),
            Err(Failure::Scene(said) | Failure::Options(said)) => own(&said.sources),
            Err(_) => Texts::new(),
        };
        // One that cannot be read yet is news as soon as it can.
        texts.entry(scene.to_owned()).or_default();
        for path in texts.keys() {
            let directory = match path.parent() {
                Some(parent) if !parent.as_os_str().is_empty() => parent,
                _ => Path::new("."),
            };
            if self.directories.insert(directory.to_owned()) {
                let watcher = self.watching.watcher();
                let watched = watcher.watch(directory, RecursiveMode::NonRecursive);
                if let Err(why) = watched {
                    remark(&format!("note: {}", cannot(why).reason()));
                }
            }
        }
        texts
    }
}

/// The files that are the user's, by the texts that were opened: one that is saved meanwhile is
/// news, and may use other files.
fn own(sources: &Sources) -> Texts {
    let own = sources.files.iter().filter(|file| !file.library);
    own.map(|file| {
        let digest = digest::bytes(file.text.as_bytes());
        (PathBuf::from(&file.name), digest)
    })
    .collect()
}

fn cannot(why: notify_debouncer_mini::notify::Error) -> Failure {
    Failure::Wrong(format!("files cannot be watched here: {why}"))
}
