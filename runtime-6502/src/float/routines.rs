//! The list of routines for floating-point reals: cheap and restricted before dear and total.

use super::model::Real;
use super::templates as t;
use crate::INT as I;
use crate::model::{bits, int};
use crate::routines::INTS;
use slowlight_routine::{Error, Form, Format, Op, Range, Routine, everywhere, joined};

const R: Format = Format::Real40;
const B: Format = Format::Bool;
const EXACT: Error = Error::Exact;
/// Half a last place, and what products and sums leave out of what is below it.
const NEAREST: Error = Error::Relative(2.5e-10);
/// What a polynomial cuts off in its steps.
const NEAR: Error = Error::Absolute(3.7e-9);
/// A turn's length is known to 2^-33 of itself, as angles are.
const FAR: Error = Error::Absolute(6.0e-7);
/// Of an angle that is known to less than a turn.
const LOST: Error = Error::Absolute(2.0);
const TANGENT: Error = Error::Mixed {
    relative: 6.0e-8,
    absolute: 4.0e-9,
};
const POLE: Error = Error::Absolute(1e39);
/// An error of the exponent, which is known as far as its whole part leaves room.
const EXP: Error = Error::Growing {
    relative: 3e-9,
    each: 3e-10,
    most: 90.0,
};
const LOGARITHM: Error = Error::Mixed {
    relative: 2e-9,
    absolute: 0.0,
};
const POWER: Error = Error::Relative(1.2e-7);

/// Where an angle's place in its turn is known to the last places.
fn near(args: &[Range], _: Range) -> bool {
    args.first().is_some_and(|a| a.within(-16.0, 16.0))
}

/// Where it is known to some places at least.
fn far(args: &[Range], _: Range) -> bool {
    args.first().is_some_and(|a| a.within(-2048.0, 2048.0))
}

/// Where the tangent is at most 14.2.
fn far_from_poles(args: &[Range], _: Range) -> bool {
    args.first().is_some_and(|a| a.within(-1.5, 1.5))
}

fn above_zero(args: &[Range], _: Range) -> bool {
    args.first().is_some_and(|a| a.lo > 0.0)
}

fn plus(args: &[Range], _: Range) -> bool {
    args.iter().take(2).all(|a| a.lo >= 0.0)
}

fn constant(args: &[Range], k: usize) -> Option<f64> {
    args.get(k).and_then(|r| r.constant())
}

fn against_zero(args: &[Range], _: Range) -> bool {
    constant(args, 1) == Some(0.0)
}

fn from_zero(args: &[Range], _: Range) -> bool {
    constant(args, 0) == Some(0.0)
}

/// The second operand is a power of two in such a range of exponents.
fn by_power(args: &[Range], mut powers: std::ops::Range<i32>) -> bool {
    constant(args, 1).is_some_and(|by| powers.any(|k| by == f64::from(k).exp2()))
}

fn by_less(args: &[Range], _: Range) -> bool {
    by_power(args, -32..0)
}

/// The result is far from the format's end.
fn by_more(args: &[Range], result: Range) -> bool {
    by_power(args, 1..33) && result.within(-1e37, 1e37)
}

/// A value of a format from bits, and to bits.
macro_rules! from {
    (R $bits:expr) => {
        Real::from_bits($bits)
    };
    (I $bits:expr) => {
        int($bits)
    };
}
macro_rules! to {
    (R $value:expr) => {
        $value.bits()
    };
    (I $value:expr) => {
        bits($value)
    };
    (B $value:expr) => {
        u64::from($value)
    };
}

/// A routine: name, operation, formats, text, needs, domain, error, model, and its cost in
/// cycles and bytes.
macro_rules! routine {
    ($name:literal $op:ident($($arg:ident),+) -> $result:ident, $text:expr, [$($need:literal),*],
     $domain:expr, $error:expr, |$($x:ident),+| $body:expr, $cycles:literal, $bytes:literal) => {
        Routine {
            name: $name,
            op: Op::$op,
            args: &[$($arg),+],
            result: $result,
            form: Form::Statement($text),
            needs: &[$($need),*],
            cycles: $cycles,
            bytes: $bytes,
            domain: $domain,
            error: $error,
            model: |args| {
                let mut args = args.iter().copied();
                $(let $x = from!($arg args.next().unwrap_or(0));)+
                to!($result $body)
            },
        }
    };
}

#[rustfmt::skip]
pub(super) const REALS: &[Routine] = &[
    routine!("add" Add(R, R) -> R, "float_add", ["float_add"], everywhere, NEAREST, |a, b| a.add(b), 350, 63),
    routine!("sub" Sub(R, R) -> R, "float_subtract", ["float_add"], everywhere, NEAREST, |a, b| a.sub(b), 362, 63),
    routine!("neg" Neg(R) -> R, t::NEGATE, [], everywhere, EXACT, |a| a.neg(), 34, 24),
    routine!("abs" Abs(R) -> R, t::ABS, [], everywhere, EXACT, |a| a.abs(), 32, 22),
    routine!("plus_min" Min(R, R) -> R, t::PLUS_MIN, [], plus, EXACT, |a, b| a.min(b), 51, 68),
    routine!("min" Min(R, R) -> R, t::MIN, [], everywhere, EXACT, |a, b| a.min(b), 57, 110),
    routine!("max_zero" Max(R, R) -> R, t::MAX_ZERO, [], against_zero, EXACT, |a, _b| a.max(Real::ZERO), 29, 36),
    routine!("zero_max" Max(R, R) -> R, t::ZERO_MAX, [], from_zero, EXACT, |_a, b| b.max(Real::ZERO), 29, 36),
    routine!("plus_max" Max(R, R) -> R, t::PLUS_MAX, [], plus, EXACT, |a, b| a.max(b), 51, 68),
    routine!("max" Max(R, R) -> R, t::MAX, [], everywhere, EXACT, |a, b| a.max(b), 57, 110),
    routine!("lessen" Mul(R, R) -> R, t::LESSEN, [], by_less, EXACT, |a, b| a.mul(b), 48, 50),
    routine!("grow" Mul(R, R) -> R, t::GROW, [], by_more, EXACT, |a, b| a.mul(b), 41, 28),
    routine!("mul" Mul(R, R) -> R, "float_multiply", ["float_multiply"], everywhere, NEAREST, |a, b| a.mul(b), 912, 63),
    routine!("div" Div(R, R) -> R, "float_divide", ["float_divide"], everywhere, NEAREST, |a, b| a.div(b), 2113, 63),
    routine!("root" Sqrt(R) -> R, "float_root", ["float_root"], everywhere, NEAREST, |a| a.sqrt(), 2445, 43),
    routine!("mod" Mod(R, R) -> R, "float_modulo", ["float_modulo"], everywhere, NEAREST, |a, b| a.modulo(b), 472, 63),
    routine!("near_sin" Sin(R) -> R, "float_sine", ["float_sine"], near, NEAR, |a| a.sin(), 6639, 43),
    routine!("sin" Sin(R) -> R, "float_sine", ["float_sine"], far, FAR, |a| a.sin(), 6639, 43),
    routine!("any_sin" Sin(R) -> R, "float_sine", ["float_sine"], everywhere, LOST, |a| a.sin(), 6639, 43),
    routine!("near_cos" Cos(R) -> R, "float_cosine", ["float_sine"], near, NEAR, |a| a.cos(), 6660, 43),
    routine!("cos" Cos(R) -> R, "float_cosine", ["float_sine"], far, FAR, |a| a.cos(), 6660, 43),
    routine!("any_cos" Cos(R) -> R, "float_cosine", ["float_sine"], everywhere, LOST, |a| a.cos(), 6660, 43),
    routine!("tan" Tan(R) -> R, "float_tangent", ["float_tangent"], far_from_poles, TANGENT, |a| a.tan(), 15279, 43),
    routine!("any_tan" Tan(R) -> R, "float_tangent", ["float_tangent"], everywhere, POLE, |a| a.tan(), 15474, 43),
    routine!("asin" Asin(R) -> R, "float_arcsine", ["float_arccosine"], everywhere, NEAR, |a| a.asin(), 16082, 43),
    routine!("acos" Acos(R) -> R, "float_arccosine", ["float_arccosine"], everywhere, NEAR, |a| a.acos(), 16358, 43),
    routine!("atan2" Atan2(R, R) -> R, "float_arctangent2", ["float_arctangent"], everywhere, NEAR, |a, b| a.atan2(b), 12101, 63),
    routine!("exp" Exp(R) -> R, "float_exponential", ["float_exponential"], everywhere, EXP, |a| a.exp(), 6222, 43),
    routine!("log" Log(R) -> R, "float_logarithm", ["float_logarithm"], above_zero, LOGARITHM, |a| a.log(), 9067, 43),
    routine!("any_log" Log(R) -> R, "float_logarithm", ["float_logarithm"], everywhere, LOGARITHM, |a| a.log(), 9067, 43),
    routine!("pow" Pow(R, R) -> R, "float_power", ["float_power"], everywhere, POWER, |a, b| a.pow(b), 16264, 63),
    routine!("floor" Floor(R) -> I, "float_floor", ["float_floor"], everywhere, EXACT, |a| a.floor(), 256, 39),
    routine!("round" Round(R) -> I, "float_to_nearest", ["float_floor"], everywhere, EXACT, |a| a.round(), 258, 39),
    routine!("sign" Sign(R) -> I, t::SIGN, [], everywhere, EXACT, |a| a.sign(), 29, 24),
    routine!("to_real" ToReal(I) -> R, "float_from_int", ["float_convert"], everywhere, EXACT, |a| Real::from_int(a), 203, 39),
    routine!("negative" Less(R, R) -> B, t::NEGATIVE, [], against_zero, EXACT, |a, _b| a.negative, 12, 8),
    routine!("positive" Less(R, R) -> B, t::POSITIVE, [], from_zero, EXACT, |_a, b| b.sign() > 0, 19, 14),
    routine!("plus_less" Less(R, R) -> B, t::PLUS_LESS, [], plus, EXACT, |a, b| a.less(b), 24, 28),
    routine!("less" Less(R, R) -> B, t::LESS, [], everywhere, EXACT, |a, b| a.less(b), 30, 70),
    routine!("not_positive" LessEqual(R, R) -> B, t::NOT_POSITIVE, [], against_zero, EXACT, |a, _b| a.sign() <= 0, 18, 14),
    routine!("not_negative" LessEqual(R, R) -> B, t::NOT_NEGATIVE, [], from_zero, EXACT, |_a, b| !b.negative, 14, 10),
    routine!("plus_less_equal" LessEqual(R, R) -> B, t::PLUS_LESS_EQUAL, [], plus, EXACT, |a, b| !b.less(a), 32, 34),
    routine!("less_equal" LessEqual(R, R) -> B, t::LESS_EQUAL, [], everywhere, EXACT, |a, b| !b.less(a), 38, 76),
    routine!("is_zero" Equal(R, R) -> B, t::IS_ZERO, [], against_zero, EXACT, |a, _b| a.is_zero(), 12, 9),
    routine!("equal" Equal(R, R) -> B, t::EQUAL, [], everywhere, EXACT, |a, b| a == b, 21, 36),
];

/// The routines of floats, and those of ints.
pub(super) static ALL: [Routine; REALS.len() + INTS.len()] = joined(REALS, INTS);
