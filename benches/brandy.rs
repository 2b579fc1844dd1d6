//! Our interpreter of BASIC against Matrix Brandy: the whole picture of mirrors, the same file.
//!
//! `cargo bench --bench brandy`, where `brandy` is installed (see `tests/peers/setup`).
//!
//! What an empty program takes is subtracted on both sides: Brandy opens a window, we make a
//! machine. Each time is the least of some runs, because anything else the computer does only
//! adds to it.

use slowlight::trial::LIMIT;
use slowlight_compiler::plan::Goal;
use slowlight_compiler::planner::plan;
use slowlight_compiler::scene;
use slowlight_compiler::sema::Options;
use slowlight_compiler::targets::{Target, default_mode, find};
use slowlight_vm::Stop;
use slowlight_vm::bbc::{Config, Dialect, Machine};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const MIRRORS: &str = include_str!("../examples/mirrors.scn");
const EMPTY: &str = "10END\n";
const RUNS: usize = 20;

/// The generated text.
fn program(target: &'static Target) -> Option<String> {
    let checked = scene::check("mirrors.scn", MIRRORS);
    let image = checked.program.image.as_ref()?;
    let mode = default_mode(target, image.width, image.height)?;
    let options = Options {
        inks: Some(mode.inks),
        offset: target.offset,
        ..Options::default()
    };
    let goal = Goal {
        name: "mirrors".to_owned(),
        mode,
        rows: None,
        plot: true,
    };
    let plan = plan(&checked.lower(&options).ok()?, target, &goal).ok()?;
    let documents = slowlight_compiler::backend::emit(&plan);
    documents.into_iter().next().map(|d| d.text)
}

fn timed(once: &dyn Fn()) -> Duration {
    let start = Instant::now();
    once();
    start.elapsed()
}

/// Ours, cycles counted: what `slowlight run` does with the file.
fn ours(text: &str) {
    let config = Config {
        dialect: Dialect::BasicV,
        ..Config::default()
    };
    let mut machine = Machine::new(config);
    assert!(machine.load_text(text).is_ok());
    let run = machine.run(LIMIT, &mut |_| true);
    assert_eq!(run.stop, Stop::Ended);
    assert!(run.cycles > 0);
}

fn brandy(file: &Path) {
    let status = Command::new("brandy")
        .arg("-quit")
        .arg(file)
        .env("SDL_VIDEODRIVER", "dummy")
        .env("SDL_AUDIODRIVER", "dummy")
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    assert!(status.is_ok_and(|s| s.success()), "brandy is installed");
}

fn main() {
    let Some(text) = find("bbc:basicv").and_then(program) else {
        panic!("mirrors does not build for bbc:basicv");
    };
    let Ok(directory) = tempfile::tempdir() else {
        panic!("no temporary directory");
    };
    let file = |name: &str, text: &str| {
        let path = directory.path().join(name);
        assert!(std::fs::write(&path, text).is_ok());
        path
    };
    let (whole, empty) = (file("mirrors.bas", &text), file("empty.bas", EMPTY));
    let kinds: [(&str, &dyn Fn()); 4] = [
        ("brandy, mirrors", &|| brandy(&whole)),
        ("brandy, an empty program", &|| brandy(&empty)),
        ("ours, mirrors", &|| ours(&text)),
        ("ours, an empty program", &|| ours(EMPTY)),
    ];
    // One after the other in turns, so that whatever else goes on meets all of them.
    let mut least = [Duration::MAX; 4];
    for _ in 0..RUNS {
        for ((_, once), least) in kinds.iter().zip(&mut least) {
            *least = timed(once).min(*least);
        }
    }
    for ((name, _), time) in kinds.iter().zip(&least) {
        println!("{name}: {time:?}");
    }
    let theirs = least[0].saturating_sub(least[1]).as_secs_f64();
    let ours = least[2].saturating_sub(least[3]).as_secs_f64();
    println!("ours / brandy: {:.2}", ours / theirs);
}
