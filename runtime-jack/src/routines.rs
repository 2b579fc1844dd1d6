//! The list of routines: for each operation the cheap and restricted ones first.

use slowlight_routine::{Error, Form, Format, Op, Range, Routine, everywhere, joined};

use crate::model::{self, Cut, Float, Float as Real, int, int_bits, wrap};
use crate::{INT as I, SUM, TERM};

const R: Format = Format::Float316 { rounded: false };
const B: Format = Format::Bool;
const EXACT: Error = Error::Exact;

/// A product is short of the exact one by up to 2^-11.08 of it.
const MUL: Error = Error::Relative(4.63e-4);
/// The smaller summand is cut at the last place of the larger, and a sum that
/// is longer loses one place more; of a difference a guard bit is kept.
const ADD: Error = Error::Relative(1.2207031250000002e-4);
/// What a whole number of divisors leaves of the dividend is cut where that is.
const REST: Error = Error::Larger(1.2207031250000002e-4);
/// The divisor's halves are cut, so a quotient may also be too large.
const DIV: Error = Error::Relative(1.2e-3);
/// Two steps of Newton's from 6% leave 1.7e-6; the last sum is cut.
const SQRT: Error = Error::Relative(9.2e-5);
/// Above 16383 the last bit of an int is cut.
const CUT: Error = Error::Relative(6.2e-5);

/// Two units in the last place of 1 and less; every angle of 2^14 and less was tried.
const SINE: Error = Error::Absolute(1.7e-4);
/// From 32768 on an angle counts as 0.
const ANY_SINE: Error = Error::Absolute(2.0);
/// The quotient, the polynomial and the product round, the difference from pi
/// is cut: 3.5e-4 if all were worst at once; 2.3e-4 is the worst of a million.
const ARC: Error = Error::Relative(4e-4);
/// 1.6e-4 up to 2^8, and one place of the exponent more beyond.
const EXP: Error = Error::Relative(2.5e-4);
/// Beside a pole, or with a large exponent, the last place of an operand decides all.
const UNKNOWN: Error = Error::Absolute(f64::MAX);

/// Ints whose exact result needs no saturation.
pub(crate) fn fits(_: &[Range], result: Range) -> bool {
    result.within(-32767.0, 32767.0)
}

/// Ints that a machine may compare by subtracting.
pub(crate) fn near(args: &[Range], _: Range) -> bool {
    match args {
        [a, b, ..] => a.hi - b.lo <= 32767.0 && b.hi - a.lo <= 32767.0,
        _ => false,
    }
}

/// A dividend of at least 0 and a divisor above 0.
fn positive(args: &[Range], _: Range) -> bool {
    matches!(args, [a, b, ..] if a.lo >= 0.0 && b.lo > 0.0)
}

/// An operand whose negative is an int too.
fn symmetric(args: &[Range], _: Range) -> bool {
    args.first().is_some_and(|a| a.within(-32767.0, 32767.0))
}

/// A domain: operand `$k` is the constant `$value`.
macro_rules! with {
    ($k:literal = $value:literal) => {
        |args, _| args.get($k).and_then(|r| r.constant()) == Some($value)
    };
}

/// A domain: operand `$k` is at most `$most` in magnitude.
macro_rules! within {
    ($k:literal: $most:literal) => {
        |args, _| args.get($k).is_some_and(|r| r.within(-$most, $most))
    };
}

pub(crate) const fn sum(template: &'static str) -> Form {
    Form::Expression {
        template,
        level: SUM,
        operands: &[TERM, TERM],
    }
}

/// Operands stand between commas or not at all: any level will do.
pub(crate) const fn call(template: &'static str) -> Form {
    Form::Expression {
        template,
        level: TERM,
        operands: &[SUM, SUM],
    }
}

use Form::Statement as Do;

/// What is made of sums, by the way in which these are rounded, and what it costs.
#[rustfmt::skip]
macro_rules! made_of_sums {
    ($sums:ident: rest $rest:literal, sin $sin:literal, cos $cos:literal, tan $tan:literal, asin $asin:literal within $arc:literal,
     acos $acos:literal, atan2 $atan2:literal, log $log:literal) => {
        &[
            routine!("mod" Mod(R, R) -> R, Do("{r}.mod({0}, {1})"), ["Float.mod"], everywhere, REST, |a, b| a.modulo::<$sums>(b), $rest, 50),
            routine!("sin" Sin(R) -> R, Do("{r}.sin({0})"), ["Float.sin"], within!(0: 32000.0), SINE, |a| a.sin::<$sums>(), $sin, 43),
            routine!("any_sin" Sin(R) -> R, Do("{r}.sin({0})"), ["Float.sin"], everywhere, ANY_SINE, |a| a.sin::<$sums>(), $sin, 43),
            routine!("cos" Cos(R) -> R, Do("{r}.cos({0})"), ["Float.cos"], within!(0: 32000.0), SINE, |a| a.cos::<$sums>(), $cos, 43),
            routine!("any_cos" Cos(R) -> R, Do("{r}.cos({0})"), ["Float.cos"], everywhere, ANY_SINE, |a| a.cos::<$sums>(), $cos, 43),
            routine!("tan" Tan(R) -> R, Do("{r}.tan({0})"), ["Float.tan"], within!(0: 1.5), Error::Relative(2.5e-4), |a| a.tan::<$sums>(), $tan, 43),
            routine!("any_tan" Tan(R) -> R, Do("{r}.tan({0})"), ["Float.tan"], everywhere, UNKNOWN, |a| a.tan::<$sums>(), $tan, 43),
            routine!("asin" Asin(R) -> R, Do("{r}.asin({0})"), ["Float.asin"], everywhere, Error::Relative($arc), |a| a.asin::<$sums>(), $asin, 43),
            routine!("acos" Acos(R) -> R, Do("{r}.acos({0})"), ["Float.acos"], everywhere, Error::Absolute(2.9e-4), |a| a.acos::<$sums>(), $acos, 43),
            routine!("atan2" Atan2(R, R) -> R, Do("{r}.atan2({0}, {1})"), ["Float.atan2"], everywhere, ARC, |a, b| a.atan2::<$sums>(b), $atan2, 50),
            routine!("log" Log(R) -> R, Do("{r}.log({0})"), ["Float.log"], everywhere, Error::Relative(2.5e-4), |a| a.log::<$sums>(), $log, 43),
        ]
    };
}

pub(crate) mod rounded;

/// What does not round, or rounds in `f316r` as it does here. Products by powers of two
/// stand before all others.
#[rustfmt::skip]
const SHARED: &[Routine] = &[
    routine!("half" Mul(R, R) -> R, Do("{r}.scale({0}, -1)"), ["Float.scale"], with!(1 = 0.5), EXACT, |a, _b| a.scale(-1), 47, 50),
    routine!("half_of" Mul(R, R) -> R, Do("{r}.scale({1}, -1)"), ["Float.scale"], with!(0 = 0.5), EXACT, |_a, b| b.scale(-1), 47, 50),
    routine!("quarter" Mul(R, R) -> R, Do("{r}.scale({0}, -2)"), ["Float.scale"], with!(1 = 0.25), EXACT, |a, _b| a.scale(-2), 47, 50),
    routine!("quarter_of" Mul(R, R) -> R, Do("{r}.scale({1}, -2)"), ["Float.scale"], with!(0 = 0.25), EXACT, |_a, b| b.scale(-2), 47, 50),
    routine!("four_times" Mul(R, R) -> R, Do("{r}.scale({0}, 2)"), ["Float.scale"], with!(1 = 4.0), EXACT, |a, _b| a.scale(2), 46, 50),
    routine!("four" Mul(R, R) -> R, Do("{r}.scale({1}, 2)"), ["Float.scale"], with!(0 = 4.0), EXACT, |_a, b| b.scale(2), 46, 50),
    routine!("neg" Neg(R) -> R, Do("{r}.neg({0})"), ["Float.neg"], everywhere, EXACT, |a| a.neg(), 28, 43),
    routine!("abs" Abs(R) -> R, Do("{r}.abs({0})"), ["Float.abs"], everywhere, EXACT, |a| a.abs(), 22, 43),
    routine!("min" Min(R, R) -> R, Do("{r}.min({0}, {1})"), ["Float.min"], everywhere, EXACT, |a, b| a.min(b), 78, 50),
    routine!("max" Max(R, R) -> R, Do("{r}.max({0}, {1})"), ["Float.max"], everywhere, EXACT, |a, b| a.max(b), 78, 50),
    routine!("exp" Exp(R) -> R, Do("{r}.exp({0})"), ["Float.exp"], everywhere, EXP, |a| a.exp(), 476, 43),
    routine!("pow" Pow(R, R) -> R, Do("{r}.pow({0}, {1})"), ["Float.pow"], within!(1: 8.0), Error::Relative(1e-3), |a, b| a.pow(b), 740, 50),
    routine!("large_pow" Pow(R, R) -> R, Do("{r}.pow({0}, {1})"), ["Float.pow"], within!(1: 64.0), Error::Relative(8e-3), |a, b| a.pow(b), 740, 50),
    routine!("any_pow" Pow(R, R) -> R, Do("{r}.pow({0}, {1})"), ["Float.pow"], everywhere, UNKNOWN, |a, b| a.pow(b), 740, 50),
    routine!("floor" Floor(R) -> I, call("{0}.floor()"), ["Float.floor"], everywhere, EXACT, |a| a.floor(), 29, 36),
    routine!("round" Round(R) -> I, call("{0}.round()"), ["Float.round"], everywhere, EXACT, |a| a.round(), 36, 36),
    routine!("sign" Sign(R) -> I, call("{0}.sign()"), ["Float.sign"], everywhere, EXACT, |a| a.sign(), 15, 36),
    routine!("from_int" ToReal(I) -> R, Do("{r}.fromInt({0})"), ["Float.fromInt"], everywhere, CUT, |a| Float::from_int(a), 140, 43),
    routine!("negative" Less(R, R) -> B, call("{0}.negative()"), ["Float.negative"], with!(1 = 0.0), EXACT, |a, _b| a.less(Float::ZERO), 11, 36),
    routine!("positive" Less(R, R) -> B, call("{1}.positive()"), ["Float.positive"], with!(0 = 0.0), EXACT, |_a, b| Float::ZERO.less(b), 11, 36),
    routine!("less" Less(R, R) -> B, call("{0}.less({1})"), ["Float.less"], everywhere, EXACT, |a, b| a.less(b), 39, 43),
    routine!("not_negative" LessEqual(R, R) -> B, sum("~{1}.negative()"), ["Float.negative"], with!(0 = 0.0), EXACT, |_a, b| !b.less(Float::ZERO), 12, 38),
    routine!("not_positive" LessEqual(R, R) -> B, sum("~{0}.positive()"), ["Float.positive"], with!(1 = 0.0), EXACT, |a, _b| !Float::ZERO.less(a), 12, 38),
    routine!("less_equal" LessEqual(R, R) -> B, sum("~{1}.less({0})"), ["Float.less"], everywhere, EXACT, |a, b| !b.less(a), 40, 45),
    routine!("equal" Equal(R, R) -> B, call("{0}.equal({1})"), ["Float.equal"], everywhere, EXACT, |a, b| a.equal(b), 33, 43),
];

/// What cuts.
#[rustfmt::skip]
const CUTTING: &[Routine] = &[
    routine!("add" Add(R, R) -> R, Do("{r}.add({0}, {1})"), ["Float.add"], everywhere, ADD, |a, b| a.add(b), 99, 50),
    routine!("sub" Sub(R, R) -> R, Do("{r}.sub({0}, {1})"), ["Float.sub"], everywhere, ADD, |a, b| a.sub(b), 101, 50),
    routine!("mul" Mul(R, R) -> R, Do("{r}.mul({0}, {1})"), ["Float.mul"], everywhere, MUL, |a, b| a.mul(b), 104, 50),
    routine!("div" Div(R, R) -> R, Do("{r}.div({0}, {1})"), ["Float.div"], everywhere, DIV, |a, b| a.div(b), 408, 50),
    routine!("sqrt" Sqrt(R) -> R, Do("{r}.sqrt({0})"), ["Float.sqrt"], everywhere, SQRT, |a| a.sqrt(), 646, 43),
];

/// And what is made of that.
const FUNCTIONS: &[Routine] = made_of_sums!(Cut: rest 255, sin 831, cos 1100, tan 2059, asin 577 within 2.8e-4, acos 614, atan2 825, log 933);

/// What ints need, in either format of reals.
#[rustfmt::skip]
pub(crate) const INTS: &[Routine] = &[
    routine!("int_add" IntAdd(I, I) -> I, sum("{0} + {1}"), [], fits, EXACT, |a, b| a + b, 1, 7),
    routine!("int_saturating_add" IntAdd(I, I) -> I, call("Int.add({0}, {1})"), ["Int.add"], everywhere, EXACT, |a, b| model::sum(a, b), 19, 36),
    routine!("int_sub" IntSub(I, I) -> I, sum("{0} - {1}"), [], fits, EXACT, |a, b| a - b, 1, 7),
    routine!("int_saturating_sub" IntSub(I, I) -> I, call("Int.sub({0}, {1})"), ["Int.sub"], everywhere, EXACT, |a, b| model::difference(a, b), 19, 36),
    routine!("int_mul" IntMul(I, I) -> I, sum("{0} * {1}"), [], fits, EXACT, |a, b| a * b, 1, 36),
    routine!("int_saturating_mul" IntMul(I, I) -> I, call("Int.mul({0}, {1})"), ["Int.mul"], everywhere, EXACT, |a, b| model::multiply(a, b), 59, 36),
    routine!("int_quotient" IntDiv(I, I) -> I, sum("{0} / {1}"), [], positive, EXACT, |a, b| if b == 0 { 0 } else { a / b }, 1, 36),
    routine!("int_div" IntDiv(I, I) -> I, call("Int.div({0}, {1})"), ["Int.div"], everywhere, EXACT, |a, b| model::divide(a, b), 58, 36),
    routine!("int_mod" IntMod(I, I) -> I, call("Int.mod({0}, {1})"), ["Int.mod"], everywhere, EXACT, |a, b| model::modulo(a, b), 64, 36),
    routine!("int_neg" IntNeg(I) -> I, sum("-{0}"), [], symmetric, EXACT, |a| -a, 1, 4),
    routine!("int_saturating_neg" IntNeg(I) -> I, call("Int.sub(0, {0})"), ["Int.sub"], everywhere, EXACT, |a| model::difference(0, a), 20, 36),
    routine!("int_abs" IntAbs(I) -> I, call("Math.abs({0})"), [], symmetric, EXACT, |a| a.abs(), 1, 36),
    routine!("int_saturating_abs" IntAbs(I) -> I, call("Int.magnitude({0})"), ["Int.magnitude"], everywhere, EXACT, |a| model::magnitude(a), 13, 36),
    routine!("int_min" IntMin(I, I) -> I, call("Math.min({0}, {1})"), [], near, EXACT, |a, b| a.min(b), 1, 36),
    routine!("int_far_min" IntMin(I, I) -> I, call("Int.min({0}, {1})"), ["Int.min"], everywhere, EXACT, |a, b| a.min(b), 22, 36),
    routine!("int_max" IntMax(I, I) -> I, call("Math.max({0}, {1})"), [], near, EXACT, |a, b| a.max(b), 1, 36),
    routine!("int_far_max" IntMax(I, I) -> I, call("Int.max({0}, {1})"), ["Int.max"], everywhere, EXACT, |a, b| a.max(b), 22, 36),
    routine!("int_sign" IntSign(I) -> I, call("Int.sign({0})"), ["Int.sign"], everywhere, EXACT, |a| a.signum(), 11, 36),
    routine!("and" BitAnd(I, I) -> I, sum("{0} & {1}"), [], everywhere, EXACT, |a, b| a & b, 1, 7),
    routine!("or" BitOr(I, I) -> I, sum("{0} | {1}"), [], everywhere, EXACT, |a, b| a | b, 1, 7),
    routine!("xor" BitXor(I, I) -> I, call("Int.xor({0}, {1})"), ["Int.xor"], everywhere, EXACT, |a, b| a ^ b, 10, 36),
    routine!("int_less" IntLess(I, I) -> B, sum("{0} < {1}"), [], near, EXACT, |a, b| a < b, 1, 12),
    routine!("int_far_less" IntLess(I, I) -> B, call("Int.less({0}, {1})"), ["Int.less"], everywhere, EXACT, |a, b| a < b, 14, 36),
    routine!("int_less_equal" IntLessEqual(I, I) -> B, sum("~({0} > {1})"), [], near, EXACT, |a, b| a <= b, 2, 14),
    routine!("int_far_less_equal" IntLessEqual(I, I) -> B, sum("~Int.less({1}, {0})"), ["Int.less"], everywhere, EXACT, |a, b| a <= b, 15, 38),
    routine!("int_equal" IntEqual(I, I) -> B, sum("{0} = {1}"), [], everywhere, EXACT, |a, b| a == b, 1, 12),
    routine!("not" Not(B) -> B, sum("~{0}"), [], everywhere, EXACT, |a| !a, 1, 3),
];

/// The routines of Floats, and those of ints.
pub(crate) static ALL: [Routine; REALS.len() + INTS.len()] = joined(&REALS, INTS);

const REALS: [Routine; SHARED.len() + OWN.len()] = joined(SHARED, &OWN);
const OWN: [Routine; CUTTING.len() + FUNCTIONS.len()] = joined(CUTTING, FUNCTIONS);
