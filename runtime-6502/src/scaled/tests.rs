//! Every routine on the processor against its model and the operation.

#![allow(clippy::unwrap_used)]

use super::kinds::{Kind, LONG, SHORT};
use super::{long, model};
use crate::model::{bits, int};
use crate::tests::bench::{Bench, Random};
use crate::write::Place;
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
        Op::ReciprocalRoot => (-45..=90).collect(),
        Op::Mul => (-8..56).collect(),
        _ => (0..48).collect(),
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

fn in_domain(routine: &Routine, args: &[i32], n: i32, exact: f64) -> bool {
    let mut ranges: Vec<Range> = args.iter().map(|a| Range::point(f64::from(*a))).collect();
    ranges.push(Range::point(f64::from(n)));
    (routine.domain)(&ranges, Range::point(exact))
}

/// What a routine's result would be exactly, in units of its last place, where the number
/// tells.
fn exact(kind: &Kind, routine: &Routine, args: &[i32], n: i32) -> Option<f64> {
    let [a, b] = [args[0], *args.last().unwrap()].map(f64::from);
    let power = |n: i32| f64::from(n).exp2();
    Some(match routine.op {
        Op::Mul => a * b * power(-n),
        Op::Div if b == 0.0 => 1e9 * f64::from(args[0].signum()),
        Op::Div => a / b * power(n),
        Op::Sqrt => (a.max(0.0) * power(n)).sqrt(),
        Op::IntRoot => a.max(0.0).sqrt() * power(n),
        Op::ReciprocalRoot if a <= 0.0 => 1e9,
        Op::ReciprocalRoot => power(n).sqrt() / a.sqrt(),
        Op::Add if n == 1 => a,
        Op::Add => a + b,
        Op::Sub => a - b,
        Op::Sin => (a * power(-n)).sin() * power(kind.sine),
        Op::Cos => (a * power(-n)).cos() * power(kind.sine),
        Op::Asin => (a * power(-kind.sine)).clamp(-1.0, 1.0).asin() * power(kind.sine),
        Op::Acos => (a * power(-kind.sine)).clamp(-1.0, 1.0).acos() * power(kind.angle),
        Op::Atan2 => a.atan2(b) * power(kind.angle),
        _ => return None,
    })
}

#[test]
fn machine_and_model_agree_bit_for_bit() {
    agree(&SHORT);
}

#[test]
fn machine_and_model_agree_bit_for_bit_in_24_bits() {
    agree(&LONG);
}

fn agree(kind: &Kind) {
    let edges = kind.edges();
    let real = |r: &&Routine| {
        let all = r.args.iter().chain([&r.result]);
        !r.name.ends_with("one_over") && all.into_iter().any(|f| *f == kind.setting.runtime.real)
    };
    let setting = kind.setting;
    for routine in setting.runtime.routines.iter().filter(real) {
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
                        .map(|_| kind.draw(&mut random, &edges))
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
            for k in [0, 1, kind.most() / 2 + 1, kind.most()] {
                pairs.push(vec![k; routine.args.len()]);
                let mut one = vec![123; routine.args.len()];
                one[routine.args.len() - 1] = k;
                pairs.push(one.clone());
                one.reverse();
                pairs.push(one);
            }
            for args in pairs {
                let exact = exact(kind, routine, &args, n);
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
                if routine.result == setting.runtime.real {
                    assert!(
                        i64::from(wanted).abs() <= most(kind.bits),
                        "{}",
                        routine.name
                    );
                }
                if let Some(exact) = exact {
                    let end = most(kind.bits) as f64;
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

/// Of 24 bits: all that the table's entries are beside, and others.
#[test]
fn roots_of_24_bits_are_within_their_bound() {
    let mut worst = 0.0f64;
    for n in 1..=23 {
        let beside = (1..1 << 8).flat_map(|k| (-2..3).map(move |more| (k << 15) + more));
        let spread = (0..1 << 16).map(|k| k * 127 + n);
        for a in beside.chain(spread).filter(|a| (0..1 << 23).contains(a)) {
            let exact = (f64::from(a) * f64::from(n).exp2()).sqrt();
            worst = worst.max((f64::from(long::root(a, n)) - exact).abs());
        }
    }
    assert!(worst <= 0.9 && worst > 0.4, "{worst}");
}

/// The reciprocal is never shorter than 24 bits: a division takes it for 2^24 less.
#[test]
fn reciprocals_have_24_bits() {
    let mut worst = 0.0f64;
    let ends = ((1 << 23)..(1 << 23) + 70_000).chain((1 << 24) - 70_000..1 << 24);
    for b in ends.chain(((1 << 23)..1 << 24).step_by(17)) {
        let found = long::reciprocal(b);
        assert!((1 << 23..1 << 24).contains(&found), "{b}: {found}");
        worst = worst.max((found as f64 - 2f64.powi(47) / b as f64).abs());
    }
    assert!(worst <= 1.0 && worst > 0.4, "{worst}");
}

/// What is one over a divisor is that division, for all divisors of 16 bits and many of 24.
#[test]
fn reciprocals_are_quotients() {
    for kind in [SHORT, LONG] {
        let end = kind.most();
        let routine = (kind.setting.runtime.routines.iter())
            .find(|r| r.name.ends_with("one_over"))
            .unwrap();
        let mut worst = 0.0f64;
        let wide = i32::from(kind.bits) - 2;
        for (one, n) in [
            (1 << wide, wide),
            (1 << wide, 0),
            (1, wide + 6),
            (4096, 7),
            (1, 2 * wide),
        ] {
            let places = [
                Place::Constant(one as u64),
                Place::At("second_operand_value".into()),
            ];
            let mut bench = Bench::of(kind.setting, routine, &places, n);
            let step = if n == 14 {
                1
            } else {
                7 << (2 * (kind.bits - 16)) >> (kind.bits / 24 * 3)
            };
            let others = (-end..=end).step_by(step as usize);
            for b in others.chain(kind.edges()) {
                let wanted = (kind.divide)(one, b, n);
                assert_eq!(bench.run(&[one, b]).0, wanted, "{one} / {b}, {n}");
                let exact = f64::from(one) / f64::from(b) * f64::from(n).exp2();
                if b != 0 {
                    let end = f64::from(end);
                    worst = worst.max((f64::from(wanted) - exact.clamp(-end, end)).abs());
                }
            }
        }
        let bound = routine.error.most(&[], 1.0);
        println!("{}: {worst} of {bound}", routine.name);
        assert!(worst <= bound, "{worst}");
    }
}

#[test]
fn every_operation_has_a_total_routine() {
    for kind in [SHORT, LONG] {
        has_all(&kind);
    }
}

fn has_all(kind: &Kind) {
    let long = i32::from(kind.bits) - 1;
    for op in Op::ALL {
        let of_reals = op.result() == Type::Real || op.args().contains(&Type::Real);
        if !of_reals {
            continue;
        }
        // At the scales that plans may have.
        let numbers: Vec<i32> = match op {
            Op::Mul => (-75..75).collect(),
            Op::Floor => (0..=long + 15).collect(),
            Op::Div => (0..=2 * long).collect(),
            Op::Sqrt => (1..=long).collect(),
            Op::Sin | Op::Cos => (long - 15..=13.max(long - 7)).collect(),
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
            let of = kind.setting.runtime.routines.iter().filter(|r| r.op == *op);
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

/// Prints what routines take, for the table in the documentation.
#[test]
fn costs_of_what_is_met_most() {
    let short: [(&str, i32, u64); 7] = [
        ("mul", 16, 290),
        ("double_mul", 15, 310),
        ("any_mul_14", 14, 335),
        ("div", 14, 610),
        ("odd_root", 13, 320),
        ("mod", 10, 280),
        ("add", 0, 25),
    ];
    let long: [(&str, i32, u64); 9] = [
        ("long_mul_24", 24, 470),
        ("long_mul_23", 23, 490),
        ("long_mul_up", 22, 560),
        ("long_mul_16", 16, 600),
        ("long_mul_middle", 18, 700),
        ("long_div", 22, 1500),
        ("long_odd_root", 21, 740),
        ("mod", 14, 700),
        ("add", 0, 30),
    ];
    for (kind, bounds) in [(SHORT, &short[..]), (LONG, &long[..])] {
        for &(name, n, most) in bounds {
            let routine = kind.routine(name);
            let mut bench = Bench::of(kind.setting, routine, &[], n);
            let mut random = Random(5);
            let (mut cycles, times) = (0, 1000);
            let end = -(1 << (kind.bits - 2));
            for _ in 0..times {
                let args: Vec<i32> = routine
                    .args
                    .iter()
                    .map(|_| (random.next() as i32 >> (33 - kind.bits)).max(end))
                    .collect();
                cycles += bench.run(&args).1;
            }
            let mean = cycles / times;
            println!("{name}: {mean} cycles, {} bytes", bench.bytes);
            assert!(mean <= most, "{name}: {mean}");
        }
    }
    assert_eq!(Format::Scaled { bits: 16 }, super::REAL);
    assert_eq!(Format::Scaled { bits: 24 }, super::LONG);
}

/// What either format keeps in the zero page lies apart.
#[test]
fn names_in_the_zero_page_lie_apart() {
    let pages = [
        include_str!("../../asm/zero_page.asm"),
        include_str!("../../asm/scaled/page.asm"),
        include_str!("../../asm/scaled24/page.asm"),
    ];
    let places = pages
        .iter()
        .flat_map(|page| page.lines())
        .filter_map(|line| {
            let (name, rest) = line.split_once(" = $")?;
            Some((u8::from_str_radix(rest.get(..2)?, 16).ok()?, name))
        });
    let mut all: Vec<(u8, &str)> = places.collect();
    assert!(all.len() > 25);
    all.sort_unstable();
    for pair in all.windows(2) {
        let pointer = pair[0].1.starts_with("sum") || pair[0].1.starts_with("dif");
        let bytes = if pointer { 2 } else { 1 };
        assert!(pair[0].0 + bytes <= pair[1].0, "{pair:?}");
    }
    let last = all.last().unwrap().0;
    assert!(last < super::LONG_FREE_ZERO_PAGE);
}
