//! What sines of arcs become is the same number.
#![allow(clippy::unwrap_used)]

use super::angle_addition;
use crate::analysis::verify::verify;
use crate::eval::native::Native;
use crate::ir::graph::*;
use crate::passes::simplify::fold::fold;
use crate::scene::check;
use crate::sema::Options;
use slowlight_routine::Op;

fn scene(shade: &str) -> Graph {
    let text = format!(
        "image 8 x 6 inks black, white;
        draw (x, y) = {{ let u = (x - 3) / 3; let v = (y - 2) / 2; threshold({shade}, 0.5) }};"
    );
    let scene = check("arcs", &text);
    assert!(scene.is_right(), "{shade}: {:?}", scene.diagnostics);
    fold(&scene.lower(&Options::default()).unwrap())
}

/// How many of these operations outputs reach.
fn count(graph: &Graph, ops: &[Op]) -> usize {
    let reached = graph.reached();
    let is = |id: &NodeId| match graph.node(*id) {
        Node::Apply(op, _) => ops.contains(&op) && reached[id.0 as usize],
        _ => false,
    };
    graph.ids().filter(is).count()
}

#[test]
fn sines_of_arcs_are_the_same_numbers() {
    // With how many sines and cosines are left: those of an int's multiple.
    for (shade, left) in [
        ("cos(acos(u))", 0),
        ("sin(acos(u))", 0),
        ("cos(8 * acos(u)) + sin(7 * acos(v))", 0),
        ("sin(3 * asin(u) - 40deg)", 0),
        ("cos(asin(u) * -5)", 0),
        ("cos(atan2(u, v)) + 2 * sin(atan2(v, u))", 0),
        ("sin(16 * atan2(u, v) + 1rad)", 0),
        ("cos((atan2(u, v) / 1turn - 0.25) * 1turn)", 0),
        (
            "{ let a = atan2(u, v) / 1turn; let n = round(12 * a); sin((a - n / 12) * 1turn) }",
            2,
        ),
        ("{ let a = asin(u); cos(a + a / 2 + a / 2) }", 0),
    ] {
        let graph = scene(shade);
        let other =
            fold(&angle_addition(&graph).unwrap_or_else(|| panic!("{shade}: nothing found")));
        verify(&other).unwrap_or_else(|broken| panic!("{shade}: {broken}"));
        assert_eq!(count(&other, &[Op::Sin, Op::Cos]), left, "{shade}");
        let [mut before, mut after] = [&graph, &other].map(Native::new);
        for (x, y) in (0..8).flat_map(|x| (0..6).map(move |y| (x, y))) {
            let shades = [before.pixel(x, y), after.pixel(x, y)].map(|p| p.shade);
            let apart = (shades[0] - shades[1]).abs();
            assert!(apart < 1e-12, "{shade} at ({x}, {y}): {shades:?}");
        }
    }
}

#[test]
fn other_angles_are_left_alone() {
    for shade in [
        "cos(2.5 * acos(u))",
        "cos(17 * acos(u))",
        "cos(acos(u) + sqrt(v + 2) * 1rad)",
        "sin(acos(u) + asin(v))",
        "sin(u * acos(v))",
        "tan(acos(u))",
    ] {
        assert!(angle_addition(&scene(shade)).is_none(), "{shade}");
    }
}
