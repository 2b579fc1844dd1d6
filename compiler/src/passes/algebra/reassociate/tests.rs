//! Sums in other forms draw what they drew, have fewer additions at a pixel, and stay
//! where the sides are not equal.
#![allow(clippy::unwrap_used)]

use super::{Site, Sums, sunk};
use crate::analysis::rate::rates;
use crate::eval::drawn::examples;
use crate::eval::native::Native;
use crate::eval::random_graphs;
use crate::ir::graph::*;
use crate::passes::simplify::fold::fold;
use crate::planner::context::Context;
use crate::scene;
use crate::schedule::analysed::Analysed;
use crate::sema::Options;
use crate::targets::find;
use slowlight_routine::{Op, Runtime};

fn runtime() -> &'static Runtime {
    find("jack").unwrap().runtime
}

fn settled(graph: &Graph) -> Analysed {
    Context::new(graph.clone(), runtime()).simplified(graph)
}

fn lowered(ink: &str) -> Analysed {
    let source = format!(
        "image 32 x 24 inks black, white; param p: real = 2 in 1 .. 3;
         draw (x, y) = ink({{
           let s = sqrt((x - 15.5) * (x - 15.5) + ((y - 3.3) * (y - 3.3) + 7));
           let t = sqrt(s + 2.5);
           let r = (y - 3.3) * 0.7;
           if {ink} then 1 else 0
         }});"
    );
    let scene = scene::check("test", &source);
    assert!(scene.is_right(), "{source}: {:?}", scene.diagnostics);
    settled(&scene.lower(&Options::default()).unwrap())
}

/// The plan with some of its sites in the other form.
fn put(plain: &Analysed, which: impl Fn(&Site) -> bool) -> Option<Graph> {
    let sums = Sums::new(&plain.graph, &plain.ranges, runtime());
    let mut all = sums.sites();
    all.retain(which);
    let graph = sums.regrouped(&all)?.graph;
    Some(fold(&graph))
}

/// How many of an operation pixels need.
fn count(graph: &Graph, ops: &[Op]) -> usize {
    let (reached, rates) = (graph.reached(), rates(graph));
    let of = |id: &NodeId| matches!(graph.node(*id), Node::Apply(op, _) if ops.contains(&op));
    let here = graph.ids().filter(|id| reached[id.0 as usize]);
    here.filter(|id| of(id) && !rates.is_still(*id)).count()
}

const SUMS: &[Op] = &[Op::Add, Op::Sub];

fn same(name: &str, a: &Graph, b: &Graph) {
    let (height, width) = (a.image.height as i32, a.image.width as i32);
    let (mut a, mut b) = (Native::new(a), Native::new(b));
    for y in (0..height).step_by((height as usize / 8).max(1)) {
        for x in (0..width).step_by((width as usize / 16).max(1)) {
            assert_eq!(a.pixel(x, y).ink, b.pixel(x, y).ink, "{name} at {x}, {y}");
        }
    }
}

fn gathered(site: &Site) -> bool {
    matches!(site, Site::Gathered(_))
}

#[test]
fn what_a_row_knows_is_added_first() {
    let plain = lowered("(r + s * t) - (y + 1.5) > 7 * t");
    let next = put(&plain, gathered).expect("a sum");
    assert_eq!(count(&next, SUMS) + 1, count(&plain.graph, SUMS));
    same("gathered", &plain.graph, &next);
}

#[test]
fn what_two_sums_have_is_added_once() {
    let plain = lowered("(s * 0.3 + t * 0.4) + s * t > 9 and (t * t * 0.2 + t * 0.4) + s * t < 60");
    let next = put(&plain, gathered).expect("a pair");
    assert_eq!(count(&next, SUMS) + 1, count(&plain.graph, SUMS));
    same("pair", &plain.graph, &next);
}

#[test]
fn what_divides_all_terms_divides_once_where_it_is_not_0() {
    let divided = |site: &Site| matches!(site, Site::Divided(_));
    let ink = |by: &str| {
        let parts = ["1.5 * (x - 9.5)", "r", "-0.7 * y"].map(|p| format!("{p} / {by}"));
        format!("({} + {}) + {} > 0.3", parts[0], parts[1], parts[2])
    };
    let plain = lowered(&ink("s"));
    let next = put(&plain, divided).expect("a divisor");
    assert_eq!(
        count(&next, &[Op::Div]) + 2,
        count(&plain.graph, &[Op::Div])
    );
    assert_eq!(count(&next, SUMS) + 1, count(&plain.graph, SUMS));
    same("divided", &plain.graph, &next);
    // What may be 0 divides nothing but what it divided.
    assert!(put(&lowered(&ink("(s - 4)")), divided).is_none());
    // A length is known by its squares.
    let squares = "(r / s) * (r / s) + (t / s) * (t / s) > 0.3";
    assert!(put(&lowered(squares), divided).is_none());
}

#[test]
fn a_sum_is_made_of_another_that_differs_by_what_a_row_knows() {
    let plain = lowered("(s * t + r) * (s * t + 2 * y) * (s * t - 1.5) > 900");
    let all = Sums::new(&plain.graph, &plain.ranges, runtime()).sites();
    let bases: Vec<&Site> = all.iter().filter(|s| matches!(s, Site::From(_))).collect();
    // Of the three, and of what is under the other root.
    assert_eq!(bases.len(), 4);
    for base in bases {
        if let Some(next) = put(&plain, |site| site == base) {
            assert!(count(&next, SUMS) <= count(&plain.graph, SUMS));
            same("from", &plain.graph, &next);
        }
    }
}

#[test]
fn what_a_sum_would_drown_in_is_not_added_to_it() {
    // A small value made of a large one would be lost.
    let plain = lowered("(s * 0.001 + 0.001) * (s * 0.001 + 300000) > 900");
    for site in Sums::new(&plain.graph, &plain.ranges, runtime()).sites() {
        let Site::From(id) = site else {
            continue;
        };
        let large = plain.ranges.result[id.0 as usize].lo > 1000.0;
        let next = put(&plain, |other| *other == site);
        assert!(!large || next.is_none());
    }
}

#[test]
fn a_factor_against_itself_goes_where_it_is_not_0() {
    let plain = lowered("(r * s) / s > 0.3");
    let next = put(&plain, gathered).expect("a quotient");
    assert_eq!(count(&next, &[Op::Div]), 0);
    same("factor", &plain.graph, &next);
    assert!(put(&lowered("(r * (s - 4)) / (s - 4) > 0.3"), gathered).is_none());
}

#[test]
fn examples_and_graphs_at_random_draw_what_they_drew() {
    let random = (1..200).map(|seed| (format!("seed {seed}"), random_graphs::graph(seed)));
    let mut done = 0;
    for (name, graph) in examples().into_iter().chain(random) {
        let plain = settled(&graph);
        for form in 0..3 {
            let next = put(&plain, |site| match site {
                Site::Gathered(_) => form == 0,
                Site::Divided(_) => form == 1,
                Site::From(_) => form == 2,
            });
            if let Some(next) = next {
                done += 1;
                same(&name, &plain.graph, &next);
            }
        }
    }
    assert!(done > 20, "{done}");
}

#[test]
fn sums_in_loops_ends_draw_what_they_drew() {
    for seed in 1..400 {
        let graph = fold(&random_graphs::graph(seed));
        if let Some(next) = sunk(&graph) {
            same(&format!("seed {seed}"), &graph, &next);
        }
    }
    let far = "fn far(a: real, b: real) -> real =
          loop (t = a) max 9 { if t < b then next(t * 1.7 + 0.3) else t } else b;";
    for ink in [
        "far(x + 1, y) + 2 > 3 * y - x",
        // Both that are chosen between are results.
        "(if x > y then far(x + 1, y) else far(y + 1, x + 0.3)) + 2 > 3 * y - x",
        "2 - (if x > y then far(x + 1, y) else y) > 3 * y - x",
    ] {
        let source = format!(
            "image 32 x 24 inks black, white; {far} draw (x, y) = ink(if {ink} then 1 else 0);"
        );
        let scene = scene::check("test", &source);
        assert!(scene.is_right(), "{:?}", scene.diagnostics);
        let graph = fold(&scene.lower(&Options::default()).unwrap());
        let next = sunk(&graph).expect("a result");
        same(ink, &graph, &next);
    }
}
