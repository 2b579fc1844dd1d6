//! `live`: a local page on which a scene is written and its picture seen.

use crate::failure::{Failure, Outcome};
use crate::files;
use crate::live::{self, Start};
use crate::scene::{self, Changes};
use crate::target_args::{self, ScreenArgs};
use crate::trial;
use slowlight_compiler::backend;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::targets::{TARGETS, Target};
use std::path::{Path, PathBuf};

/// Options of `live`.
#[derive(clap::Args, Debug)]
pub struct Args {
    /// The scene's file
    scene: PathBuf,
    /// The machine to begin with, as in jack or 6502 (`slowlight targets` lists all) [default: the first]
    #[arg(short, long, value_name = "T", value_parser = target_args::target)]
    target: Option<&'static Target>,
    /// The port of this computer that the page is at [default: one that is free]
    #[arg(long, value_name = "P")]
    port: Option<u16>,
    /// Open the page in the browser
    #[arg(long)]
    open: bool,
}

/// Serves the page until Ctrl-C.
pub fn run(args: &Args) -> Outcome<()> {
    if scene::is_standard_input(&args.scene) {
        let message = "live watches a file and writes to it, and standard input is none";
        return Err(Failure::Usage(message.to_owned()));
    }
    let first = TARGETS.first().copied();
    let target = args.target.or(first);
    let target = target.ok_or_else(|| Failure::Wrong("there is no machine".to_owned()))?;
    live::serve(&Start {
        path: &args.scene,
        target,
        port: args.port.unwrap_or(0),
        open: args.open,
        changes: Changes::default(),
        build: write,
    })
}

/// Writes what `build` writes; answers where. Through no link that leads out of the directory:
/// whoever works with the page may have got it from somebody else, links and all.
fn write(plan: &PlannedScene, screen: &ScreenArgs, directory: &Path) -> Outcome<Vec<PathBuf>> {
    let text = backend::emit(plan);
    let built = trial::build_written(&text, plan, screen.machine(plan.target))?;
    let paths: Vec<PathBuf> = built.files().map(|f| directory.join(&f.name)).collect();
    if let Some(path) = paths.iter().find(|p| files::is_elsewhere(p, directory)) {
        let shown = path.display();
        let why = "is a link to a file outside of the scene's directory, and this page writes \
                   nothing there";
        return Err(Failure::Wrong(format!("{shown} {why}")));
    }
    let bytes = built.files().map(|f| f.bytes.as_slice());
    let written: Vec<(&Path, &[u8])> = paths.iter().map(PathBuf::as_path).zip(bytes).collect();
    files::write_all(&written)?;
    Ok(paths)
}
