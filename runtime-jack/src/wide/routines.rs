//! The routines of `f416`.

use super::REAL as R;
use super::model::Wide as Real;
use crate::model::{int, int_bits, wrap};
use crate::routines::{INTS, call, sum};
use crate::{INT as I, wide::model::Wide};
use slowlight_routine::{Error, Form::Statement as Do, Format, Op, Routine, everywhere, joined};

const B: Format = Format::Bool;
const EXACT: Error = Error::Exact;

/// Half a unit in the last place of a mantissa of 2^27, of what may be less than that.
const HALF: Error = Error::Relative(3.725_290_4e-9);
/// What three products of digits left out, and two cut, make more of a mantissa that is doubled.
const MUL: Error = Error::Relative(4.2e-9);
/// The last digit's divisor is cut.
const DIV: Error = Error::Relative(3.8e-9);
const SQRT: Error = Error::Relative(4.2e-9);
/// A difference of the divisor's size is rounded.
const REST: Error = Error::Larger(3.725_290_4e-9);
/// 1.1e-8 is the worst of a million.
const SINE: Error = Error::Absolute(1.5e-8);
/// From 32768 on an angle counts as 0.
const ANY_SINE: Error = Error::Absolute(2.0);
/// 1.9e-8 is the worst of a million.
const ARC: Error = Error::Relative(2.4e-8);
/// The exponent's fraction errs by what its larger part is rounded by.
const EXP: Error = Error::Growing {
    relative: 1e-8,
    each: 1.8e-9,
    most: 6000.0,
};
/// Beside a pole, or with a large exponent, the last place of an operand decides all.
const UNKNOWN: Error = Error::Absolute(f64::MAX);

/// Products by powers of two stand before all others.
#[rustfmt::skip]
const REALS: &[Routine] = &[
    routine!("half" Mul(R, R) -> R, Do("{r}.scale({0}, -1)"), ["Float.scale"], with!(1 = 0.5), EXACT, |a, _b| a.scale(-1), 53, 50),
    routine!("half_of" Mul(R, R) -> R, Do("{r}.scale({1}, -1)"), ["Float.scale"], with!(0 = 0.5), EXACT, |_a, b| b.scale(-1), 53, 50),
    routine!("quarter" Mul(R, R) -> R, Do("{r}.scale({0}, -2)"), ["Float.scale"], with!(1 = 0.25), EXACT, |a, _b| a.scale(-2), 53, 50),
    routine!("quarter_of" Mul(R, R) -> R, Do("{r}.scale({1}, -2)"), ["Float.scale"], with!(0 = 0.25), EXACT, |_a, b| b.scale(-2), 53, 50),
    routine!("four_times" Mul(R, R) -> R, Do("{r}.scale({0}, 2)"), ["Float.scale"], with!(1 = 4.0), EXACT, |a, _b| a.scale(2), 52, 50),
    routine!("four" Mul(R, R) -> R, Do("{r}.scale({1}, 2)"), ["Float.scale"], with!(0 = 4.0), EXACT, |_a, b| b.scale(2), 52, 50),
    routine!("neg" Neg(R) -> R, Do("{r}.neg({0})"), ["Float.neg"], everywhere, EXACT, |a| a.neg(), 34, 43),
    routine!("abs" Abs(R) -> R, Do("{r}.abs({0})"), ["Float.abs"], everywhere, EXACT, |a| a.abs(), 28, 43),
    routine!("min" Min(R, R) -> R, Do("{r}.min({0}, {1})"), ["Float.min"], everywhere, EXACT, |a, b| a.min(b), 84, 50),
    routine!("max" Max(R, R) -> R, Do("{r}.max({0}, {1})"), ["Float.max"], everywhere, EXACT, |a, b| a.max(b), 84, 50),
    routine!("add" Add(R, R) -> R, Do("{r}.add({0}, {1})"), ["Float.add"], everywhere, HALF, |a, b| a.add(b), 170, 50),
    routine!("sub" Sub(R, R) -> R, Do("{r}.sub({0}, {1})"), ["Float.sub"], everywhere, HALF, |a, b| a.sub(b), 172, 50),
    routine!("mul" Mul(R, R) -> R, Do("{r}.mul({0}, {1})"), ["Float.mul"], everywhere, MUL, |a, b| a.mul(b), 224, 50),
    routine!("div" Div(R, R) -> R, Do("{r}.div({0}, {1})"), ["Float.div"], everywhere, DIV, |a, b| a.div(b), 369, 50),
    routine!("sqrt" Sqrt(R) -> R, Do("{r}.sqrt({0})"), ["Float.sqrt"], everywhere, SQRT, |a| a.sqrt(), 193, 43),
    routine!("mod" Mod(R, R) -> R, Do("{r}.mod({0}, {1})"), ["Float.mod"], everywhere, REST, |a, b| a.modulo(b), 423, 50),
    routine!("sin" Sin(R) -> R, Do("{r}.sin({0})"), ["Float.sin"], within!(0: 32000.0), SINE, |a| a.sin(), 1922, 43),
    routine!("any_sin" Sin(R) -> R, Do("{r}.sin({0})"), ["Float.sin"], everywhere, ANY_SINE, |a| a.sin(), 1922, 43),
    routine!("cos" Cos(R) -> R, Do("{r}.cos({0})"), ["Float.cos"], within!(0: 32000.0), SINE, |a| a.cos(), 2335, 43),
    routine!("any_cos" Cos(R) -> R, Do("{r}.cos({0})"), ["Float.cos"], everywhere, ANY_SINE, |a| a.cos(), 2335, 43),
    routine!("tan" Tan(R) -> R, Do("{r}.tan({0})"), ["Float.tan"], within!(0: 1.5), Error::Relative(4e-8), |a| a.tan(), 4648, 43),
    routine!("any_tan" Tan(R) -> R, Do("{r}.tan({0})"), ["Float.tan"], everywhere, UNKNOWN, |a| a.tan(), 4648, 43),
    routine!("asin" Asin(R) -> R, Do("{r}.asin({0})"), ["Float.asin"], everywhere, ARC, |a| a.asin(), 2629, 43),
    routine!("acos" Acos(R) -> R, Do("{r}.acos({0})"), ["Float.acos"], everywhere, ARC, |a| a.acos(), 2743, 43),
    routine!("atan2" Atan2(R, R) -> R, Do("{r}.atan2({0}, {1})"), ["Float.atan2"], everywhere, ARC, |a, b| a.atan2(b), 2625, 50),
    routine!("exp" Exp(R) -> R, Do("{r}.exp({0})"), ["Float.exp"], everywhere, EXP, |a| a.exp(), 1518, 43),
    routine!("log" Log(R) -> R, Do("{r}.log({0})"), ["Float.log"], everywhere, Error::Relative(2.4e-8), |a| a.log(), 2488, 43),
    routine!("pow" Pow(R, R) -> R, Do("{r}.pow({0}, {1})"), ["Float.pow"], within!(1: 8.0), Error::Relative(8e-8), |a, b| a.pow(b), 2318, 50),
    routine!("large_pow" Pow(R, R) -> R, Do("{r}.pow({0}, {1})"), ["Float.pow"], within!(1: 64.0), Error::Relative(6e-7), |a, b| a.pow(b), 2318, 50),
    routine!("any_pow" Pow(R, R) -> R, Do("{r}.pow({0}, {1})"), ["Float.pow"], everywhere, UNKNOWN, |a, b| a.pow(b), 2318, 50),
    routine!("floor" Floor(R) -> I, call("{0}.floor()"), ["Float.floor"], everywhere, EXACT, |a| a.floor(), 34, 36),
    routine!("round" Round(R) -> I, call("{0}.round()"), ["Float.round"], everywhere, EXACT, |a| a.round(), 36, 36),
    routine!("sign" Sign(R) -> I, call("{0}.sign()"), ["Float.sign"], everywhere, EXACT, |a| a.sign(), 15, 36),
    routine!("from_int" ToReal(I) -> R, Do("{r}.fromInt({0})"), ["Float.fromInt"], everywhere, EXACT, |a| Wide::from_int(a), 143, 43),
    routine!("negative" Less(R, R) -> B, call("{0}.negative()"), ["Float.negative"], with!(1 = 0.0), EXACT, |a, _b| a.less(Wide::ZERO), 11, 36),
    routine!("positive" Less(R, R) -> B, call("{1}.positive()"), ["Float.positive"], with!(0 = 0.0), EXACT, |_a, b| Wide::ZERO.less(b), 11, 36),
    routine!("less" Less(R, R) -> B, call("{0}.less({1})"), ["Float.less"], everywhere, EXACT, |a, b| a.less(b), 39, 43),
    routine!("not_negative" LessEqual(R, R) -> B, sum("~{1}.negative()"), ["Float.negative"], with!(0 = 0.0), EXACT, |_a, b| !b.less(Wide::ZERO), 12, 38),
    routine!("not_positive" LessEqual(R, R) -> B, sum("~{0}.positive()"), ["Float.positive"], with!(1 = 0.0), EXACT, |a, _b| !Wide::ZERO.less(a), 12, 38),
    routine!("less_equal" LessEqual(R, R) -> B, sum("~{1}.less({0})"), ["Float.less"], everywhere, EXACT, |a, b| !b.less(a), 40, 45),
    routine!("equal" Equal(R, R) -> B, call("{0}.equal({1})"), ["Float.equal"], everywhere, EXACT, |a, b| a.equal(b), 41, 43),
];

/// The routines of wide Floats, and those of ints.
pub(super) static ALL: [Routine; REALS.len() + INTS.len()] = joined(REALS, INTS);
