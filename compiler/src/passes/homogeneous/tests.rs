//! Values held at a direction's own length give the inks that they gave.

use super::{homogeneous, lengths};
use crate::eval::drawn::examples;
use crate::eval::native::Native;
use crate::flow::graph::*;
use crate::flow::verify::verify;
use crate::passes::fold::fold;
use crate::passes::schedule::schedule;
use crate::passes::threshold::threshold;
use crate::range::{Ranges, Slack, ranges};
use crate::target::bbc::MICRO;

/// Every so many rows are compared. Row 129 of mirrors.scn, where two values that
/// are compared are the same over the reals, so that roundings decide, is none of them.
const STEP: usize = 7;

fn ranged(graph: &Graph) -> Ranges {
    ranges(graph, &schedule(graph), &Slack::of(MICRO.runtime))
}

/// Holds every length's graph against the one that it is made of; answers how
/// many there were.
fn hold(name: &str, graph: &Graph) -> usize {
    let ranges = ranged(graph);
    let found = lengths(graph, &ranges);
    for &length in &found {
        let other = fold(&homogeneous(graph, &ranges, length));
        if let Err(broken) = verify(&other) {
            panic!("{name}, {length}: {broken}");
        }
        let [mut before, mut after] = [graph, &other].map(Native::new);
        let image = &graph.image;
        for y in (0..image.height as i32).step_by(STEP) {
            let [was, is] = [&mut before, &mut after].map(|native| {
                let mut row = Vec::new();
                native.pixels(0..image.width as i32, y, &mut row);
                row.iter().map(|pixel| pixel.ink).collect::<Vec<u8>>()
            });
            assert_eq!(was, is, "{name}, {length}, row {y}");
        }
    }
    found.len()
}

#[test]
fn inks_stay_as_they_were() {
    let (mut shaded, mut compared) = (0, 0);
    for (name, graph) in examples() {
        shaded += hold(&name, &graph);
        if let Some(next) = threshold(&graph, &ranged(&graph), MICRO.runtime) {
            compared += hold(&name, &fold(&next));
        }
    }
    assert!(shaded > 10 && compared > 5, "{shaded} {compared}");
}
