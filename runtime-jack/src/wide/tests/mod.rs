//! How far wide Floats are from the exact results: what the routines state.
#![allow(clippy::unwrap_used)]

use super::F416;
use super::model::Wide;
use crate::tests::Random;
use slowlight_routine::{Error, Op, Value};

/// What an error is held against.
#[derive(Clone, Copy, PartialEq)]
enum Against {
    Result,
    One,
}
use Against::{One, Result};

/// Any real with a binary exponent within these.
fn any(random: &mut Random, (least, most): (i32, i32)) -> Wide {
    let ones = match random.below(8) {
        0 => 0,
        1 => (1 << 27) - 1,
        _ => random.below(1 << 27),
    };
    Wide {
        s: random.below(2),
        e: 127 + least + random.below((most - least) as u64 + 1),
        m: (1 << 27) + i64::from(ones),
    }
}

/// The greatest error of so many results.
fn worst(op: Op, count: u32, against: Against, exponents: &[(i32, i32)]) -> f64 {
    let routine = F416.routines.iter().find(|r| {
        let all = [slowlight_routine::Range::ALL; 2];
        r.op == op && (r.domain)(&all, all[0])
    });
    let model = routine.unwrap().model;
    let mut random = Random(77);
    let mut most = 0f64;
    for _ in 0..count {
        let args: Vec<Wide> = exponents.iter().map(|e| any(&mut random, *e)).collect();
        let values: Vec<Value> = args.iter().map(|a| Value::Real(a.value())).collect();
        let bits: Vec<u64> = args.iter().map(|a| a.bits()).collect();
        let (made, exact) = (
            Wide::from_bits(model(&bits)).value(),
            op.eval(&values).real(),
        );
        let follows = exact.abs() > 1e-290 && exact.abs() < 1e290;
        if exact == 0.0 || !follows {
            let far = made.abs() < 1e-280 || made.abs() > 1e280;
            assert!(far, "{op:?} {args:?}: {made}, not {exact}");
            continue;
        }
        let of = if against == One { 1.0 } else { exact.abs() };
        most = most.max((made - exact).abs() / of);
    }
    most
}

/// The relative error that the routines of an operation state.
fn stated(op: Op) -> f64 {
    let routines = F416.routines.iter().filter(|r| r.op == op);
    let of = |error| match error {
        Error::Relative(most) => most,
        _ => 0.0,
    };
    routines.map(|r| of(r.error)).fold(0.0, f64::max)
}

/// In units of 2^-28 of the result, which is half a unit in a last place or a quarter.
#[test]
fn arithmetic_errs_by_little_more_than_half_a_unit() {
    let found = [
        (Op::Add, &[(-16, 16), (-16, 16)][..]),
        (Op::Sub, &[(-1, 1), (-1, 1)]),
        (Op::Mul, &[(0, 0), (0, 0)]),
        (Op::Div, &[(0, 0), (0, 0)]),
        (Op::Sqrt, &[(0, 1)]),
    ]
    .map(|(op, exponents)| {
        let most = worst(op, 2_000_000, Result, exponents);
        (op, format!("{:.3}", most * 2f64.powi(28)), most)
    });
    for (op, _, most) in &found {
        assert!(*most <= stated(*op), "{op:?}: {most:e}");
    }
    let said = found.map(|(_, most, _)| most);
    assert_eq!(said, ["1.000", "1.000", "1.026", "1.000", "1.042"]);
}

#[test]
fn functions_err_by_a_few_units() {
    let few = 300_000;
    let found = [
        worst(Op::Sin, few, Result, &[(-40, 0)]),
        worst(Op::Sin, few, One, &[(-40, 14)]),
        worst(Op::Cos, few, One, &[(-40, 14)]),
        worst(Op::Tan, few, Result, &[(-40, -1)]),
        worst(Op::Asin, few, Result, &[(-40, -1)]),
        worst(Op::Acos, few, Result, &[(-40, -1)]),
        worst(Op::Atan2, few, Result, &[(-20, 20), (-20, 20)]),
        worst(Op::Exp, few, Result, &[(-40, 0)]),
        worst(Op::Exp, few, Result, &[(3, 3)]),
        worst(Op::Exp, few, Result, &[(8, 8)]),
        worst(Op::Log, few, Result, &[(-40, 40)]),
        worst(Op::Log, few, Result, &[(-1, 0)]),
        worst(Op::Pow, few, Result, &[(-20, 20), (-30, -1)]),
        worst(Op::Pow, few, Result, &[(-20, 20), (2, 2)]),
        worst(Op::Pow, few, Result, &[(-20, 20), (5, 5)]),
    ];
    let said = found.map(|most| format!("{most:.2e}"));
    assert_eq!(
        said,
        [
            "7.96e-9", "8.18e-9", "1.03e-8", "1.46e-8", "1.91e-8", "1.71e-8", "1.83e-8", "9.05e-9",
            "2.25e-8", "5.62e-7", "1.48e-8", "1.55e-8", "1.17e-8", "3.73e-8", "2.96e-7"
        ]
    );
}
