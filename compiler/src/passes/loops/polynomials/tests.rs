//! Polynomials by their coefficients draw what they drew, and a turn computes less.
#![allow(clippy::unwrap_used)]

use super::*;
use crate::passes::loops::drawn::{analysed, products, shades};
use crate::schedule::analysed::Analysed;
use crate::targets::bbc::MICRO;

/// A march along a ray by a distance `d` of a point `p`.
fn marched(d: &str, far: &str) -> Analysed {
    let source = format!(
        "image 24 x 16 inks black, white;
         fn away(p: vec3) -> real = {d};
         draw (x, y) = {{
           let r = pinhole((2, 1.5, 3), at: (0, 0, 0), field: 50deg).through(x, y);
           let t = loop (t = 0.0) max 40 {{
             let d = away(r.at(t));
             if d < 0.01 or t + d > {far} then t else next(t + d)
           }} else 9;
           threshold(t / 9, 0.5)
         }};"
    );
    analysed(&source, MICRO.runtime)
}

fn put(plain: &Analysed) -> Option<Graph> {
    polynomials(&plain.graph, &plain.ranges, MICRO.runtime)
}

#[test]
fn what_is_turned_or_squared_is_a_polynomial_in_the_distance() {
    for (d, before, after) in [
        // A square is two products less one, since directions have length 1.
        ("length(p) - 1", 6, 1),
        ("min(length(p) - 1, length(p - (1, 0, 0.5)) - 0.5)", 8, 2),
        // A turned point, its other part as it was.
        (
            "max(abs(0.8 * p.x + 0.6 * p.z), max(abs(0.8 * p.z - 0.6 * p.x), abs(p.y))) - 0.7",
            7,
            3,
        ),
    ] {
        let plain = marched(d, "9");
        let next = put(&plain).unwrap();
        assert_eq!(
            (products(&plain.graph), products(&next)),
            (before, after),
            "{d}"
        );
        let pairs = shades(&plain.graph).into_iter().zip(shades(&next));
        for (old, new) in pairs {
            assert!((old - new).abs() < 1e-9, "{d}: {old} {new}");
        }
    }
}

/// Three products a turn are a point's least; squares of what is far away cancel.
#[test]
fn what_gains_nothing_or_would_cancel_is_left() {
    assert!(put(&marched("max(abs(p.x), max(abs(p.y), abs(p.z))) - 1", "9")).is_none());
    assert!(put(&marched("length(p) - 1", "9000")).is_none());
}
