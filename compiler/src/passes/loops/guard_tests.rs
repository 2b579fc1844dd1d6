//! A loop behind a guard draws the same, with shortcuts in it or without, started or skipped.
#![allow(clippy::unwrap_used)]

use super::guard::guard;
use crate::analysis::verify::verify;
use crate::eval::drawn::{grid, picture};
use crate::eval::random_graphs;
use crate::ir::graph::*;
use crate::passes::branches::early_exit::{in_loops, without};
use crate::passes::loops::bypass::skip;
use crate::passes::simplify::fold::fold;
use crate::scene;
use crate::schedule::statements::schedule;
use crate::sema::Options;

#[test]
fn guarded_loops_draw_the_same() {
    let (mut guarded, mut skipped) = (0, 0);
    for seed in 0..300 {
        let graph = fold(&random_graphs::graph(seed));
        let places = grid(7, 5, 1);
        let plain = picture(&graph, &schedule(&graph), &places);
        for k in 0..graph.loops.len() {
            let same = |other: &Graph, how: &str| {
                let what = format!("{how}, seed {seed}, loop {k}");
                verify(other).unwrap_or_else(|broken| panic!("{what}: {broken}"));
                let tree = schedule(other);
                assert_eq!(plain, picture(other, &tree, &places), "{what}:\n{tree}");
            };
            for conditions in [1, 2] {
                let Some(other) = guard(&graph, LoopId(k as u32), conditions, 1000) else {
                    continue;
                };
                guarded += 1;
                same(&other, "guarded");
                let Some(other) = skip(&other) else {
                    continue;
                };
                skipped += 1;
                same(&other, "skipped");
            }
        }
    }
    assert!(guarded > 60 && skipped > 30, "{guarded} {skipped}");
}

#[test]
fn shortcuts_change_no_pixel() {
    for source in [
        include_str!("../../../../examples/mirrors.scn"),
        include_str!("../../../../examples/glass.scn"),
    ] {
        let scene = scene::check("test", source);
        let graph = scene.lower(&Options::default()).unwrap();
        assert!(!graph.early.is_empty());
        let places = grid(graph.image.width, graph.image.height, 7);
        let drawn = |graph: &Graph| picture(graph, &schedule(graph), &places);
        let plain = drawn(&fold(&without(&graph)));
        assert_eq!(plain, drawn(&fold(&graph)));
        // The loop follows rays that meet spheres, so there are some in it.
        let some = fold(&in_loops(&graph).unwrap());
        assert!(some.early.is_empty());
        assert_eq!(plain, drawn(&some));
    }
}
