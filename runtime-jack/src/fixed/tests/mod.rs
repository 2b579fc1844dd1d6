#![allow(clippy::unwrap_used)]
//! The models against the exact results, for every number that scales may come to; the Jack
//! source is held against the models in [`machine`].

mod machine;
pub mod worst;

use super::functions::{arcs, logs, powers};
use super::model::{FIRST_ROOT, roots};
use super::{filled, routines::ALL};
use crate::model::{MOST, int, int_bits};
use crate::tests::generator::Generator;
use slowlight_routine::scale::{self, Scales};
use slowlight_routine::{Bits, Error, Form, Format, Op, Range, Routine, Type, Value};

/// The numbers that a routine takes, of those that scales may come to.
fn numbers(routine: &Routine) -> Vec<i32> {
    let small = Range::new(-1.0, 1.0);
    let takes = |n: &i32| {
        let mut args = vec![small; routine.args.len()];
        args.push(Range::point(f64::from(*n)));
        // Some are for an operand of 1.
        let ones = [Range::point(1.0), Range::point(1.0), args[args.len() - 1]];
        (routine.domain)(&args, small) || routine.args.len() == 2 && (routine.domain)(&ones, small)
    };
    match routine.op {
        Op::Mul | Op::Div | Op::Sqrt | Op::Floor | Op::Sin | Op::Cos => {
            (-20..=32).filter(takes).collect()
        }
        Op::Tan | Op::Exp | Op::Log | Op::Pow => all_scales(routine.op).filter(takes).collect(),
        Op::Add if takes(&1) && !takes(&0) => vec![1],
        _ => vec![0],
    }
}

/// Numbers of all scales: those of operands and results from end to end.
fn all_scales(op: Op) -> impl Iterator<Item = i32> {
    let second: &[i8] = match op {
        Op::Pow => &[5, 8, 9, 10, 12, 13, 14, 15],
        _ => &[0],
    };
    let (firsts, results) = match op {
        Op::Exp => ((10..=15).collect(), (scale::FEWEST..=scale::MOST).collect()),
        _ => (
            vec![scale::FEWEST, 0, 5, 10, 12, 13, 14, 15, scale::MOST],
            vec![scale::FEWEST, -6, -1, 0, 4, 9, 10, 12, 14, 15, scale::MOST],
        ),
    };
    firsts.into_iter().flat_map(move |a| {
        let results = results.clone();
        second.iter().flat_map(move |&b| {
            let of = move |result| Scales {
                args: [a, b],
                result,
            };
            let numbers: Vec<i32> = results.iter().map(|r| of(*r).number(op)).collect();
            numbers
        })
    })
}

fn own() -> impl Iterator<Item = &'static Routine> {
    ALL.iter().filter(|r| scale::concerns(r.op))
}

/// Whether a routine is right for such operands.
fn may(routine: &Routine, args: &[i32], n: i32, exact: f64) -> bool {
    let mut ranges: Vec<Range> = args.iter().map(|a| Range::point(f64::from(*a))).collect();
    ranges.push(Range::point(f64::from(n)));
    (routine.domain)(&ranges, Range::point(exact))
}

/// What is meant, in units of the result's last place.
fn exact(op: Op, args: &[i32], n: i32) -> f64 {
    let a = f64::from(args[0]);
    let b = f64::from(args.get(1).copied().unwrap_or(0));
    let by = f64::from(n).exp2();
    let scales = Scales::unpacked(n);
    let scaled = |x: f64, scale: i8| Value::Real(x * (-f64::from(scale)).exp2());
    match op {
        Op::Tan | Op::Exp | Op::Log | Op::Pow => {
            let all = [scaled(a, scales.args[0]), scaled(b, scales.args[1])];
            op.eval(&all).real() * f64::from(scales.result).exp2()
        }
        Op::Asin => op.eval(&[scaled(a, 14)]).real() * 16384.0,
        Op::Acos => op.eval(&[scaled(a, 14)]).real() * 8192.0,
        Op::Atan2 => a.atan2(b) * 8192.0,
        Op::Mul => a * b / by,
        Op::Div if b == 0.0 => a.signum() * f64::from(args[0].signum().abs()) * 1e9,
        Op::Div => a / b * by,
        Op::Sqrt => (a.max(0.0) * by).sqrt(),
        Op::Floor => (a / by).floor(),
        Op::Sin | Op::Cos => op.eval(&[Value::Real(a / by)]).real() * 16384.0,
        // Read as twice what it is.
        Op::Add if n == 1 => a,
        Op::Round | Op::ToReal => a,
        _ => op.eval(&[Value::Real(a), Value::Real(b)]).real(),
    }
}

fn computed(routine: &Routine, args: &[i32], n: i32) -> Bits {
    let mut bits: Vec<Bits> = args.iter().map(|a| int_bits(*a)).collect();
    bits.push(i64::from(n) as Bits);
    (routine.model)(&bits)
}

fn edges() -> Vec<i32> {
    let near = [
        0, 1, 2, 3, 127, 128, 129, 255, 256, 257, 511, 512, 8191, 8192, 8193,
    ];
    let far = [16383, 16384, 16385, 21845, 32639, 32640, 32766, 32767];
    let all = near.into_iter().chain(far);
    all.flat_map(|x| [x, -x]).collect()
}

/// How far a routine is off for such operands, in last places; nothing where it is not
/// for them.
fn off(routine: &Routine, args: &[i32], n: i32) -> Option<f64> {
    let exact = exact(routine.op, args, n);
    let held = match routine.result {
        Format::Bool => exact,
        _ => exact.clamp(f64::from(-MOST), f64::from(MOST)),
    };
    let made = || f64::from(int(computed(routine, args, n)));
    may(routine, args, n, exact).then(|| (made() - held).abs())
}

/// Of single operands all; of pairs edges and others.
#[test]
fn routines_keep_within_their_errors() {
    let mut generator = Generator(3);
    let mut values = edges();
    values.extend((0..60).map(|_| generator.next()));
    values.extend((0..60).map(|_| -(generator.next() / 64)));
    let every: Vec<i32> = (-MOST..=MOST).collect();
    for routine in own() {
        let [firsts, seconds] = match routine.args.len() {
            1 => [&every[..], &[0]],
            _ => [&values[..], &values[..]],
        };
        for n in numbers(routine) {
            let mut worst = 0f64;
            for &a in firsts {
                for &b in seconds {
                    let off = off(routine, &[a, b][..routine.args.len()], n);
                    worst = worst.max(off.unwrap_or(0.0));
                }
            }
            let most = match routine.error {
                Error::Absolute(most) => most,
                _ => 0.0,
            };
            let name = routine.name;
            assert!(worst <= most, "{name} with {n}: {worst}, not {most}");
        }
    }
}

#[test]
fn roots_of_every_value_are_right_to_what_is_stated() {
    let of = |k: usize| ((k + FIRST_ROOT) as f64 / 256.0).sqrt() * 32768.0;
    let off = |(k, root): (usize, &i32)| (f64::from(*root) - of(k)).abs();
    let worst = roots().iter().enumerate().map(off).fold(0.0, f64::max);
    assert!(worst <= 1.0, "{worst}");
    let routine = own().find(|r| r.op == Op::Sqrt).unwrap();
    for n in 1..=15 {
        for a in 0..=MOST {
            let off = f64::from(int(computed(routine, &[a], n))) - exact(Op::Sqrt, &[a], n);
            assert!(off.abs() <= 1.5, "{a} with {n}: {off}");
        }
    }
}

#[test]
fn tables_are_right_to_what_is_stated() {
    let worst = |table: &[i32], exact: &dyn Fn(f64) -> f64| {
        let off =
            |(k, made): (usize, &i32)| (f64::from(*made) - exact(k as f64 / 256.0) * 32768.0).abs();
        // The last ones stand for 1 in their own ways.
        table[..256].iter().enumerate().map(off).fold(0.0, f64::max)
    };
    let found = [
        worst(arcs(), &f64::atan),
        worst(powers(), &|x| x.exp2() - 1.0),
        worst(logs(), &|x| (1.0 + x).log2()),
    ];
    let said = found.map(|worst| format!("{worst:.2}"));
    assert_eq!(said, ["0.70", "0.59", "0.62"]);
    assert_eq!(
        [arcs(), powers(), logs()].map(|t| t[256]),
        [25736, 32767, -32768]
    );
}

#[test]
fn texts_have_no_holes_left() {
    for routine in own() {
        for n in numbers(routine) {
            let Form::Expression { template, .. } = routine.form else {
                panic!("{} is no expression", routine.name);
            };
            let text = filled(template, n).replace("{0}", "a").replace("{1}", "b");
            assert!(!text.contains('{'), "{text}");
        }
    }
}

/// Whether a plan has such scales.
fn planned(op: Op, n: i32) -> bool {
    let Scales {
        args: [a, b],
        result,
    } = Scales::unpacked(n);
    match op {
        Op::Tan => (0..=13).contains(&a) && result <= 14,
        Op::Exp => (10..=15).contains(&a),
        Op::Log => result <= 14,
        _ => (5..=15).contains(&b),
    }
}

#[test]
fn every_operation_on_reals_that_is_offered_has_a_total_routine() {
    let all = Range::ALL;
    for routine in own() {
        let offered = |n: i32| {
            let number = Range::point(f64::from(n));
            let args = [vec![all; routine.args.len()], vec![number]].concat();
            ALL.iter()
                .any(|r| r.op == routine.op && (r.domain)(&args, all))
        };
        let numbers = match routine.op {
            Op::Mul => -60..=31,
            Op::Div => 0..=30,
            Op::Sqrt => 1..=15,
            Op::Floor => 0..=30,
            Op::Sin | Op::Cos => 0..=13,
            _ => 0..=0,
        };
        let numbers: Vec<i32> = match routine.op {
            Op::Tan | Op::Exp | Op::Log | Op::Pow => all_scales(routine.op)
                .filter(|n| planned(routine.op, *n))
                .collect(),
            _ => numbers.collect(),
        };
        for n in numbers {
            assert!(offered(n), "{} with {n}", routine.op.name());
        }
        assert!(routine.args.iter().all(|f| f.scalar() != Type::Bool));
    }
}
