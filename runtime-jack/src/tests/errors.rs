//! How far the models are from the exact results: what the routines state.

use super::{Random, edges};
use crate::F316;
use crate::model::{Float, int};
use slowlight_routine::{Bits, Error, Format, Op, Value};

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
    let of = |error| match error {
        Error::Relative(r) => r,
        Error::Exact => 0.0,
        Error::Larger(a) | Error::Absolute(a) | Error::Mixed { absolute: a, .. } => panic!("{a}"),
    };
    F316.routines
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
    assert_eq!(said, ["-1.19e-4", "1.17e-3", "-6.10e-5", "1.94e-3"]);
    assert!(quotient.0.abs().max(quotient.1) <= stated(Op::Div));
    assert!(root.0.abs().max(root.1) <= stated(Op::Sqrt));
}

#[test]
fn a_difference_may_be_twice_the_exact_one() {
    let least = unit(8192).sub(Float {
        s: 0,
        e: 126,
        m: 16383,
    });
    assert_eq!(least.value(), 2f64.powi(-13), "of 2^-14");
}

/// Every routine against the operation that it claims to be, in its domain.
#[test]
fn routines_keep_within_their_errors() {
    let mut random = Random(99);
    for routine in F316.routines {
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
                Format::Float316 { .. } => !(-300..=600).contains(&Float::from_bits(x).e),
                _ => int(x) == -32768,
            };
            let beyond = routine.args.iter().zip(bits).any(|(f, x)| far(f, x));
            let values: Vec<Value> = routine
                .args
                .iter()
                .zip(bits)
                .map(|(f, x)| (F316.decode)(x, *f))
                .collect();
            let exact = routine.op.eval(&values);
            let ranges: Vec<_> = values
                .iter()
                .map(|v| slowlight_routine::Range::point(v.real()))
                .collect();
            if beyond || !(routine.domain)(&ranges, slowlight_routine::Range::point(exact.real())) {
                continue;
            }
            let made = (F316.decode)((routine.model)(&bits[..values.len()]), routine.result);
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
                "{} {values:?}: {made}, not {exact}",
                routine.name
            );
        }
    }
}
