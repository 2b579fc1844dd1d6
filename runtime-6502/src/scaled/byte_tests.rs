//! Routines with results of 8 bits on the processor against their models and the operations.

#![allow(clippy::unwrap_used)]

use super::inline::Inline;
use super::{BYTE, FIXED12, REAL, byte, inline_byte};
use crate::model::{bits, int};
use crate::tests::bench::{Bench, Random, Setting};
use crate::write::{Place, Shape};
use slowlight_routine::scale::most;
use slowlight_routine::{Form, Format, Op, Range, Routine, Type};

const SETTING: Setting = Setting {
    runtime: &FIXED12,
    sizes: 1,
};

/// The routines that have anything of 8 bits.
fn all() -> impl Iterator<Item = &'static Routine> {
    let has = |r: &&Routine| r.args.iter().chain([&r.result]).any(|f| *f == BYTE);
    FIXED12.routines.iter().filter(has)
}

fn routine(name: &str) -> &'static Routine {
    all().find(|r| r.name == name).unwrap()
}

fn in_domain(routine: &Routine, args: &[i32], n: i32, exact: f64) -> bool {
    let all = args.iter().chain([&n]);
    let ranges: Vec<Range> = all.map(|a| Range::point(f64::from(*a))).collect();
    (routine.domain)(&ranges, Range::point(exact))
}

/// Checks a use; answers how far the result is from the exact one.
fn check(bench: &mut Bench, routine: &Routine, args: &[i32], n: i32, exact: Option<f64>) -> f64 {
    let mut given: Vec<_> = args.iter().map(|a| bits(*a)).collect();
    given.push(i64::from(n) as u64);
    let wanted = int((routine.model)(&given));
    let (found, _) = bench.run(args);
    let found = match routine.result == BYTE {
        true => i32::from(found as i8),
        false => found,
    };
    assert_eq!(
        found, wanted,
        "{}({args:?}), {n}: machine, model",
        routine.name
    );
    let end = most(byte::BITS) as f64;
    assert!(routine.result != BYTE || f64::from(wanted).abs() <= end);
    exact.map_or(0.0, |exact| {
        (f64::from(wanted) - exact.clamp(-end, end)).abs()
    })
}

/// What a routine's result would be exactly, in units of its last place.
fn exact(routine: &Routine, [a, b]: [i32; 2], n: i32) -> Option<f64> {
    let [a, b] = [a, b].map(f64::from);
    Some(match routine.op {
        Op::Mul => a * b * f64::from(-n).exp2(),
        Op::Add if n == 1 => a,
        Op::Add => a + b,
        Op::Sub => a - b,
        _ => return None,
    })
}

/// The numbers at which a routine is looked at.
fn numbers(routine: &Routine) -> Vec<i32> {
    match (routine.op, routine.name) {
        (_, "byte_low_mul") => vec![9, 12, 15],
        (_, "byte_far_mul") => vec![3, 17],
        (_, "byte_long_mul") => vec![-3, 0],
        (Op::Mul, name) => vec![name.rsplit('_').next().unwrap().parse().unwrap_or(0)],
        (Op::Add, "twice") => vec![1],
        (Op::Floor, "fraction_floor") => vec![7, 9],
        (Op::Floor, _) => vec![0, 3, 6],
        _ => vec![0],
    }
}

/// Whether a routine takes few enough cycles for all operands.
fn is_quick(routine: &Routine) -> bool {
    routine.args.iter().all(|f| *f == BYTE) && routine.cycles < 900
}

/// Each number with each.
#[test]
fn all_pairs_of_bytes_come_out_as_in_the_model() {
    let end = most(byte::BITS) as i32;
    for routine in all().filter(|r| is_quick(r)) {
        for n in numbers(routine) {
            let mut bench = Bench::of(SETTING, routine, &[], n);
            let (mut checked, mut worst) = (0, 0.0f64);
            let others = if routine.args.len() == 2 {
                -end..=end
            } else {
                0..=0
            };
            let pairs = (-end..=end).flat_map(|a| others.clone().map(move |b| [a, b]));
            for pair in pairs {
                let args = &pair[..routine.args.len()];
                let exact = exact(routine, pair, n);
                if in_domain(routine, args, n, exact.unwrap_or(0.0)) {
                    worst = worst.max(check(&mut bench, routine, args, n, exact));
                    checked += 1;
                }
            }
            assert!(checked >= 255, "{} {n}: {checked}", routine.name);
            assert!(
                worst <= routine.error.most(&[], 1.0),
                "{}: {worst}",
                routine.name
            );
        }
    }
}

/// Each number with each, where products stand in place: with signs known and unknown, and with
/// a factor that is known.
#[test]
fn products_in_place_have_the_models_bits() {
    let end = most(byte::BITS) as i32;
    let held = |name: &str| Place::Held(name.to_owned(), Shape::whole(1));
    let places = ["first_operand", "second_operand_value"].map(held);
    let all = all().filter(|r| r.op == Op::Mul && is_quick(r));
    for (routine, n) in all.flat_map(|r| numbers(r).into_iter().map(move |n| (r, n))) {
        let Form::Statement(text) = routine.form else {
            continue;
        };
        let Some(bits) = inline_byte::bits(text, n) else {
            continue;
        };
        for (positive, known) in [
            (false, None),
            (true, None),
            (false, Some(-77)),
            (false, Some(5)),
        ] {
            let constant = known.map(|k: i32| Place::Constant(i64::from(k) as u64));
            let args = [&places[0], constant.as_ref().unwrap_or(&places[1])];
            let write = |lines: &mut Vec<String>| {
                let used = Inline {
                    args,
                    positive: [positive; 2],
                    kept: None,
                    again: None,
                    to: "result",
                    serial: 1,
                };
                assert_eq!(inline_byte::product(bits, used, lines), known.is_none());
                vec!["product8"]
            };
            let mut bench = Bench::written(&FIXED12, &write).sized(1);
            let least = if positive { 0 } else { -end };
            for a in least..=end {
                for b in known.map_or(least..=end, |k| k..=k) {
                    let exact = exact(routine, [a, b], n);
                    if in_domain(routine, &[a, b], n, exact.unwrap_or(0.0)) {
                        check(&mut bench, routine, &[a, b], n, exact);
                    }
                }
            }
        }
    }
}

/// All numbers of 16 bits.
#[test]
fn all_roots_come_out_as_in_the_model() {
    let routine = routine("byte_root");
    let mut bench = Bench::of(SETTING, routine, &[], -1);
    let mut worst = 0.0f64;
    for a in -32767..=32767 {
        let exact = (f64::from(a.max(0)) / 2.0).sqrt();
        worst = worst.max(check(&mut bench, routine, &[a], -1, Some(exact)));
    }
    assert!(worst <= 0.5, "{worst}");
}

/// Whole roots, with nothing rounded.
#[test]
fn all_whole_roots_are_exact() {
    let write = |lines: &mut Vec<String>| {
        for line in [
            "lda first_operand",
            "sta acc",
            "lda first_operand+1",
            "jsr isqrt16",
            "sta result",
        ] {
            lines.push(format!("        {line}"));
        }
        vec!["root8"]
    };
    let mut bench = Bench::written(&FIXED12, &write).sized(1);
    for a in 0..=65535 {
        let (found, _) = bench.run(&[a]);
        assert!(
            found * found <= a && (found + 1) * (found + 1) > a,
            "{a}: {found}"
        );
        assert_eq!(found, byte::whole_root(a));
    }
}

/// Edges with each other, and random numbers of all sizes.
#[test]
fn quotients_come_out_as_in_the_model() {
    let routine = routine("byte_div");
    assert_eq!(routine.args, [REAL, REAL]);
    let end = most(16) as i32;
    let mut edges: Vec<i32> = (0..15)
        .flat_map(|k| [1 << k, (1 << k) - 1, (3 << k).min(end)])
        .collect();
    edges.extend([end, 255, 257, 12345]);
    edges.extend(edges.clone().iter().map(|n| -n));
    let mut random = Random(5);
    let mut pairs: Vec<[i32; 2]> = edges
        .iter()
        .flat_map(|a| edges.iter().map(|b| [*a, *b]))
        .collect();
    pairs.extend((0..4000).map(|_| {
        [0; 2].map(|_: i32| ((random.next() as i32) >> (16 + random.next() % 15)).max(-end))
    }));
    let mut worst = 0.0f64;
    for n in 0..=30 {
        let mut bench = Bench::of(SETTING, routine, &[], n);
        for pair in &pairs {
            let [a, b] = pair.map(f64::from);
            let exact = match pair[1] {
                0 => 1e9 * a.signum() * f64::from(u8::from(a != 0.0)),
                _ => a / b * f64::from(n).exp2(),
            };
            worst = worst.max(check(&mut bench, routine, pair, n, Some(exact)));
        }
    }
    println!("quotients of 8 bits: {worst}");
    assert!(worst <= routine.error.most(&[], 1.0), "{worst}");
}

/// All divisors of 1 and of the greatest.
#[test]
fn quotients_are_within_their_bound() {
    let mut worst = 0.0f64;
    for b in 1..=32767 {
        for (a, n) in [
            (1, 15),
            (1, 10),
            (1, 22),
            (32767, 0),
            (32767, 6),
            (12345, 7),
        ] {
            let exact = (f64::from(a) / f64::from(b) * f64::from(n).exp2()).min(127.0);
            worst = worst.max((f64::from(byte::divide(a, b, n)) - exact).abs());
        }
    }
    assert!(worst <= 1.5 && worst > 0.5, "{worst}");
}

/// Those of 16.16, at some operands.
#[test]
fn functions_come_out_as_in_the_model() {
    for routine in all().filter(|r| !is_quick(r) && r.args[0] == BYTE) {
        let scales = [-8i32, -3, 0, 3, 5, 7, 14, 22];
        let packed = scales
            .iter()
            .flat_map(|a| scales.map(|r| ((a + 32) * 64 + 36) * 64 + r + 32));
        let numbers: Vec<i32> = match routine.op {
            Op::Tan | Op::Exp | Op::Log | Op::Pow => packed.collect(),
            _ => scales.to_vec(),
        };
        let mut random = Random(3);
        let mut checked = 0;
        for n in numbers {
            let mut bench = Bench::of(SETTING, routine, &[], n);
            for k in 0..12 {
                let args: Vec<i32> = (routine.args.iter())
                    .map(|_| match k {
                        0 => 127,
                        1 => -127,
                        2 => 0,
                        _ => (random.next() % 255) as i32 - 127,
                    })
                    .collect();
                if in_domain(routine, &args, n, 0.0) {
                    check(&mut bench, routine, &args, n, None);
                    checked += 1;
                }
            }
        }
        assert!(checked > 10, "{}: {checked}", routine.name);
    }
}

/// Ints of all sizes.
#[test]
fn int_roots_come_out_as_in_the_model() {
    let routine = routine("byte_int_root");
    for n in [-4, 0, 3, 6, 10] {
        let mut bench = Bench::of(SETTING, routine, &[], n);
        for a in (0..31).flat_map(|k| [(1i32 << k) - 1, 1 << k, 5 << (k - 2).max(0)]) {
            let exact = f64::from(a.max(0)).sqrt() * f64::from(n).exp2();
            let off = check(&mut bench, routine, &[a], n, Some(exact));
            assert!(off <= routine.error.most(&[], 1.0), "{a} {n}: {off}");
        }
    }
}

/// What plans are priced by, about: most products stand in place, which costs a third less than
/// a call.
#[test]
fn costs_are_about_what_is_measured() {
    let asked = |r: &&Routine| is_quick(r) || r.name == "byte_div" || r.name == "byte_root";
    // An int may be kept in any number of bytes.
    for routine in all()
        .filter(asked)
        .filter(|r| r.result.scalar() != Type::Int)
    {
        let n = match routine.op {
            Op::Div => 6,
            Op::Sqrt => -1,
            _ => numbers(routine)[numbers(routine).len() / 2],
        };
        let wide = routine.args[0] == REAL;
        let mut bench = Bench::of(SETTING, routine, &[], n);
        let mut random = Random(9);
        let (mut cycles, mut times) = (0, 0u32);
        for _ in 0..2000 {
            let args = [0; 2].map(|_: i32| (random.next() as i32) >> if wide { 16 } else { 24 });
            let args = args.map(|a| a.max(if wide { -32767 } else { -127 }));
            let args = &args[..routine.args.len()];
            let exact = exact(routine, [args[0], *args.last().unwrap()], n);
            if in_domain(routine, args, n, exact.unwrap_or(0.0)) {
                (cycles, times) = (cycles + bench.run(args).1, times + 1);
            }
        }
        if times == 0 {
            continue;
        }
        // A bool is stored here, and asked in programs.
        let stored = if routine.result == Format::Bool {
            7.0
        } else {
            0.0
        };
        let mean = cycles as f64 / f64::from(times) - stored;
        let said = f64::from(routine.cycles);
        println!("{}: {mean:.0} cycles, {said} in plans", routine.name);
        if routine.name.starts_with("byte_") {
            assert_eq!(bench.bytes, routine.bytes, "{}", routine.name);
        }
        assert!(
            (mean - said).abs() <= 8.0 + 0.15 * said,
            "{}: {mean}",
            routine.name
        );
    }
}
