//! What a graph and a tree draw, for holding passes against each other.

use super::run::{Exact, Run};
use crate::flow::graph::*;
use crate::flow::tree::Tree;

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
        let ink = run.pixel(x, y);
        let shade = graph.shade.and_then(|id| run.last(id));
        format!("({x}, {y}): {ink:?} {shade:?}")
    });
    let all = all.collect();
    (all, run.unset_reads())
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
