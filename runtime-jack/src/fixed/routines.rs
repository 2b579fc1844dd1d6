//! The list of routines for fixed-point reals: cheap and restricted before dear and total.

use super::{REAL as R, functions, model};
use crate::model::{difference, int, int_bits, modulo, multiply, sum as saturating_sum};
use crate::routines::{INTS, call, fits, near, sum};
use crate::{INT as I, TERM};
use slowlight_routine::scale::Scales;
use slowlight_routine::{Error, Form, Format, Op, Range, Routine, everywhere, joined};

const B: Format = Format::Bool;
const EXACT: Error = Error::Exact;

/// What a model makes, as bits.
trait Result {
    fn bits(self) -> u64;
}

impl Result for i32 {
    fn bits(self) -> u64 {
        int_bits(self)
    }
}

impl Result for bool {
    fn bits(self) -> u64 {
        u64::from(self)
    }
}

/// A routine: as [`routine!`], but that all operands are ints, and the last of the model's
/// is the number of its scales.
macro_rules! fixed {
    ($name:literal $op:ident($($arg:ident),+) -> $result:ident, $form:expr, [$($need:literal),*],
     $domain:expr, $error:expr, |$a:ident, $b:ident, $n:ident| $body:expr, $cycles:literal, $bytes:literal) => {
        Routine {
            name: $name,
            op: Op::$op,
            args: &[$($arg),+],
            result: $result,
            form: $form,
            needs: &[$($need),*],
            cycles: $cycles,
            bytes: $bytes,
            domain: $domain,
            error: $error,
            model: |all| {
                let at = |k: usize| int(all.get(k).copied().unwrap_or(0));
                #[allow(unused_variables)]
                let ($a, $b, $n) = (at(0), at(all.len().saturating_sub(2)), all.last().map_or(0, |n| *n as i64 as i32));
                Result::bits($body)
            },
        }
    };
}

/// The number of the scales, which stands behind the arguments.
fn number(args: &[Range]) -> i32 {
    args.last().map_or(0, |n| n.lo as i32)
}

/// A domain: numbers from `$least` to `$most`, and perhaps something else.
macro_rules! number {
    ($least:literal to $most:literal) => {
        |args: &[Range], _: Range| ($least..=$most).contains(&number(args))
    };
    ($n:literal, $also:expr) => {
        |args: &[Range], result: Range| number(args) == $n && $also(args, result)
    };
}

/// A domain: how many fraction bits the operand and the result may have, or the second
/// operand of two; and how large the first may be, over 2^13.
macro_rules! scales {
    (a: $a:pat, r: $r:pat $(, most: $most:literal)?) => {
        |args: &[Range], _: Range| {
            let Scales { args: [a, _], result } = Scales::unpacked(number(args));
            matches!((a, result), ($a, $r)) $(&& args[0].within(-$most, $most))?
        }
    };
    (b: $b:pat) => {
        |args: &[Range], _: Range| matches!(Scales::unpacked(number(args)).args[1], $b)
    };
}

/// Whether operand `k` is 1 as the machine holds it.
fn is_one(k: usize) -> impl Fn(&[Range], Range) -> bool {
    move |args, _| args.get(k).and_then(|r| r.constant()) == Some(1.0)
}

/// Whether the divisor is a power of two as the machine holds it: a mask is left.
fn by_power(args: &[Range], _: Range) -> bool {
    let divisor = args.get(1).and_then(|r| r.constant());
    divisor.is_some_and(|b| b >= 1.0 && (b as u32).is_power_of_two())
}

fn even_root(args: &[Range], _: Range) -> bool {
    (1..=15).contains(&number(args)) && number(args) % 2 == 0
}

/// The operand itself.
const fn same(template: &'static str) -> Form {
    Form::Expression {
        template,
        level: TERM,
        operands: &[TERM, TERM],
    }
}

#[rustfmt::skip]
const REALS: &[Routine] = &[
    fixed!("twice" Add(R, R) -> R, same("{0}"), [], number!(1 to 1), EXACT, |a, b, n| a, 0, 0),
    fixed!("add" Add(R, R) -> R, sum("{0} + {1}"), [], fits, EXACT, |a, b, n| a + b, 1, 7),
    fixed!("any_add" Add(R, R) -> R, call("Int.add({0}, {1})"), ["Int.add"], everywhere, EXACT, |a, b, n| saturating_sum(a, b), 19, 36),
    fixed!("sub" Sub(R, R) -> R, sum("{0} - {1}"), [], fits, EXACT, |a, b, n| a - b, 1, 7),
    fixed!("any_sub" Sub(R, R) -> R, call("Int.sub({0}, {1})"), ["Int.sub"], everywhere, EXACT, |a, b, n| difference(a, b), 19, 36),
    fixed!("times_one" Mul(R, R) -> R, same("{0}"), [], number!(0, is_one(1)), EXACT, |a, b, n| a, 0, 0),
    fixed!("once" Mul(R, R) -> R, same("{1}"), [], number!(0, is_one(0)), EXACT, |a, b, n| b, 0, 0),
    fixed!("multiple" Mul(R, R) -> R, sum("{0} * {1}"), [], number!(0, fits), EXACT, |a, b, n| a * b, 1, 36),
    fixed!("any_multiple" Mul(R, R) -> R, call("Int.mul({0}, {1})"), ["Int.mul"], number!(0 to 0), EXACT, |a, b, n| multiply(a, b), 58, 36),
    fixed!("mul" Mul(R, R) -> R, call("Fixed.mul({0}, {1})"), ["Fixed.mul"], number!(15 to 15), Error::Absolute(0.54), |a, b, n| model::mul(a, b), 70, 36),
    fixed!("half_mul" Mul(R, R) -> R, call("Fixed.halfMul({0}, {1})"), ["Fixed.halfMul"], number!(16 to 16), Error::Absolute(0.52), |a, b, n| model::half_mul(a, b), 66, 36),
    fixed!("small_mul" Mul(R, R) -> R, call("Fixed.right(Fixed.halfMul({0}, {1}), {2^(n-17)})"), ["Fixed.halfMul", "Fixed.right"], number!(17 to 31), Error::Absolute(0.77), |a, b, n| model::right(model::half_mul(a, b), n - 16), 84, 60),
    fixed!("wide_mul" Mul(R, R) -> R, call("Fixed.wideMul({0}, {1}, {2^(16-n)}, {2^(n-9)})"), ["Fixed.wideMul"], number!(12 to 14), Error::Absolute(0.8), |a, b, n| model::wide_mul(a, b, n), 86, 50),
    // Of what nearly always saturates.
    fixed!("long_mul" Mul(R, R) -> R, call("Fixed.left(Fixed.mul({0}, {1}), {32767/2^(15-n)}, {2^(15-n)})"), ["Fixed.mul", "Fixed.left"], number!(-99 to 11), Error::Absolute(65536.0), |a, b, n| model::left(model::mul(a, b), 15 - n), 85, 60),
    fixed!("div" Div(R, R) -> R, call("Fixed.div({0}, {1}, {n})"), ["Fixed.div"], number!(0 to 30), Error::Absolute(0.5), |a, b, n| model::div(a, b, n), 256, 40),
    fixed!("root" Sqrt(R) -> R, call("Fixed.root({0}, {2^((15-n)/2)})"), ["Fixed.root"], |args, result| !even_root(args, result) && (1..=15).contains(&number(args)), Error::Absolute(1.5), |a, b, n| model::sqrt(a, n), 61, 40),
    fixed!("double_root" Sqrt(R) -> R, call("Fixed.doubleRoot({0}, {2^((16-n)/2)}, {2^((14-n)/2)})"), ["Fixed.doubleRoot"], even_root, Error::Absolute(1.5), |a, b, n| model::sqrt(a, n), 67, 48),
    fixed!("sin" Sin(R) -> R, call("Fixed.sin(Fixed.turns({0}, {2^(13-n)}))"), ["Fixed.sin", "Fixed.turns"], number!(13 to 13), Error::Absolute(2.5), |a, b, n| model::sin(a, n), 127, 60),
    fixed!("wide_sin" Sin(R) -> R, call("Fixed.sin(Fixed.turns({0}, {2^(13-n)}))"), ["Fixed.sin", "Fixed.turns"], number!(10 to 12), Error::Absolute(9.0), |a, b, n| model::sin(a, n), 127, 60),
    fixed!("any_sin" Sin(R) -> R, call("Fixed.sin(Fixed.turns({0}, {2^(13-n)}))"), ["Fixed.sin", "Fixed.turns"], number!(0 to 9), Error::Absolute(32768.0), |a, b, n| model::sin(a, n), 126, 60),
    fixed!("cos" Cos(R) -> R, call("Fixed.sin(Fixed.turns({0}, {2^(13-n)}) + 16384)"), ["Fixed.sin", "Fixed.turns"], number!(13 to 13), Error::Absolute(2.5), |a, b, n| model::cos(a, n), 129, 64),
    fixed!("wide_cos" Cos(R) -> R, call("Fixed.sin(Fixed.turns({0}, {2^(13-n)}) + 16384)"), ["Fixed.sin", "Fixed.turns"], number!(10 to 12), Error::Absolute(9.0), |a, b, n| model::cos(a, n), 129, 64),
    fixed!("any_cos" Cos(R) -> R, call("Fixed.sin(Fixed.turns({0}, {2^(13-n)}) + 16384)"), ["Fixed.sin", "Fixed.turns"], number!(0 to 9), Error::Absolute(32768.0), |a, b, n| model::cos(a, n), 127, 64),
    fixed!("tan" Tan(R) -> R, call("Fixed.tan(Fixed.turns({0}, {2^(13-a)}), {r})"), ["Fixed.tan", "Fixed.turns"], scales!(a: 13, r: 0..=14, most: 6433.0), Error::Absolute(5.0), |a, b, n| functions::tan(a, Scales::unpacked(n)), 452, 60),
    fixed!("any_tan" Tan(R) -> R, call("Fixed.tan(Fixed.turns({0}, {2^(13-a)}), {r})"), ["Fixed.tan", "Fixed.turns"], scales!(a: 0..=13, r: 0..=14), Error::Absolute(65536.0), |a, b, n| functions::tan(a, Scales::unpacked(n)), 436, 60),
    fixed!("small_tan" Tan(R) -> R, call("Fixed.right(Fixed.tan(Fixed.turns({0}, {2^(13-a)}), 0), {2^(-r-1)})"), ["Fixed.tan", "Fixed.turns", "Fixed.right"], scales!(a: 0..=13, r: -15..=-1), Error::Absolute(65536.0), |a, b, n| functions::tan(a, Scales::unpacked(n)), 314, 84),
    fixed!("asin" Asin(R) -> R, call("Fixed.asin({0})"), ["Fixed.asin"], everywhere, Error::Absolute(2.5), |a, b, n| functions::asin(a), 233, 36),
    fixed!("acos" Acos(R) -> R, call("Fixed.acos({0})"), ["Fixed.acos"], everywhere, Error::Absolute(1.7), |a, b, n| functions::acos(a), 236, 36),
    fixed!("atan2" Atan2(R, R) -> R, call("Fixed.atan2({0}, {1})"), ["Fixed.atan2"], everywhere, Error::Absolute(1.0), |a, b, n| functions::atan2(a, b), 324, 36),
    fixed!("exp" Exp(R) -> R, call("Fixed.exp({0}, {2^(15-a)}, {2^(a-5)}, {r})"), ["Fixed.exp"], scales!(a: 13..=15, r: _), Error::Absolute(3.0), |a, b, n| functions::exp(a, Scales::unpacked(n)), 216, 60),
    fixed!("wide_exp" Exp(R) -> R, call("Fixed.exp({0}, {2^(15-a)}, {2^(a-5)}, {r})"), ["Fixed.exp"], scales!(a: 10..=12, r: _), Error::Absolute(16.0), |a, b, n| functions::exp(a, Scales::unpacked(n)), 189, 60),
    fixed!("log" Log(R) -> R, call("Fixed.log({0}, {14-a}, {32767/2^(r-10)}, {2^(r-10)}, {2^(14-r)})"), ["Fixed.log"], scales!(a: _, r: 10..=14), Error::Absolute(1.5), |a, b, n| functions::log(a, Scales::unpacked(n)), 138, 60),
    fixed!("small_log" Log(R) -> R, call("Fixed.smallLog({0}, {14-a}, {2^(9-r)})"), ["Fixed.smallLog"], scales!(a: _, r: -15..=9), Error::Absolute(1.0), |a, b, n| functions::log(a, Scales::unpacked(n)), 151, 84),
    fixed!("pow" Pow(R, R) -> R, call("Fixed.pow({0}, {1}, {14-a}, {2^(15-b)}, {2^(b-5)}, {r})"), ["Fixed.pow"], scales!(b: 13..=15), Error::Absolute(8.0), |a, b, n| functions::pow(a, b, Scales::unpacked(n)), 191, 72),
    fixed!("wide_pow" Pow(R, R) -> R, call("Fixed.pow({0}, {1}, {14-a}, {2^(15-b)}, {2^(b-5)}, {r})"), ["Fixed.pow"], scales!(b: 10..=12), Error::Absolute(60.0), |a, b, n| functions::pow(a, b, Scales::unpacked(n)), 170, 72),
    fixed!("far_pow" Pow(R, R) -> R, call("Fixed.pow({0}, {1}, {14-a}, {2^(15-b)}, {2^(b-5)}, {r})"), ["Fixed.pow"], scales!(b: 5..=9), Error::Absolute(1900.0), |a, b, n| functions::pow(a, b, Scales::unpacked(n)), 180, 72),
    fixed!("power_mod" Mod(R, R) -> R, sum("{0} & ({1} - 1)"), [], by_power, EXACT, |a, b, n| a & (b - 1), 3, 20),
    fixed!("mod" Mod(R, R) -> R, call("Int.mod({0}, {1})"), ["Int.mod"], everywhere, EXACT, |a, b, n| modulo(a, b), 64, 36),
    fixed!("neg" Neg(R) -> R, sum("-{0}"), [], everywhere, EXACT, |a, b, n| -a, 1, 4),
    fixed!("abs" Abs(R) -> R, call("Math.abs({0})"), [], everywhere, EXACT, |a, b, n| a.abs(), 1, 36),
    fixed!("min" Min(R, R) -> R, call("Math.min({0}, {1})"), [], near, EXACT, |a, b, n| a.min(b), 1, 36),
    fixed!("far_min" Min(R, R) -> R, call("Int.min({0}, {1})"), ["Int.min"], everywhere, EXACT, |a, b, n| a.min(b), 22, 36),
    fixed!("max" Max(R, R) -> R, call("Math.max({0}, {1})"), [], near, EXACT, |a, b, n| a.max(b), 1, 36),
    fixed!("far_max" Max(R, R) -> R, call("Int.max({0}, {1})"), ["Int.max"], everywhere, EXACT, |a, b, n| a.max(b), 22, 36),
    fixed!("floor" Floor(R) -> I, call("Fixed.floor({0}, {2^n})"), ["Fixed.floor"], number!(0 to 14), EXACT, |a, b, n| model::floor(a, n), 14, 36),
    // Below 1.
    fixed!("fraction_floor" Floor(R) -> I, call("Math.min(0, Int.sign({0}))"), ["Int.sign"], number!(15 to 30), EXACT, |a, b, n| a.signum().min(0), 13, 40),
    // Read at the scale of ints.
    fixed!("round" Round(R) -> I, same("{0}"), [], everywhere, EXACT, |a, b, n| a, 0, 0),
    fixed!("to_real" ToReal(I) -> R, same("{0}"), [], everywhere, EXACT, |a, b, n| a, 0, 0),
    fixed!("sign" Sign(R) -> I, call("Int.sign({0})"), ["Int.sign"], everywhere, EXACT, |a, b, n| a.signum(), 11, 36),
    fixed!("less" Less(R, R) -> B, sum("{0} < {1}"), [], near, EXACT, |a, b, n| a < b, 1, 12),
    fixed!("far_less" Less(R, R) -> B, call("Int.less({0}, {1})"), ["Int.less"], everywhere, EXACT, |a, b, n| a < b, 15, 36),
    fixed!("less_equal" LessEqual(R, R) -> B, sum("~({0} > {1})"), [], near, EXACT, |a, b, n| a <= b, 2, 14),
    fixed!("far_less_equal" LessEqual(R, R) -> B, sum("~Int.less({1}, {0})"), ["Int.less"], everywhere, EXACT, |a, b, n| a <= b, 16, 38),
    fixed!("equal" Equal(R, R) -> B, sum("{0} = {1}"), [], everywhere, EXACT, |a, b, n| a == b, 1, 12),
];

/// The routines of fixed-point reals, and those of ints.
pub(super) static ALL: [Routine; REALS.len() + INTS.len()] = joined(REALS, INTS);
