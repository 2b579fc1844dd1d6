//! The list of routines for logarithmic reals: cheap and restricted before dear and total.

use super::templates as t;
use crate::model::{bits, int};
use crate::routines::INTS;
use slowlight_routine::log::LOG as R;
use slowlight_routine::log::domains::*;
use slowlight_routine::log::model::{LEAST, Log};
use slowlight_routine::{Error, Form, Format, Op, Range, Routine, everywhere, joined};

use crate::INT as I;
const B: Format = Format::Bool;
const EXACT: Error = Error::Exact;

/// A value of a format from bits, and to bits.
macro_rules! from {
    (R $bits:expr) => {
        Log::from_bits($bits)
    };
    (I $bits:expr) => {
        int($bits)
    };
}
macro_rules! to {
    (R $value:expr) => {
        Log::bits($value)
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

/// Two arguments of known signs, and a sum that fits.
macro_rules! signs {
    ($a:ident $b:ident) => {
        |args: &[Range], result: Range| signs(args, result, [Sign::$a, Sign::$b])
    };
}

// Names are those of Jack's routines where what may be smaller than the least magnitude hangs
// on them ([`slowlight_routine::log::loose`]).
#[rustfmt::skip]
const REALS: &[Routine] = &[
    routine!("mul" Mul(R, R) -> R, t::MULTIPLY, [], inner_product, PRODUCT, |a, b| a.mul(b), 29, 19),
    routine!("low_mul" Mul(R, R) -> R, t::LOW_MULTIPLY, [], fits, PRODUCT, |a, b| a.mul(b), 34, 33),
    routine!("loose_mul" Mul(R, R) -> R, t::MULTIPLY, [], never, PRODUCT, |a, b| a.loose_mul(b), 29, 19),
    routine!("any_mul" Mul(R, R) -> R, t::ANY_MULTIPLY, [], everywhere, PRODUCT, |a, b| a.mul(b), 37, 45),
    routine!("div" Div(R, R) -> R, t::DIVIDE, [], inner_quotient, PRODUCT, |a, b| a.div(b), 29, 19),
    routine!("low_div" Div(R, R) -> R, t::LOW_DIVIDE, [], low_quotient, PRODUCT, |a, b| a.div(b), 34, 33),
    routine!("loose_div" Div(R, R) -> R, t::DIVIDE, [], never, PRODUCT, |a, b| a.loose_div(b), 29, 19),
    routine!("high_div" Div(R, R) -> R, t::HIGH_DIVIDE, [], high_quotient, PRODUCT, |a, b| a.div(b), 34, 33),
    routine!("any_div" Div(R, R) -> R, t::ANY_DIVIDE, [], everywhere, PRODUCT, |a, b| a.div(b), 36, 45),
    routine!("sum" Add(R, R) -> R, t::SUM, ["log_sum"], signs!(Plus Plus), SUMS, |a, b| a.add(b), 84, 51),
    routine!("any_sum" Add(R, R) -> R, t::ANY_SUM, ["log_sum"], plus, SUMS, |a, b| a.add(b), 90, 65),
    routine!("minus_sum" Add(R, R) -> R, t::MINUS_SUM, ["log_sum"], signs!(Minus Minus), SUMS, |a, b| a.add(b), 84, 51),
    routine!("difference_sum" Sub(R, R) -> R, t::SUM, ["log_sum"], signs!(Plus Minus), SUMS, |a, b| a.sub(b), 83, 51),
    routine!("minus_difference_sum" Sub(R, R) -> R, t::MINUS_SUM, ["log_sum"], signs!(Minus Plus), SUMS, |a, b| a.sub(b), 84, 51),
    routine!("sum_less" Add(R, R) -> R, t::SUM_LESS, ["log_difference"], signs!(Plus Minus), DIFFERENCES, |a, b| a.add(b), 91, 71),
    routine!("less_sum" Add(R, R) -> R, t::SUM_LESS, ["log_difference"], signs!(Minus Plus), DIFFERENCES, |a, b| a.add(b), 91, 71),
    routine!("difference" Sub(R, R) -> R, t::DIFFERENCE, ["log_difference"], signs!(Plus Plus), DIFFERENCES, |a, b| a.sub(b), 92, 73),
    routine!("minus_difference" Sub(R, R) -> R, t::DIFFERENCE, ["log_difference"], signs!(Minus Minus), DIFFERENCES, |a, b| a.sub(b), 92, 73),
    routine!("add" Add(R, R) -> R, t::ADD, ["log_sum", "log_difference"], fits, DIFFERENCES, |a, b| a.add(b), 98, 131),
    routine!("sub" Sub(R, R) -> R, t::SUBTRACT, ["log_sum", "log_difference"], fits, DIFFERENCES, |a, b| a.sub(b), 99, 133),
    routine!("any_add" Add(R, R) -> R, t::ANY_ADD, ["log_sum", "log_difference"], everywhere, DIFFERENCES, |a, b| a.add(b), 102, 145),
    routine!("any_sub" Sub(R, R) -> R, t::ANY_SUBTRACT, ["log_sum", "log_difference"], everywhere, DIFFERENCES, |a, b| a.sub(b), 102, 147),
    routine!("root" Sqrt(R) -> R, t::ROOT, [], plus, ROOT, |a| a.sqrt(), 23, 16),
    routine!("any_root" Sqrt(R) -> R, t::ANY_ROOT, [], everywhere, ROOT, |a| a.sqrt(), 26, 31),
    routine!("mod" Mod(R, R) -> R, "log_modulo", ["log_modulo"], everywhere, UNKNOWN, |a, b| a.modulo(b), 816, 39),
    routine!("neg" Neg(R) -> R, t::NEGATE, [], everywhere, EXACT, |a| a.neg(), 20, 14),
    routine!("abs" Abs(R) -> R, t::ABS, [], everywhere, EXACT, |a| a.abs(), 17, 12),
    routine!("plus_min" Min(R, R) -> R, t::PLUS_MIN, [], plus, EXACT, |a, b| a.min(b), 34, 35),
    routine!("min" Min(R, R) -> R, t::MIN, [], everywhere, EXACT, |a, b| a.min(b), 41, 57),
    routine!("plus_max" Max(R, R) -> R, t::PLUS_MAX, [], plus, EXACT, |a, b| a.max(b), 34, 35),
    routine!("max_zero" Max(R, R) -> R, t::MAX_ZERO, [], against_zero, EXACT, |a, _b| a.max(Log::ZERO), 23, 25),
    routine!("zero_max" Max(R, R) -> R, t::ZERO_MAX, [], from_zero, EXACT, |_a, b| Log::ZERO.max(b), 23, 25),
    routine!("max" Max(R, R) -> R, t::MAX, [], everywhere, EXACT, |a, b| a.max(b), 41, 57),
    routine!("floor" Floor(R) -> I, "log_floor", ["log_floor"], everywhere, STEP, |a| a.wide_floor(), 226, 31),
    routine!("round" Round(R) -> I, "log_round", ["log_round"], everywhere, STEP, |a| a.wide_round(), 366, 31),
    routine!("sign" Sign(R) -> I, t::SIGN, [], everywhere, EXACT, |a| a.sign(), 24, 18),
    routine!("from_int" ToReal(I) -> R, "log_from_int", ["log_from_int"], everywhere, WHOLE, |a| Log::from_wide_int(a), 223, 31),
    routine!("negative" Less(R, R) -> B, t::NEGATIVE, [], against_zero, EXACT, |a, _b| !a.plus, 12, 8),
    routine!("positive" Less(R, R) -> B, t::POSITIVE, [], from_zero, EXACT, |_a, b| b.plus && b.log > LEAST, 21, 22),
    routine!("plus_less" Less(R, R) -> B, t::PLUS_LESS, [], plus, EXACT, |a, b| a.less(b), 21, 14),
    routine!("less_plus" Less(R, R) -> B, t::LESS_PLUS, [], second_plus, EXACT, |a, b| a.less(b), 22, 22),
    routine!("plus_less_any" Less(R, R) -> B, t::PLUS_LESS_ANY, [], first_plus, EXACT, |a, b| a.less(b), 22, 22),
    routine!("less" Less(R, R) -> B, t::LESS, [], everywhere, EXACT, |a, b| a.less(b), 26, 35),
    routine!("not_positive" LessEqual(R, R) -> B, t::NOT_POSITIVE, [], against_zero, EXACT, |a, _b| !(a.plus && a.log > LEAST), 22, 24),
    routine!("not_negative" LessEqual(R, R) -> B, t::NOT_NEGATIVE, [], from_zero, EXACT, |_a, b| b.plus, 14, 10),
    routine!("plus_less_equal" LessEqual(R, R) -> B, t::PLUS_LESS_EQUAL, [], plus, EXACT, |a, b| !b.less(a), 23, 16),
    routine!("less_equal" LessEqual(R, R) -> B, t::LESS_EQUAL, [], everywhere, EXACT, |a, b| !b.less(a), 27, 39),
    routine!("is_zero" Equal(R, R) -> B, t::IS_ZERO, [], against_zero, EXACT, |a, _b| a.log <= LEAST, 21, 16),
    routine!("equal" Equal(R, R) -> B, t::EQUAL, [], everywhere, EXACT, |a, b| a == b, 18, 24),
];

#[rustfmt::skip]
const FUNCTIONS: &[Routine] = &[
    routine!("near_sin" Sin(R) -> R, "log_sine", ["log_sine"], near_angle, NEAR_SINE, |a| a.sin(), 961, 27),
    routine!("sin" Sin(R) -> R, "log_sine", ["log_sine"], angle, SINE, |a| a.sin(), 1094, 27),
    routine!("any_sin" Sin(R) -> R, "log_sine", ["log_sine"], everywhere, ANY_SINE, |a| a.sin(), 1094, 27),
    routine!("near_cos" Cos(R) -> R, "log_cosine", ["log_sine"], near_angle, NEAR_SINE, |a| a.cos(), 1012, 27),
    routine!("cos" Cos(R) -> R, "log_cosine", ["log_sine"], angle, SINE, |a| a.cos(), 1129, 27),
    routine!("any_cos" Cos(R) -> R, "log_cosine", ["log_sine"], everywhere, ANY_SINE, |a| a.cos(), 1129, 27),
    routine!("tan" Tan(R) -> R, "log_tangent", ["log_tangent"], near_tangent, TANGENT, |a| a.tan(), 2096, 27),
    routine!("any_tan" Tan(R) -> R, "log_tangent", ["log_tangent"], everywhere, UNKNOWN, |a| a.tan(), 2343, 27),
    routine!("asin" Asin(R) -> R, "log_arcsine", ["log_arc"], everywhere, ARC, |a| a.asin(), 527, 27),
    routine!("acos" Acos(R) -> R, "log_arccosine", ["log_arc"], everywhere, ARC, |a| a.acos(), 678, 27),
    routine!("atan2" Atan2(R, R) -> R, "log_arctangent2", ["log_arc"], everywhere, ARC, |a, b| a.atan2(b), 910, 39),
    routine!("near_exp" Exp(R) -> R, "log_exponential", ["log_exponential"], near_angle, NEAR_EXP, |a| a.exp(), 421, 27),
    routine!("exp" Exp(R) -> R, "log_exponential", ["log_exponential"], everywhere, EXP, |a| a.exp(), 551, 27),
    routine!("log" Log(R) -> R, "log_natural", ["log_natural"], above_zero, LOGARITHM, |a| a.log(), 339, 27),
    routine!("any_log" Log(R) -> R, "log_natural", ["log_natural"], everywhere, UNKNOWN, |a| a.log(), 209, 27),
    routine!("pow" Pow(R, R) -> R, "log_power", ["log_power"], above_zero, POWER, |a, b| a.pow(b), 1196, 39),
    routine!("any_pow" Pow(R, R) -> R, "log_power", ["log_power"], everywhere, UNKNOWN, |a, b| a.pow(b), 829, 39),
];

/// The routines of logarithms, and those of ints.
pub(super) static ALL: [Routine; OF_REALS.len() + INTS.len()] = joined(OF_REALS, INTS);

pub(super) const OF_REALS: &[Routine] =
    &joined::<{ REALS.len() + FUNCTIONS.len() }>(REALS, FUNCTIONS);
