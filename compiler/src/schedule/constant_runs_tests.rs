//! What is known before a run is right for all of it, and set where it is read.
#![allow(clippy::unwrap_used)]

use crate::analysis::region::Fact;
use crate::analysis::verify::verify;
use crate::eval::arithmetic::Exact;
use crate::eval::native::Native;
use crate::eval::random::Random;
use crate::eval::run::Run;
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::ir::ramp;
use crate::passes::branches::unswitch::unswitch;
use crate::passes::loops::strip_mine::{passes, strip_mined};
use crate::schedule::constant_runs::{Inks, still};
use crate::schedule::statements::schedule_in_segments;
use crate::source::Span;
use slowlight_routine::{Op, Value};

const AT: Span = Span {
    file: 0,
    start: 0,
    end: 0,
    within: None,
    effect: None,
};
const WIDTH: i32 = 71;
const HEIGHT: i32 = 9;

/// Inks chosen by conditions of every kind: on the row, on the column against
/// what the row knows, on the pixel, and on the column's remainders; or, in the place
/// of the last two, on a ramp.
fn picture(seed: u64, ramps: bool) -> Graph {
    let mut random = Random::new(seed);
    let mut b = Builder::new();
    let [x, y] = [Axis::X, Axis::Y].map(|axis| b.axis(axis, AT));
    let int = |b: &mut Builder, n: i32| b.constant(Value::Int(n), AT);
    let three = int(&mut b, 3);
    let row = b.apply(Op::BitAnd, &[y, three], AT);
    let square = b.apply(Op::IntMul, &[x, x], AT);
    let pixel = b.apply(Op::BitAnd, &[square, three], AT);
    let rest = b.apply(Op::BitAnd, &[x, three], AT);
    let mut ints = match ramps {
        true => vec![row],
        false => vec![row, pixel, rest],
    };
    ints.extend((0..4).map(|n| int(&mut b, n)));
    let mut bools = Vec::new();
    for k in 0..6 {
        let by = int(&mut b, random.below(9) as i32);
        let from = int(&mut b, random.below(WIDTH as u64) as i32);
        let line = b.apply(Op::IntMul, &[y, by], AT);
        let line = b.apply(Op::IntAdd, &[line, from], AT);
        let few = int(&mut b, random.below(4) as i32);
        bools.push(match k {
            0 | 1 => b.apply(Op::IntLess, &[x, line], AT),
            2 => b.apply(Op::IntLessEqual, &[line, x], AT),
            3 => b.apply(Op::IntLess, &[row, few], AT),
            4 if ramps => {
                let step = int(&mut b, 700_000_000 + random.below(1_000_000_000) as i32);
                let first = b.apply(Op::IntMul, &[line, step], AT);
                let ramp = b.ramp(first, step, 1, AT);
                let zero = int(&mut b, 0);
                b.apply(Op::IntLess, &[ramp, zero], AT)
            }
            5 if ramps => bools[0],
            4 => b.apply(Op::IntLess, &[rest, few], AT),
            _ => b.apply(Op::IntLess, &[few, pixel], AT),
        });
    }
    for _ in 0..14 {
        let mut any = |from: &[NodeId]| from[random.below(from.len() as u64) as usize];
        let cond = any(&bools);
        let (yes, no) = (any(&bools), any(&bools));
        bools.push(b.select(cond, yes, no, AT));
        let (cond, yes, no) = (any(&bools), any(&ints), any(&ints));
        let (one, other) = (any(&ints), any(&ints));
        let sum = b.apply(Op::IntAdd, &[one, other], AT);
        ints.push(b.apply(Op::BitAnd, &[sum, three], AT));
        ints.push(b.select(cond, yes, no, AT));
    }
    let ink = *ints.last().unwrap();
    let image = Image {
        block: (1, 1),
        width: WIDTH as u32,
        height: HEIGHT as u32,
        palette: vec![[0; 3]; 4],
    };
    b.finish(image, ink, None)
}

#[test]
fn runs_and_passes_draw_the_same_and_still_inks_are_known() {
    let (mut stills, mut pixels, mut drawn_in_passes) = (0, 0, 0);
    let (mut splits, mut eithers) = (0, 0);
    for seed in 0..800 {
        let plain = picture(seed, seed % 2 == 1);
        let stepped = |graph: &Graph| graph.nodes.iter().any(|n| matches!(n, Node::Ramp { .. }));
        let graph = match stepped(&plain) {
            true => unswitch(&plain),
            false => strip_mined(&plain, 1),
        };
        splits += usize::from(stepped(&plain) && graph.is_some());
        let graph = graph.unwrap_or_else(|| plain.clone());
        verify(&graph).unwrap();
        drawn_in_passes += usize::from(passes(&graph) == 4);
        let tree = schedule_in_segments(&graph);
        let mut native = Native::new(&plain);
        let mut run = Run::new(&graph, &tree, Exact(&graph));
        // This one never comes to the pixel's own statements.
        let mut before = Run::new(&graph, &tree, Exact(&graph));
        let found = match tree.segment.is_empty() {
            true => None,
            false => still(&graph),
        };
        stills += usize::from(found.is_some());
        for y in 0..HEIGHT {
            for x in 0..WIDTH {
                let ink = run.pixel(x, y).int();
                assert_eq!(
                    i32::from(native.pixel(x, y).ink),
                    ink,
                    "{seed} ({x}, {y})\n{tree}"
                );
                let Some(found) = &found else {
                    continue;
                };
                // Each condition is there where those before it hold.
                before.segment((x, y), true, &[]);
                let mut all = found.conditions.iter();
                let holds = |(cond, holds): &Fact| before.last(*cond).unwrap().truth() == *holds;
                if all.all(holds) {
                    pixels += 1;
                    let value = |id: NodeId| match graph.node(id) {
                        Node::Axis(_) => Value::Int(x.rem_euclid(4)),
                        Node::Ramp { .. } => {
                            let parts = ramp::coefficients(&graph, id).into_iter();
                            let parts: Vec<i32> =
                                parts.map(|part| before.last(part).unwrap().int()).collect();
                            Value::Int(ramp::at(x, &parts))
                        }
                        _ => before.last(id).unwrap().into(),
                    };
                    let shown = match found.inks {
                        Inks::One(ink) => ink,
                        Inks::Either { cond, yes, no } => {
                            let Node::Apply(op, args) = graph.node(cond) else {
                                panic!("{seed}\n{graph}");
                            };
                            eithers += 1;
                            match op.eval(&args.map(value)).truth() {
                                true => yes,
                                false => no,
                            }
                        }
                    };
                    assert_eq!(value(shown).int(), ink, "{seed} ({x}, {y})");
                }
            }
        }
        assert_eq!(run.unset_reads(), 0, "{seed}\n{graph}\n{tree}");
    }
    assert!(stills > 50 && pixels > 5_000, "{stills} {pixels}");
    assert!(drawn_in_passes > 100, "{drawn_in_passes}");
    assert!(splits > 50 && eithers > 2_000, "{splits} {eithers}");
}

#[test]
fn passes_are_a_multiple_of_all_that_they_must_be() {
    let of = |moduli: &[i32], multiple: u32| {
        let mut b = Builder::new();
        let x = b.axis(Axis::X, AT);
        let mut ink = b.constant(Value::Int(0), AT);
        for &modulus in moduli {
            let modulus = b.constant(Value::Int(modulus), AT);
            let rest = b.apply(Op::IntMod, &[x, modulus], AT);
            ink = b.apply(Op::IntAdd, &[ink, rest], AT);
        }
        let image = Image {
            block: (1, 1),
            width: 320,
            height: 1,
            palette: vec![[0; 3]; 256],
        };
        let graph = b.finish(image, ink, None);
        let made = strip_mined(&graph, multiple)?;
        let (mut before, mut after) = (Native::new(&graph), Native::new(&made));
        for x in 0..320 {
            assert_eq!(before.pixel(x, 0), after.pixel(x, 0));
        }
        Some(passes(&made))
    };
    assert_eq!(of(&[4], 1), Some(4));
    assert_eq!(of(&[2, 3], 1), Some(6));
    assert_eq!(of(&[4], 8), Some(8));
    assert_eq!(of(&[3], 2), Some(6));
    // Too many, and none.
    assert_eq!(of(&[5, 7], 1), None);
    assert_eq!(of(&[], 4), None);
}
