//! Values held at a direction's own length give the inks that they gave.

#![allow(clippy::unwrap_used)]

use super::{lengths, unnormalised};
use crate::analysis::range::{Ranges, Slack, ranges};
use crate::analysis::verify::verify;
use crate::eval::drawn::examples;
use crate::eval::native::Native;
use crate::ir::graph::*;
use crate::passes::branches::invert_monotone::invert_monotone;
use crate::passes::simplify::fold::fold;
use crate::schedule::statements::schedule;
use crate::targets::bbc::MICRO;

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
    let held = (lengths(graph, &ranges).into_iter())
        .filter_map(|length| unnormalised(graph, &ranges, length))
        .flat_map(|(held, longer)| std::iter::once(held).chain(longer));
    let mut found = 0;
    for other in held {
        let other = fold(&other);
        if let Err(broken) = verify(&other) {
            panic!("{name}, {found}: {broken}");
        }
        let [mut before, mut after] = [graph, &other].map(Native::new);
        let image = &graph.image;
        for y in (0..image.height as i32).step_by(STEP) {
            let [was, is] = [&mut before, &mut after].map(|native| {
                let mut row = Vec::new();
                native.pixels(0..image.width as i32, y, &mut row);
                row.iter().map(|pixel| pixel.ink).collect::<Vec<u8>>()
            });
            assert_eq!(was, is, "{name}, {found}, row {y}");
        }
        found += 1;
    }
    found
}

#[test]
fn inks_stay_as_they_were() {
    let (mut shaded, mut compared) = (0, 0);
    for (name, graph) in examples() {
        shaded += hold(&name, &graph);
        if let Some(next) = invert_monotone(&graph, &ranged(&graph), MICRO.runtime) {
            compared += hold(&name, &fold(&next));
        }
    }
    assert!(shaded > 10 && compared > 5, "{shaded} {compared}");
}

/// What a vector is multiplied by has a decimal: the second length makes that product
/// whole, too.
#[test]
fn products_are_whole_at_a_greater_length() {
    let source = "image 32 x 24 inks black, white;
        draw (x, y) = ink({
          let d = unit(((x - 15.5) / 16, (11.5 - y) / 16, -1));
          let b = dot((2, DECIMAL, 3), d);
          if b * b > 4 + d.x then 1 else 0
        });";
    for (decimal, another) in [("0.1", true), ("1", false)] {
        let scene = crate::scene::check("test", &source.replace("DECIMAL", decimal));
        let graph = fold(&scene.lower(&Default::default()).unwrap());
        let ranges = ranged(&graph);
        let all = lengths(&graph, &ranges);
        let made = all
            .iter()
            .map(|id| unnormalised(&graph, &ranges, *id).unwrap());
        let longer = made.filter(|(_, longer)| longer.is_some()).count();
        assert_eq!((all.len(), longer), (1, usize::from(another)), "{decimal}");
    }
}
