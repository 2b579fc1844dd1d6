//! Polynomials by their differences draw what they drew, and a turn has fewer products.
#![allow(clippy::unwrap_used)]

use super::*;
use crate::passes::loops::drawn::{analysed, products, shades};
use crate::schedule::analysed::Analysed;
use crate::targets::bbc::MICRO;
use slowlight_runtime_6502::scaled::FIXED16;

/// A search along a ray by a function of a point `p`; what is looked at, and what the next turn
/// has.
fn searched(f: &str, at: &str, next: &str, turns: u32, runtime: &'static Runtime) -> Analysed {
    let source = format!(
        "image 24 x 16 inks black, white;
         fn inside(p: vec3) -> real = {f};
         draw (x, y) = {{
           let r = pinhole((2, 1.5, 3), at: (0, 0, 0), field: 50deg).through(x, y);
           let step = 0.1 + x / 240;
           let t = loop (t = 0.5) max {turns} {{
             if inside(r.at({at})) < 0 then t else next({next})
           }} else 9;
           threshold(t / 9, 0.5)
         }};"
    );
    analysed(&source, runtime)
}

fn put(f: &str, at: &str, next: &str) -> (Analysed, Option<Graph>) {
    let plain = searched(f, at, next, 40, MICRO.runtime);
    let next = forward_differences(&plain.graph, &plain.ranges, MICRO.runtime);
    (plain, next)
}

/// The third of the points is a product of two values that grow evenly.
#[test]
fn what_grows_evenly_is_a_sum() {
    for (f, at, next, before, after) in [
        (
            "max(abs(p.x), max(abs(p.y), abs(p.z))) - 1",
            "t",
            "t + step",
            3,
            0,
        ),
        (
            "max(abs(p.x), max(abs(p.y), abs(p.z))) - 1",
            "t",
            "t - -0.125",
            3,
            0,
        ),
        (
            "max(abs(p.x), abs(p.y * 0.3 - p.z)) - 1",
            "t + step",
            "t + step",
            4,
            0,
        ),
        ("p.x * p.y - max(p.z, 0)", "t", "t + step", 4, 0),
        ("dot(p, p) - 1.3", "t + 0.2", "step + t", 6, 0),
    ] {
        let (plain, next) = put(f, at, next);
        let next = next.unwrap();
        assert_eq!(
            (products(&plain.graph), products(&next)),
            (before, after),
            "{f}"
        );
        for (old, new) in shades(&plain.graph).into_iter().zip(shades(&next)) {
            assert!((old - new).abs() < 1e-9, "{f}: {old} {new}");
        }
    }
}

#[test]
fn what_does_not_grow_evenly_is_left() {
    assert!(
        put("max(abs(p.x), abs(p.y)) - 1", "t", "t * 1.1")
            .1
            .is_none()
    );
    assert!(
        put("max(abs(p.x), abs(p.y)) - 1", "t", "t + 0.1 * abs(t)")
            .1
            .is_none()
    );
}

/// A sum of a thousand roundings of 16 bits is not what it should be.
#[test]
fn as_many_turns_are_summed_up_as_the_format_has_digits_for() {
    let put = |turns: u32| {
        let f = "max(abs(p.x), max(abs(p.y), abs(p.z))) - 1";
        let plain = searched(f, "t", "t + step", turns, &FIXED16);
        forward_differences(&plain.graph, &plain.ranges, &FIXED16)
    };
    assert!(put(100).is_some());
    assert!(put(1000).is_none());
}

/// A square of what is far away ends near 0, where its roundings on the way count.
#[test]
fn squares_are_summed_up_where_their_roundings_do_not_matter() {
    let put = |eye: u32| {
        let source = format!(
            "image 24 x 16 inks black, white;
             draw (x, y) = {{
               let r = pinhole((0, 0, {eye}), at: (0, 0, 0), field: 20deg).through(x, y);
               let t = loop (t = 0.5) max 60 {{
                 let p = r.at(t);
                 if dot(p, p) < 0.8 then 1.0 else next(t + {eye} / 50)
               }} else 0;
               threshold(t, 0.5)
             }};"
        );
        let plain = analysed(&source, &FIXED16);
        let made = forward_differences(&plain.graph, &plain.ranges, &FIXED16);
        made.map_or(products(&plain.graph), |made| products(&made))
    };
    assert_eq!(put(2), 0);
    assert_eq!(put(80), 3);
}

/// What one loop cannot have keeps no other from it, and what is shared is looked at once.
#[test]
fn loops_are_told_apart_and_long_chains_take_no_time() {
    let chain: String = (1..60)
        .map(|k| {
            let (s, q) = (format!("s{}", k - 1), format!("q{}", k - 1));
            format!("let s{k} = max({s} * {q}, 0.1); let q{k} = min({q} * {s}, 0.9);\n")
        })
        .collect();
    let source = format!(
        "image 24 x 16 inks black, white;
         draw (x, y) = {{
           let r = pinhole((2, 1.5, 3), at: (0, 0, 0), field: 50deg).through(x, y);
           let s0 = 0.1 + x / 240; let q0 = 0.9 - y / 160;
           {chain}
           let t = loop (t = 0.5) max 40 {{
             let p = r.at(t);
             if max(abs(p.x), max(abs(p.y), abs(p.z))) < 1 then t else next(t + (0.1 + 0.1 * s59))
           }} else 9;
           let v = loop (u = 0.3, k = 0) max 4 {{
             let w = loop (t = 0.1) max 20 {{ if t * u + 0.3 > 1 then t else next(t + 0.125) }} else 0;
             if k == 3 then u else next(u * 0.9 + w * 0.01, k + 1)
           }} else 0;
           threshold(t / 9 + v, 0.5)
         }};"
    );
    let plain = analysed(&source, MICRO.runtime);
    let next = forward_differences(&plain.graph, &plain.ranges, MICRO.runtime).unwrap();
    assert_eq!(products(&plain.graph) - products(&next), 3);
    for (old, new) in shades(&plain.graph).into_iter().zip(shades(&next)) {
        assert!((old - new).abs() < 1e-9, "{old} {new}");
    }
}
