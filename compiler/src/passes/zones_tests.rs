//! What is told by zones is what the ways give, and asks less.

use super::zones::choices;
use crate::eval::drawn::grid;
use crate::eval::native::Native;
use crate::flow::graph::*;
use crate::passes::fold::fold;
use crate::passes::schedule::schedule;
use crate::range::{Ranges, Slack, ranges};
use crate::scene;
use crate::sema::Options;
use crate::target::bbc::MICRO;

/// A scene whose inks are told by v and by a dear condition.
fn lowered(ink: &str) -> (Graph, Ranges) {
    let source = format!(
        "image 24 x 16 inks black, grey, silver, white;
         const low = [0.1, 0.3; 0.2, 0.15]; const high = [0.35, 0.5; 0.45, 0.75];
         const signed = [-0.1, 0.2; 0.1, -0.3];
         draw (x, y) = {{
           let v = (x * 0.7 + y) / 40;
           let dear = loop (u = x * 0.1 + y * 0.07, n = 0) max 40 {{
             if n < 30 then next(u * 1.1 + 0.01, n + 1) else u > 20
           }} else false;
           ink({ink})
         }};"
    );
    let options = Options {
        inks: Some(4),
        ..Options::default()
    };
    let checked = scene::check("test", &source);
    let graph = fold(&checked.lower(&options).expect(&source));
    let ranges = ranges(&graph, &schedule(&graph), &Slack::of(MICRO.runtime));
    (graph, ranges)
}

/// The inks, and how many operations they took.
fn inks(graph: &Graph) -> (Vec<u8>, u64) {
    let mut native = Native::new(graph);
    let inks = grid(24, 16, 1);
    let inks = inks.iter().map(|(x, y)| native.pixel(*x, *y).ink).collect();
    (inks, native.operations())
}

const STEPS: [&str; 3] = [
    "if dear then (if v < 0.2 then 3 else if v < 0.5 then 2 else 1)
     else (if 0.3 <= v then (if v > 0.6 then 1 else 2) else 3)",
    "if dear then (if v < low[x mod 2, y mod 2] then 3 else 2)
     else (if high[x mod 2, y mod 2] < v then 2 else 3)",
    // Below 0, where v never is, order is no matter.
    "if dear then (if v < low[x mod 2, y mod 2] then 1 else 2)
     else (if v < signed[x mod 2, y mod 2] then 1 else 2)",
];

#[test]
fn zones_give_what_the_ways_give_and_ask_less() {
    for ink in &STEPS {
        let (graph, ranges) = lowered(ink);
        let (drawn, all) = inks(&graph);
        let found = choices(&graph, &ranges);
        assert_eq!(found.len(), 1, "{ink}");
        for choice in &found {
            let every = choice.all();
            let others = choice.others(&every);
            assert!(others.len() > 1, "{ink}");
            for way in others.iter().chain([&every]) {
                let (inks, few) = inks(&choice.put(way));
                assert_eq!(inks, drawn, "{ink}: {way:?}");
                let limit = if *way == every { all * 9 / 10 } else { all };
                assert!(few < limit, "{ink}: {way:?} {few} of {all}");
            }
        }
    }
}

#[test]
fn numbers_without_a_known_order_are_left() {
    for ink in [
        // Either table may have the greater entry.
        "if dear then (if v < low[x mod 2, y mod 2] then 3 else 2)
         else (if v < low[y mod 2, x mod 2] then 3 else 2)",
        // Two values.
        "if dear then (if v < 0.2 then 3 else 2) else (if v + x < 0.4 then 3 else 2)",
        // The same number, counted to either side.
        "if dear then (if v < 0.2 then 3 else 2) else (if v <= 0.2 then 3 else 2)",
        // Nowhere the same.
        "if dear then (if v < 0.2 then 3 else 2) else (if v < 0.4 then 1 else 0)",
    ] {
        let (graph, ranges) = lowered(ink);
        assert_eq!(choices(&graph, &ranges).len(), 0, "{ink}");
    }
}
