//! How far the functions are from the exact results.

use crate::model::{Cut, Float, Rounded, Sums};
use slowlight_routine::{Op, Value};

fn exact(op: Op, args: &[Float]) -> f64 {
    let values: Vec<Value> = args.iter().map(|a| Value::Real(a.value())).collect();
    op.eval(&values).real()
}

/// Every Float with an exponent within these, of both signs.
fn floats(exponents: std::ops::RangeInclusive<i32>) -> impl Iterator<Item = Float> {
    exponents.flat_map(|e| (8192..16384).flat_map(move |m| [0, 1].map(|s| Float { s, e, m })))
}

/// The greatest relative error.
fn relative(op: Op, model: fn(Float) -> Float, all: impl Iterator<Item = Float>) -> f64 {
    all.fold(0.0, |worst: f64, a| {
        let exact = exact(op, &[a]);
        worst.max(((model(a).value() - exact) / exact).abs())
    })
}

/// The greatest absolute error.
fn absolute(op: Op, model: fn(Float) -> Float, all: impl Iterator<Item = Float>) -> f64 {
    all.fold(0.0, |worst: f64, a| {
        worst.max((model(a).value() - exact(op, &[a])).abs())
    })
}

#[test]
fn functions_of_one_operand_err_as_stated() {
    assert_eq!(
        of_one_operand::<Cut>(),
        [
            "1.58e-4", "1.62e-4", "1.61e-4", "2.21e-4", "2.69e-4", "1.61e-4", "2.60e-4", "1.58e-4",
            "1.58e-4", "1.55e-4"
        ]
    );
    assert_eq!(
        of_one_operand::<Rounded>(),
        [
            "1.58e-4", "1.59e-4", "1.60e-4", "2.21e-4", "3.01e-4", "1.87e-4", "2.71e-4", "1.58e-4",
            "1.58e-4", "1.55e-4"
        ]
    );
}

fn of_one_operand<S: Sums>() -> [String; 10] {
    let found = [
        relative(
            Op::Sin,
            Float::sin::<S>,
            floats(90..=127).filter(|a| a.value().abs() < 1.6),
        ),
        absolute(Op::Sin, Float::sin::<S>, floats(90..=141)),
        absolute(Op::Cos, Float::cos::<S>, floats(90..=141)),
        relative(
            Op::Tan,
            Float::tan::<S>,
            floats(90..=127).filter(|a| a.value().abs() < 1.5),
        ),
        relative(Op::Asin, Float::asin::<S>, floats(90..=128)),
        relative(Op::Acos, Float::acos::<S>, floats(90..=126)),
        absolute(Op::Acos, Float::acos::<S>, floats(90..=126)),
        relative(Op::Exp, Float::exp, floats(90..=131)),
        relative(Op::Exp, Float::exp, floats(90..=135)),
        relative(
            Op::Log,
            Float::log::<S>,
            floats(90..=160).filter(|a| a.s == 0 && a.value() != 1.0),
        ),
    ];
    found.map(|f| format!("{f:.2e}"))
}

#[test]
fn functions_of_two_operands_err_as_stated() {
    let mut random = super::Random(3);
    let mut float = |least, most| Float {
        s: random.below(2),
        e: least + random.below((most - least) as u64 + 1),
        m: 8192 + random.below(8192),
    };
    let mut arc = [0f64; 2];
    for _ in 0..1_000_000 {
        let (y, x) = (float(110, 140), float(110, 140));
        let exact = exact(Op::Atan2, &[y, x]);
        for (worst, made) in arc
            .iter_mut()
            .zip([y.atan2::<Cut>(x), y.atan2::<Rounded>(x)])
        {
            *worst = worst.max(((made.value() - exact) / exact).abs());
        }
    }
    // By the greatest exponent: 1, 8, 64 and what is beyond.
    let powers = [126, 129, 132, 145].map(|most| {
        let mut worst = 0f64;
        for _ in 0..500_000 {
            let (a, b) = (float(107, 147), float(90, most));
            let exact = exact(Op::Pow, &[a, b]);
            let made = a.pow(b).value();
            // What f64 cannot follow must only lie beyond it as well.
            let follows = |x: f64| x.abs() > 1e-290 && x.abs() < 1e290;
            if exact == 0.0 || !follows(exact) {
                assert!(!follows(made) || exact != 0.0, "{a:?} ^ {b:?}");
            } else {
                worst = worst.max(((made - exact) / exact).abs());
            }
        }
        worst
    });
    let said =
        [arc[0], arc[1], powers[0], powers[1], powers[2], powers[3]].map(|f| format!("{f:.2e}"));
    assert_eq!(
        said,
        [
            "1.72e-4", "1.72e-4", "1.90e-4", "3.54e-4", "2.56e-3", "8.91e-2"
        ]
    );
}
