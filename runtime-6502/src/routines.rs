//! The list of routines: for each operation the cheap and restricted ones first.

use slowlight_routine::{Error, Form, Format, Op, Range, Routine, everywhere, joined};

use crate::model::{self, bits, int};
use crate::templates as t;
use crate::{FIXED as R, INT as I};

/// The greatest magnitude that a real may have by its range for the routines
/// that do not saturate: what is left to the end of the format covers the
/// rounding of everything that the value was computed from.
const REAL: f64 = 32000.0;
/// The same for ints, which are exact; the ends themselves may stand for what saturated.
const WHOLE: f64 = i32::MAX as f64 - 1.0;
/// Half of the last place of a real.
const HALF_PLACE: f64 = 1.0 / 131_072.0;

const B: Format = Format::Bool;
const EXACT: Error = Error::Exact;
const NEAREST: Error = Error::Absolute(HALF_PLACE);

/// A place: half of one for the rounding, and at most 0.24 for the rest, which
/// is 0.01 or less but for angles far from 0 (see `tests/functions.rs`).
const PLACE: Error = Error::Absolute(1.0 / 65_536.0);
/// The exponent is cut at 2^-32; so up to six places where e^x nears 32768.
const EXP: Error = Error::Mixed {
    relative: 3.8e-9,
    absolute: 1.0 / 65_536.0,
};
/// The logarithm's error, at most three times 2^-31, is multiplied by the exponent: here by 64,
const POWER: Error = Error::Mixed {
    relative: 1.2e-7,
    absolute: 1.0 / 65_536.0,
};
/// and here by 32768.
const ANY_POWER: Error = Error::Mixed {
    relative: 6.1e-5,
    absolute: 1.0 / 65_536.0,
};
/// Beside a pole the last place of the angle decides the sign.
const POLE: Error = Error::Absolute(65_536.0);

/// Where the tangent is at most 14.2.
fn far_from_poles(args: &[Range], _: Range) -> bool {
    args.first().is_some_and(|a| a.within(-1.5, 1.5))
}

/// Where errors grow 64-fold at most.
fn small_exponent(args: &[Range], _: Range) -> bool {
    args.get(1).is_some_and(|b| b.within(-64.0, 64.0))
}

fn fits_real(_: &[Range], result: Range) -> bool {
    result.within(-REAL, REAL)
}

fn fits_int(_: &[Range], result: Range) -> bool {
    result.within(-WHOLE, WHOLE)
}

fn bytes(args: &[Range], _: Range) -> bool {
    args.iter().take(2).all(|a| a.within(0.0, 255.0))
}

fn of_byte(args: &[Range], _: Range) -> bool {
    args.first().is_some_and(|a| a.within(0.0, 255.0))
}

/// Ints from 0 to these.
fn words(args: &[Range], most: [f64; 2]) -> bool {
    (args.iter().zip(most)).all(|(of, most)| of.within(0.0, most))
}

/// An int of two bytes from 0 on, and one of a byte above 0.
fn word_by_byte(args: &[Range], _: Range) -> bool {
    words(args, [65535.0, 255.0]) && args.get(1).is_some_and(|by| by.lo >= 1.0)
}

/// An int that 16.16 holds.
fn from_short(args: &[Range], _: Range) -> bool {
    args.first().is_some_and(|a| a.within(-32768.0, 32767.0))
}

fn constant(args: &[Range], k: usize) -> Option<f64> {
    args.get(k).and_then(|r| r.constant())
}

/// The second operand is a power of two from 2 to 128.
fn by_small_power(args: &[Range], _: Range) -> bool {
    (1..8).any(|k| constant(args, 1) == Some(f64::from(1 << k)))
}

fn by_power(args: &[Range], _: Range) -> bool {
    constant(args, 1).is_some_and(|by| (-16..15).any(|k| by == f64::from(k).exp2()))
}

/// A domain: operand `$k` is the constant `$value`, and `$more` holds of the ranges.
macro_rules! with {
    ($k:literal = $value:literal) => {
        |args, _| constant(args, $k) == Some($value)
    };
    ($k:literal = $value:literal, $more:ident) => {
        |args, result| constant(args, $k) == Some($value) && $more(args, result)
    };
}

/// A routine: name, operation, formats, text, needs, domain, error, model, and
/// its cost in cycles and bytes.
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
                let mut args = args.iter().map(|a| int(*a));
                $(let $x = args.next().unwrap_or(0);)+
                bits($body)
            },
        }
    };
}

#[rustfmt::skip]
const REALS: &[Routine] = &[
    routine!("add" Add(R, R) -> R, t::ADD, [], fits_real, EXACT, |a, b| a.wrapping_add(b), 38, 25),
    routine!("saturating_add" Add(R, R) -> R, t::SATURATING_ADD, [], everywhere, EXACT, |a, b| a.saturating_add(b), 41, 44),
    routine!("sub" Sub(R, R) -> R, t::SUBTRACT, [], fits_real, EXACT, |a, b| a.wrapping_sub(b), 38, 25),
    routine!("saturating_sub" Sub(R, R) -> R, t::SATURATING_SUBTRACT, [], everywhere, EXACT, |a, b| a.saturating_sub(b), 41, 44),
    routine!("neg" Neg(R) -> R, t::NEGATE, [], fits_real, EXACT, |a| a.wrapping_neg(), 34, 25),
    routine!("saturating_neg" Neg(R) -> R, t::SATURATING_NEGATE, [], everywhere, EXACT, |a| a.saturating_neg(), 37, 44),
    routine!("abs" Abs(R) -> R, t::ABS, [], fits_real, EXACT, |a| a.wrapping_abs(), 36, 46),
    routine!("saturating_abs" Abs(R) -> R, t::SATURATING_ABS, [], everywhere, EXACT, |a| a.saturating_abs(), 36, 65),
    routine!("min" Min(R, R) -> R, t::MIN, [], everywhere, EXACT, |a, b| a.min(b), 55, 55),
    routine!("max" Max(R, R) -> R, t::MAX, [], everywhere, EXACT, |a, b| a.max(b), 55, 55),
    routine!("twice" Mul(R, R) -> R, t::TWICE, [], with!(1 = 2.0, fits_real), EXACT, |a, _b| a.wrapping_mul(2), 32, 20),
    routine!("four_times" Mul(R, R) -> R, t::FOUR_TIMES, [], with!(1 = 4.0, fits_real), EXACT, |a, _b| a.wrapping_mul(4), 52, 28),
    routine!("half" Mul(R, R) -> R, t::HALF, [], with!(1 = 0.5), NEAREST, |a, _b| model::shift_round(a, 1), 41, 38),
    routine!("quarter" Mul(R, R) -> R, t::QUARTER, [], with!(1 = 0.25), NEAREST, |a, _b| model::shift_round(a, 2), 66, 50),
    routine!("mul" Mul(R, R) -> R, "fixed_multiply", ["fixed_multiply"], everywhere, NEAREST, |a, b| model::fixed_multiply(a, b), 750, 51),
    routine!("div_2" Div(R, R) -> R, t::HALF, [], with!(1 = 2.0), NEAREST, |a, _b| model::shift_round(a, 1), 41, 38),
    routine!("div_4" Div(R, R) -> R, t::QUARTER, [], with!(1 = 4.0), NEAREST, |a, _b| model::shift_round(a, 2), 66, 50),
    routine!("div" Div(R, R) -> R, "fixed_divide", ["fixed_divide"], everywhere, NEAREST, |a, b| model::fixed_divide(a, b), 1736, 51),
    routine!("sqrt" Sqrt(R) -> R, "root", ["root"], everywhere, NEAREST, |a| model::root(a), 2228, 35),
    routine!("mod_power" Mod(R, R) -> R, t::REAL_MOD_POWER, [], by_power, EXACT, |a, b| a & b.wrapping_sub(1), 46, 33),
    routine!("mod" Mod(R, R) -> R, "modulo", ["modulo"], everywhere, EXACT, |a, b| model::modulo(a, b), 446, 51),
    routine!("sin" Sin(R) -> R, "sine", ["sine"], everywhere, PLACE, |a| model::sine(a), 1006, 35),
    routine!("cos" Cos(R) -> R, "cosine", ["sine"], everywhere, PLACE, |a| model::cosine(a), 1006, 35),
    routine!("tan" Tan(R) -> R, "tangent", ["tangent"], far_from_poles, PLACE, |a| model::tangent(a), 14937, 35),
    routine!("tan_anywhere" Tan(R) -> R, "tangent", ["tangent"], everywhere, POLE, |a| model::tangent(a), 17203, 35),
    routine!("asin" Asin(R) -> R, "arcsine", ["arccosine"], everywhere, PLACE, |a| model::arcsine(a), 11193, 35),
    routine!("acos" Acos(R) -> R, "arccosine", ["arccosine"], everywhere, PLACE, |a| model::arccosine(a), 11150, 35),
    routine!("atan2" Atan2(R, R) -> R, "arctangent2", ["arctangent"], everywhere, PLACE, |a, b| model::arctangent2(a, b), 12572, 51),
    routine!("exp" Exp(R) -> R, "exponential", ["exponential"], everywhere, EXP, |a| model::exponential(a), 9004, 35),
    routine!("log" Log(R) -> R, "logarithm", ["logarithm"], everywhere, PLACE, |a| model::logarithm(a), 12735, 35),
    routine!("pow" Pow(R, R) -> R, "power", ["power"], small_exponent, POWER, |a, b| model::power(a, b), 19862, 51),
    routine!("any_pow" Pow(R, R) -> R, "power", ["power"], everywhere, ANY_POWER, |a, b| model::power(a, b), 19862, 51),
    routine!("floor" Floor(R) -> I, t::FLOOR, [], everywhere, EXACT, |a| a >> 16, 23, 17),
    routine!("round" Round(R) -> I, "fixed_round", ["convert"], everywhere, EXACT, |a| model::fixed_round(a), 104, 35),
    routine!("sign" Sign(R) -> I, t::SIGN, [], everywhere, EXACT, |a| a.signum(), 30, 28),
    routine!("to_real" ToReal(I) -> R, t::TO_REAL, [], from_short, EXACT, |a| a.wrapping_shl(16), 20, 14),
    routine!("saturating_to_real" ToReal(I) -> R, "fixed_from_int", ["convert"], everywhere, EXACT, |a| model::fixed_from_int(a), 96, 35),
    routine!("negative" Less(R, R) -> B, t::NEGATIVE, [], with!(1 = 0.0), EXACT, |a, _b| i32::from(a < 0), 12, 8),
    routine!("less" Less(R, R) -> B, t::LESS, [], everywhere, EXACT, |a, b| i32::from(a < b), 36, 26),
    routine!("not_negative" LessEqual(R, R) -> B, t::NOT_NEGATIVE, [], with!(0 = 0.0), EXACT, |_a, b| i32::from(b >= 0), 14, 10),
    routine!("less_equal" LessEqual(R, R) -> B, t::LESS_EQUAL, [], everywhere, EXACT, |a, b| i32::from(a <= b), 37, 26),
    routine!("equal" Equal(R, R) -> B, t::EQUAL, [], everywhere, EXACT, |a, b| i32::from(a == b), 18, 30),
];

#[rustfmt::skip]
pub(crate) const INTS: &[Routine] = &[
    routine!("int_add" IntAdd(I, I) -> I, t::ADD, [], fits_int, EXACT, |a, b| a.wrapping_add(b), 38, 25),
    routine!("int_saturating_add" IntAdd(I, I) -> I, t::SATURATING_ADD, [], everywhere, EXACT, |a, b| a.saturating_add(b), 41, 44),
    routine!("int_sub" IntSub(I, I) -> I, t::SUBTRACT, [], fits_int, EXACT, |a, b| a.wrapping_sub(b), 38, 25),
    routine!("int_saturating_sub" IntSub(I, I) -> I, t::SATURATING_SUBTRACT, [], everywhere, EXACT, |a, b| a.saturating_sub(b), 41, 44),
    routine!("int_neg" IntNeg(I) -> I, t::NEGATE, [], fits_int, EXACT, |a| a.wrapping_neg(), 34, 25),
    routine!("int_saturating_neg" IntNeg(I) -> I, t::SATURATING_NEGATE, [], everywhere, EXACT, |a| a.saturating_neg(), 37, 44),
    routine!("int_abs" IntAbs(I) -> I, t::ABS, [], fits_int, EXACT, |a| a.wrapping_abs(), 37, 46),
    routine!("int_saturating_abs" IntAbs(I) -> I, t::SATURATING_ABS, [], everywhere, EXACT, |a| a.saturating_abs(), 36, 65),
    routine!("int_min" IntMin(I, I) -> I, t::MIN, [], everywhere, EXACT, |a, b| a.min(b), 55, 55),
    routine!("int_max" IntMax(I, I) -> I, t::MAX, [], everywhere, EXACT, |a, b| a.max(b), 55, 55),
    routine!("int_sign" IntSign(I) -> I, t::SIGN, [], everywhere, EXACT, |a| a.signum(), 29, 28),
    routine!("int_twice" IntMul(I, I) -> I, t::TWICE, [], with!(1 = 2.0, fits_int), EXACT, |a, _b| a.wrapping_mul(2), 32, 20),
    routine!("int_four_times" IntMul(I, I) -> I, t::FOUR_TIMES, [], with!(1 = 4.0, fits_int), EXACT, |a, _b| a.wrapping_mul(4), 52, 28),
    routine!("byte_product" IntMul(I, I) -> I, t::BYTE_PRODUCT, ["squares"], bytes, EXACT, |a, b| a.wrapping_mul(b), 64, 39),
    routine!("word_by_byte" IntMul(I, I) -> I, t::WORD_BY_BYTE, ["squares"], |args, _| words(args, [65535.0, 255.0]), EXACT, |a, b| a.wrapping_mul(b), 105, 58),
    routine!("byte_by_word" IntMul(I, I) -> I, t::BYTE_BY_WORD, ["squares"], |args, _| words(args, [255.0, 65535.0]), EXACT, |a, b| a.wrapping_mul(b), 105, 58),
    routine!("int_mul" IntMul(I, I) -> I, "int_multiply", ["int_multiply"], everywhere, EXACT, |a, b| a.saturating_mul(b), 636, 51),
    routine!("byte_div_2" IntDiv(I, I) -> I, t::BYTE_HALF, [], with!(1 = 2.0, of_byte), EXACT, |a, _b| a >> 1, 23, 17),
    routine!("byte_div_4" IntDiv(I, I) -> I, t::BYTE_QUARTER, [], with!(1 = 4.0, of_byte), EXACT, |a, _b| a >> 2, 25, 18),
    routine!("byte_div_8" IntDiv(I, I) -> I, t::BYTE_EIGHTH, [], with!(1 = 8.0, of_byte), EXACT, |a, _b| a >> 3, 27, 19),
    routine!("byte_div_16" IntDiv(I, I) -> I, t::BYTE_SIXTEENTH, [], with!(1 = 16.0, of_byte), EXACT, |a, _b| a >> 4, 29, 20),
    routine!("byte_div_32" IntDiv(I, I) -> I, t::BYTE_BY_32, [], with!(1 = 32.0, of_byte), EXACT, |a, _b| a >> 5, 31, 21),
    routine!("byte_div_64" IntDiv(I, I) -> I, t::BYTE_BY_64, [], with!(1 = 64.0, of_byte), EXACT, |a, _b| a >> 6, 29, 21),
    routine!("byte_div_128" IntDiv(I, I) -> I, t::BYTE_BY_128, [], with!(1 = 128.0, of_byte), EXACT, |a, _b| a >> 7, 27, 20),
    routine!("int_div_2" IntDiv(I, I) -> I, t::INT_HALF, [], with!(1 = 2.0), EXACT, |a, _b| a >> 1, 34, 22),
    routine!("int_div_4" IntDiv(I, I) -> I, t::INT_QUARTER, [], with!(1 = 4.0), EXACT, |a, _b| a >> 2, 59, 34),
    routine!("int_div_8" IntDiv(I, I) -> I, t::INT_EIGHTH, [], with!(1 = 8.0), EXACT, |a, _b| a >> 3, 84, 46),
    routine!("int_div_16" IntDiv(I, I) -> I, t::INT_SIXTEENTH, [], with!(1 = 16.0), EXACT, |a, _b| a >> 4, 109, 58),
    routine!("int_div_32" IntDiv(I, I) -> I, t::INT_BY_32, [], with!(1 = 32.0), EXACT, |a, _b| a >> 5, 86, 46),
    routine!("int_div_64" IntDiv(I, I) -> I, t::INT_BY_64, [], with!(1 = 64.0), EXACT, |a, _b| a >> 6, 64, 37),
    routine!("int_div_128" IntDiv(I, I) -> I, t::INT_BY_128, [], with!(1 = 128.0), EXACT, |a, _b| a >> 7, 38, 26),
    routine!("int_div_256" IntDiv(I, I) -> I, t::INT_BY_256, [], with!(1 = 256.0), EXACT, |a, _b| a >> 8, 29, 21),
    routine!("word_div" IntDiv(I, I) -> I, "word_divide", ["word_divide"], word_by_byte, EXACT, |a, b| model::int_divide(a, b), 306, 51),
    routine!("int_div" IntDiv(I, I) -> I, "int_divide", ["int_divide"], everywhere, EXACT, |a, b| model::int_divide(a, b), 400, 51),
    routine!("int_mod_power" IntMod(I, I) -> I, t::MOD_POWER, [], by_small_power, EXACT, |a, b| a & (b.wrapping_sub(1) & 0xFF), 24, 17),
    routine!("word_mod" IntMod(I, I) -> I, "word_modulo", ["word_divide"], word_by_byte, EXACT, |a, b| model::modulo(a, b), 326, 51),
    routine!("int_mod" IntMod(I, I) -> I, "modulo", ["modulo"], everywhere, EXACT, |a, b| model::modulo(a, b), 444, 51),
    routine!("and" BitAnd(I, I) -> I, t::AND, [], everywhere, EXACT, |a, b| a & b, 36, 24),
    routine!("or" BitOr(I, I) -> I, t::OR, [], everywhere, EXACT, |a, b| a | b, 36, 24),
    routine!("xor" BitXor(I, I) -> I, t::XOR, [], everywhere, EXACT, |a, b| a ^ b, 36, 24),
    routine!("int_negative" IntLess(I, I) -> B, t::NEGATIVE, [], with!(1 = 0.0), EXACT, |a, _b| i32::from(a < 0), 12, 8),
    routine!("int_positive" IntLess(I, I) -> B, t::POSITIVE, [], with!(0 = 0.0), EXACT, |_a, b| i32::from(b > 0), 19, 27),
    routine!("int_less" IntLess(I, I) -> B, t::LESS, [], everywhere, EXACT, |a, b| i32::from(a < b), 36, 26),
    routine!("int_not_negative" IntLessEqual(I, I) -> B, t::NOT_NEGATIVE, [], with!(0 = 0.0), EXACT, |_a, b| i32::from(b >= 0), 14, 10),
    routine!("int_not_positive" IntLessEqual(I, I) -> B, t::NOT_POSITIVE, [], with!(1 = 0.0), EXACT, |a, _b| i32::from(a <= 0), 19, 27),
    routine!("int_less_equal" IntLessEqual(I, I) -> B, t::LESS_EQUAL, [], everywhere, EXACT, |a, b| i32::from(a <= b), 37, 26),
    routine!("int_equal" IntEqual(I, I) -> B, t::EQUAL, [], everywhere, EXACT, |a, b| i32::from(a == b), 18, 30),
    routine!("not" Not(B) -> B, t::NOT, [], everywhere, EXACT, |a| a & 1 ^ 1, 14, 10),
];

/// The routines of reals in 16.16, and those of ints.
pub(crate) static ALL: [Routine; REALS.len() + INTS.len()] = joined(REALS, INTS);
