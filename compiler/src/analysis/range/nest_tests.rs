//! Loops inside each other: the walk ends, and what it says holds.
#![allow(clippy::unwrap_used)]

use super::{STATEMENTS, Slack, ranges_counted};
use crate::eval::native::Native;
use crate::ir::graph::Graph;
use crate::ir::tree::walk;
use crate::scene::check;
use crate::schedule::statements::schedule;
use crate::sema::Options;
use crate::targets::TARGETS;

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

/// Shapes of shapes: each is a loop over where its parts begin and end, in the loop of the one
/// that it is a part of. Where bounds grow in each turn, nests are not walked through to the end.
#[test]
fn nests_of_shapes_are_walked_within_a_number_of_statements_a_node() {
    let graph = graph(
        "image 16 x 12 inks black, white;
        scene world {
          intersection(
            union(intersection(sphere((-0.6, 0.4, 2), 0.5), cylinder((0.7, 0.6, 1.7), (0, 1, 0), 0.5)),
              box((-0.2, -0.8, -0.2), (0.9, 0.8, 0.5))),
            difference(box((-0.9, -0.5, -0.9), (0.6, 1, 1)), box((-0.4, 0, -0.4), (0.7, 0.4, 0.4)))) is 0.3;
        }
        draw (x, y) = threshold(if let h = world.trace(ray((1, 1, 4), unit((x / 16 - 0.5, 0.5 - y / 12, -1.5))), far: 100)
          then h.tag * lambert(h, (0.48, 0.64, 0.6)) else 0.1, 0.5);",
    );
    let tree = schedule(&graph);
    for target in TARGETS.iter() {
        let (_, walked) = ranges_counted(&graph, &tree, &Slack::of(target.runtime));
        let most = 1_000 * graph.nodes.len() as u64;
        assert!(walked < most, "{}: {walked} of {most}", target.name);
    }
}

/// A counter that its loop's turns end before it gets somewhere is not asked whether it is there.
#[test]
fn a_counter_has_not_counted_the_last_turn() {
    for (most, is_asked) in [(4, false), (5, true)] {
        let graph = graph(&format!(
            "image 8 x 8 inks black, white;
             draw (x, y) = ink((loop (k = 0, s = 1) max {most} {{
               if k == 4 then x else next(k + 1, 2 * s + x) }} else s) mod 2);"
        ));
        let tree = schedule(&graph);
        let found = ranges_counted(&graph, &tree, &Slack::exact()).0;
        let again = graph.loops.first().unwrap().again;
        let always = found.result.get(again.0 as usize).unwrap().constant();
        assert_eq!(always.is_none(), is_asked, "{most}");
    }
}
