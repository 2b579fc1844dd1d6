//! What a graph and a tree draw, for holding passes against each other.
#![allow(clippy::unwrap_used)]

use super::arithmetic::Exact;
use super::native::{Native, Pixel};
use super::run::Run;
use crate::analysis::verify::verify;
use crate::ir::graph::*;
use crate::ir::tree::Tree;
use crate::passes::simplify::fold::fold;
use crate::scene::check;
use crate::schedule::statements::missing;
use crate::sema::Options;
use slowlight_routine::Value;

/// A scene's graph as it is written.
pub fn lowered(text: &str) -> Graph {
    let scene = check("test", text);
    assert!(scene.is_right(), "{:?}", scene.diagnostics);
    scene.lower(&Options::default()).unwrap()
}

/// The native picture, row by row.
pub fn native(graph: &Graph) -> Vec<Vec<Pixel>> {
    let mut native = Native::new(graph);
    let mut row = |y| {
        let mut out = Vec::new();
        native.pixels(0..graph.image.width as i32, y, &mut out);
        out
    };
    (0..graph.image.height as i32).map(&mut row).collect()
}

/// Inks and shades of some pixels, as text, nothing being read that was not written.
pub fn picture(graph: &Graph, tree: &Tree, places: &[(i32, i32)]) -> Vec<String> {
    let (all, unset) = drawn(graph, tree, places);
    assert_eq!(unset, 0);
    all
}

/// Inks and shades of some pixels, as text, and how often something was read
/// that was not written.
pub fn drawn(graph: &Graph, tree: &Tree, places: &[(i32, i32)]) -> (Vec<String>, u64) {
    let mut run = Run::new(graph, tree, Exact(graph));
    let all = places.iter().map(|&(x, y)| {
        let ink = Value::from(run.pixel(x, y));
        let shade = graph.shade.and_then(|id| run.last(id)).map(Value::from);
        format!("({x}, {y}): {ink:?} {shade:?}")
    });
    let all = all.collect();
    (all, run.unset_reads())
}

/// That a graph in which a pass changed something is whole and draws what it did before.
pub fn assert_same(before: (&Graph, &Tree), (graph, tree): (&Graph, &Tree), seed: u64) {
    verify(graph).unwrap_or_else(|broken| panic!("seed {seed}: {broken}"));
    assert_eq!(missing(graph, tree), None, "seed {seed}");
    let places = grid(7, 5, 1);
    assert_eq!(
        picture(before.0, before.1, &places),
        picture(graph, tree, &places),
        "seed {seed}:\n{tree}"
    );
}

/// Every `step`th column of every `step`th row.
pub fn grid(columns: u32, rows: u32, step: usize) -> Vec<(i32, i32)> {
    let rows = (0..rows).step_by(step);
    rows.flat_map(|y| {
        (0..columns)
            .step_by(step)
            .map(move |x| (x as i32, y as i32))
    })
    .collect()
}

/// The graphs of the example scenes, hard ones included, by name; without
/// those that read other files, which need the command line.
pub fn examples() -> Vec<(String, Graph)> {
    let directory = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples");
    let mut paths: Vec<_> = [directory.to_owned(), format!("{directory}/hard")]
        .iter()
        .flat_map(|d| std::fs::read_dir(d).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "scn"))
        .collect();
    paths.sort();
    let graph = |path: std::path::PathBuf| {
        let scene = check("test", &std::fs::read_to_string(&path).unwrap());
        let graph = scene.is_right().then(|| scene.lower(&Options::default()))?;
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        Some((name, fold(&graph.unwrap())))
    };
    paths.into_iter().filter_map(graph).collect()
}
