//! How far the functions are from the exact results, in places of 2^-16.
//!
//! Where every operand can be tried in the time of a test, every one is. The
//! others (sines, logarithms: 2^32 operands) are sampled in strides of a prime,
//! so their figures are the worst of the sample; `SLOWLIGHT_STRIDE=1` tries all.

use crate::model;
use slowlight_routine::{Op, Value};

const PLACE: f64 = 1.0 / 65536.0;

fn exact(op: Op, args: &[i32]) -> f64 {
    let values: Vec<Value> = args
        .iter()
        .map(|a| Value::Real(f64::from(*a) * PLACE))
        .collect();
    let most = f64::from(i32::MAX) * PLACE;
    op.eval(&values).real().clamp(-32768.0, most)
}

/// The greatest difference over these operands, in places.
fn worst(op: Op, model: fn(i32) -> i32, operands: impl Iterator<Item = i32>) -> f64 {
    operands.fold(0.0, |worst, a| {
        let off = (f64::from(model(a)) - exact(op, &[a]) / PLACE).abs();
        f64::max(worst, off)
    })
}

fn everywhere() -> impl Iterator<Item = i32> {
    let stride = std::env::var("SLOWLIGHT_STRIDE").ok();
    let stride = stride.and_then(|s| s.parse().ok()).unwrap_or(1009);
    (i32::MIN..=i32::MAX).step_by(stride)
}

#[test]
fn functions_of_one_operand_err_as_stated() {
    let near = || -0xB_0000..=0xB_0000;
    let unit = || -0x1_0010..=0x1_0010;
    let pole = 3 * 0x8000;
    let found = [
        worst(Op::Sin, model::sine, near()),
        worst(Op::Cos, model::cosine, near()),
        worst(Op::Sin, model::sine, everywhere()),
        worst(Op::Cos, model::cosine, everywhere()),
        worst(Op::Tan, model::tangent, -pole..=pole),
        worst(Op::Asin, model::arcsine, unit()),
        worst(Op::Acos, model::arccosine, unit()),
        worst(Op::Exp, model::exponential, near()),
        worst(Op::Log, model::logarithm, 0..=0x2_0000),
        worst(Op::Log, model::logarithm, everywhere()),
    ];
    let said = found.map(|f| format!("{f:.3}"));
    assert_eq!(
        said,
        [
            "0.663", "0.665", "0.793", "0.795", "0.504", "0.576", "0.577", "6.059", "0.500",
            "0.500"
        ]
    );
}

#[test]
fn powers_err_as_stated() {
    let mut random = super::Random(5);
    // By the exponent's bits before the point: the worst beyond half a place,
    // as a share of the result.
    let worst = [3, 6, 10, 15].map(|bits| {
        let mut worst = 0f64;
        for _ in 0..500_000 {
            let a = (random.next() >> 1 >> (random.next() % 31)) as i32;
            // Every second one is near 1, where large exponents tell.
            let a = match random.next() & 1 {
                0 => a & 0x1_0000 | 0xFFFF & a >> 8,
                _ => a,
            };
            let b = (random.next() as i32) >> (15 - bits) >> (random.next() % 20);
            let exact = exact(Op::Pow, &[a, b]) / PLACE;
            let off = (f64::from(model::power(a, b)) - exact).abs();
            worst = worst.max((off - 0.5) / exact.abs().max(1.0));
        }
        format!("2^{:.1}", worst.log2())
    });
    assert_eq!(worst, ["2^-27.7", "2^-24.7", "2^-21.5", "2^-16.3"]);
}
