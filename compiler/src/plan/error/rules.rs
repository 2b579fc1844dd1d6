//! Error propagation: what an operation does to the errors of its arguments.
//!
//! Every rule is an identity or a mean value, not a linearisation: with x the
//! exact argument and x + e the machine's, f(x + e) - f(x) is e times something
//! that is known to lie between bounds. So what is first order here is proved,
//! without a remainder.

use super::Value;
use super::form::Form;
use crate::ir::interval::{interval, product};
use slowlight_routine::{Format, Op, Range};
use std::f64::consts::{FRAC_PI_2, PI};

/// `op` of the machine's arguments less `op` of the exact ones, both exact.
/// `result` holds the exact results. Where a branch is taken (a comparison, a
/// step of `floor`), the machine is taken to go the same way.
pub fn inherited(op: Op, x: &Value, y: &Value, same: bool, result: Range) -> Form {
    match op {
        Op::Add => x.error.plus(&y.error),
        Op::Sub => x.error.minus(&y.error),
        Op::Neg => x.error.scaled(Range::point(-1.0)),
        Op::ToReal => x.error.clone(),
        // (x + e)^2 - x^2 = e (2x + e)
        Op::Mul if same => x.error.scaled(sum(x.range, x.machine())),
        // (x + e)(y + f) - x y = x f + e (y + f)
        Op::Mul => {
            let part = y.error.scaled(x.range);
            part.plus(&x.error.scaled(y.machine()))
        }
        Op::Div => quotient(x, y, result),
        Op::Abs => chosen(
            x.range.hi <= 0.0,
            x.range.lo >= 0.0,
            &x.error.scaled(Range::point(-1.0)),
            &x.error,
        ),
        // Between what the one and what the other is off.
        Op::Min => chosen(
            x.range.hi <= y.range.lo && x.machine().hi <= y.machine().lo,
            y.range.hi <= x.range.lo && y.machine().hi <= x.machine().lo,
            &x.error,
            &y.error,
        ),
        Op::Max => chosen(
            x.range.lo >= y.range.hi && x.machine().lo >= y.machine().hi,
            y.range.lo >= x.range.hi && y.machine().lo >= x.machine().hi,
            &x.error,
            &y.error,
        ),
        Op::Sqrt | Op::IntRoot => root(x),
        // The derivative is -1/2 x^(-3/2).
        Op::ReciprocalRoot if x.hull().lo > 0.0 => {
            x.error.scaled(over(x, |v| -0.5 / (v * v.sqrt())))
        }
        Op::ReciprocalRoot => Form::unbounded(),
        // Within one step of the floor of x/y: x - n y.
        Op::Mod => match y.error.is_exact() {
            true => x.error.clone(),
            false => {
                let n = interval(Op::Div, [x.range, y.range], false);
                let steps = Range::new(n.lo.floor(), n.hi.floor());
                x.error.minus(&y.error.scaled(steps))
            }
        },
        Op::Sin => x.error.scaled(slope(x, |v| v.cos(), 1.0)),
        Op::Cos => x.error.scaled(slope(x, |v| -v.sin(), 1.0)),
        Op::Exp => x.error.scaled(over(x, f64::exp)),
        Op::Log if x.hull().lo > 0.0 => x.error.scaled(over(x, f64::recip)),
        Op::Tan => tangent(x),
        Op::Asin => arc(x, 1.0),
        Op::Acos => arc(x, -1.0),
        Op::Atan2 => angle(x, y),
        Op::Pow => power(x, y),
        Op::Log => Form::unbounded(),
        // Ints and truth values are what they should be, or a branch flips.
        _ => Form::EXACT,
    }
}

/// Whether an int may be beyond the machine's, where it is not beyond the native ones: it is
/// not what it should be then.
pub(super) fn leaves_ints(format: Format, exact: Range) -> bool {
    let most = format.most();
    matches!(format, Format::Int { bits: ..32 }) && !exact.within(-most, most - 1.0)
}

fn sum(a: Range, b: Range) -> Range {
    Range::new(a.lo + b.lo, a.hi + b.hi)
}

/// The one, the other, or what lies between.
fn chosen(one: bool, other: bool, a: &Form, b: &Form) -> Form {
    match (one, other) {
        (true, _) => a.clone(),
        (_, true) => b.clone(),
        _ => a.hull(b),
    }
}

/// (x + e)/(y + f) - x/y = (e - f x/y)/(y + f)
fn quotient(x: &Value, y: &Value, result: Range) -> Form {
    let divisor = y.machine();
    if divisor.contains(0.0) || y.range.contains(0.0) {
        return Form::unbounded();
    }
    let inverse = Range::new(1.0 / divisor.hi, 1.0 / divisor.lo);
    x.error.minus(&y.error.scaled(result)).scaled(inverse)
}

/// sqrt(x + e) - sqrt(x) = e/(sqrt(x + e) + sqrt(x)), and at most sqrt(e).
fn root(x: &Value) -> Form {
    let machine = x.machine();
    let least = machine.lo.max(0.0).sqrt() + x.range.lo.max(0.0).sqrt();
    let most = machine.hi.max(0.0).sqrt() + x.range.hi.max(0.0).sqrt();
    let coarse = Form::within(x.error.bound().sqrt());
    if least <= 0.0 || most <= 0.0 {
        return coarse;
    }
    let fine = x.error.scaled(Range::new(1.0 / most, 1.0 / least));
    if fine.bound() <= coarse.bound() {
        fine
    } else {
        coarse
    }
}

/// The range of a monotone derivative.
fn over(x: &Value, derivative: fn(f64) -> f64) -> Range {
    let hull = x.hull();
    let (a, b) = (derivative(hull.lo), derivative(hull.hi));
    Range::new(a.min(b), a.max(b))
}

/// The range of a derivative that itself changes by at most `bend` a unit.
fn slope(x: &Value, derivative: fn(f64) -> f64, bend: f64) -> Range {
    let hull = x.hull();
    let half = (hull.hi - hull.lo) / 2.0;
    let middle = derivative(hull.lo + half);
    let wide = Range::new(middle - bend * half, middle + bend * half);
    wide.meet(Range::new(-1.0, 1.0))
}

/// The derivative is 1 + tan^2, between two poles.
fn tangent(x: &Value) -> Form {
    let hull = x.hull();
    let branch = |v: f64| ((v + FRAC_PI_2) / PI).floor();
    if branch(hull.lo) != branch(hull.hi) {
        return Form::unbounded();
    }
    let at = |v: f64| 1.0 + v.tan() * v.tan();
    let most = at(hull.lo).max(at(hull.hi));
    x.error.scaled(Range::new(1.0, most))
}

/// Arc sine or cosine: slope 1/sqrt(1 - x^2), and at most (pi/2) sqrt(2 e) where that has no end.
fn arc(x: &Value, sign: f64) -> Form {
    let most = x.hull().magnitude();
    let coarse = Form::within(FRAC_PI_2 * (2.0 * x.error.bound()).sqrt());
    if most >= 1.0 {
        return coarse;
    }
    let steep = 1.0 / (1.0 - most * most).sqrt();
    let fine = x
        .error
        .scaled(Range::new(sign.min(sign * steep), sign.max(sign * steep)));
    if fine.bound() <= coarse.bound() {
        fine
    } else {
        coarse
    }
}

/// The angle of (y, x), x the second argument: d = (x dy - y dx)/(x^2 + y^2),
/// unless the half-line where it jumps may be met.
fn angle(y: &Value, x: &Value) -> Form {
    let (v, h) = (y.hull(), x.hull());
    let least = |r: Range| {
        if r.contains(0.0) {
            0.0
        } else {
            r.lo.abs().min(r.hi.abs())
        }
    };
    let near = least(v).powi(2) + least(h).powi(2);
    if near == 0.0 || (v.contains(0.0) && h.lo < 0.0) {
        return Form::unbounded();
    }
    let far = v.magnitude().powi(2) + h.magnitude().powi(2);
    let over = Range::new(1.0 / far, 1.0 / near);
    let up = y.error.scaled(product(h, over));
    let across = x.error.scaled(product(v, over));
    up.minus(&across)
}

/// x^y: slopes y x^(y-1) and x^y ln x, for x above 0; whole constant powers by
/// the first alone, for every x.
fn power(x: &Value, y: &Value) -> Form {
    let hull = x.hull();
    if let Some(n) = y.range.constant().filter(|_| y.error.is_exact()) {
        let whole = n >= 1.0 && n.fract() == 0.0;
        if whole || hull.lo > 0.0 {
            let at = |v: f64| n * v.powf(n - 1.0);
            let (a, b) = (at(hull.lo), at(hull.hi));
            // An odd derivative is monotone; an even one may have its least value between.
            let floor = if hull.contains(0.0) { 0.0 } else { a.min(b) };
            return x.error.scaled(Range::new(floor.min(a).min(b), a.max(b)));
        }
    }
    if hull.lo <= 0.0 {
        return Form::unbounded();
    }
    let corners = |f: &dyn Fn(f64, f64) -> f64| {
        let e = y.hull();
        let all = [
            f(hull.lo, e.lo),
            f(hull.lo, e.hi),
            f(hull.hi, e.lo),
            f(hull.hi, e.hi),
        ];
        let most = all.iter().fold(0.0f64, |m, v| m.max(v.abs()));
        Range::new(-most, most)
    };
    let tall = corners(&|b, e| b.powf(e));
    let steep = product(corners(&|b, e| b.powf(e) / b), y.hull());
    let logs = Range::new(hull.lo.ln(), hull.hi.ln());
    let first = x.error.scaled(steep);
    first.plus(&y.error.scaled(product(tall, logs)))
}
