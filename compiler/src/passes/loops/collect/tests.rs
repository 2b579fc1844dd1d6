//! Collected polynomials draw what they drew with fewer products, where no digits are lost.
#![allow(clippy::unwrap_used)]

use super::*;
use crate::passes::loops::drawn::{analysed, products, shades};
use crate::passes::loops::induction_tables::induction_tables;
use crate::schedule::analysed::Analysed;
use crate::targets::bbc::MICRO;
use crate::targets::mos6502::PLAIN;

/// The least of a number over seven turns: of `k`, the vectors `p`, `q` and `s` that hang on it,
/// and the ray `r`.
fn least(number: &str, runtime: &'static Runtime) -> Analysed {
    let source = format!(
        "image 24 x 16 inks black, white;
         fn at(k: real) -> vec3 = (cos(70deg * k), 1 - sin(20deg * k), sin(40deg * k));
         draw (x, y) = {{
           let r = pinhole((2, 1.5, 3), at: (0, 0, 0), field: 50deg).through(x, y);
           let t = loop (k = 0, t = 9.0) max 8 {{
             let p = at(k); let q = at(k + 1); let s = at(2 * k);
             if k == 7 then t else next(k + 1, min(t, {number}))
           }} else 9;
           threshold(t / 9, 0.5)
         }};"
    );
    analysed(&source, runtime)
}

/// Products at each turn, once what hangs on the counter is in tables.
fn left(graph: &Graph) -> usize {
    products(&induction_tables(graph, 2).unwrap())
}

#[test]
fn what_hangs_on_the_counter_stands_together() {
    for (number, before, after) in [
        // A triple product, and one of what is known of the eye.
        ("dot(p, cross(r.dir, q))", 9, 3),
        ("dot(r.from - p, cross(r.dir, q - p))", 9, 3),
        // Of rays from elsewhere, where both kinds of factors are vectors.
        ("dot(r.at(2) - p, cross(r.dir, q))", 9, 6),
        // A sum of two is one.
        ("dot(p, r.dir) + dot(q, r.dir)", 6, 3),
    ] {
        let plain = least(number, MICRO.runtime);
        let next = collected(&plain.graph, &plain.ranges, MICRO.runtime).unwrap();
        let found = (left(&plain.graph), left(&next));
        assert_eq!(found, (before, after), "{number}");
        for (old, new) in shades(&plain.graph).into_iter().zip(shades(&next)) {
            assert!((old - new).abs() < 1e-9, "{number}: {old} {new}");
        }
    }
}

#[test]
fn what_is_no_shorter_or_loses_digits_is_left_alone() {
    let is_left = |number: &str, runtime: &'static Runtime| {
        let plain = least(number, runtime);
        collected(&plain.graph, &plain.ranges, runtime).is_none()
    };
    assert!(is_left("dot(p, r.dir)", MICRO.runtime));
    assert!(is_left("sqrt(abs(r.dir.x)) * p.x", MICRO.runtime));
    // A polynomial in the counter.
    assert!(is_left(
        "(2 + 0.1 * k) * (r.dir.x + 0.3 * k) * (r.dir.y - 0.2 * k)",
        MICRO.runtime
    ));
    // A small difference of large numbers: of reals of few bits, nothing would be left of it.
    let far = "dot(r.at(2) + (9, 9, 9) - (p + (9, 9, 9)), cross(r.dir, q - p))";
    assert!(!is_left(far, MICRO.runtime));
    assert!(is_left(far, PLAIN.runtime));
}
