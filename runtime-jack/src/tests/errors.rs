//! How far the models are from the exact results: what the routines state.

use super::{Random, edges};
use crate::model::{Float, Rounded, Sums, int};
use crate::wide::F416;
use crate::{F316, F316R, words};
use slowlight_routine::{Bits, Error, Format, Op, Runtime, Value};

fn unit(m: i32) -> Float {
    Float { s: 0, e: 127, m }
}

#[test]
fn a_product_is_short_by_up_to_2_to_the_minus_11_08() {
    let (mut worst, mut sum) = (0f64, 0f64);
    for a in 8192..16384 {
        for b in 8192..16384 {
            let exact = f64::from(a) * f64::from(b);
            let short = 1.0 - unit(a).mul(unit(b)).value() * f64::from(1 << 26) / exact;
            assert!(short >= 0.0, "towards zero");
            worst = worst.max(short);
            sum += short;
        }
    }
    let mean = sum / f64::from(1 << 26);
    assert_eq!(
        format!("{:.2} {:.2}", worst.log2(), mean.log2()),
        "-11.08 -13.49"
    );
    assert!(worst <= stated(Op::Mul), "{worst}");
}

/// The relative error that the routines of an operation state.
fn stated(op: Op) -> f64 {
    stated_by(&F316, op)
}

fn stated_by(runtime: &Runtime, op: Op) -> f64 {
    let of = |error| match error {
        Error::Relative(r) => r,
        Error::Exact => 0.0,
        other => panic!("{other:?}"),
    };
    runtime
        .routines
        .iter()
        .filter(|r| r.op == op)
        .map(|r| of(r.error))
        .fold(0.0, f64::max)
}

#[test]
fn a_quotient_and_a_root_err_as_stated() {
    let (mut quotient, mut root) = ((0f64, 0f64), (0f64, 0f64));
    for a in 8192..16384 {
        // Every divisor was tried: these hold the worst.
        for b in (8192..16384).step_by(7).chain([8193, 16383]) {
            let error = unit(a).div(unit(b)).value() / (f64::from(a) / f64::from(b)) - 1.0;
            quotient = (quotient.0.min(error), quotient.1.max(error));
        }
        for e in [127, 128] {
            let x = Float { s: 0, e, m: a };
            let error = x.sqrt().value() / x.value().sqrt() - 1.0;
            root = (root.0.min(error), root.1.max(error));
        }
    }
    let said = [quotient.0, quotient.1, root.0, root.1].map(|e| format!("{e:.2e}"));
    assert_eq!(said, ["-1.19e-4", "1.17e-3", "-9.01e-5", "3.00e-5"]);
    assert!(quotient.0.abs().max(quotient.1) <= stated(Op::Div));
    assert!(root.0.abs().max(root.1) <= stated(Op::Sqrt));
}

/// Of all pairs of mantissas: products and quotients are the nearest, of two as near
/// the larger; so are roots.
#[test]
fn rounded_results_are_the_nearest() {
    for a in 8192i64..16384 {
        for b in 8192i64..16384 {
            let [p, q] = [a, b].map(|m| unit(m as i32));
            let product = a * b;
            let shift = if product < 1 << 27 { 13 } else { 14 };
            let nearest = (product + (1 << (shift - 1))) >> shift;
            let made = p.product(q);
            let units = i64::from(made.m) << (made.e - 114 - shift);
            assert_eq!(units, nearest, "{a} * {b}");
            let shift = if a < b { 14 } else { 13 };
            let nearest = ((a << (shift + 1)) / b + 1) >> 1;
            let made = p.ratio(q);
            assert_eq!(
                (i64::from(made.m), made.e),
                (nearest, 140 - shift),
                "{a} / {b}"
            );
        }
        for e in [126, 127] {
            let x = Float {
                s: 0,
                e,
                m: a as i32,
            };
            let near = Float::nearest(x.value().sqrt());
            assert_eq!(Rounded::sqrt(x), near, "{x:?}");
        }
    }
    let half = 0.5f64.powi(14);
    assert!([Op::Mul, Op::Div, Op::Sqrt].map(|op| stated_by(&F316R, op)) == [half; 3]);
}

/// Of all distances between exponents: sums are the nearest, and differences but for
/// those close under a power of two, which are as near for their size.
#[test]
fn a_rounded_sum_errs_by_half_a_unit() {
    let mut random = Random(5);
    let (mut worst, mut others) = (0f64, 0);
    for apart in 0..18 {
        for _ in 0..200_000 {
            let a = Float {
                s: 0,
                e: 140,
                m: 8192 + random.below(8192),
            };
            let m = if random.below(8) == 0 {
                8192
            } else {
                8192 + random.below(8192)
            };
            let b = Float {
                s: random.below(2),
                e: 140 - apart,
                m,
            };
            let (a, b) = if random.below(4) == 0 {
                (Float { m: 8192, ..a }, b)
            } else {
                (a, b)
            };
            let exact = a.value() + b.value();
            let made = Rounded::add(a, b).value();
            if exact == 0.0 {
                assert_eq!(made, 0.0, "{a:?} {b:?}");
                continue;
            }
            worst = worst.max(((made - exact) / exact).abs());
            let near = (made - exact).abs() <= (Float::nearest(exact).value() - exact).abs();
            let power = made.log2().fract() == 0.0 && made > exact && b.s == 1;
            assert!(near || power, "{a:?} {b:?}: {made}, not {exact}");
            others += u32::from(!near);
        }
    }
    assert!(others > 0, "the nearest is described too carefully");
    assert_eq!(format!("{worst:.4e}"), "6.1031e-5");
    assert!(
        [Op::Add, Op::Sub]
            .iter()
            .all(|op| stated_by(&F316R, *op) == 0.5f64.powi(14))
    );
}

/// The original, without a guard bit, makes twice the difference of 1 and its neighbour.
#[test]
fn neighbours_in_different_binades_are_told_apart() {
    for (e, apart) in [(127, 1), (100, 1), (127, 3), (141, 1000)] {
        let (above, below) = (
            Float { s: 0, e, m: 8192 },
            Float {
                s: 0,
                e: e - 1,
                m: 16384 - apart,
            },
        );
        let exact = above.value() - below.value();
        for difference in [above.sub(below), Rounded::sub(above, below)] {
            assert_eq!(difference.value(), exact);
        }
        assert_eq!(below.sub(above).value(), -exact);
    }
}

/// Every routine against the operation that it claims to be, in its domain.
#[test]
fn routines_keep_within_their_errors() {
    for runtime in [&F316, &F316R, &F416] {
        keep_within_their_errors(runtime);
    }
}

fn keep_within_their_errors(runtime: &Runtime) {
    let mut random = Random(99);
    for routine in runtime.routines {
        let mut lists: Vec<Vec<Bits>> = routine.args.iter().map(|f| edges(*f)).collect();
        lists
            .iter_mut()
            .zip(routine.args)
            .for_each(|(l, f)| l.extend((0..100).map(|_| random.bits(*f))));
        let one = vec![0];
        let second = lists.get(1).unwrap_or(&one);
        for (&a, &b) in lists[0]
            .iter()
            .flat_map(|a| second.iter().map(move |b| (a, b)))
        {
            let bits = [a, b];
            // What f64 cannot follow, and an int that stands for another, are the machine's affair.
            let far = |f: &Format, x| match f {
                f if f.is_object() => !(-300..=600).contains(&words(x, *f)[1]),
                _ => int(x) == -32768,
            };
            let beyond = routine.args.iter().zip(bits).any(|(f, x)| far(f, x));
            let values: Vec<Value> = routine
                .args
                .iter()
                .zip(bits)
                .map(|(f, x)| (runtime.decode)(x, *f))
                .collect();
            let exact = routine.op.eval(&values);
            let ranges: Vec<_> = values
                .iter()
                .map(|v| slowlight_routine::Range::point(v.real()))
                .collect();
            if beyond || !(routine.domain)(&ranges, slowlight_routine::Range::point(exact.real())) {
                continue;
            }
            let made = (runtime.decode)((routine.model)(&bits[..values.len()]), routine.result);
            let (made, exact) = (made.real(), exact.real());
            let exact = match routine.result {
                Format::Int { .. } => exact.clamp(-32768.0, 32767.0),
                _ => exact,
            };
            let within = match routine.error {
                // Saturating ints end one short of the format's least.
                Error::Exact => made == exact || exact.abs() >= 32767.0 && made.abs() >= 32767.0,
                error => (made - exact).abs() <= error.most(&ranges, exact),
            };
            let across = matches!(routine.error, Error::Larger(_)) && made * exact < 0.0;
            assert!(
                (within && !across) || made.abs() == f64::MAX,
                "{} {} {values:?}: {made}, not {exact}",
                runtime.format,
                routine.name
            );
        }
    }
}
