//! Every value is computed before it is read, on every path of every example's plan.
#![allow(clippy::unwrap_used)]

use rayon::prelude::*;
use slowlight::scene::Precision;
use slowlight_compiler::plan::Goal;
use slowlight_compiler::plan::model::ModelRun;
use slowlight_compiler::planner::plan;
use slowlight_compiler::scene;
use slowlight_compiler::targets::{Target, default_mode, find};
use std::path::{Path, PathBuf};

fn examples() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folders = ["examples", "examples/hard"].map(|folder| root.join(folder));
    let files = folders.iter().flat_map(|f| std::fs::read_dir(f).unwrap());
    let paths = files.map(|f| f.unwrap().path());
    paths
        .filter(|p| p.extension().is_some_and(|e| e == "scn"))
        .collect()
}

/// A machine of each runtime, and of BASIC one whose roots are cheap: the others differ
/// in how pixels are drawn.
const TARGETS: [&str; 4] = ["jack", "bbc:micro", "bbc:agon", "6502:plain"];

/// How many reads of what no statement on the path has written there are in some
/// pixels.
fn unset(path: &Path, target: &'static Target) -> u64 {
    let scene = scene::check("test", &std::fs::read_to_string(path).unwrap());
    assert!(scene.is_right(), "{:?}", scene.diagnostics);
    let graph = scene
        .lower(&Precision::of(target).options(Default::default()))
        .unwrap();
    let (width, height) = (graph.image.width, graph.image.height);
    let goal = Goal {
        name: "test".to_owned(),
        mode: default_mode(target, width, height).unwrap(),
        rows: None,
        plot: true,
    };
    let plan = plan(&graph, target, &goal).unwrap();
    let mut model = ModelRun::new(&plan);
    for y in [20, 60, 90].into_iter().filter(|&y| y < height) {
        for x in (0..width).step_by(37) {
            model.pixel(x as i32, y as i32);
        }
    }
    model.unset_reads()
}

#[test]
fn plans_read_what_they_have_written() {
    let examples = examples();
    assert!(examples.len() >= 25, "{examples:?}");
    let targets = TARGETS.map(|name| find(name).unwrap());
    let all: Vec<_> = (examples.iter())
        .flat_map(|path| targets.map(|target| (path, target)))
        .collect();
    let wrong: Vec<String> = (all.par_iter())
        .map(|&(path, target)| (path, target, unset(path, target)))
        .filter(|&(.., reads)| reads != 0)
        .map(|(path, target, reads)| format!("{} on {}: {reads}", path.display(), target.name))
        .collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}
