//! The list of routines for reals with points of their own: cheap and restricted before
//! dear and total.

use super::{
    BYTE as S, LONG as L, REAL as R, byte, logarithms, long, model, powers, sines, templates as t,
    templates_byte as tb, templates_long as tl,
};
use crate::model as wide;
use crate::model::{bits, int};
use crate::routines::INTS;
use crate::{INT as I, templates};
use slowlight_routine::scale::{Scales, most};
use slowlight_routine::{Error, Form, Format, Op, Range, Routine, everywhere, joined};

const B: Format = Format::Bool;
const EXACT: Error = Error::Exact;
/// In units of the result's last place: half of one, and what is left of cut products.
const NEAREST: Error = Error::Absolute(0.51);
/// Of a result with so few bits less that these count.
const CUT: Error = Error::Absolute(0.63);
/// Half of the last place, and what the reciprocal is off.
const QUOTIENT: Error = Error::Absolute(1.5);
/// Of all roots that there are.
const ROOT: Error = Error::Absolute(1.8);
/// The same where the radicand is cut to 16 bits.
const INT_ROOT: Error = Error::Absolute(2.3);
/// Of one over any root.
const RECIPROCAL_ROOT: Error = Error::Absolute(1.65);
/// What saturates, or is a hundredth of a place.
const LONG_NEAREST: Error = Error::Absolute(0.53);
/// The same of 24 bits, where more is left of cut products.
const LONG_CUT: Error = Error::Absolute(0.75);
const LONG_QUOTIENT: Error = Error::Absolute(1.5);
const LONG_ROOT: Error = Error::Absolute(0.9);
/// What the upper byte of a product lacks when it is shifted.
const BYTE_LOWER: Error = Error::Absolute(1.0);
/// Half a place, and what a number of 16 bits is off of which it is the upper byte.
const BYTE_UPPER: Error = Error::Absolute(0.51);
/// Of a root that is rounded.
const BYTE_ROOT: Error = Error::Absolute(0.51);
/// Half of the last place, and what the table and the angle in turns are off: all operands,
/// with ten bits behind the point or more, and with eight.
const SINE: Error = Error::Absolute(1.3);
const WIDE_SINE: Error = Error::Absolute(2.05);
const FAR_SINE: Error = Error::Absolute(9.05);
/// The same of a power of e.
const POWER: Error = Error::Absolute(1.25);
const ANY: Error = Error::Absolute(65536.0);

/// What logarithms take of one, two and three bytes: most of it to move points, of bytes by most.
const LOGARITHM: [u32; 3] = [2100, 710, 580];

/// The number of the scales, which stands behind the arguments.
fn number(args: &[Range]) -> i32 {
    args.last().map_or(0, |n| n.lo as i32)
}

/// A domain: numbers from `$least` to `$most`, and perhaps something else.
macro_rules! number {
    ($least:literal to $most:expr) => {
        |args: &[Range], _: Range| ($least..=$most).contains(&number(args))
    };
    ($least:literal to $most:literal, $also:expr) => {
        |args: &[Range], result: Range| {
            ($least..=$most).contains(&number(args)) && $also(args, result)
        }
    };
}

/// A domain: on which sides of 16 the scales of operands and result are.
macro_rules! sides {
    ($a:pat, $r:pat) => {
        |args: &[Range], _: Range| {
            let scales = Scales::unpacked(number(args));
            matches!((scales.args[0] <= 16, scales.result <= 16), ($a, $r))
        }
    };
}

/// A domain: numbers that are even, and the others.
fn even(args: &[Range], _: Range) -> bool {
    number(args) % 2 == 0
}

fn odd(args: &[Range], _: Range) -> bool {
    number(args) % 2 != 0
}

/// The greatest of so many bytes.
const fn greatest(bytes: u8) -> f64 {
    most(8 * bytes) as f64
}

/// A domain: results that need no saturation, so many units from a format's end.
macro_rules! fits {
    ($w:literal, $from:literal) => {
        |_: &[Range], result: Range| {
            let most = const { greatest($w) - $from as f64 };
            result.within(-most, most)
        }
    };
}

/// A domain: operands whose difference is a number.
macro_rules! near {
    ($w:literal) => {
        |args: &[Range], _: Range| match args {
            [a, b, ..] => a.hi - b.lo <= greatest($w) && b.hi - a.lo <= greatest($w),
            _ => false,
        }
    };
}

/// A dividend of which nothing but a shift is left.
fn power_of_two(args: &[Range], _: Range) -> bool {
    let one = args.first().and_then(|r| r.constant());
    one.is_some_and(|one| one >= 1.0 && (one as u32).is_power_of_two())
}

/// A divisor of which nothing but a mask is left.
fn by_power(args: &[Range], _: Range) -> bool {
    let divisor = args.get(1).and_then(|r| r.constant());
    divisor.is_some_and(|b| b >= 1.0 && (b as u32).is_power_of_two())
}

/// Ints of 16 bits.
fn short(args: &[Range], _: Range) -> bool {
    args.iter().all(|a| a.within(-32768.0, 32767.0))
}

/// Ints of 16 bits that are not below 0, whose product is one of 32 bits.
fn not_negative(args: &[Range], result: Range) -> bool {
    args.iter().all(|a| a.within(0.0, 65535.0)) && result.within(0.0, f64::from(i32::MAX))
}

fn is(k: usize, value: f64) -> impl Fn(&[Range], Range) -> bool {
    move |args, _| args.get(k).and_then(|r| r.constant()) == Some(value)
}

/// A routine: as for 16.16, but that the last of the model's operands is the number of the
/// scales.
macro_rules! scaled {
    ($name:literal $op:ident($($arg:ident),+) -> $result:ident, $text:expr, [$($need:expr),*],
     $domain:expr, $error:expr, |$a:ident, $b:ident, $n:ident| $body:expr, $cycles:expr, $bytes:expr) => {
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
            model: |all| {
                let at = |k: usize| int(all.get(k).copied().unwrap_or(0));
                #[allow(unused_variables)]
                let ($a, $b, $n) = (at(0), at(all.len().saturating_sub(2)), all.last().map_or(0, |n| *n as i64 as i32));
                bits($body)
            },
        }
    };
}

/// A function of 16.16, for both sides of either point.
fn function(of: fn(i32) -> i32, a: i32, n: i32, bits: u8) -> i32 {
    let scales = Scales::unpacked(n);
    model::function(of, a, [scales.args[0], scales.result], bits)
}

/// What is the same but for the number of bytes: sums, comparisons, and functions of 16.16
/// around which points are shifted. Given the format, its bytes, the templates, the parts
/// that shift, and the fraction bits of sines and of angles.
macro_rules! of_bytes {
    ($r:ident, $w:literal, $t:ident, [$widen:literal, $both:literal, $narrow:literal], $sine:literal, $angle:literal) => {
        &[
            scaled!("twice" Add($r, $r) -> $r, t::COPY, [], number!(1 to 1), EXACT, |a, b, n| a, 6 * $w, 4 * $w),
            scaled!("add" Add($r, $r) -> $r, templates::ADD, [], fits!($w, 0), EXACT, |a, b, n| a + b, 2 + 9 * $w, 1 + 6 * $w),
            scaled!("any_add" Add($r, $r) -> $r, $t::SATURATING_ADD, [], everywhere, EXACT, |a, b, n| model::held(i64::from(a) + i64::from(b), 8 * $w), 10 + 9 * $w, 27 + 6 * $w),
            scaled!("sub" Sub($r, $r) -> $r, templates::SUBTRACT, [], fits!($w, 0), EXACT, |a, b, n| a - b, 2 + 9 * $w, 1 + 6 * $w),
            scaled!("any_sub" Sub($r, $r) -> $r, $t::SATURATING_SUBTRACT, [], everywhere, EXACT, |a, b, n| model::held(i64::from(a) - i64::from(b), 8 * $w), 10 + 9 * $w, 27 + 6 * $w),
            scaled!("times_one" Mul($r, $r) -> $r, t::COPY, [], number!(0 to 0, is(1, 1.0)), EXACT, |a, b, n| a, 6 * $w, 4 * $w),
            scaled!("times_minus_one" Mul($r, $r) -> $r, templates::NEGATE, [], number!(0 to 0, is(1, -1.0)), EXACT, |a, b, n| -a, 2 + 8 * $w, 1 + 6 * $w),
            scaled!("one_times" Mul($r, $r) -> $r, t::COPY_SECOND, [], number!(0 to 0, is(0, 1.0)), EXACT, |a, b, n| b, 6 * $w, 4 * $w),
            scaled!("minus_one_times" Mul($r, $r) -> $r, t::NEGATE_SECOND, [], number!(0 to 0, is(0, -1.0)), EXACT, |a, b, n| -b, 2 + 8 * $w, 1 + 6 * $w),
            scaled!("sin" Sin($r) -> $r, $t::SINE, [$widen, "sine", $narrow], |args, _| (8 * $w - 16..=16).contains(&number(args)), Error::Absolute(0.8), |a, b, n| model::function(wide::sine, a, [n as i8, $sine], 8 * $w), 1300, 18 + 5 * $w),
            scaled!("cos" Cos($r) -> $r, $t::COSINE, [$widen, "sine", $narrow], |args, _| (8 * $w - 16..=16).contains(&number(args)), Error::Absolute(0.8), |a, b, n| model::function(wide::cosine, a, [n as i8, $sine], 8 * $w), 1300, 18 + 5 * $w),
            scaled!("tan" Tan($r) -> $r, $t::TANGENT[0], [$widen, "tangent", $narrow], sides!(true, true), ANY, |a, b, n| function(wide::tangent, a, n, 8 * $w), 15400, 18 + 5 * $w),
            scaled!("tan_10" Tan($r) -> $r, $t::TANGENT[1], [$widen, "tangent", $narrow], sides!(false, true), ANY, |a, b, n| function(wide::tangent, a, n, 8 * $w), 15400, 18 + 5 * $w),
            scaled!("tan_01" Tan($r) -> $r, $t::TANGENT[2], [$widen, "tangent", $narrow], sides!(true, false), ANY, |a, b, n| function(wide::tangent, a, n, 8 * $w), 15400, 18 + 5 * $w),
            scaled!("tan_11" Tan($r) -> $r, $t::TANGENT[3], [$widen, "tangent", $narrow], sides!(false, false), ANY, |a, b, n| function(wide::tangent, a, n, 8 * $w), 15400, 18 + 5 * $w),
            scaled!("asin" Asin($r) -> $r, $t::ARCSINE, [$widen, "arccosine", $narrow], everywhere, Error::Absolute(0.8), |a, b, n| model::function(wide::arcsine, a, [$sine, $sine], 8 * $w), 11500, 18 + 5 * $w),
            scaled!("acos" Acos($r) -> $r, $t::ARCCOSINE, [$widen, "arccosine", $narrow], everywhere, Error::Absolute(0.8), |a, b, n| model::function(wide::arccosine, a, [$sine, $angle], 8 * $w), 11500, 18 + 5 * $w),
            scaled!("atan2" Atan2($r, $r) -> $r, $t::ARCTANGENT, [$both, "arctangent", $narrow], everywhere, Error::Absolute(0.8), |a, b, n| model::arctangent2(a, b, $angle, 8 * $w), 13000, 22 + 10 * $w),
            scaled!("exp" Exp($r) -> $r, $t::EXPONENTIAL[0], [$widen, "exponential", $narrow], sides!(true, true), Error::Absolute(16.0), |a, b, n| function(wide::exponential, a, n, 8 * $w), 9400, 18 + 5 * $w),
            scaled!("exp_10" Exp($r) -> $r, $t::EXPONENTIAL[1], [$widen, "exponential", $narrow], sides!(false, true), Error::Absolute(16.0), |a, b, n| function(wide::exponential, a, n, 8 * $w), 9400, 18 + 5 * $w),
            scaled!("exp_01" Exp($r) -> $r, $t::EXPONENTIAL[2], [$widen, "exponential", $narrow], sides!(true, false), ANY, |a, b, n| function(wide::exponential, a, n, 8 * $w), 9400, 18 + 5 * $w),
            scaled!("exp_11" Exp($r) -> $r, $t::EXPONENTIAL[3], [$widen, "exponential", $narrow], sides!(false, false), ANY, |a, b, n| function(wide::exponential, a, n, 8 * $w), 9400, 18 + 5 * $w),
            scaled!("log" Log($r) -> $r, $t::LOGARITHM[0], [$widen, "table_logarithm", $narrow], sides!(true, true), Error::Absolute(1.5), |a, b, n| function(logarithms::logarithm, a, n, 8 * $w), LOGARITHM[$w - 1], 18 + 5 * $w),
            scaled!("log_10" Log($r) -> $r, $t::LOGARITHM[1], [$widen, "table_logarithm", $narrow], sides!(false, true), ANY, |a, b, n| function(logarithms::logarithm, a, n, 8 * $w), LOGARITHM[$w - 1], 18 + 5 * $w),
            scaled!("log_01" Log($r) -> $r, $t::LOGARITHM[2], [$widen, "table_logarithm", $narrow], sides!(true, false), ANY, |a, b, n| function(logarithms::logarithm, a, n, 8 * $w), LOGARITHM[$w - 1], 18 + 5 * $w),
            scaled!("log_11" Log($r) -> $r, $t::LOGARITHM[3], [$widen, "table_logarithm", $narrow], sides!(false, false), ANY, |a, b, n| function(logarithms::logarithm, a, n, 8 * $w), LOGARITHM[$w - 1], 18 + 5 * $w),
            scaled!("pow" Pow($r, $r) -> $r, $t::POWER[0], [$both, "power", $narrow], sides!(true, true), ANY, |a, b, n| model::power(a, b, Scales::unpacked(n), 8 * $w), 20000, 20 + 10 * $w),
            scaled!("pow_10" Pow($r, $r) -> $r, $t::POWER[1], [$both, "power", $narrow], sides!(false, true), ANY, |a, b, n| model::power(a, b, Scales::unpacked(n), 8 * $w), 20000, 20 + 10 * $w),
            scaled!("pow_01" Pow($r, $r) -> $r, $t::POWER[2], [$both, "power", $narrow], sides!(true, false), ANY, |a, b, n| model::power(a, b, Scales::unpacked(n), 8 * $w), 20000, 20 + 10 * $w),
            scaled!("pow_11" Pow($r, $r) -> $r, $t::POWER[3], [$both, "power", $narrow], sides!(false, false), ANY, |a, b, n| model::power(a, b, Scales::unpacked(n), 8 * $w), 20000, 20 + 10 * $w),
            scaled!("mod_power" Mod($r, $r) -> $r, templates::REAL_MOD_POWER, [], by_power, EXACT, |a, b, n| a & (b - 1), 2 + 12 * $w, 1 + 10 * $w),
            scaled!("mod" Mod($r, $r) -> $r, $t::MODULO, [$t::MODULO_PART], everywhere, EXACT, |a, b, n| wide::modulo(a, b), $t::MODULO_CYCLES, 6 + 10 * $w),
            scaled!("neg" Neg($r) -> $r, templates::NEGATE, [], everywhere, EXACT, |a, b, n| -a, 2 + 8 * $w, 1 + 6 * $w),
            scaled!("abs" Abs($r) -> $r, t::ABS, [], everywhere, EXACT, |a, b, n| a.abs(), 6 + 7 * $w, 8 + 10 * $w),
            scaled!("min" Min($r, $r) -> $r, templates::MIN, [], everywhere, EXACT, |a, b, n| a.min(b), 9 + 13 * $w, 11 + 12 * $w),
            scaled!("max" Max($r, $r) -> $r, templates::MAX, [], everywhere, EXACT, |a, b, n| a.max(b), 9 + 13 * $w, 11 + 12 * $w),
            scaled!("floor" Floor($r) -> I, "!floor", [], |args, _| (0..=8 * $w - 2).contains(&number(args)), EXACT, |a, b, n| a >> n, 20 + 10 * $w, 20 + 5 * $w),
            // Below 1.
            scaled!("fraction_floor" Floor($r) -> I, $t::FRACTION_FLOOR, [], |args, _| (8 * $w - 1..=40).contains(&number(args)), EXACT, |a, b, n| a.signum().min(0), 13, 12),
            // Read at the scale of ints.
            scaled!("round" Round($r) -> I, "!whole", [], everywhere, EXACT, |a, b, n| a, 6 * $w, 4 * $w),
            scaled!("to_real" ToReal(I) -> $r, "~[lda {0.k} | sta {r.k}]", [], everywhere, EXACT, |a, b, n| a, 6 * $w, 4 * $w),
            scaled!("sign" Sign($r) -> I, $t::SIGN, [], everywhere, EXACT, |a, b, n| a.signum(), 14 + 3 * $w, 11 + 2 * $w),
            scaled!("negative" Less($r, $r) -> B, templates::NEGATIVE, [], |args, result| is(1, 0.0)(args, result), EXACT, |a, b, n| i32::from(a < 0), 5, 4),
            scaled!("less" Less($r, $r) -> B, $t::LESS_NEAR, [], near!($w), EXACT, |a, b, n| i32::from(a < b), 2 + 6 * $w, 2 + 4 * $w),
            scaled!("far_less" Less($r, $r) -> B, templates::LESS, [], everywhere, EXACT, |a, b, n| i32::from(a < b), 5 + 6 * $w, 6 + 4 * $w),
            scaled!("not_negative" LessEqual($r, $r) -> B, templates::NOT_NEGATIVE, [], |args, result| is(0, 0.0)(args, result), EXACT, |a, b, n| i32::from(b >= 0), 7, 5),
            scaled!("less_equal" LessEqual($r, $r) -> B, $t::LESS_EQUAL_NEAR, [], near!($w), EXACT, |a, b, n| i32::from(a <= b), 4 + 6 * $w, 4 + 4 * $w),
            scaled!("far_less_equal" LessEqual($r, $r) -> B, templates::LESS_EQUAL, [], everywhere, EXACT, |a, b, n| i32::from(a <= b), 6 + 6 * $w, 6 + 4 * $w),
            scaled!("equal" Equal($r, $r) -> B, templates::EQUAL, [], everywhere, EXACT, |a, b, n| i32::from(a == b), 2 + 6 * $w, 1 + 8 * $w),
        ]
    };
}

/// A product of short ints.
const INT_MUL: Routine = Routine {
    name: "int_mul_16",
    op: Op::IntMul,
    args: &[I, I],
    result: I,
    form: Form::Statement("int_product"),
    needs: &["int_product"],
    cycles: 366,
    bytes: 51,
    domain: short,
    error: EXACT,
    model: |all| {
        bits(
            all.iter()
                .fold(1, |product: i32, a| product.wrapping_mul(int(*a))),
        )
    },
};

/// The same of what is not below 0.
const PLUS_INT_MUL: Routine = Routine {
    name: "int_mul_plus",
    form: Form::Statement(t::PLUS_MULTIPLY),
    needs: &["plus_product"],
    cycles: 234,
    bytes: 31,
    domain: not_negative,
    ..INT_MUL
};

/// Out of tables. What has other points is left to the functions of 16.16.
#[rustfmt::skip]
const TABULATED: &[Routine] = &[
    scaled!("sin_16" Sin(R) -> R, t::SINE_16, ["sine16"], number!(10 to 16), SINE, |a, b, n| sines::sine(a, n), 397, 13),
    scaled!("wide_sin_16" Sin(R) -> R, t::SINE_16, ["sine16"], number!(8 to 9), WIDE_SINE, |a, b, n| sines::sine(a, n), 397, 13),
    scaled!("far_sin_16" Sin(R) -> R, t::SINE_16, ["sine16"], number!(5 to 7), FAR_SINE, |a, b, n| sines::sine(a, n), 412, 13),
    scaled!("cos_16" Cos(R) -> R, t::COSINE_16, ["sine16"], number!(10 to 16), SINE, |a, b, n| sines::cosine(a, n), 404, 13),
    scaled!("wide_cos_16" Cos(R) -> R, t::COSINE_16, ["sine16"], number!(8 to 9), WIDE_SINE, |a, b, n| sines::cosine(a, n), 404, 13),
    scaled!("far_cos_16" Cos(R) -> R, t::COSINE_16, ["sine16"], number!(5 to 7), FAR_SINE, |a, b, n| sines::cosine(a, n), 419, 13),
    scaled!("exp_16" Exp(R) -> R, t::EXPONENTIAL_16, ["exponential16"], |args, _| powers::has(Scales::unpacked(number(args))), POWER, |a, b, n| powers::exponential(a, Scales::unpacked(n)), 464, 17),
];

#[rustfmt::skip]
const REALS: &[Routine] = of_bytes!(R, 2, t, ["widen", "widen_both", "narrow"], 14, 13);

#[rustfmt::skip]
const PRODUCTS: &[Routine] = &[
    scaled!("mul" Mul(R, R) -> R, t::MULTIPLY_16, ["product"], number!(16 to 16), NEAREST, |a, b, n| model::multiply(a, b, n), 243, 32),
    scaled!("double_mul" Mul(R, R) -> R, t::MULTIPLY_15, ["product"], number!(15 to 15), NEAREST, |a, b, n| model::multiply(a, b, n), 255, 37),
    scaled!("mul_14" Mul(R, R) -> R, t::MULTIPLY_14, ["product"], number!(14 to 14, fits!(2, 1)), CUT, |a, b, n| model::multiply(a, b, n), 267, 36),
    scaled!("mul_13" Mul(R, R) -> R, t::MULTIPLY_13, ["product"], number!(13 to 13, fits!(2, 1)), CUT, |a, b, n| model::multiply(a, b, n), 279, 41),
    scaled!("mul_12" Mul(R, R) -> R, t::MULTIPLY_12, ["product"], number!(12 to 12, fits!(2, 1)), CUT, |a, b, n| model::multiply(a, b, n), 291, 46),
    scaled!("any_mul_14" Mul(R, R) -> R, t::MULTIPLY_ANY_14, ["product", "up"], number!(14 to 14), CUT, |a, b, n| model::multiply(a, b, n), 297, 25),
    scaled!("any_mul_13" Mul(R, R) -> R, t::MULTIPLY_ANY_13, ["product", "up"], number!(13 to 13), CUT, |a, b, n| model::multiply(a, b, n), 309, 25),
    scaled!("any_mul_12" Mul(R, R) -> R, t::MULTIPLY_ANY_12, ["product", "up"], number!(12 to 12), CUT, |a, b, n| model::multiply(a, b, n), 321, 25),
    scaled!("middle_mul" Mul(R, R) -> R, t::MULTIPLY_8, ["middle16"], number!(8 to 8, fits!(2, 1)), NEAREST, |a, b, n| model::any_product(a, b, n), 222, 19),
    scaled!("low_mul" Mul(R, R) -> R, t::MULTIPLY_RIGHT, ["lower24"], number!(17 to 31), Error::Absolute(0.77), |a, b, n| model::multiply(a, b, n), 310, 29),
    scaled!("wide_mul" Mul(R, R) -> R, t::MULTIPLY_ANY, ["narrow24"], number!(8 to 11), Error::Absolute(1.5), |a, b, n| model::multiply(a, b, n), 540, 29),
    scaled!("far_mul" Mul(R, R) -> R, t::MULTIPLY_DOWN, ["int_product", "narrow"], number!(1 to 99), NEAREST, |a, b, n| model::any_product(a, b, n), 490, 29),
    scaled!("long_mul" Mul(R, R) -> R, t::MULTIPLY_UP, ["int_product", "narrow"], number!(-99 to 0), ANY, |a, b, n| model::any_product(a, b, n), 490, 29),
    scaled!("one_over" Div(R, R) -> R, t::ONE_OVER, ["one_over"], number!(0 to 30, power_of_two), QUOTIENT, |a, b, n| model::divide(a, b, n), 230, 17),
    scaled!("div" Div(R, R) -> R, t::DIVIDE, ["divide16"], number!(0 to 30), QUOTIENT, |a, b, n| model::divide(a, b, n), 504, 30),
    scaled!("root" Sqrt(R) -> R, t::ROOT, ["root16"], |args, _| number(args) % 2 == 0 && (1..=15).contains(&number(args)), ROOT, |a, b, n| model::root(a, n), 135, 20),
    scaled!("odd_root" Sqrt(R) -> R, t::ODD_ROOT, ["root16"], |args, _| number(args) % 2 == 1 && (1..=15).contains(&number(args)), ROOT, |a, b, n| model::root(a, n), 140, 20),
];

#[rustfmt::skip]
const WHOLE: &[Routine] = &[
    scaled!("reciprocal_root" ReciprocalRoot(R) -> R, t::RECIPROCAL_ROOT, ["reciprocal_root"], even, RECIPROCAL_ROOT, |a, b, n| model::reciprocal_root(a, n), 140, 20),
    scaled!("odd_reciprocal_root" ReciprocalRoot(R) -> R, t::ODD_RECIPROCAL_ROOT, ["reciprocal_root"], odd, RECIPROCAL_ROOT, |a, b, n| model::reciprocal_root(a, n), 135, 20),
    scaled!("int_root" IntRoot(I) -> R, t::INT_ROOT, ["int_root"], everywhere, INT_ROOT, |a, b, n| model::int_root(a, n), 185, 36),
    PLUS_INT_MUL,
    INT_MUL,
];

#[rustfmt::skip]
const LONG_REALS: &[Routine] = of_bytes!(L, 3, tl, ["widen24", "widen24", "hold24"], 16, 16);

#[rustfmt::skip]
const LONG_PRODUCTS: &[Routine] = &[
    scaled!("long_mul_24" Mul(L, L) -> L, tl::MULTIPLY_24, ["product24"], number!(24 to 24), LONG_NEAREST, |a, b, n| long::multiply(a, b, n), 464, 46),
    scaled!("long_mul_23" Mul(L, L) -> L, tl::MULTIPLY_23, ["product24"], number!(23 to 23, fits!(3, 1)), LONG_NEAREST, |a, b, n| long::multiply(a, b, n), 481, 53),
    scaled!("long_mul_22" Mul(L, L) -> L, tl::MULTIPLY_22, ["product24"], number!(22 to 22, fits!(3, 1)), LONG_CUT, |a, b, n| long::multiply(a, b, n), 498, 60),
    scaled!("long_mul_21" Mul(L, L) -> L, tl::MULTIPLY_21, ["product24"], number!(21 to 21, fits!(3, 1)), LONG_CUT, |a, b, n| long::multiply(a, b, n), 515, 67),
    scaled!("long_mul_20" Mul(L, L) -> L, tl::MULTIPLY_20, ["product24"], number!(20 to 20, fits!(3, 1)), LONG_CUT, |a, b, n| long::multiply(a, b, n), 532, 74),
    scaled!("long_mul_up" Mul(L, L) -> L, tl::MULTIPLY_ANY, ["product24", "up24"], number!(20 to 23), LONG_CUT, |a, b, n| long::multiply(a, b, n), 543, 36),
    scaled!("long_mul_down" Mul(L, L) -> L, tl::MULTIPLY_RIGHT, ["product24", "lower32"], number!(25 to 47), Error::Absolute(0.77), |a, b, n| long::multiply(a, b, n), 540, 36),
    scaled!("long_mul_16" Mul(L, L) -> L, tl::MULTIPLY_16, ["whole24", "round40"], number!(16 to 16), NEAREST, |a, b, n| long::any_product(a, b, n), 581, 34),
    scaled!("long_mul_middle" Mul(L, L) -> L, tl::MULTIPLY_MIDDLE, ["whole24", "round40"], number!(17 to 19), NEAREST, |a, b, n| long::any_product(a, b, n), 644, 36),
    scaled!("long_mul_far" Mul(L, L) -> L, tl::MULTIPLY_DOWN, ["exact24"], number!(1 to 99), NEAREST, |a, b, n| long::any_product(a, b, n), 1300, 43),
    scaled!("long_mul_left" Mul(L, L) -> L, tl::MULTIPLY_UP, ["exact24"], number!(-99 to 0), ANY, |a, b, n| long::any_product(a, b, n), 1100, 43),
    scaled!("long_one_over" Div(L, L) -> L, tl::ONE_OVER, ["one_over24"], number!(0 to 46, power_of_two), LONG_QUOTIENT, |a, b, n| long::one_over(a, b, n), 800, 29),
    scaled!("long_div" Div(L, L) -> L, tl::DIVIDE, ["divide24"], number!(0 to 46), LONG_QUOTIENT, |a, b, n| long::divide(a, b, n), 1300, 37),
    scaled!("long_root" Sqrt(L) -> L, tl::ROOT, ["root24"], |args, _| number(args) % 2 == 0 && (1..=23).contains(&number(args)), LONG_ROOT, |a, b, n| long::root(a, n), 700, 30),
    scaled!("long_odd_root" Sqrt(L) -> L, tl::ODD_ROOT, ["root24"], |args, _| number(args) % 2 == 1 && (1..=23).contains(&number(args)), LONG_ROOT, |a, b, n| long::root(a, n), 720, 30),
    PLUS_INT_MUL,
    INT_MUL,
];

#[rustfmt::skip]
const BYTE_REALS: &[Routine] = of_bytes!(S, 1, tb, ["widen", "widen_both", "narrow8"], 6, 5);

#[rustfmt::skip]
const BYTE_PRODUCTS: &[Routine] = &[
    scaled!("byte_mul_8" Mul(S, S) -> S, tb::MULTIPLY_8, ["product8"], number!(8 to 8), NEAREST, |a, b, n| byte::multiply(a, b, n), 82, 13),
    scaled!("byte_mul_7" Mul(S, S) -> S, tb::MULTIPLY_7, ["product8"], number!(7 to 7), NEAREST, |a, b, n| byte::multiply(a, b, n), 89, 16),
    scaled!("byte_mul_6" Mul(S, S) -> S, tb::MULTIPLY_6, ["product8"], number!(6 to 6, fits!(1, 1)), NEAREST, |a, b, n| byte::multiply(a, b, n), 96, 19),
    scaled!("byte_mul_5" Mul(S, S) -> S, tb::MULTIPLY_5, ["product8"], number!(5 to 5, fits!(1, 1)), NEAREST, |a, b, n| byte::multiply(a, b, n), 103, 22),
    scaled!("byte_mul_4" Mul(S, S) -> S, tb::MULTIPLY_4, ["product8"], number!(4 to 4, fits!(1, 1)), NEAREST, |a, b, n| byte::multiply(a, b, n), 110, 25),
    scaled!("byte_any_mul_6" Mul(S, S) -> S, tb::MULTIPLY_ANY_6, ["product8"], number!(6 to 6), NEAREST, |a, b, n| byte::multiply(a, b, n), 106, 45),
    scaled!("byte_any_mul_5" Mul(S, S) -> S, tb::MULTIPLY_ANY_5, ["product8"], number!(5 to 5), NEAREST, |a, b, n| byte::multiply(a, b, n), 110, 48),
    scaled!("byte_any_mul_4" Mul(S, S) -> S, tb::MULTIPLY_ANY_4, ["product8"], number!(4 to 4), NEAREST, |a, b, n| byte::multiply(a, b, n), 114, 51),
    scaled!("byte_low_mul" Mul(S, S) -> S, tb::MULTIPLY_RIGHT, ["product8"], number!(9 to 15), BYTE_LOWER, |a, b, n| byte::multiply(a, b, n), 115, 19),
    scaled!("byte_far_mul" Mul(S, S) -> S, tb::MULTIPLY_DOWN, ["product8", "narrow8"], number!(1 to 99), NEAREST, |a, b, n| byte::multiply(a, b, n), 730, 17),
    scaled!("byte_long_mul" Mul(S, S) -> S, tb::MULTIPLY_UP, ["product8", "narrow8"], number!(-99 to 0), NEAREST, |a, b, n| byte::multiply(a, b, n), 205, 17),
    scaled!("byte_div" Div(R, R) -> S, tb::DIVIDE, ["divide8"], number!(0 to 30), QUOTIENT, |a, b, n| byte::divide(a, b, n), 280, 23),
    scaled!("byte_root" Sqrt(R) -> S, tb::ROOT, ["root8"], number!(-1 to -1), BYTE_ROOT, |a, b, n| byte::root(a), 60, 11),
    scaled!("byte_reciprocal_root" ReciprocalRoot(R) -> S, tb::RECIPROCAL_ROOT, ["reciprocal_root"], even, BYTE_UPPER, |a, b, n| byte::reciprocal_root(a, n), 145, 20),
    scaled!("byte_odd_reciprocal_root" ReciprocalRoot(R) -> S, tb::ODD_RECIPROCAL_ROOT, ["reciprocal_root"], odd, BYTE_UPPER, |a, b, n| byte::reciprocal_root(a, n), 140, 20),
    scaled!("byte_int_root" IntRoot(I) -> S, tb::INT_ROOT, ["int_root"], everywhere, BYTE_LOWER, |a, b, n| byte::int_root(a, n), 190, 40),
];

/// The routines of reals of 16 bits, and those of ints.
pub(super) static ALL: [Routine; TABULATED.len() + SHORT_AND_INTS] = joined(
    TABULATED,
    &joined::<SHORT_AND_INTS>(
        &joined::<{ SHORT.len() + WHOLE.len() }>(&SHORT, WHOLE),
        INTS,
    ),
);

const SHORT_AND_INTS: usize = SHORT.len() + WHOLE.len() + INTS.len();

const SHORT: [Routine; REALS.len() + PRODUCTS.len()] = joined(REALS, PRODUCTS);

/// The same of 24 bits.
pub(super) static ALL_LONG: [Routine; LONG_REALS.len() + LONG_PRODUCTS.len() + INTS.len()] = joined(
    &joined::<{ LONG_REALS.len() + LONG_PRODUCTS.len() }>(LONG_REALS, LONG_PRODUCTS),
    INTS,
);

/// Those of 24 bits, and then those of 16 for what is held in as many.
pub(super) static ALL_MIXED: [Routine; ALL_LONG.len() + SHORT.len()] = joined(&ALL_LONG, &SHORT);

const BYTES: [Routine; BYTE_REALS.len() + BYTE_PRODUCTS.len()] = joined(BYTE_REALS, BYTE_PRODUCTS);

/// Those of 16 bits, and then those of 8.
pub(super) static ALL_SHORT: [Routine; ALL.len() + BYTES.len()] = joined(&ALL, &BYTES);
