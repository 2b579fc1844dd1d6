//! Functions of one real become tables where they are flat enough, and draw what they drew.
#![allow(clippy::unwrap_used)]

use super::*;
use crate::passes::loops::drawn::{analysed, shades};
use slowlight_runtime_6502::float::REAL40;
use slowlight_runtime_6502::scaled::{FIXED16, FIXED24};

fn tabled(shade: &str, runtime: &'static Runtime) -> (Graph, Option<Graph>) {
    let source = format!(
        "image 24 x 16 inks black, white;
         draw (x, y) = {{
           let a = x * 0.137 + y * 0.071;
           threshold({shade}, 0.5)
         }};"
    );
    let plain = analysed(&source, runtime);
    let next = function_tables(&plain.graph, &plain.ranges, runtime);
    (plain.graph.clone(), next)
}

/// How many operations with reals are left.
fn reals(graph: &Graph) -> usize {
    let reached = graph.reached();
    let is_real = |id: &NodeId| matches!(graph.node(*id), Node::Apply(op, _) if op.args().first() == Some(&Type::Real));
    let all = graph.ids().filter(|id| reached[id.0 as usize]);
    all.filter(is_real).count()
}

#[test]
fn fades_are_looked_up() {
    let fade = "smoothstep(0, 1, a - floor(a))";
    let (plain, next) = tabled(fade, &FIXED16);
    let next = next.unwrap();
    assert!(has_function_tables(&next) && !has_function_tables(&plain));
    assert!(reals(&next) < reals(&plain));
    for (old, new) in shades(&plain).into_iter().zip(shades(&next)) {
        assert!((old - new).abs() < 0.004, "{old} {new}");
    }
    // Of another range, clamped on its way.
    let (plain, next) = tabled("smoothstep(1, 4, a) * 0.5 + 0.25", &FIXED16);
    for (old, new) in shades(&plain).into_iter().zip(shades(&next.unwrap())) {
        assert!((old - new).abs() < 0.004, "{old} {new}");
    }
}

#[test]
fn what_is_steep_or_cheap_or_of_two_values_is_left() {
    for shade in [
        // Steep; without a bound; two sums; of two reals.
        "(a - floor(a)) ^ 9",
        "1 / (a * a * a - 3.01)",
        "0.5 - (a - floor(a)) + 0.1",
        "(x * 0.1) * (y * 0.07) * (x * 0.1 + y * 0.05)",
    ] {
        assert!(tabled(shade, &FIXED16).1.is_none(), "{shade}");
    }
}

#[test]
fn formats_of_many_digits_keep_them() {
    let fade = "smoothstep(0, 1, a - floor(a))";
    assert!(tabled(fade, &FIXED24).1.is_none());
    assert!(tabled(fade, &REAL40).1.is_none());
}

#[test]
fn sines_of_pixels_are_looked_up_in_any_format() {
    for runtime in [&FIXED16, &FIXED24, &REAL40] {
        for shade in ["0.5 + 0.4 * sin(a * 1rad)", "0.5 + 0.4 * cos(3 * a * 1rad)"] {
            let (plain, next) = tabled(shade, runtime);
            let next = next.expect(shade);
            let is_sine = |id: &NodeId| matches!(next.node(*id), Node::Apply(Op::Sin | Op::Cos, _));
            let reached = next.reached();
            let left = next.ids().filter(is_sine);
            assert_eq!(left.filter(|id| reached[id.0 as usize]).count(), 0);
            // Half a part of the period, and of that four tenths.
            for (old, new) in shades(&plain).into_iter().zip(shades(&next)) {
                assert!((old - new).abs() < 0.4 * 0.0124, "{shade}: {old} {new}");
            }
        }
    }
}

#[test]
fn sines_of_a_column_a_row_or_a_picture_are_worked_out() {
    for angle in ["x * 0.3", "y * 0.3 + 1", "0.7"] {
        let shade = format!("0.5 + 0.4 * sin(({angle}) * 1rad)");
        assert!(tabled(&shade, &REAL40).1.is_none(), "{angle}");
    }
}
