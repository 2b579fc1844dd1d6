//! The arithmetic of the published ray marcher, stated again from its
//! description, step by step and slowly, for exponents far from the ends.

use super::{Random, float_edges};
use crate::model::Float;

fn normalise(s: i32, mut e: i32, mut m: i32) -> (i32, i32, i32) {
    while m < 8192 {
        m *= 2;
        e -= 1;
    }
    (s, e, m)
}

/// m = h1 h2 + (h1 l2 + l1 h2)/128, with m = 128 h + l; the exponent is e1 + e2 - 126.
fn mul(a: Float, b: Float) -> (i32, i32, i32) {
    if a.m * b.m == 0 {
        return (0, 0, 0);
    }
    let (h1, l1, h2, l2) = (a.m >> 7, a.m % 128, b.m >> 7, b.m % 128);
    normalise(
        a.s ^ b.s,
        a.e + b.e - 126,
        h1 * h2 + ((h1 * l2 + l1 * h2) >> 7),
    )
}

/// The smaller's mantissa is halved once for each step between the exponents; of a
/// difference both have been doubled before, which the original does not do: so
/// neighbours on both sides of a power of two are told apart.
fn add(a: Float, b: Float) -> (i32, i32, i32) {
    if a.m == 0 || b.m == 0 {
        return parts(if a.m == 0 { b } else { a });
    }
    let (mut big, mut small) = if a.value().abs() >= b.value().abs() {
        (a, b)
    } else {
        (b, a)
    };
    if big.s != small.s {
        for part in [&mut big, &mut small] {
            part.m *= 2;
            part.e -= 1;
        }
    }
    while small.e < big.e && small.m > 0 {
        small.m /= 2;
        small.e += 1;
    }
    if big.s != small.s {
        if big.m == small.m {
            return (0, 0, 0);
        }
        let rest = big.m - small.m;
        return match rest > 16383 {
            true => (big.s, big.e + 1, rest / 2),
            false => normalise(big.s, big.e, rest),
        };
    }
    let sum = big.m + small.m;
    if sum > 16383 {
        (big.s, big.e + 1, sum >> 1)
    } else {
        (big.s, big.e, sum)
    }
}

/// Fourteen bits, most significant first; the divisor is halved after each.
fn div(a: Float, b: Float) -> (i32, i32, i32) {
    let (mut rest, mut quotient) = (a.m, 0);
    for step in 0..14 {
        let part = b.m >> step;
        quotient <<= 1;
        if part <= rest {
            rest -= part;
            quotient |= 1;
        }
    }
    normalise(a.s ^ b.s, a.e + 127 - b.e, quotient)
}

/// A value as its parts; the sign of a zero means nothing.
fn parts(f: Float) -> (i32, i32, i32) {
    if f.m == 0 { (0, 0, 0) } else { (f.s, f.e, f.m) }
}

fn operands() -> Vec<Float> {
    let mut random = Random(0x2545_F491_4F6C_DD1D);
    let all = float_edges()
        .into_iter()
        .chain((0..3000).map(|_| random.float()));
    all.filter(|f| f.m == 0 || (28..=226).contains(&f.e))
        .collect()
}

#[test]
fn the_models_do_what_the_facts_say() {
    let operands = operands();
    let mut random = Random(7);
    let count = operands.len() as u64;
    for &a in &operands {
        for _ in 0..100 {
            let b = operands[random.below(count) as usize];
            assert_eq!(mul(a, b), parts(a.mul(b)), "{a:?} * {b:?}");
            assert_eq!(add(a, b), parts(a.add(b)), "{a:?} + {b:?}");
            assert_eq!(
                add(a, Float { s: 1 - b.s, ..b }),
                parts(a.sub(b)),
                "{a:?} - {b:?}"
            );
            if a.m > 0 && b.m > 0 {
                assert_eq!(div(a, b), parts(a.div(b)), "{a:?} / {b:?}");
            }
        }
    }
}

#[test]
fn conversions_are_those_of_the_reals() {
    for a in operands() {
        let x = a.value();
        assert_eq!(
            f64::from(a.floor()),
            x.floor().clamp(-32767.0, 32767.0),
            "floor {x}"
        );
        assert_eq!(
            f64::from(a.round()),
            x.round().clamp(-32767.0, 32767.0),
            "round {x}"
        );
        assert_eq!(Float::nearest(x).value(), x);
        assert_eq!(f64::from(a.sign()), if x == 0.0 { 0.0 } else { x.signum() });
        for b in operands().into_iter().step_by(31) {
            let y = b.value();
            assert_eq!((a.less(b), a.equal(b)), (x < y, x == y), "{x} {y}");
            assert_eq!(
                (a.min(b).value(), a.max(b).value()),
                (x.min(y), x.max(y)),
                "{x} {y}"
            );
        }
    }
    for i in -32767i32..=32767 {
        let exact = i % 2 == 0 || i.abs() <= 16383;
        let made = Float::from_int(i).value();
        assert!(
            if exact {
                made == f64::from(i)
            } else {
                made == f64::from(i - i.signum())
            },
            "{i}: {made}"
        );
    }
}

#[test]
fn what_lies_beyond_the_ends_is_the_largest_or_zero() {
    let (huge, tiny) = (
        Float::largest(1),
        Float {
            s: 0,
            e: crate::model::BOTTOM,
            m: 8192,
        },
    );
    let one = Float::from_int(1);
    assert_eq!(huge.mul(huge), Float::largest(0));
    assert_eq!(huge.add(huge), huge);
    assert_eq!(huge.div(tiny), huge);
    assert_eq!(huge.scale(2), huge);
    assert_eq!(tiny.mul(tiny), Float::ZERO);
    assert_eq!(tiny.div(huge), Float::ZERO);
    assert_eq!(tiny.scale(-1), Float::ZERO);
    assert_eq!(tiny.sub(Float { m: 8193, ..tiny }), Float::ZERO);
    assert_eq!(one.div(Float::ZERO), Float::largest(0));
    assert_eq!(
        one.neg().div(Float {
            s: 1,
            ..Float::ZERO
        }),
        Float::largest(1)
    );
    assert_eq!(Float::ZERO.div(Float::ZERO), Float::ZERO);
    assert_eq!(one.neg().sqrt(), Float::ZERO);
    assert_eq!((huge.floor(), huge.neg().floor()), (-32767, 32767));
    assert_eq!(huge.value(), f64::MIN);
}
