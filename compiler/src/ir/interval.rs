//! Interval arithmetic: the range of an operation from its arguments' ranges.
//!
//! Bounds are computed in `f64` to nearest; the enlargement by the machine's
//! error, far larger than an `f64` ulp, covers that.

use slowlight_routine::{Op, Range, Type, Value};
use std::f64::consts::PI;

/// The range of `op`; `same` says that both arguments are one value.
pub fn interval(op: Op, [a, b]: [Range; 2], same: bool) -> Range {
    let one = |x: f64| op.eval(&[Value::Real(x)]).real();
    if let Some(made) = point(op, a, b) {
        return made;
    }
    match op {
        Op::Add => bounds(a.lo + b.lo, a.hi + b.hi),
        Op::Sub if same => Range::point(0.0),
        Op::Sub => bounds(a.lo - b.hi, a.hi - b.lo),
        Op::Mul if same => square(a),
        Op::Mul => product(a, b),
        Op::Div => quotient(a, b),
        Op::Neg => Range {
            lo: -a.hi,
            hi: -a.lo,
            nonzero: a.nonzero,
        },
        Op::Abs => magnitude(a),
        Op::Min | Op::IntMin => bounds(a.lo.min(b.lo), a.hi.min(b.hi)),
        Op::Max | Op::IntMax => bounds(a.lo.max(b.lo), a.hi.max(b.hi)),
        Op::Sqrt | Op::IntRoot => {
            let root = |x: f64| x.max(0.0).sqrt();
            let made = Range::new(root(a.lo), root(a.hi));
            Range {
                nonzero: made.nonzero || (a.nonzero && a.lo >= 0.0),
                ..made
            }
        }
        Op::ReciprocalRoot => {
            let made = |x: f64| match x > 0.0 {
                true => x.sqrt().recip(),
                false => f64::INFINITY,
            };
            Range::new(made(a.hi).min(f64::MAX), made(a.lo))
        }
        Op::Mod => modulus(b, 0.0),
        Op::Sin => wave(a, 0.25),
        Op::Cos => wave(a, 0.0),
        Op::Asin => bounds(one(a.lo), one(a.hi)),
        Op::Acos => bounds(one(a.hi), one(a.lo)),
        Op::Atan2 => Range::new(-PI, PI),
        Op::Exp | Op::Log => bounds(one(a.lo), one(a.hi)),
        Op::Pow if a.lo > 0.0 => {
            let corners = [(a.lo, b.lo), (a.lo, b.hi), (a.hi, b.lo), (a.hi, b.hi)];
            let all = corners.map(|(x, y)| Range::point(x.powf(y).min(f64::MAX)));
            all.into_iter().reduce(Range::join).unwrap_or(Range::ALL)
        }
        Op::Pow if a.lo >= 0.0 => Range::new(0.0, f64::INFINITY),
        Op::Pow | Op::Tan => Range::ALL,
        Op::Floor => Range::new(whole(a.lo.floor()), whole(a.hi.floor())),
        Op::Round => Range::new(whole(a.lo.round()), whole(a.hi.round())),
        Op::Sign | Op::IntSign => signs(a),
        Op::ToReal => a,
        Op::IntAdd => ints(a.lo + b.lo, a.hi + b.hi),
        Op::IntSub if same => Range::point(0.0),
        Op::IntSub => ints(a.lo - b.hi, a.hi - b.lo),
        Op::IntMul => {
            let made = if same { square(a) } else { product(a, b) };
            ints(made.lo, made.hi)
        }
        Op::IntDiv => {
            let made = quotient(a, b);
            // Flooring moves a bound by less than one; quotients by 0 are ends.
            ints(made.lo.floor(), made.hi.floor())
        }
        Op::IntMod => modulus(b, 1.0),
        Op::IntNeg => ints(-a.hi, -a.lo),
        Op::IntAbs => magnitude(a),
        Op::BitAnd => mask(a, b),
        Op::BitOr | Op::BitXor => joined(op, a, b),
        Op::Less | Op::LessEqual | Op::Equal | Op::Not => truth(op, a, b),
        Op::IntLess | Op::IntLessEqual | Op::IntEqual => truth(op, a, b),
    }
}

/// The operation itself, where both arguments are known.
fn point(op: Op, a: Range, b: Range) -> Option<Range> {
    let known = a.constant()?;
    // Where points are of a plan's choice, what an int is read as may end below 1.
    if op == Op::ToReal {
        return None;
    }
    let value = |ty: Type, x: f64| match ty {
        Type::Bool => Value::Bool(x != 0.0),
        Type::Int => Value::Int(x as i32),
        Type::Real => Value::Real(x),
    };
    let args = op.args();
    let first = value(*args.first()?, known);
    let made = match args.get(1) {
        Some(&ty) => op.eval(&[first, value(ty, b.constant()?)]),
        None => op.eval(&[first]),
    };
    Some(Range::point(made.real()))
}

/// The cosine of a range; `turn` is how far its peaks lie from whole turns.
fn wave(a: Range, turn: f64) -> Range {
    if !a.lo.is_finite() || !a.hi.is_finite() || a.magnitude() > 1e9 {
        return Range::new(-1.0, 1.0);
    }
    let (lo, hi) = (a.lo / (2.0 * PI) - turn, a.hi / (2.0 * PI) - turn);
    let ends = [lo, hi].map(|x| (x * 2.0 * PI).cos());
    // Whether a whole number plus `at` lies between the ends.
    let meets = |at: f64| (lo - at).ceil() <= hi - at;
    let least = if meets(0.5) {
        -1.0
    } else {
        ends[0].min(ends[1])
    };
    let most = if meets(0.0) {
        1.0
    } else {
        ends[0].max(ends[1])
    };
    bounds((least - 1e-9).max(-1.0), (most + 1e-9).min(1.0))
}

/// A range whose bounds may have come out of inf - inf.
fn bounds(lo: f64, hi: f64) -> Range {
    let lo = if lo.is_nan() { f64::NEG_INFINITY } else { lo };
    let hi = if hi.is_nan() { f64::INFINITY } else { hi };
    Range::new(lo, hi)
}

fn whole(x: f64) -> f64 {
    x.clamp(f64::from(i32::MIN), f64::from(i32::MAX))
}

/// Exact bounds of ints; the format cuts them, so they may pass 32 bits.
fn ints(lo: f64, hi: f64) -> Range {
    bounds(lo, hi)
}

fn square(a: Range) -> Range {
    let m = magnitude(a);
    Range {
        nonzero: m.nonzero,
        ..bounds(m.lo * m.lo, m.hi * m.hi)
    }
}

fn magnitude(a: Range) -> Range {
    let lo = if a.lo <= 0.0 && a.hi >= 0.0 {
        0.0
    } else {
        a.lo.abs().min(a.hi.abs())
    };
    Range {
        lo,
        hi: a.magnitude(),
        nonzero: a.nonzero || lo > 0.0,
    }
}

pub(crate) fn product(a: Range, b: Range) -> Range {
    let times = |x: f64, y: f64| if x == 0.0 || y == 0.0 { 0.0 } else { x * y };
    let corners = [
        times(a.lo, b.lo),
        times(a.lo, b.hi),
        times(a.hi, b.lo),
        times(a.hi, b.hi),
    ];
    let lo = corners.into_iter().fold(f64::INFINITY, f64::min);
    let hi = corners.into_iter().fold(f64::NEG_INFINITY, f64::max);
    bounds(lo, hi)
}

fn quotient(a: Range, b: Range) -> Range {
    // Division by 0 gives the largest value, so it belongs to the infinite end.
    let inverse = match () {
        () if b.lo > 0.0 || b.hi < 0.0 => Range::new(1.0 / b.hi, 1.0 / b.lo),
        () if b.lo == 0.0 && b.hi > 0.0 => Range::new(1.0 / b.hi, f64::INFINITY),
        () if b.hi == 0.0 && b.lo < 0.0 && b.nonzero => Range::new(f64::NEG_INFINITY, 1.0 / b.lo),
        () => return Range::ALL,
    };
    let made = product(a, inverse);
    // 0/0 is 0.
    if !b.nonzero && a.contains(0.0) {
        made.join(Range::point(0.0))
    } else {
        made
    }
}

/// a mod b: between 0 and b; `gap` is what keeps it from reaching b.
fn modulus(b: Range, gap: f64) -> Range {
    let top = if b.hi > 0.0 { b.hi - gap } else { 0.0 };
    let bottom = if b.lo < 0.0 { b.lo + gap } else { 0.0 };
    bounds(bottom.min(0.0), top.max(0.0))
}

fn signs(a: Range) -> Range {
    let lo = if a.lo < 0.0 {
        -1.0
    } else if a.lo > 0.0 || a.nonzero {
        1.0
    } else {
        0.0
    };
    let hi = if a.hi > 0.0 {
        1.0
    } else if a.hi < 0.0 || a.nonzero {
        -1.0
    } else {
        0.0
    };
    Range {
        nonzero: a.nonzero,
        ..bounds(lo, hi)
    }
}

fn mask(a: Range, b: Range) -> Range {
    match (a.lo >= 0.0, b.lo >= 0.0) {
        (true, true) => Range::new(0.0, a.hi.min(b.hi)),
        (true, false) => Range::new(0.0, a.hi),
        (false, true) => Range::new(0.0, b.hi),
        (false, false) => Range::ALL,
    }
}

/// Bits that one of two ints has, or just one: none above the greatest bit of both.
fn joined(op: Op, a: Range, b: Range) -> Range {
    let most = [a.hi, b.hi, -1.0 - a.lo, -1.0 - b.lo];
    let most = most.into_iter().fold(0.0, f64::max);
    let end = (0..31)
        .map(|bits| f64::from(bits).exp2())
        .find(|end| most < *end);
    let end = end.unwrap_or(31f64.exp2());
    let least = match (a.lo >= 0.0 && b.lo >= 0.0, op) {
        (true, Op::BitOr) => a.lo.max(b.lo),
        (true, _) => 0.0,
        (false, _) => -end,
    };
    ints(least, end - 1.0)
}

fn truth(op: Op, a: Range, b: Range) -> Range {
    let always = match op {
        Op::Less | Op::IntLess => a.hi < b.lo,
        Op::LessEqual | Op::IntLessEqual => a.hi <= b.lo,
        Op::Equal | Op::IntEqual => a.constant().is_some() && a.constant() == b.constant(),
        _ => a.hi == 0.0,
    };
    let never = match op {
        Op::Less | Op::IntLess => a.lo >= b.hi,
        Op::LessEqual | Op::IntLessEqual => a.lo > b.hi,
        Op::Equal | Op::IntEqual => a.hi < b.lo || b.hi < a.lo,
        _ => a.lo >= 1.0,
    };
    match (always, never) {
        (true, _) => Range::point(1.0),
        (_, true) => Range::point(0.0),
        _ => Range::new(0.0, 1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_int_that_is_cut_below_1_is_not_0() {
        let cut = Range::point(0.499);
        assert_eq!(interval(Op::ToReal, [cut, cut], false), cut);
    }

    #[test]
    fn intervals_hold_what_operations_give() {
        let ranges = [
            (-3.0, 2.0),
            (0.0, 4.0),
            (1.0, 1.0),
            (-5.0, -0.5),
            (-2.0, 0.0),
            (3.0, 17.0),
        ];
        for &op in Op::EVERY {
            for &(alo, ahi) in &ranges {
                for &(blo, bhi) in &ranges {
                    let made = interval(op, [Range::new(alo, ahi), Range::new(blo, bhi)], false);
                    for k in 0..=20 {
                        for j in 0..=20 {
                            let a = alo + (ahi - alo) * f64::from(k) / 20.0;
                            let b = blo + (bhi - blo) * f64::from(j) / 20.0;
                            let (a, b) = match op.args()[0] {
                                slowlight_routine::Type::Real => (Value::Real(a), Value::Real(b)),
                                slowlight_routine::Type::Int => {
                                    (Value::Int(a.ceil() as i32), Value::Int(b.ceil() as i32))
                                }
                                slowlight_routine::Type::Bool => {
                                    (Value::Bool(k > 9), Value::Bool(j > 9))
                                }
                            };
                            let inside = |v: Value, lo, hi| (lo..=hi).contains(&v.real());
                            let not = op == Op::Not && (alo, ahi) != (0.0, 4.0);
                            if not
                                || (op != Op::Not && !(inside(a, alo, ahi) && inside(b, blo, bhi)))
                            {
                                continue;
                            }
                            let x = op.eval(&[a, b]).real();
                            let slack = 1e-12 * x.abs();
                            assert!(
                                made.lo - slack <= x && x <= made.hi + slack,
                                "{op:?}({a:?}, {b:?}) = {x} outside {made:?}"
                            );
                        }
                    }
                }
            }
        }
    }
}
