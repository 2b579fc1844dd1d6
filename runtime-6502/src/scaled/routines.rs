//! The list of routines for reals with points of their own: cheap and restricted before
//! dear and total.

use super::{REAL as R, model, templates as t};
use crate::model as wide;
use crate::model::{bits, int};
use crate::routines::INTS;
use crate::{INT as I, templates};
use slowlight_routine::scale::Scales;
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
/// What saturates, or is a hundredth of a place.
const ANY: Error = Error::Absolute(65536.0);

/// The number of the scales, which stands behind the arguments.
fn number(args: &[Range]) -> i32 {
    args.last().map_or(0, |n| n.lo as i32)
}

/// A domain: numbers from `$least` to `$most`, and perhaps something else.
macro_rules! number {
    ($least:literal to $most:literal) => {
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

/// Results that need no saturation.
fn fits(_: &[Range], result: Range) -> bool {
    result.within(-32767.0, 32767.0)
}

/// The same of what is rounded.
fn fits_rounded(_: &[Range], result: Range) -> bool {
    result.within(-32766.0, 32766.0)
}

/// A dividend of which nothing but a shift is left.
fn power_of_two(args: &[Range], _: Range) -> bool {
    let one = args.first().and_then(|r| r.constant());
    one.is_some_and(|one| one >= 1.0 && (one as u32).is_power_of_two())
}

/// Ints of 16 bits.
fn short(args: &[Range], _: Range) -> bool {
    args.iter().all(|a| a.within(-32768.0, 32767.0))
}

/// Operands whose difference is a number.
fn near(args: &[Range], _: Range) -> bool {
    match args {
        [a, b, ..] => a.hi - b.lo <= 32767.0 && b.hi - a.lo <= 32767.0,
        _ => false,
    }
}

fn is(k: usize, value: f64) -> impl Fn(&[Range], Range) -> bool {
    move |args, _| args.get(k).and_then(|r| r.constant()) == Some(value)
}

/// A routine: as for 16.16, but that the last of the model's operands is the number of the
/// scales.
macro_rules! scaled {
    ($name:literal $op:ident($($arg:ident),+) -> $result:ident, $text:expr, [$($need:literal),*],
     $domain:expr, $error:expr, |$a:ident, $b:ident, $n:ident| $body:expr, $cycles:literal, $bytes:literal) => {
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
fn function(of: fn(i32) -> i32, a: i32, n: i32) -> i32 {
    let scales = Scales::unpacked(n);
    model::function(of, a, [scales.args[0], scales.result])
}

#[rustfmt::skip]
const REALS: &[Routine] = &[
    scaled!("twice" Add(R, R) -> R, t::COPY, [], number!(1 to 1), EXACT, |a, b, n| a, 12, 8),
    scaled!("add" Add(R, R) -> R, templates::ADD, [], fits, EXACT, |a, b, n| a + b, 20, 13),
    scaled!("any_add" Add(R, R) -> R, t::SATURATING_ADD, [], everywhere, EXACT, |a, b, n| model::held(i64::from(a) + i64::from(b)), 28, 39),
    scaled!("sub" Sub(R, R) -> R, templates::SUBTRACT, [], fits, EXACT, |a, b, n| a - b, 20, 13),
    scaled!("any_sub" Sub(R, R) -> R, t::SATURATING_SUBTRACT, [], everywhere, EXACT, |a, b, n| model::held(i64::from(a) - i64::from(b)), 28, 39),
    scaled!("times_one" Mul(R, R) -> R, t::COPY, [], number!(0 to 0, is(1, 1.0)), EXACT, |a, b, n| a, 12, 8),
    scaled!("times_minus_one" Mul(R, R) -> R, templates::NEGATE, [], number!(0 to 0, is(1, -1.0)), EXACT, |a, b, n| -a, 18, 13),
    scaled!("one_times" Mul(R, R) -> R, t::COPY_SECOND, [], number!(0 to 0, is(0, 1.0)), EXACT, |a, b, n| b, 12, 8),
    scaled!("minus_one_times" Mul(R, R) -> R, t::NEGATE_SECOND, [], number!(0 to 0, is(0, -1.0)), EXACT, |a, b, n| -b, 18, 13),
    scaled!("mul" Mul(R, R) -> R, t::MULTIPLY_16, ["product"], number!(16 to 16), NEAREST, |a, b, n| model::multiply(a, b, n), 253, 32),
    scaled!("double_mul" Mul(R, R) -> R, t::MULTIPLY_15, ["product"], number!(15 to 15), NEAREST, |a, b, n| model::multiply(a, b, n), 266, 37),
    scaled!("mul_14" Mul(R, R) -> R, t::MULTIPLY_14, ["product"], number!(14 to 14, fits_rounded), CUT, |a, b, n| model::multiply(a, b, n), 278, 36),
    scaled!("mul_13" Mul(R, R) -> R, t::MULTIPLY_13, ["product"], number!(13 to 13, fits_rounded), CUT, |a, b, n| model::multiply(a, b, n), 290, 41),
    scaled!("mul_12" Mul(R, R) -> R, t::MULTIPLY_12, ["product"], number!(12 to 12, fits_rounded), CUT, |a, b, n| model::multiply(a, b, n), 302, 46),
    scaled!("any_mul_14" Mul(R, R) -> R, t::MULTIPLY_ANY_14, ["product", "up"], number!(14 to 14), CUT, |a, b, n| model::multiply(a, b, n), 307, 25),
    scaled!("any_mul_13" Mul(R, R) -> R, t::MULTIPLY_ANY_13, ["product", "up"], number!(13 to 13), CUT, |a, b, n| model::multiply(a, b, n), 319, 25),
    scaled!("any_mul_12" Mul(R, R) -> R, t::MULTIPLY_ANY_12, ["product", "up"], number!(12 to 12), CUT, |a, b, n| model::multiply(a, b, n), 331, 25),
    scaled!("low_mul" Mul(R, R) -> R, t::MULTIPLY_RIGHT, ["lower24"], number!(17 to 31), Error::Absolute(0.77), |a, b, n| model::multiply(a, b, n), 320, 29),
    scaled!("wide_mul" Mul(R, R) -> R, t::MULTIPLY_ANY, ["narrow24"], number!(8 to 11), Error::Absolute(1.5), |a, b, n| model::multiply(a, b, n), 550, 29),
    scaled!("far_mul" Mul(R, R) -> R, t::MULTIPLY_DOWN, ["int_product", "narrow"], number!(1 to 99), NEAREST, |a, b, n| model::any_product(a, b, n), 500, 29),
    scaled!("long_mul" Mul(R, R) -> R, t::MULTIPLY_UP, ["int_product", "narrow"], number!(-99 to 0), ANY, |a, b, n| model::any_product(a, b, n), 500, 29),
    scaled!("one_over" Div(R, R) -> R, t::ONE_OVER, ["one_over"], number!(0 to 30, power_of_two), QUOTIENT, |a, b, n| model::divide(a, b, n), 230, 17),
    scaled!("div" Div(R, R) -> R, t::DIVIDE, ["divide16"], number!(0 to 30), QUOTIENT, |a, b, n| model::divide(a, b, n), 506, 30),
    scaled!("root" Sqrt(R) -> R, t::ROOT, ["root16"], |args, _| number(args) % 2 == 0 && (1..=15).contains(&number(args)), ROOT, |a, b, n| model::root(a, n), 135, 20),
    scaled!("odd_root" Sqrt(R) -> R, t::ODD_ROOT, ["root16"], |args, _| number(args) % 2 == 1 && (1..=15).contains(&number(args)), ROOT, |a, b, n| model::root(a, n), 140, 20),
    scaled!("sin" Sin(R) -> R, t::SINE, ["widen", "sine", "narrow"], number!(0 to 16), Error::Absolute(0.8), |a, b, n| model::function(wide::sine, a, [n as i8, 14]), 8400, 28),
    scaled!("cos" Cos(R) -> R, t::COSINE, ["widen", "sine", "narrow"], number!(0 to 16), Error::Absolute(0.8), |a, b, n| model::function(wide::cosine, a, [n as i8, 14]), 8400, 28),
    scaled!("tan" Tan(R) -> R, t::TANGENT[0], ["widen", "tangent", "narrow"], sides!(true, true), ANY, |a, b, n| function(wide::tangent, a, n), 15400, 28),
    scaled!("tan_10" Tan(R) -> R, t::TANGENT[1], ["widen", "tangent", "narrow"], sides!(false, true), ANY, |a, b, n| function(wide::tangent, a, n), 15400, 28),
    scaled!("tan_01" Tan(R) -> R, t::TANGENT[2], ["widen", "tangent", "narrow"], sides!(true, false), ANY, |a, b, n| function(wide::tangent, a, n), 15400, 28),
    scaled!("tan_11" Tan(R) -> R, t::TANGENT[3], ["widen", "tangent", "narrow"], sides!(false, false), ANY, |a, b, n| function(wide::tangent, a, n), 15400, 28),
    scaled!("asin" Asin(R) -> R, t::ARCSINE, ["widen", "arccosine", "narrow"], everywhere, Error::Absolute(0.8), |a, b, n| model::function(wide::arcsine, a, [14, 14]), 11500, 28),
    scaled!("acos" Acos(R) -> R, t::ARCCOSINE, ["widen", "arccosine", "narrow"], everywhere, Error::Absolute(0.8), |a, b, n| model::function(wide::arccosine, a, [14, 13]), 11500, 28),
    scaled!("atan2" Atan2(R, R) -> R, t::ARCTANGENT, ["widen_both", "arctangent", "narrow"], everywhere, Error::Absolute(0.8), |a, b, n| model::arctangent2(a, b), 13000, 42),
    scaled!("exp" Exp(R) -> R, t::EXPONENTIAL[0], ["widen", "exponential", "narrow"], sides!(true, true), Error::Absolute(16.0), |a, b, n| function(wide::exponential, a, n), 9400, 28),
    scaled!("exp_10" Exp(R) -> R, t::EXPONENTIAL[1], ["widen", "exponential", "narrow"], sides!(false, true), Error::Absolute(16.0), |a, b, n| function(wide::exponential, a, n), 9400, 28),
    scaled!("exp_01" Exp(R) -> R, t::EXPONENTIAL[2], ["widen", "exponential", "narrow"], sides!(true, false), ANY, |a, b, n| function(wide::exponential, a, n), 9400, 28),
    scaled!("exp_11" Exp(R) -> R, t::EXPONENTIAL[3], ["widen", "exponential", "narrow"], sides!(false, false), ANY, |a, b, n| function(wide::exponential, a, n), 9400, 28),
    scaled!("log" Log(R) -> R, t::LOGARITHM[0], ["widen", "logarithm", "narrow"], sides!(true, true), Error::Absolute(1.5), |a, b, n| function(wide::logarithm, a, n), 13000, 28),
    scaled!("log_10" Log(R) -> R, t::LOGARITHM[1], ["widen", "logarithm", "narrow"], sides!(false, true), ANY, |a, b, n| function(wide::logarithm, a, n), 13000, 28),
    scaled!("log_01" Log(R) -> R, t::LOGARITHM[2], ["widen", "logarithm", "narrow"], sides!(true, false), ANY, |a, b, n| function(wide::logarithm, a, n), 13000, 28),
    scaled!("log_11" Log(R) -> R, t::LOGARITHM[3], ["widen", "logarithm", "narrow"], sides!(false, false), ANY, |a, b, n| function(wide::logarithm, a, n), 13000, 28),
    scaled!("pow" Pow(R, R) -> R, t::POWER[0], ["widen_both", "power", "narrow"], sides!(true, true), ANY, |a, b, n| model::power(a, b, Scales::unpacked(n)), 20000, 40),
    scaled!("pow_10" Pow(R, R) -> R, t::POWER[1], ["widen_both", "power", "narrow"], sides!(false, true), ANY, |a, b, n| model::power(a, b, Scales::unpacked(n)), 20000, 40),
    scaled!("pow_01" Pow(R, R) -> R, t::POWER[2], ["widen_both", "power", "narrow"], sides!(true, false), ANY, |a, b, n| model::power(a, b, Scales::unpacked(n)), 20000, 40),
    scaled!("pow_11" Pow(R, R) -> R, t::POWER[3], ["widen_both", "power", "narrow"], sides!(false, false), ANY, |a, b, n| model::power(a, b, Scales::unpacked(n)), 20000, 40),
    scaled!("mod" Mod(R, R) -> R, t::MODULO, ["widen_both", "modulo"], everywhere, EXACT, |a, b, n| wide::modulo(a, b), 1000, 36),
    scaled!("neg" Neg(R) -> R, templates::NEGATE, [], everywhere, EXACT, |a, b, n| -a, 18, 13),
    scaled!("abs" Abs(R) -> R, t::ABS, [], everywhere, EXACT, |a, b, n| a.abs(), 20, 28),
    scaled!("min" Min(R, R) -> R, templates::MIN, [], everywhere, EXACT, |a, b, n| a.min(b), 35, 35),
    scaled!("max" Max(R, R) -> R, templates::MAX, [], everywhere, EXACT, |a, b, n| a.max(b), 35, 35),
    scaled!("floor" Floor(R) -> I, "!floor", [], number!(0 to 14), EXACT, |a, b, n| a >> n, 40, 30),
    // Below 1.
    scaled!("fraction_floor" Floor(R) -> I, "~ldx #0 | lda {0.1} | bpl even{n} | dex | even{n}: [stx {r.k}]", [], number!(15 to 30), EXACT, |a, b, n| a.signum().min(0), 13, 12),
    // Read at the scale of ints.
    scaled!("round" Round(R) -> I, "!whole", [], everywhere, EXACT, |a, b, n| a, 12, 8),
    scaled!("to_real" ToReal(I) -> R, t::COPY, [], everywhere, EXACT, |a, b, n| a, 12, 8),
    scaled!("sign" Sign(R) -> I, t::SIGN, [], everywhere, EXACT, |a, b, n| a.signum(), 20, 15),
    Routine {
        name: "int_mul_16",
        op: Op::IntMul,
        args: &[I, I],
        result: I,
        form: Form::Statement("int_product"),
        needs: &["int_product"],
        cycles: 377,
        bytes: 51,
        domain: short,
        error: EXACT,
        model: |all| bits(all.iter().fold(1, |product: i32, a| product.wrapping_mul(int(*a)))),
    },
    scaled!("negative" Less(R, R) -> B, templates::NEGATIVE, [], |args, result| is(1, 0.0)(args, result), EXACT, |a, b, n| i32::from(a < 0), 5, 4),
    scaled!("less" Less(R, R) -> B, t::LESS_NEAR, [], near, EXACT, |a, b, n| i32::from(a < b), 14, 10),
    scaled!("far_less" Less(R, R) -> B, templates::LESS, [], everywhere, EXACT, |a, b, n| i32::from(a < b), 17, 14),
    scaled!("not_negative" LessEqual(R, R) -> B, templates::NOT_NEGATIVE, [], |args, result| is(0, 0.0)(args, result), EXACT, |a, b, n| i32::from(b >= 0), 7, 5),
    scaled!("less_equal" LessEqual(R, R) -> B, t::LESS_EQUAL_NEAR, [], near, EXACT, |a, b, n| i32::from(a <= b), 16, 12),
    scaled!("far_less_equal" LessEqual(R, R) -> B, templates::LESS_EQUAL, [], everywhere, EXACT, |a, b, n| i32::from(a <= b), 18, 14),
    scaled!("equal" Equal(R, R) -> B, templates::EQUAL, [], everywhere, EXACT, |a, b, n| i32::from(a == b), 14, 17),
];

/// The routines of reals, and those of ints.
pub(super) static ALL: [Routine; REALS.len() + INTS.len()] = joined(REALS, INTS);
