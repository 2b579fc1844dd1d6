//! The page by a server on the loopback, with two workers.

mod desk;
mod file;
mod guard;
mod http;
mod page;
mod queue;
mod routes;
mod searched;
mod watching;
mod workers;

use crate::draw::STACK;
use crate::failure::{Failure, Outcome};
use crate::interrupt;
use crate::scene::Changes;
use crate::target_args::ScreenArgs;
use desk::Desk;
use file::SceneFile;
use guard::Guard;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::targets::Target;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

/// Writes the program of a plan to a directory; answers the files.
pub type Build = fn(&PlannedScene, &ScreenArgs, &Path) -> Outcome<Vec<PathBuf>>;

/// What a page begins with.
pub struct Start<'s> {
    /// The scene's file.
    pub path: &'s Path,
    /// The first machine.
    pub target: &'static Target,
    /// The port; 0 for any that is free.
    pub port: u16,
    /// Whether to open the page in a browser.
    pub open: bool,
    /// What of the scene is otherwise than its text says.
    pub changes: Changes,
    /// What writes programs.
    pub build: Build,
}

/// How often it is looked whether Ctrl-C was pressed.
const LOOK: Duration = Duration::from_millis(20);

/// Serves the page of a scene until Ctrl-C.
///
/// # Errors
/// Where the scene's file cannot be read, the port is taken, or no thread can be had.
pub fn serve(start: &Start<'_>) -> Outcome<()> {
    // Ctrl-C is how it ends, and what it waits for.
    let _attentive = interrupt::writing();
    let file = SceneFile::open(start.path)?;
    let server = http::listen(start.port)?;
    let guard = Guard::new(server.port)?;
    let address = guard.address();
    let desk = Arc::new(Desk::new(file, start.target));
    let watching = watching::watch(&desk);
    if watching.is_none() {
        crate::output::remark("note: the file cannot be watched; the page has a button to load it");
    }
    let worker = |name: &str, work: Box<dyn FnOnce(&Desk) + Send>| {
        let desk = desk.clone();
        let thread = std::thread::Builder::new().name(name.to_owned());
        let thread = thread.stack_size(STACK).spawn(move || work(&desk));
        thread.map_err(|e| Failure::Wrong(format!("cannot start a thread: {e}")))
    };
    let (changes, build) = (start.changes.clone(), start.build);
    let workers = [
        worker(
            "native",
            Box::new(move |desk| workers::native(desk, &changes)),
        )?,
        worker(
            "machine",
            Box::new(move |desk| workers::machine(desk, build)),
        )?,
    ];
    let serving = http::serve(server, &desk, guard)?;
    crate::say(&format!(
        "{address}\n{} is shown there; Ctrl-C ends it\n",
        start.path.display()
    ))?;
    if start.open {
        open(&address);
    }
    while !interrupt::ends() {
        std::thread::sleep(LOOK);
    }
    desk.end();
    drop((watching, serving));
    // A worker that plans does not look up: the process ends without it.
    drop(workers);
    // What is being saved is saved first.
    desk.file().finish();
    Ok(())
}

/// Asks the system to show an address.
fn open(address: &str) {
    let (program, first): (&str, &[&str]) = match std::env::consts::OS {
        "macos" => ("open", &[]),
        "windows" => ("cmd", &["/c", "start", ""]),
        _ => ("xdg-open", &[]),
    };
    let mut command = std::process::Command::new(program);
    command.args(first).arg(address);
    let quiet = std::process::Stdio::null;
    let started = command.stdout(quiet()).stderr(quiet()).spawn();
    if let Ok(mut started) = started {
        // Whether it could show the page, it says itself.
        std::thread::spawn(move || started.wait());
    } else {
        crate::output::remark("note: no browser could be opened; open the address yourself");
    }
}
