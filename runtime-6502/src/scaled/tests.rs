//! Every routine on the processor against its model and the operation.

#![allow(clippy::unwrap_used)]

use super::{FIXED16, Read, floor, model, read};
use crate::model::{bits, int};
use crate::tests::bench::{Bench, Random, Setting};
use crate::write::{Place, Shape};
use slowlight_routine::scale::{Scales, most};
use slowlight_routine::{Format, Op, Range, Routine, Type};

/// Random operands for each routine and number.
const PAIRS: u32 = 300;

/// The numbers that a routine may be given: of all scales that a plan may have.
fn numbers(routine: &Routine) -> Vec<i32> {
    let scales = [-15, -3, 0, 5, 10, 13, 14, 15, 16, 17, 22, 30];
    let packed = |a: i8, b: i8, result: i8| {
        Scales {
            args: [a, b],
            result,
        }
        .number(routine.op)
    };
    let all: Vec<i32> = match routine.op {
        Op::Tan | Op::Exp | Op::Log | Op::Pow => scales
            .iter()
            .flat_map(|a| scales.iter().map(move |r| (*a, *r)))
            .map(|(a, r)| packed(a, 12 - a / 5, r))
            .collect(),
        Op::Add => vec![i32::from(routine.name == "twice")],
        Op::Mul => (-8..40).collect(),
        _ => (0..31).collect(),
    };
    let at = |value: f64, n: i32| {
        let ranges = [value, value, f64::from(n)].map(Range::point);
        (routine.domain)(&ranges, Range::point(0.0))
    };
    let everywhere = |n: &i32| [1.0, 0.0, -1.0].iter().any(|one| at(*one, *n));
    let mut found: Vec<i32> = all.into_iter().filter(everywhere).collect();
    found.dedup();
    found
}

pub(super) fn edges() -> Vec<i32> {
    let mut all = vec![0, 3, 10, 100, 255, 257, 1000, 12345, 0x5555, 32767];
    for k in 0..15 {
        all.extend([1 << k, (1 << k) - 1]);
    }
    all.extend(all.clone().iter().map(|n| -n));
    all.sort_unstable();
    all.dedup();
    all
}

/// An operand: half of them edges, the others of all magnitudes.
fn draw(random: &mut Random, edges: &[i32]) -> i32 {
    match random.next() & 1 {
        0 => edges[random.next() as usize % edges.len()],
        _ => ((random.next() as i32 >> 16) >> (random.next() % 16)).max(-32767),
    }
}

fn in_domain(routine: &Routine, args: &[i32], n: i32, exact: f64) -> bool {
    let mut ranges: Vec<Range> = args.iter().map(|a| Range::point(f64::from(*a))).collect();
    ranges.push(Range::point(f64::from(n)));
    (routine.domain)(&ranges, Range::point(exact))
}

/// What a routine's result would be exactly, in units of its last place, where the number
/// tells.
fn exact(routine: &Routine, args: &[i32], n: i32) -> Option<f64> {
    let [a, b] = [args[0], *args.last().unwrap()].map(f64::from);
    let power = |n: i32| f64::from(n).exp2();
    Some(match routine.op {
        Op::Mul => a * b * power(-n),
        Op::Div if b == 0.0 => 1e9 * f64::from(args[0].signum()),
        Op::Div => a / b * power(n),
        Op::Sqrt => (a.max(0.0) * power(n)).sqrt(),
        Op::Add if n == 1 => a,
        Op::Add => a + b,
        Op::Sub => a - b,
        Op::Sin => (a * power(-n)).sin() * power(14),
        Op::Cos => (a * power(-n)).cos() * power(14),
        Op::Asin => (a * power(-14)).clamp(-1.0, 1.0).asin() * power(14),
        Op::Acos => (a * power(-14)).clamp(-1.0, 1.0).acos() * power(13),
        Op::Atan2 => a.atan2(b) * power(13),
        _ => return None,
    })
}

#[test]
fn machine_and_model_agree_bit_for_bit() {
    let edges = edges();
    let real = |r: &&Routine| {
        r.name != "one_over" && r.args.iter().chain([&r.result]).any(|f| *f == super::REAL)
    };
    let setting = Setting {
        runtime: &FIXED16,
        sizes: 2,
    };
    for routine in FIXED16.routines.iter().filter(real) {
        let numbers = numbers(routine);
        assert!(!numbers.is_empty(), "{}", routine.name);
        let slow = routine.cycles > 5000;
        let (mut checked, mut worst) = (0, 0.0f64);
        for n in numbers {
            let mut bench = Bench::of(setting, routine, &[], n);
            let mut random = Random(1);
            let mut pairs: Vec<Vec<i32>> = (0..PAIRS / if slow { 20 } else { 1 })
                .map(|_| {
                    routine
                        .args
                        .iter()
                        .map(|_| draw(&mut random, &edges))
                        .collect()
                })
                .collect();
            if !slow && routine.args.len() == 2 {
                pairs.extend(
                    edges
                        .iter()
                        .flat_map(|a| edges.iter().map(|b| vec![*a, *b])),
                );
            }
            for k in [0, 1, 16384, 32767] {
                pairs.push(vec![k; routine.args.len()]);
                let mut one = vec![123; routine.args.len()];
                one[routine.args.len() - 1] = k;
                pairs.push(one.clone());
                one.reverse();
                pairs.push(one);
            }
            for args in pairs {
                let exact = exact(routine, &args, n);
                if !in_domain(routine, &args, n, exact.unwrap_or(0.0)) {
                    continue;
                }
                checked += 1;
                let mut all: Vec<_> = args.iter().map(|a| bits(*a)).collect();
                all.push(i64::from(n) as u64);
                let wanted = int((routine.model)(&all));
                let (found, _) = bench.run(&args);
                assert_eq!(
                    found, wanted,
                    "{}({args:?}), {n}: machine, model",
                    routine.name
                );
                if routine.result == super::REAL {
                    assert!(i64::from(wanted).abs() <= most(16), "{}", routine.name);
                }
                if let Some(exact) = exact {
                    let end = most(16) as f64;
                    let off = (f64::from(wanted) - exact.clamp(-end, end)).abs();
                    worst = worst.max(off);
                }
            }
        }
        let bound = routine.error.most(&[], 1.0);
        println!("{}: {worst} of {bound}", routine.name);
        assert!(worst <= bound, "{} is {worst} off", routine.name);
        assert!(
            checked > 3,
            "{}: only {checked} operands are in its domain",
            routine.name
        );
    }
}

/// All operands at all scales that a plan may have.
#[test]
fn roots_are_within_their_bound() {
    let mut worst = 0.0f64;
    for n in 1..=15 {
        for a in 0..=32767 {
            let exact = (f64::from(a) * f64::from(n).exp2()).sqrt();
            worst = worst.max((f64::from(model::root(a, n)) - exact).abs());
        }
    }
    assert!(worst <= 1.8 && worst > 0.5, "{worst}");
}

/// What is one over a divisor is that division, for all divisors.
#[test]
fn reciprocals_are_quotients() {
    let setting = Setting {
        runtime: &FIXED16,
        sizes: 2,
    };
    let routine = FIXED16
        .routines
        .iter()
        .find(|r| r.name == "one_over")
        .unwrap();
    let mut worst = 0.0f64;
    for (one, n) in [(16384, 14), (16384, 0), (1, 20), (4096, 7), (1, 30)] {
        let places = [
            Place::Constant(one),
            Place::At("second_operand_value".into()),
        ];
        let mut bench = Bench::of(setting, routine, &places, n);
        for b in (-32767..=32767).step_by(if n == 14 { 1 } else { 7 }) {
            let wanted = model::divide(one as i32, b, n);
            assert_eq!(bench.run(&[one as i32, b]).0, wanted, "{one} / {b}, {n}");
            let exact = one as f64 / f64::from(b) * f64::from(n).exp2();
            if b != 0 {
                worst = worst.max((f64::from(wanted) - exact.clamp(-32767.0, 32767.0)).abs());
            }
        }
    }
    assert!(worst <= 1.5, "{worst}");
}

#[test]
fn short_ints_have_products_of_32_bits() {
    let setting = Setting {
        runtime: &FIXED16,
        sizes: 4,
    };
    let name = |r: &&Routine| r.name == "int_mul_16";
    let routine = FIXED16.routines.iter().find(name).unwrap();
    let mut bench = Bench::of(setting, routine, &[], 0);
    let mut all = edges();
    all.push(-32768);
    let (mut cycles, mut checked) = (0, 0u32);
    for a in &all {
        for b in &all {
            let (found, taken) = bench.run(&[*a, *b]);
            assert_eq!(found, a * b, "{a} * {b}");
            let held = [*a, *b].map(bits);
            assert_eq!(int((routine.model)(&held)), a * b);
            (cycles, checked) = (cycles + taken, checked + 1);
        }
    }
    let mean = cycles as f64 / f64::from(checked);
    assert!(
        (mean - f64::from(routine.cycles)).abs() < 20.0,
        "{mean} cycles"
    );
}

#[test]
fn every_operation_has_a_total_routine() {
    for op in Op::ALL {
        let of_reals = op.result() == Type::Real || op.args().contains(&Type::Real);
        if !of_reals {
            continue;
        }
        // At the scales that plans may have.
        let numbers: Vec<i32> = match op {
            Op::Mul => (-75..75).collect(),
            Op::Div | Op::Floor => (0..=30).collect(),
            Op::Sqrt => (1..=15).collect(),
            Op::Sin | Op::Cos => (0..=13).collect(),
            Op::Tan | Op::Exp | Op::Log | Op::Pow => (-15..=30)
                .map(|a| {
                    Scales {
                        args: [a, 5 + (a + 15) % 11],
                        result: 14 - a / 2,
                    }
                    .number(*op)
                })
                .collect(),
            _ => vec![0],
        };
        for n in numbers {
            let ranges = [Range::ALL, Range::ALL, Range::point(f64::from(n))];
            let of = FIXED16.routines.iter().filter(|r| r.op == *op);
            let ranges = match op.arity() {
                1 => &ranges[1..],
                _ => &ranges,
            };
            assert!(
                of.clone().any(|r| (r.domain)(ranges, Range::ALL)),
                "{op:?} {n}"
            );
        }
    }
}

#[test]
fn numbers_are_read_at_other_scales() {
    let edges = edges();
    for by in -20..=20 {
        for (fits, quick) in [(false, false), (false, true), (true, false)] {
            let held = Place::Held("first_operand".into(), Shape::whole(2));
            let write = |lines: &mut Vec<String>| {
                let what = Read {
                    from: &held,
                    by,
                    fits,
                    to: "result",
                    serial: 1,
                    quick,
                };
                read(what, lines).into_iter().collect()
            };
            let mut bench = Bench::written(&FIXED16, &write);
            for a in &edges {
                let wanted = model::shifted(i64::from(*a), by, 16);
                let free = i64::from(*a) << by.max(0);
                if fits && free.abs() > most(16) {
                    continue;
                }
                let (found, _) = bench.run(&[*a]);
                assert_eq!(i64::from(found as i16), wanted, "{a} by {by}, {fits}");
            }
        }
    }
}

/// Ints of three and four bytes, and of two without a sign.
#[test]
fn wide_ints_are_read_at_other_scales() {
    let unsigned = Shape {
        signed: false,
        ..Shape::whole(2)
    };
    for shape in [Shape::whole(4), Shape::whole(3), unsigned] {
        let held = Place::Held("first_operand".into(), shape);
        for by in -20..=9 {
            let write = |lines: &mut Vec<String>| {
                let what = Read {
                    from: &held,
                    by,
                    fits: true,
                    to: "result",
                    serial: 1,
                    quick: false,
                };
                read(what, lines).into_iter().collect()
            };
            let mut bench = Bench::written(&FIXED16, &write);
            let mut random = Random(7);
            let mut checked = 0;
            let drawn = (0..400).map(|k| match k {
                0..40 => (1 << (k / 2)) - 1 + k % 2,
                40..80 => -(1 << ((k - 40) / 2)) + k % 2,
                _ => random.next() as i32 >> (k % 32),
            });
            for a in drawn {
                let bits = 8 * u32::from(shape.bytes);
                let has = match shape.signed {
                    true => i64::from(a) == (i64::from(a) << (64 - bits)) >> (64 - bits),
                    false => (0..1 << bits).contains(&i64::from(a)),
                };
                let exact = f64::from(a) * f64::from(by).exp2();
                if !has || exact.abs() > most(16) as f64 {
                    continue;
                }
                checked += 1;
                let wanted = model::shifted(i64::from(a), by, 16);
                let (found, _) = bench.run(&[a]);
                assert_eq!(i64::from(found as i16), wanted, "{a} by {by}, {shape:?}");
            }
            assert!(checked > 20, "{by} {shape:?}");
        }
    }
}

#[test]
fn whole_parts_are_floored() {
    let edges = edges();
    for n in 0..=14 {
        for bytes in [1, 2, 4] {
            let held = Place::Held("first_operand".into(), Shape::whole(2));
            let write = |lines: &mut Vec<String>| {
                floor(&held, n, "result", bytes, lines);
                Vec::new()
            };
            let mut bench = Bench::written(&FIXED16, &write);
            for a in &edges {
                let (found, _) = bench.run(&[*a]);
                let part = |n: i32| n & ((1i64 << (8 * bytes)) - 1) as i32;
                assert_eq!(part(found), part(a >> n), "{a} {n} {bytes}");
            }
        }
    }
}

/// Prints what routines take, for the table in the documentation.
#[test]
fn costs_of_what_is_met_most() {
    let setting = Setting {
        runtime: &FIXED16,
        sizes: 2,
    };
    let bounds = [
        ("mul", 16, 290),
        ("double_mul", 15, 310),
        ("any_mul_14", 14, 335),
        ("div", 14, 610),
        ("odd_root", 13, 320),
        ("add", 0, 25),
    ];
    for (name, n, most) in bounds {
        let routine = FIXED16.routines.iter().find(|r| r.name == name).unwrap();
        let mut bench = Bench::of(setting, routine, &[], n);
        let mut random = Random(5);
        let (mut cycles, times) = (0, 1000);
        for _ in 0..times {
            let args: Vec<i32> = routine
                .args
                .iter()
                .map(|_| (random.next() as i32 >> 17).max(-16000))
                .collect();
            cycles += bench.run(&args).1;
        }
        let mean = cycles / times;
        println!("{name}: {mean} cycles");
        assert!(mean <= most, "{name}: {mean}");
    }
    assert_eq!(Format::Scaled { bits: 16 }, super::REAL);
}
