//! Ramps on BASIC II held against their closed form: wide pictures, cropped ones,
//! ramps that wrap, ramps that step ramps, errors spread beside them.
#![allow(clippy::unwrap_used)]

use crate::bbc::{differences, run, text};
use random::Random;
use slowlight_compiler::eval::native::Native;
use slowlight_compiler::ir::build::Builder;
use slowlight_compiler::ir::graph::*;
use slowlight_compiler::plan::Goal;
use slowlight_compiler::planner::plan;
use slowlight_compiler::source::Span;
use slowlight_compiler::targets::find;
use slowlight_routine::{Op, Type, Value};
use slowlight_vm::Stop;
use slowlight_vm::bbc::Dialect;

#[path = "../../compiler/src/eval/random.rs"]
pub mod random;

const AT: Span = Span {
    file: 0,
    start: 0,
    end: 0,
    within: None,
    effect: None,
};

/// An int that is the same for a row and stays far within 31 bits.
fn row(b: &mut Builder, random: &mut Random) -> NodeId {
    let size = [9, 1000, 1_000_000, 2_000_000_000][random.below(4) as usize];
    let n = random.below(2 * size + 1) as i64 - size as i64;
    let constant = b.constant(Value::Int(n as i32), AT);
    let y = b.axis(Axis::Y, AT);
    let by = b.constant(Value::Int(random.below(5000) as i32), AT);
    let part = b.apply(Op::IntMul, &[y, by], AT);
    match random.below(3) {
        0 => constant,
        1 if size < 2_000_000_000 => b.apply(Op::IntAdd, &[part, constant], AT),
        _ => part,
    }
}

/// A picture of the signs and low bits of some ramps, two bits of each pixel.
fn picture(seed: u64, width: u32, spreads: bool, passes: u32) -> Graph {
    let mut random = Random::new(seed);
    let mut b = Builder::new();
    let (zero, one, two) = (0, 1, 2);
    let [zero, one, two] = [zero, one, two].map(|n| b.constant(Value::Int(n), AT));
    let mut ink = zero;
    for degree in 1..=3 {
        let mut ramp = row(&mut b, &mut random);
        for _ in 0..degree {
            let mut first = row(&mut b, &mut random);
            if passes > 1 {
                let pass = b.axis(Axis::Pass(passes), AT);
                first = b.apply(Op::IntSub, &[pass, first], AT);
            }
            ramp = b.ramp(first, ramp, passes, AT);
        }
        let low = b.apply(Op::BitAnd, &[ramp, one], AT);
        let negative = b.apply(Op::IntLess, &[ramp, zero], AT);
        let bits = b.apply(Op::IntAdd, &[low, two], AT);
        let bits = b.select(negative, bits, low, AT);
        // Some pixels are done early: the ramp is stepped on every way.
        let x = b.axis(Axis::X, AT);
        let odd = b.apply(Op::BitAnd, &[x, one], AT);
        let even = b.apply(Op::IntEqual, &[odd, zero], AT);
        let sum = b.apply(Op::IntAdd, &[ink, bits], AT);
        let sum = b.apply(Op::IntMod, &[sum, two], AT);
        let more = b.apply(Op::IntAdd, &[sum, ink], AT);
        ink = b.select(even, bits, more, AT);
    }
    let three = b.constant(Value::Int(3), AT);
    ink = b.apply(Op::BitAnd, &[ink, three], AT);
    if spreads {
        let received = b.received(AT);
        let half = b.constant(Value::Real(0.5), AT);
        let over = b.apply(Op::Less, &[half, received], AT);
        let flipped = b.apply(Op::IntSub, &[three, ink], AT);
        ink = b.select(over, flipped, ink, AT);
        let sent = b.apply(Op::ToReal, &[ink], AT);
        let node = b.apply(Op::Mul, &[sent, half], AT);
        b.spread(&[Share { dx: 1, dy: 0, node }], AT);
    }
    let image = Image {
        block: (1, 1),
        width,
        height: 3,
        palette: vec![[0; 3]; 4],
    };
    b.finish(image, ink, None)
}

#[test]
fn ramps_on_the_machine_are_their_closed_form() {
    let target = find("bbc:micro").unwrap();
    let mut wraps = 0;
    for seed in 0..40 {
        let width = [320, 77, 352, 500][seed as usize % 4];
        let spreads = seed % 5 == 4;
        // Bytes hold four pixels: passes over every other column are plotted.
        let passes = [1, 2, 4, 8][seed as usize / 4 % 4];
        let graph = picture(seed, width, spreads, if spreads { 1 } else { passes });
        let goal = Goal {
            name: "ramps".to_owned(),
            mode: *target.modes.iter().find(|m| m.name == "1").unwrap(),
            rows: None,
            plot: true,
        };
        let plan = plan(&graph, target, &goal).unwrap();
        let ramps = plan.graph.nodes.iter();
        assert!(ramps.filter(|n| matches!(n, Node::Ramp { .. })).count() > 0);
        wraps += plan
            .graph
            .ids()
            .filter(|id| matches!(plan.graph.node(*id), Node::Ramp { .. }))
            .filter(|id| plan.ranges.result[id.0 as usize].hi == f64::from(i32::MAX))
            .count();
        let text = text(&plan);
        let run = run(Dialect::Micro, &text);
        assert_eq!(run.stop, Stop::Ended, "{text}");
        assert_eq!(differences(&plan, &run), 0, "{seed}\n{graph}\n{text}");
        // All is whole, so the machine is exact.
        let (mut native, mut model) = (
            Native::new(&graph),
            slowlight_compiler::plan::model::ModelRun::new(&plan),
        );
        for y in 0..3 {
            for x in 0..width as i32 {
                assert_eq!(native.pixel(x, y).ink, model.pixel(x, y).ink, "{seed}");
            }
        }
    }
    assert!(wraps > 20, "{wraps}");
}

#[test]
fn who_cannot_step_says_so() {
    let mut b = Builder::new();
    let one = b.constant(Value::Int(1), AT);
    let ramp = b.ramp(one, one, 1, AT);
    assert_eq!(b.ty(ramp), Type::Int);
    let image = Image {
        block: (1, 1),
        width: 4,
        height: 1,
        palette: vec![[0; 3]; 4],
    };
    let graph = b.finish(image, ramp, None);
    let target = find("6502:plain").unwrap();
    let goal = Goal {
        name: "ramps".to_owned(),
        mode: target.modes[0],
        rows: None,
        plot: true,
    };
    let refused = plan(&graph, target, &goal).unwrap_err();
    assert!(refused[0].message.contains("cannot step"), "{refused:?}");
}
