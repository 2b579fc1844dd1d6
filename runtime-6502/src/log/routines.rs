//! The list of routines for logarithmic reals: cheap and restricted before dear and total.

use super::templates as t;
use crate::model::{bits, int};
use crate::routines::INTS;
use slowlight_routine::log::domains::*;
use slowlight_routine::log::model::Logarithm;
use slowlight_routine::{Error, Form, Format, Op, Range, Routine, everywhere, joined};

use crate::INT as I;

/// A real: all 16 bits of a logarithm count.
type L<const FRAC: u8> = Logarithm<FRAC, true>;
const EXACT: Error = Error::Exact;

/// A value of a format from bits, and to bits.
macro_rules! from {
    (R $bits:expr) => {
        L::<FRAC>::from_bits($bits)
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

/// What is written R.
macro_rules! format {
    (R) => {
        L::<FRAC>::FORMAT
    };
    (I) => {
        I
    };
    (B) => {
        Format::Bool
    };
}

/// Of ten bits, or of eleven.
const fn pick<const FRAC: u8>([ten, eleven]: [u32; 2]) -> u32 {
    if FRAC == 10 { ten } else { eleven }
}

/// A routine: name, operation, formats, text, needs, domain, error, model, and its cost in
/// cycles and bytes.
macro_rules! routine {
    ($name:literal $op:ident($($arg:ident),+) -> $result:ident, $text:expr, [$($need:literal),*],
     $domain:expr, $error:expr, |$($x:ident),+| $body:expr, $cycles:expr, $bytes:expr) => {
        Routine {
            name: $name,
            op: Op::$op,
            args: &[$(format!($arg)),+],
            result: format!($result),
            form: Form::Statement($text),
            needs: &[$($need),*],
            cycles: pick::<FRAC>($cycles),
            bytes: pick::<FRAC>($bytes),
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

/// An int of a byte.
fn byte(args: &[Range], _: Range) -> bool {
    args.first().is_some_and(|a| a.within(0.0, 255.0))
}

/// Two arguments of known signs, and a sum that fits.
macro_rules! signs {
    ($a:ident $b:ident) => {
        |args: &[Range], result: Range| L::<FRAC>::signs(args, result, [Sign::$a, Sign::$b])
    };
}

/// The routines of logarithms of so many bits behind the point.
struct Of<const FRAC: u8>;

#[rustfmt::skip]
impl<const FRAC: u8> Of<FRAC> {
    const REALS: &'static [Routine] = &[
        routine!("mul" Mul(R, R) -> R, t::MULTIPLY, [], L::<FRAC>::inner_product, L::<FRAC>::PRODUCT, |a, b| a.mul(b), [29, 29], [19, 19]),
        routine!("low_mul" Mul(R, R) -> R, t::LOW_MULTIPLY, [], L::<FRAC>::fits, L::<FRAC>::PRODUCT, |a, b| a.mul(b), [32, 32], [29, 29]),
        routine!("any_mul" Mul(R, R) -> R, t::ANY_MULTIPLY, [], everywhere, L::<FRAC>::PRODUCT, |a, b| a.mul(b), [32, 32], [39, 39]),
        routine!("div" Div(R, R) -> R, t::DIVIDE, [], L::<FRAC>::inner_quotient, L::<FRAC>::PRODUCT, |a, b| a.div(b), [29, 29], [19, 19]),
        routine!("low_div" Div(R, R) -> R, t::LOW_DIVIDE, [], L::<FRAC>::low_quotient, L::<FRAC>::PRODUCT, |a, b| a.div(b), [32, 32], [29, 29]),
        routine!("high_div" Div(R, R) -> R, t::HIGH_DIVIDE, [], L::<FRAC>::high_quotient, L::<FRAC>::PRODUCT, |a, b| a.div(b), [32, 32], [29, 29]),
        routine!("any_div" Div(R, R) -> R, t::ANY_DIVIDE, [], everywhere, L::<FRAC>::PRODUCT, |a, b| a.div(b), [32, 32], [39, 39]),
        routine!("sum" Add(R, R) -> R, t::SUM, ["log_sum"], signs!(Plus Plus), L::<FRAC>::SUMS, |a, b| a.add(b), [75, 73], [97, 97]),
        routine!("any_sum" Add(R, R) -> R, t::ANY_SUM, ["log_sum"], plus, L::<FRAC>::SUMS, |a, b| a.add(b), [78, 76], [107, 107]),
        routine!("minus_sum" Add(R, R) -> R, t::MINUS_SUM, ["log_sum"], signs!(Minus Minus), L::<FRAC>::SUMS, |a, b| a.add(b), [75, 72], [97, 97]),
        routine!("difference_sum" Sub(R, R) -> R, t::SUM, ["log_sum"], signs!(Plus Minus), L::<FRAC>::SUMS, |a, b| a.sub(b), [75, 72], [97, 97]),
        routine!("minus_difference_sum" Sub(R, R) -> R, t::MINUS_SUM, ["log_sum"], signs!(Minus Plus), L::<FRAC>::SUMS, |a, b| a.sub(b), [75, 73], [97, 97]),
        routine!("sum_less" Add(R, R) -> R, t::SUM_LESS, ["log_difference"], signs!(Plus Minus), L::<FRAC>::DIFFERENCES, |a, b| a.add(b), [78, 77], [122, 122]),
        routine!("less_sum" Add(R, R) -> R, t::SUM_LESS, ["log_difference"], signs!(Minus Plus), L::<FRAC>::DIFFERENCES, |a, b| a.add(b), [79, 77], [122, 122]),
        routine!("difference" Sub(R, R) -> R, t::DIFFERENCE, ["log_difference"], signs!(Plus Plus), L::<FRAC>::DIFFERENCES, |a, b| a.sub(b), [79, 79], [124, 124]),
        routine!("minus_difference" Sub(R, R) -> R, t::DIFFERENCE, ["log_difference"], signs!(Minus Minus), L::<FRAC>::DIFFERENCES, |a, b| a.sub(b), [79, 78], [124, 124]),
        routine!("add" Add(R, R) -> R, t::ADD, ["log_sum", "log_difference"], L::<FRAC>::fits, L::<FRAC>::DIFFERENCES, |a, b| a.add(b), [84, 83], [225, 225]),
        routine!("sub" Sub(R, R) -> R, t::SUBTRACT, ["log_sum", "log_difference"], L::<FRAC>::fits, L::<FRAC>::DIFFERENCES, |a, b| a.sub(b), [85, 84], [228, 228]),
        routine!("any_add" Add(R, R) -> R, t::ANY_ADD, ["log_sum", "log_difference"], everywhere, L::<FRAC>::DIFFERENCES, |a, b| a.add(b), [85, 84], [235, 235]),
        routine!("any_sub" Sub(R, R) -> R, t::ANY_SUBTRACT, ["log_sum", "log_difference"], everywhere, L::<FRAC>::DIFFERENCES, |a, b| a.sub(b), [87, 86], [238, 238]),
        routine!("root" Sqrt(R) -> R, t::ROOT, [], plus, L::<FRAC>::ROOT, |a| a.sqrt(), [23, 23], [16, 16]),
        routine!("any_root" Sqrt(R) -> R, t::ANY_ROOT, [], everywhere, L::<FRAC>::ROOT, |a| a.sqrt(), [26, 26], [31, 31]),
        routine!("mod" Mod(R, R) -> R, "log_modulo", ["log_modulo"], everywhere, L::<FRAC>::UNKNOWN, |a, b| a.modulo(b), [677, 675], [39, 39]),
        routine!("neg" Neg(R) -> R, t::NEGATE, [], everywhere, EXACT, |a| a.neg(), [20, 20], [14, 14]),
        routine!("abs" Abs(R) -> R, t::ABS, [], everywhere, EXACT, |a| a.abs(), [17, 17], [12, 12]),
        routine!("plus_min" Min(R, R) -> R, t::PLUS_MIN, [], plus, EXACT, |a, b| a.min(b), [37, 37], [39, 39]),
        routine!("min" Min(R, R) -> R, t::MIN, [], everywhere, EXACT, |a, b| a.min(b), [42, 42], [65, 65]),
        routine!("plus_max" Max(R, R) -> R, t::PLUS_MAX, [], plus, EXACT, |a, b| a.max(b), [37, 37], [39, 39]),
        routine!("max_zero" Max(R, R) -> R, t::MAX_ZERO, [], against_zero, EXACT, |a, _b| a.max(L::<FRAC>::ZERO), [23, 23], [25, 25]),
        routine!("zero_max" Max(R, R) -> R, t::ZERO_MAX, [], from_zero, EXACT, |_a, b| L::<FRAC>::ZERO.max(b), [23, 23], [25, 25]),
        routine!("max" Max(R, R) -> R, t::MAX, [], everywhere, EXACT, |a, b| a.max(b), [42, 42], [65, 65]),
        routine!("floor" Floor(R) -> I, "log_floor", ["log_floor"], everywhere, STEP, |a| a.wide_floor(), [178, 176], [31, 31]),
        routine!("round" Round(R) -> I, "log_round", ["log_round"], everywhere, STEP, |a| a.wide_round(), [189, 194], [31, 31]),
        routine!("sign" Sign(R) -> I, t::SIGN, [], everywhere, EXACT, |a| a.sign(), [24, 24], [18, 18]),
        routine!("byte_from_int" ToReal(I) -> R, t::OF_BYTE, ["log_is_whole"], byte, L::<FRAC>::WHOLE, |a| L::<FRAC>::from_wide_int(a), [22, 22], [16, 16]),
        routine!("from_int" ToReal(I) -> R, "log_from_int", ["log_from_int"], everywhere, L::<FRAC>::WHOLE, |a| L::<FRAC>::from_wide_int(a), [224, 231], [31, 31]),
        routine!("negative" Less(R, R) -> B, t::NEGATIVE, [], against_zero, EXACT, |a, _b| !a.plus, [12, 12], [8, 8]),
        routine!("positive" Less(R, R) -> B, t::POSITIVE, [], from_zero, EXACT, |_a, b| b.plus && b.log > L::<FRAC>::LEAST, [22, 22], [21, 21]),
        routine!("plus_less" Less(R, R) -> B, t::PLUS_LESS, [], plus, EXACT, |a, b| a.less(b), [24, 24], [18, 18]),
        routine!("less_plus" Less(R, R) -> B, t::LESS_PLUS, [], second_plus, EXACT, |a, b| a.less(b), [24, 24], [26, 26]),
        routine!("plus_less_any" Less(R, R) -> B, t::PLUS_LESS_ANY, [], first_plus, EXACT, |a, b| a.less(b), [24, 24], [26, 26]),
        routine!("less" Less(R, R) -> B, t::LESS, [], everywhere, EXACT, |a, b| a.less(b), [27, 27], [43, 43]),
        routine!("not_positive" LessEqual(R, R) -> B, t::NOT_POSITIVE, [], against_zero, EXACT, |a, _b| !(a.plus && a.log > L::<FRAC>::LEAST), [22, 22], [20, 20]),
        routine!("not_negative" LessEqual(R, R) -> B, t::NOT_NEGATIVE, [], from_zero, EXACT, |_a, b| b.plus, [14, 14], [10, 10]),
        routine!("plus_less_equal" LessEqual(R, R) -> B, t::PLUS_LESS_EQUAL, [], plus, EXACT, |a, b| !b.less(a), [26, 26], [20, 20]),
        routine!("less_equal" LessEqual(R, R) -> B, t::LESS_EQUAL, [], everywhere, EXACT, |a, b| !b.less(a), [28, 28], [47, 47]),
        routine!("is_zero" Equal(R, R) -> B, t::IS_ZERO, [], against_zero, EXACT, |a, _b| a.log <= L::<FRAC>::LEAST, [21, 21], [15, 15]),
        routine!("equal" Equal(R, R) -> B, t::EQUAL, [], everywhere, EXACT, |a, b| a == b, [18, 18], [24, 24]),
    ];

    const FUNCTIONS: &'static [Routine] = &[
        routine!("near_sin" Sin(R) -> R, "log_sine", ["log_sine"], near_angle, NEAR_SINE_BY_TABLE, |a| a.sin(), [360, 364], [27, 27]),
        routine!("sin" Sin(R) -> R, "log_sine", ["log_sine"], angle, SINE, |a| a.sin(), [452, 449], [27, 27]),
        routine!("any_sin" Sin(R) -> R, "log_sine", ["log_sine"], everywhere, ANY_SINE, |a| a.sin(), [452, 449], [27, 27]),
        routine!("near_cos" Cos(R) -> R, "log_cosine", ["log_sine"], near_angle, NEAR_SINE_BY_TABLE, |a| a.cos(), [440, 490], [27, 27]),
        routine!("cos" Cos(R) -> R, "log_cosine", ["log_sine"], angle, SINE, |a| a.cos(), [487, 493], [27, 27]),
        routine!("any_cos" Cos(R) -> R, "log_cosine", ["log_sine"], everywhere, ANY_SINE, |a| a.cos(), [487, 493], [27, 27]),
        routine!("tan" Tan(R) -> R, "log_tangent", ["log_tangent"], near_tangent, L::<FRAC>::TANGENT, |a| a.tan(), [914, 966], [27, 27]),
        routine!("any_tan" Tan(R) -> R, "log_tangent", ["log_tangent"], everywhere, L::<FRAC>::UNKNOWN, |a| a.tan(), [1053, 1057], [27, 27]),
        routine!("asin" Asin(R) -> R, "log_arcsine", ["log_arc"], everywhere, L::<FRAC>::ARC, |a| a.asin(), [237, 257], [27, 27]),
        routine!("acos" Acos(R) -> R, "log_arccosine", ["log_arc"], everywhere, L::<FRAC>::ARC, |a| a.acos(), [381, 380], [27, 27]),
        routine!("atan2" Atan2(R, R) -> R, "log_arctangent2", ["log_arc"], everywhere, L::<FRAC>::ARC, |a, b| a.atan2(b), [350, 372], [39, 39]),
        routine!("near_exp" Exp(R) -> R, "log_exponential", ["log_exponential"], near_angle, NEAR_EXP, |a| a.exp(), [421, 562], [27, 27]),
        routine!("exp" Exp(R) -> R, "log_exponential", ["log_exponential"], everywhere, L::<FRAC>::EXP, |a| a.exp(), [552, 639], [27, 27]),
        routine!("log" Log(R) -> R, "log_natural", ["log_natural"], L::<FRAC>::above_zero, L::<FRAC>::LOGARITHM, |a| a.log(), [334, 344], [27, 27]),
        routine!("any_log" Log(R) -> R, "log_natural", ["log_natural"], everywhere, L::<FRAC>::UNKNOWN, |a| a.log(), [207, 211], [27, 27]),
        routine!("pow" Pow(R, R) -> R, "log_power", ["log_power"], L::<FRAC>::above_zero, L::<FRAC>::POWER, |a, b| a.pow(b), [1139, 1129], [39, 39]),
        routine!("any_pow" Pow(R, R) -> R, "log_power", ["log_power"], everywhere, L::<FRAC>::UNKNOWN, |a, b| a.pow(b), [769, 764], [39, 39]),
    ];
}

pub(super) const TEN: &[Routine] = &joined::<{ Of::<10>::REALS.len() + Of::<10>::FUNCTIONS.len() }>(
    Of::<10>::REALS,
    Of::<10>::FUNCTIONS,
);
pub(super) const ELEVEN: &[Routine] =
    &joined::<{ TEN.len() }>(Of::<11>::REALS, Of::<11>::FUNCTIONS);

/// The routines of logarithms, and those of ints.
pub(super) static WITH_TEN: [Routine; TEN.len() + INTS.len()] = joined(TEN, INTS);
pub(super) static WITH_ELEVEN: [Routine; TEN.len() + INTS.len()] = joined(ELEVEN, INTS);
