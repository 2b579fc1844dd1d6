//! Pruned minima are the minima, and leave out what loses.
#![allow(clippy::unwrap_used)]

use super::*;
use crate::analysis::verify::verify;
use crate::cost::size_budget::SizeBudget;
use crate::eval::native::Native;
use crate::planner::context::Context;
use crate::scene;
use crate::schedule::analysed::Analysed;
use crate::sema::Options;
use crate::targets::bbc::MICRO;

const SIZE: (i32, i32) = (24, 16);

/// The picture of a value `v` of the pixel's place `p`, and where it is planned.
fn settled(v: &str) -> (Context, Analysed) {
    let source = format!(
        "image 24 x 16 inks black, white;
         fn ball(p: vec3, r: real) -> real = length(p) - r;
         fn box(p: vec3, half: vec3) -> real = {{
           let q = abs(p) - half;
           length(max(q, (0, 0, 0))) + min(max(q.x, max(q.y, q.z)), 0)
         }};
         fn ring(p: vec3, major: real, minor: real) -> real =
           length((length((p.x, p.z, 0)) - major, p.y, 0)) - minor;
         draw (x, y) = {{
           let p = (x / 4 - 3, y / 4 - 2, (x + y) / 8 - 2);
           let v = {v};
           threshold(v / 4 + 0.5, 0.5)
         }};"
    );
    let checked = scene::check("test", &source);
    assert!(checked.is_right(), "{source}: {:?}", checked.diagnostics);
    let graph = checked.lower(&Options::default()).unwrap();
    let cx = Context::new(graph.clone(), MICRO.runtime);
    let plain = cx.simplified(&graph);
    (cx, plain)
}

fn pruned(plain: &Analysed) -> Option<Graph> {
    prune_minima(&plain.graph, &plain.ranges, MICRO.runtime)
}

/// Shades everywhere.
fn shades(graph: &Graph) -> Vec<f64> {
    let mut native = Native::new(graph);
    let places = (0..SIZE.1).flat_map(|y| (0..SIZE.0).map(move |x| (x, y)));
    places.map(|(x, y)| native.pixel(x, y).shade).collect()
}

#[test]
fn minima_are_what_they_were_and_less_is_computed() {
    for (v, most) in [
        // Of two, of many, and minima of minima.
        ("min(ball(p, 1), ball(p - (1, 0, 0), 0.5))", 1.0),
        (
            "min(min(ball(p, 1), box(p + (2, 0, 0), (0.5, 1, 0.3))), \
             min(ring(p - (1, 0, 0), 1, 0.2), ball(p - (2, 1, 0), 0.4)))",
            0.9,
        ),
        // What is at hand first.
        ("min(p.y, box(p, (0.5, 1, 0.3)))", 0.9),
        // What is taken away.
        ("max(ball(p, 1), -ball(p - (0.5, 0.5, 0), 0.8))", 1.0),
        ("max(p.y, -min(ball(p, 1), box(p, (1, 0.2, 1))))", 1.0),
        ("max(p.y, 1.5 - length(p))", 1.0),
        // What is never great.
        (
            "max(ball(p, 1), sin(p.x * 3rad) * cos(p.y * 3rad) / 9)",
            0.8,
        ),
        // What is rounded.
        (
            "smooth_min(smooth_min(ball(p, 1), ball(p - (1, 0, 0), 0.5), 0.4), \
             box(p + (2, 0, 0), (0.5, 1, 0.3)), 0.6)",
            0.95,
        ),
        (
            "-smooth_min(-ball(p, 1), ball(p - (1, 0, 0), 0.5), 0.4)",
            1.0,
        ),
        // What is common.
        ("max(ball(p, 1), ball(p - (0.5, 0.5, 0), 0.8))", 1.0),
    ] {
        let (cx, plain) = settled(v);
        let made = pruned(&plain).unwrap_or_else(|| panic!("{v}: nothing pruned"));
        verify(&made).unwrap();
        for (a, b) in shades(&plain.graph).iter().zip(&shades(&made)) {
            assert!((a - b).abs() < 1e-12, "{v}: {a} {b}");
        }
        let price = cx.price(SizeBudget::default());
        let cycles = |plan: &Analysed| price.cycles_known(plan);
        let part = cycles(&cx.simplified(&made)) / cycles(&plain);
        assert!(part < most, "{v}: {part}");
    }
}

#[test]
fn what_is_cheap_or_read_elsewhere_is_left() {
    for v in [
        "min(p.x, p.y)",
        // Its root is needed in any case.
        "{ let d = ball(p, 1); min(p.y, d) + d }",
        // By a width that may be below 0.
        "smooth_min(p.y, ball(p, 1), p.x)",
        // What is rounded is 0 nowhere.
        "smooth_min_exp(p.y, ball(p, 1), 4)",
        // No bound, and no root.
        "min(p.y, sin(p.x * 1rad) * cos(p.y * 1rad))",
    ] {
        assert!(pruned(&settled(v).1).is_none(), "{v}");
    }
}

/// max(x, y) + min(max(x, z), 0) is less than x where all are below 0, unlike where the first is
/// a root: x is no bound of it.
#[test]
fn what_only_looks_like_a_box_has_no_bound() {
    let inside = "min(max(p.x, length(p) - 5), 0)";
    let with =
        |outside: &str| pruned(&settled(&format!("min(p.z / 8 - 3, {outside} + {inside})")).1);
    assert!(with("max(p.x, p.y)").is_none());
    assert!(with("length((max(p.x, 0), max(p.y, 0), 0))").is_some());
}

/// Long chains and doubled sums take no time of their own.
#[test]
fn many_minima_are_one_chain() {
    let balls: Vec<String> = (0..150)
        .map(|k| format!("ball(p - ({k} / 50 - 1, 0, 0), 0.1 + {k} / 1000)"))
        .collect();
    let v = balls
        .iter()
        .skip(1)
        .fold(balls[0].clone(), |all, ball| format!("min({all}, {ball})"));
    let (_, plain) = settled(&v);
    let made = pruned(&plain).unwrap();
    assert!(made.nodes.len() < 3 * plain.graph.nodes.len());
    let mut doubled = "p.x * p.x".to_owned();
    for _ in 0..7 {
        doubled = format!("({doubled} + {doubled})");
    }
    let (_, plain) = settled(&format!("min(p.y, sqrt({doubled}) - 1)"));
    pruned(&plain).unwrap();
}
