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

/// What is far away is squared from the nearest point of the ray, so that nothing cancels.
#[test]
fn squares_of_what_is_far_are_taken_from_the_nearest_point() {
    for (d, before, after) in [
        ("length(p) - 1", 6, 1),
        ("min(length(p), length(p - (1, 0, 0.5)) + 0.25) - 0.5", 8, 2),
    ] {
        let plain = marched(d, "9000");
        let next = put(&plain).unwrap();
        assert_eq!(
            (products(&plain.graph), products(&next)),
            (before, after),
            "{d}"
        );
        // All that is added to a square of a turn is a sum of squares.
        let is_square =
            |id: NodeId| matches!(next.node(id), Node::Apply(Op::Mul, [a, b]) if a == b);
        let of_squares = |id: NodeId| match next.node(id) {
            Node::Apply(Op::Sqrt, [sum, _]) => squares(&next, sum).into_iter().all(is_square),
            _ => true,
        };
        assert!(next.ids().all(of_squares), "{d}");
        let pairs = shades(&plain.graph).into_iter().zip(shades(&next));
        for (old, new) in pairs {
            assert!((old - new).abs() < 1e-9, "{d}: {old} {new}");
        }
    }
}

/// The terms of a sum.
fn squares(graph: &Graph, sum: NodeId) -> Vec<NodeId> {
    match graph.node(sum) {
        Node::Apply(Op::Add, [a, b]) => [squares(graph, a), squares(graph, b)].concat(),
        _ => vec![sum],
    }
}

/// Three products a turn are a point's least; squares of what is far away cancel, and where the
/// direction's length is not known there is no nearest point.
#[test]
fn what_gains_nothing_or_would_cancel_is_left() {
    assert!(put(&marched("max(abs(p.x), max(abs(p.y), abs(p.z))) - 1", "9")).is_none());
    assert!(put(&marched("length((p.x, 0, p.z)) - 1", "9000")).is_none());
}
