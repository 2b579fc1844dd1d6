//! The functions that are looked up: all operands, on the processor and beside `f64`.

#![allow(clippy::unwrap_used)]

use super::kinds::{LONG, SHORT};
use super::{logarithms, powers, sines};
use crate::tests::bench::Bench;
use slowlight_routine::scale::Scales;
use slowlight_routine::{Op, Range, Routine};

fn found<'a>(op: Op, name: &'a str) -> impl Iterator<Item = &'static Routine> + 'a {
    let all = SHORT.setting.runtime.routines.iter();
    all.filter(move |r| r.op == op && r.name.ends_with(name))
}

/// Of all operands at all points the worst, in units of the last place.
#[test]
fn sines_are_within_their_bounds() {
    let of = [
        (
            Op::Sin,
            sines::sine as fn(i32, i32) -> i32,
            f64::sin as fn(f64) -> f64,
        ),
        (Op::Cos, sines::cosine, f64::cos),
    ];
    for (op, sine, exact) in of {
        let mut worst = [0.0f64; 17];
        for n in sines::POINTS {
            for a in -32767..=32767 {
                let wanted = exact(f64::from(a) * f64::from(-n).exp2()) * 16384.0;
                let off = (f64::from(sine(a, n)) - wanted).abs();
                worst[n as usize] = worst[n as usize].max(off);
            }
        }
        println!("{op:?}: {worst:.2?}");
        let of = |from: usize, to: usize| worst[from..=to].iter().fold(0.0, |a: f64, b| a.max(*b));
        let name = match op {
            Op::Sin => "sin_16",
            _ => "cos_16",
        };
        for (worst, by) in [(of(10, 16), ""), (of(8, 9), "wide_"), (of(5, 7), "far_")] {
            let name = format!("{by}{name}");
            let routine = found(op, "_16").find(|r| r.name == name);
            let bound = routine.unwrap().error.most(&[], 1.0);
            assert!(
                worst <= bound && worst > bound - 0.15,
                "{op:?}, {name}: {worst}"
            );
        }
    }
}

/// All operands where most angles have their points, and some of all.
#[test]
fn sines_are_the_models_on_the_processor() {
    let all = found(Op::Sin, "sin_16").chain(found(Op::Cos, "cos_16"));
    for routine in all {
        let (mut cycles, mut times) = (0, 0);
        for n in sines::POINTS {
            let own = (routine.domain)(&[Range::point(f64::from(n))], Range::ALL);
            if !own {
                continue;
            }
            let mut bench = Bench::of(SHORT.setting, routine, &[], n);
            for a in (-32767..=32767).step_by(if n == 13 { 1 } else { 13 }) {
                let wanted = match routine.op {
                    Op::Sin => sines::sine(a, n),
                    _ => sines::cosine(a, n),
                };
                let (found, taken) = bench.run(&[a]);
                assert_eq!(found, wanted, "{} of {a}, {n}", routine.name);
                if n == 13 {
                    (cycles, times) = (cycles + taken, times + 1);
                }
            }
        }
        if times > 0 {
            let mean = cycles as f64 / f64::from(times);
            println!("{}: {mean} cycles", routine.name);
            let told = f64::from(routine.cycles);
            assert!((mean - told).abs() < 2.0, "{}: {mean}", routine.name);
        }
    }
}

/// What is told of a power's points, and its number.
fn scales(a: i8, result: i8) -> (Scales, i32) {
    let scales = Scales {
        args: [a, 0],
        result,
    };
    (scales, scales.number(Op::Exp))
}

/// Of all operands at all points the worst, in units of the last place.
#[test]
fn powers_are_within_their_bound() {
    let mut worst = 0.0f64;
    for (a, result) in (10..=16).flat_map(|a| (0..=15).map(move |r| (a, r))) {
        let (scales, _) = scales(a, result);
        let unit = f64::from(-a).exp2();
        // What saturates is so at all other operands, too.
        let most = ((15.0 - f64::from(result)) * std::f64::consts::LN_2 / unit) as i32 + 2;
        for x in -32767..=most.min(32767) {
            let exact = (f64::from(x) * unit).exp() * f64::from(result).exp2();
            let off = f64::from(powers::exponential(x, scales)) - exact.min(32767.0);
            worst = worst.max(off.abs());
        }
    }
    let routine = found(Op::Exp, "exp_16").next().unwrap();
    let bound = routine.error.most(&[], 1.0);
    println!("powers of e: {worst}");
    assert!(worst <= bound && worst > bound - 0.1, "{worst}");
}

/// All operands at points that are met most, and some at all.
#[test]
fn powers_are_the_models_on_the_processor() {
    let routine = found(Op::Exp, "exp_16").next().unwrap();
    let (mut cycles, mut times) = (0, 0);
    for (a, result) in (10..=16).flat_map(|a| (0..=15).map(move |r| (a, r))) {
        let (scales, number) = scales(a, result);
        assert!((routine.domain)(
            &[Range::point(f64::from(number))],
            Range::ALL
        ));
        let mut bench = Bench::of(SHORT.setting, routine, &[], number);
        let usual = (a, result) == (13, 14);
        for x in (-32767..=32767).step_by(if usual { 1 } else { 61 }) {
            let (found, taken) = bench.run(&[x]);
            assert_eq!(found, powers::exponential(x, scales), "{x}, {scales:?}");
            if usual && x < 0 {
                (cycles, times) = (cycles + taken, times + 1);
            }
        }
    }
    let mean = cycles as f64 / f64::from(times);
    println!("{}: {mean} cycles", routine.name);
    assert!((mean - f64::from(routine.cycles)).abs() < 2.0, "{mean}");
}

/// Numbers of all magnitudes, in units of the last place; what is a power of two is rounded alone.
#[test]
fn logarithms_are_within_their_bound() {
    let exact = |a: i32| (f64::from(a) / 65536.0).ln() * 65536.0;
    let off = |a: i32| (f64::from(logarithms::logarithm(a)) - exact(a)).abs();
    let step = |a: &i32| a.checked_add(1 + a / 30011);
    let all = std::iter::successors(Some(1), step);
    let worst = all.map(off).fold(0.0, f64::max);
    println!("logarithms: {worst}");
    assert!((1.0..1.15).contains(&worst), "{worst}");
    for place in 0..31 {
        assert!(off(1 << place) <= 0.501, "2^{place}: {}", off(1 << place));
    }
    assert_eq!(logarithms::logarithm(0x1_0000), 0);
    for a in [0, -1, i32::MIN] {
        assert_eq!(logarithms::logarithm(a), i32::MIN);
    }
}

/// Costs hang on how far points are moved: what is told is about the mean over those that are met.
#[test]
fn logarithms_take_what_is_told() {
    for (kind, from) in [(&SHORT, 8), (&LONG, 12)] {
        let routine = kind.routine("log");
        let (mut cycles, mut times) = (0, 0);
        for (a, result) in (from..=16).flat_map(|a| (from..=16).map(move |r| (a, r))) {
            let number = Scales {
                args: [a, 0],
                result,
            };
            let mut bench = Bench::of(kind.setting, routine, &[], number.number(Op::Log));
            for a in (1..kind.most()).step_by(kind.most() as usize / 40) {
                (cycles, times) = (cycles + bench.run(&[a]).1, times + 1);
            }
        }
        let mean = cycles as f64 / f64::from(times);
        println!("log of {} bits: {mean:.0} cycles", kind.bits);
        let told = f64::from(routine.cycles);
        assert!((mean - told).abs() < 0.1 * told, "{}: {mean}", kind.bits);
    }
}
