//! Loops inside each other: the walk ends, and what it says holds.
#![allow(clippy::unwrap_used)]

use super::{STATEMENTS, Slack, ranges_counted};
use crate::eval::native::Native;
use crate::flow::graph::Graph;
use crate::flow::tree::walk;
use crate::passes::schedule::schedule;
use crate::scene::check;
use crate::sema::Options;
use crate::target::TARGETS;

fn graph(text: &str) -> Graph {
    let scene = check("nest", text);
    assert!(scene.is_right(), "{:?}", scene.diagnostics);
    scene.lower(&Options::default()).unwrap()
}

/// So many loops, each of whose turns goes through the next.
fn nest(deep: u32, most: u32, end: &str) -> Graph {
    let mut value = "x".to_owned();
    for k in 0..deep {
        value = format!(
            "loop (i{k} = 0) max {most} {{ if i{k} > {end} then i{k} else next(i{k} + 1 + abs({value}) mod 3) }} else 0"
        );
    }
    graph(&format!(
        "image 8 x 8 inks black, white;\ndraw (x, y) = ink(({value}) mod 2);"
    ))
}

#[test]
fn nests_of_loops_are_walked_within_a_number_of_statements() {
    for deep in [2, 4, 6] {
        let graph = nest(deep, 65535, "9000 + x");
        let tree = schedule(&graph);
        let mut size = 0;
        for block in tree.outer() {
            walk(block, &mut |_| size += 1);
        }
        for target in TARGETS.iter() {
            let slack = Slack::of(target.runtime);
            let (_, walked) = ranges_counted(&graph, &tree, &slack);
            // What is open when there are enough is walked once more, at every depth.
            let most = STATEMENTS + 4 * u64::from(deep + 1) * size;
            assert!(walked < most, "{deep} deep for {}: {walked}", target.name);
        }
    }
}

#[test]
fn what_is_said_of_a_nest_holds() {
    for (deep, most, end) in [(2, 20, "5 + y"), (3, 9, "x"), (4, 6, "2 * x - y")] {
        let graph = nest(deep, most, end);
        let tree = schedule(&graph);
        let (mut native, slack) = (Native::new(&graph), Slack::of(TARGETS[0].runtime));
        let (ranges, _) = ranges_counted(&graph, &tree, &slack);
        let ink = ranges.result[graph.ink.0 as usize];
        for (x, y) in (0..8).flat_map(|y| (0..8).map(move |x| (x, y))) {
            let found = f64::from(native.pixel(x, y).ink);
            assert!(ink.contains(found), "{found} at ({x}, {y}) in {ink:?}");
        }
    }
}
