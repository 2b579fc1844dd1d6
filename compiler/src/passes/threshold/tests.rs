//! The comparisons give the ink that the steps give.
#![allow(clippy::unwrap_used)]

use super::threshold;
use crate::eval::native::Native;
use crate::flow::graph::*;
use crate::passes::fold::fold;
use crate::passes::schedule::schedule;
use crate::range::{Slack, ranges};
use crate::scene;
use crate::sema::Options;
use crate::target::find;

/// A graph before and after the pass, if it does anything.
fn both(source: &str) -> (Graph, Option<Graph>) {
    let scene = scene::check("test", source);
    assert!(scene.is_right(), "{source}: {:?}", scene.diagnostics);
    let graph = fold(&scene.lower(&Options::default()).unwrap());
    let ranges = ranges(&graph, &schedule(&graph), &Slack::exact());
    let runtime = find("bbc:micro").unwrap().runtime;
    let after = threshold(&graph, &ranges, runtime);
    (graph, after.map(|g| fold(&g)))
}

fn scene_of(inks: &str, dither: &str, shade: &str) -> String {
    format!(
        "image 61 x 47 inks {inks};\n\
         const cells = [0, 24, 6, 30; 36, 12, 42, 18; 9, 33, 3, 27; 45, 21, 39, 15];\n\
         dither d(v: real, x: int, y: int) -> ink = {dither};\n\
         draw (x, y) = d({shade}, x, y);\n"
    )
}

const FOUR: &str = "black, red, yellow, white";

#[test]
fn every_pixel_keeps_its_ink() {
    let shade = "(x * 31 + y * 17) mod 97 / 90";
    for (inks, dither) in [
        (
            FOUR,
            "ink(inks - 1 - floor(16 * (inks - 1) * sqrt(v) + cells[x mod 4, (247 - y) mod 4] / 3) div 16)",
        ),
        (FOUR, "ink(floor(3.99 * v + cells[x mod 4, y mod 4] / 48))"),
        (FOUR, "ink(round((1 - v) * 3 / 1.1))"),
        (FOUR, "ink(floor(sqrt(max(v, 0.1) * 12 + (x mod 4)) - 0.5))"),
        (
            "black, white",
            "ink(floor(0 - (clamp(v, 0, 1) * 0.9 - (x mod 8) / 8)) + 1)",
        ),
    ] {
        let (before, after) = both(&scene_of(inks, dither, shade));
        let after = after.unwrap_or_else(|| panic!("{dither} is left alone"));
        let [mut old, mut new] = [&before, &after].map(Native::new);
        let mut seen = std::collections::BTreeSet::new();
        for (x, y) in (0..47).flat_map(|y| (0..61).map(move |x| (x, y))) {
            let [is, was] = [new.pixel(x, y).ink, old.pixel(x, y).ink];
            assert_eq!(is, was, "{dither} at {x}, {y}");
            seen.insert(is);
        }
        assert!(seen.len() > 1, "{dither}: one ink everywhere");
    }
}

/// Bisection finds the first real of a step to its last bit.
#[test]
fn thresholds_are_exact() {
    let (_, after) = both(&scene_of(
        "black, white",
        "ink(floor(sqrt(v) * 3 - 0.1))",
        "x / 30",
    ));
    let after = after.unwrap();
    let compared = after.ids().find_map(|id| match after.node(id) {
        Node::Apply(slowlight_routine::Op::Less, [_, t]) => after.constant(t),
        _ => None,
    });
    let t = compared.unwrap().real();
    // What is compared is x, before it is divided.
    let ink = |x: f64| ((x / 30.0).sqrt() * 3.0 - 0.1).floor();
    assert_eq!((ink(t), ink(t.next_down())), (1.0, 0.0));
}

#[test]
fn what_is_not_monotone_is_left_alone() {
    for dither in [
        "ink(floor(v * 9) mod 4)",
        // Nothing to save.
        "ink(if v < 0.5 then 1 else 0)",
        "ink((x + y) mod 4)",
    ] {
        let (_, after) = both(&scene_of(FOUR, dither, "(x + y) / 90"));
        assert!(after.is_none(), "{dither}");
    }
    let spread = "{ spread v / 2 to { (1, 0): 1 }; ink(floor(sqrt(v) * 3)) }";
    assert!(both(&scene_of(FOUR, spread, "x / 60")).1.is_none());
}

/// All thresholds of a dither by a matrix are worked out from its cells, as are
/// the squares that algebra compares with; the bits stay near the entries.
#[test]
fn thresholds_are_worked_out_from_the_cells() {
    let scene = crate::scene::check("test", include_str!("../../../../examples/mirrors.scn"));
    let target = crate::target::find("bbc:micro").unwrap();
    let options = crate::sema::Options {
        offset: target.offset,
        ..Default::default()
    };
    let graph = scene.lower(&options).unwrap();
    let goal = crate::plan::Goal {
        name: "test".to_owned(),
        mode: crate::target::default_mode(target, 320, 240).unwrap(),
        rows: None,
        plot: true,
    };
    let plan = crate::plan::plan(&graph, target, &goal).unwrap();
    assert!(plan.graph.tables.len() > 4);
    for (k, table) in plan.graph.tables.iter().enumerate() {
        let id = TableId(k as u32);
        assert!(plan.table(id).unwrap().recipe.is_some(), "{}", table.name);
        for (at, entry) in table.entries.iter().enumerate() {
            let (real, bits) = (entry.value().real(), plan.entry(id, at));
            let made = (plan.runtime.decode)(bits, plan.runtime.real).real();
            assert!(
                (made - real).abs() <= real.abs() / 4_194_304.0,
                "{made} for {real}"
            );
        }
    }
}
