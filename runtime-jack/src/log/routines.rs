//! The list of routines for logarithmic reals: cheap and restricted before dear and total.

use super::LOG as R;
use super::model::{self, Log, Log as Real};
use crate::INT as I;
use crate::model::{int, int_bits, wrap};
use crate::routines::{INTS, call, joined, sum};
use slowlight_routine::{Error, Form, Format, Op, Range, Routine, everywhere};

const B: Format = Format::Bool;
const EXACT: Error = Error::Exact;

/// Products are exact between the format's ends.
const PRODUCT: Error = Error::Mixed {
    relative: 1e-12,
    absolute: ZERO,
};
/// Entries of the table of sums are right to 0.54 units, what a far summand adds to 0.76.
const SUMS: Error = Error::Mixed {
    relative: 4.8e-4,
    absolute: ZERO,
};
/// Those of differences to 0.6 units, and to 1.22 where the summands are as near as 2^(1/4).
const DIFFERENCES: Error = Error::Mixed {
    relative: 8.4e-4,
    absolute: ZERO,
};
/// Half a unit is cut.
const ROOT: Error = Error::Mixed {
    relative: 3.4e-4,
    absolute: ZERO,
};
/// The logarithms of whole numbers are right to 0.55 units; from 512 on they are sums.
const WHOLE: Error = Error::Mixed {
    relative: 8.5e-4,
    absolute: ZERO,
};
/// What is as near to a whole number as logarithms tell counts as that; nine bits.
const STEP: Error = Error::Mixed {
    relative: 1.0 / 256.0,
    absolute: 1.0,
};
/// A quotient that is cut beside a whole number moves the result by the divisor.
const UNKNOWN: Error = Error::Absolute(131_072.0);
/// The least magnitude, which stands for 0.
const ZERO: f64 = 1.0 / 65536.0;

/// Magnitudes that need no clamping above, with room for what roundings add.
const HIGH: f64 = 60_000.0;

/// The least magnitude in a range.
fn least(range: &Range) -> f64 {
    range.lo.max(-range.hi).max(ZERO)
}

fn high(result: Range) -> bool {
    result.within(-HIGH, HIGH)
}

/// Products that stay between the ends.
fn inner_product(args: &[Range], result: Range) -> bool {
    matches!(args, [a, b, ..] if high(result) && least(a) * least(b) >= ZERO)
}

fn inner_quotient(args: &[Range], _: Range) -> bool {
    matches!(args, [a, b, ..] if a.magnitude() < HIGH * least(b) && least(a) >= ZERO * b.magnitude())
}

fn low_quotient(args: &[Range], _: Range) -> bool {
    matches!(args, [a, b, ..] if a.magnitude() < HIGH * least(b))
}

/// Two arguments of known signs, and a sum that fits.
macro_rules! signs {
    ($a:ident $b:ident) => {
        |args, result| {
            matches!(args, [a, b, ..] if sign!(a $a) && sign!(b $b)) && high(result)
        }
    };
}
macro_rules! sign {
    ($x:ident plus) => {
        $x.lo >= 0.0
    };
    // 0 is held as a small number above it.
    ($x:ident minus) => {
        $x.hi < 0.0
    };
}

/// Results that need no clamping above.
fn fits(_: &[Range], result: Range) -> bool {
    high(result)
}

fn plus(args: &[Range], _: Range) -> bool {
    args.iter().all(|a| a.lo >= 0.0)
}

fn zero(range: Option<&Range>) -> bool {
    range.and_then(|r| r.constant()) == Some(0.0)
}

fn against_zero(args: &[Range], _: Range) -> bool {
    zero(args.get(1))
}

fn from_zero(args: &[Range], _: Range) -> bool {
    zero(args.first())
}

use Form::Statement as Do;

#[rustfmt::skip]
const REALS: &[Routine] = &[
    routine!("mul" Mul(R, R) -> R, Do("let {r} = {0} + {1};\nlet {r+} = {0+} = {1+};"), [], inner_product, PRODUCT, |a, b| a.mul(b), 5, 16),
    routine!("low_mul" Mul(R, R) -> R, Do("let {r} = {0} + {1};\nif ({r} < (-16384)) { let {r} = -16384; }\nlet {r+} = {0+} = {1+};"), [], fits, PRODUCT, |a, b| a.mul(b), 11, 32),
    routine!("any_mul" Mul(R, R) -> R, Do("let {r} = Log.clamp({0} + {1});\nlet {r+} = {0+} = {1+};"), ["Log.clamp"], everywhere, PRODUCT, |a, b| a.mul(b), 20, 22),
    routine!("div" Div(R, R) -> R, Do("let {r} = {0} - {1};\nlet {r+} = {0+} = {1+};"), [], inner_quotient, PRODUCT, |a, b| a.div(b), 5, 16),
    routine!("low_div" Div(R, R) -> R, Do("let {r} = {0} - {1};\nif ({r} < (-16384)) { let {r} = -16384; }\nlet {r+} = {0+} = {1+};"), [], low_quotient, PRODUCT, |a, b| a.div(b), 11, 32),
    routine!("any_div" Div(R, R) -> R, Do("let {r} = Log.clamp({0} - {1});\nlet {r+} = {0+} = {1+};"), ["Log.clamp"], everywhere, PRODUCT, |a, b| a.div(b), 20, 22),
    routine!("sum" Add(R, R) -> R, Do("let {r} = Log.sum({0}, {1});\nlet {r+} = true;"), ["Log.sum"], signs!(plus plus), SUMS, |a, b| a.add(b), 29, 14),
    routine!("minus_sum" Add(R, R) -> R, Do("let {r} = Log.sum({0}, {1});\nlet {r+} = false;"), ["Log.sum"], signs!(minus minus), SUMS, |a, b| a.add(b), 28, 14),
    routine!("sum_less" Add(R, R) -> R, Do("let {r+} = ~({0} < {1});\nlet {r} = Log.difference({0}, {1});"), ["Log.difference"], signs!(plus minus), DIFFERENCES, |a, b| a.add(b), 45, 24),
    routine!("less_sum" Add(R, R) -> R, Do("let {r+} = ~({1} < {0});\nlet {r} = Log.difference({0}, {1});"), ["Log.difference"], signs!(minus plus), DIFFERENCES, |a, b| a.add(b), 45, 24),
    routine!("add" Add(R, R) -> R, Do("let {r} = Log.add({0}, {0+}, {1}, {1+});\nlet {r+} = Log.plus();"), ["Log.add"], fits, DIFFERENCES, |a, b| a.add(b), 46, 30),
    routine!("any_add" Add(R, R) -> R, Do("let {r} = Log.clamp(Log.add({0}, {0+}, {1}, {1+}));\nlet {r+} = Log.plus();"), ["Log.add", "Log.clamp"], everywhere, DIFFERENCES, |a, b| a.add(b), 63, 36),
    routine!("difference" Sub(R, R) -> R, Do("let {r+} = ~({0} < {1});\nlet {r} = Log.difference({0}, {1});"), ["Log.difference"], signs!(plus plus), DIFFERENCES, |a, b| a.sub(b), 45, 24),
    routine!("minus_difference" Sub(R, R) -> R, Do("let {r+} = ~({1} < {0});\nlet {r} = Log.difference({0}, {1});"), ["Log.difference"], signs!(minus minus), DIFFERENCES, |a, b| a.sub(b), 45, 24),
    routine!("difference_sum" Sub(R, R) -> R, Do("let {r} = Log.sum({0}, {1});\nlet {r+} = true;"), ["Log.sum"], signs!(plus minus), SUMS, |a, b| a.sub(b), 29, 14),
    routine!("minus_difference_sum" Sub(R, R) -> R, Do("let {r} = Log.sum({0}, {1});\nlet {r+} = false;"), ["Log.sum"], signs!(minus plus), SUMS, |a, b| a.sub(b), 28, 14),
    routine!("sub" Sub(R, R) -> R, Do("let {r} = Log.add({0}, {0+}, {1}, ~{1+});\nlet {r+} = Log.plus();"), ["Log.add"], fits, DIFFERENCES, |a, b| a.sub(b), 47, 31),
    routine!("any_sub" Sub(R, R) -> R, Do("let {r} = Log.clamp(Log.add({0}, {0+}, {1}, ~{1+}));\nlet {r+} = Log.plus();"), ["Log.add", "Log.clamp"], everywhere, DIFFERENCES, |a, b| a.sub(b), 64, 37),
    routine!("root" Sqrt(R) -> R, Do("let {r} = Log.half({0});\nlet {r+} = true;"), ["Log.half"], plus, ROOT, |a| a.sqrt(), 69, 14),
    routine!("any_root" Sqrt(R) -> R, Do("let {r} = Log.root({0}, {0+});\nlet {r+} = true;"), ["Log.root"], everywhere, ROOT, |a| a.sqrt(), 78, 20),
    routine!("mod" Mod(R, R) -> R, Do("let {r} = Log.mod({0}, {0+}, {1}, {1+});\nlet {r+} = Log.plus();"), ["Log.mod"], everywhere, UNKNOWN, |a, b| a.modulo(b), 229, 30),
    routine!("neg" Neg(R) -> R, Do("let {r+} = ~{0+};\nlet {r} = {0};"), [], everywhere, EXACT, |a| a.neg(), 3, 12),
    routine!("abs" Abs(R) -> R, Do("let {r} = {0};\nlet {r+} = true;"), [], everywhere, EXACT, |a| a.abs(), 3, 10),
    routine!("plus_min" Min(R, R) -> R, Do("let {r} = Math.min({0}, {1});\nlet {r+} = true;"), [], plus, EXACT, |a, b| a.min(b), 4, 14),
    routine!("min" Min(R, R) -> R, Do("if (Log.less({0}, {0+}, {1}, {1+})) {\nlet {r} = {0};\nlet {r+} = {0+};\n}\nelse {\nlet {r} = {1};\nlet {r+} = {1+};\n}"), ["Log.less"], everywhere, EXACT, |a, b| a.min(b), 18, 60),
    routine!("plus_max" Max(R, R) -> R, Do("let {r} = Math.max({0}, {1});\nlet {r+} = true;"), [], plus, EXACT, |a, b| a.max(b), 4, 14),
    routine!("max" Max(R, R) -> R, Do("if (Log.less({0}, {0+}, {1}, {1+})) {\nlet {r} = {1};\nlet {r+} = {1+};\n}\nelse {\nlet {r} = {0};\nlet {r+} = {0+};\n}"), ["Log.less"], everywhere, EXACT, |a, b| a.max(b), 18, 60),
    routine!("floor" Floor(R) -> I, call("Log.floor({0}, {0+})"), ["Log.floor"], everywhere, STEP, |a| a.floor(), 79, 20),
    routine!("round" Round(R) -> I, call("Log.round({0}, {0+})"), ["Log.round"], everywhere, STEP, |a| a.round(), 132, 20),
    routine!("sign" Sign(R) -> I, call("Log.sign({0+})"), ["Log.sign"], everywhere, EXACT, |a| a.sign(), 7, 14),
    routine!("from_int" ToReal(I) -> R, Do("let {r+} = ~({0} < 0);\nlet {r} = Log.fromInt({0});"), ["Log.fromInt"], everywhere, WHOLE, |a| Log::from_int(a), 42, 24),
    routine!("negative" Less(R, R) -> B, sum("~{0+}"), [], against_zero, EXACT, |a, _b| !a.plus, 0, 6),
    routine!("positive" Less(R, R) -> B, sum("{1+} & ({1} > (-16384))"), [], from_zero, EXACT, |_a, b| b.plus && b.log > model::LEAST, 4, 24),
    routine!("plus_less" Less(R, R) -> B, sum("{0} < {1}"), [], plus, EXACT, |a, b| a.less(b), 1, 12),
    routine!("less_plus" Less(R, R) -> B, sum("(~{0+}) | ({0} < {1})"), [], |args, _| matches!(args, [_, b, ..] if b.lo >= 0.0), EXACT, |a, b| a.less(b), 4, 24),
    routine!("plus_less_any" Less(R, R) -> B, sum("{1+} & ({0} < {1})"), [], |args, _| matches!(args, [a, ..] if a.lo >= 0.0), EXACT, |a, b| a.less(b), 3, 22),
    routine!("less" Less(R, R) -> B, call("Log.less({0}, {0+}, {1}, {1+})"), ["Log.less"], everywhere, EXACT, |a, b| a.less(b), 13, 30),
    routine!("not_positive" LessEqual(R, R) -> B, sum("~({0+} & ({0} > (-16384)))"), [], against_zero, EXACT, |a, _b| !(a.plus && a.log > model::LEAST), 5, 26),
    routine!("not_negative" LessEqual(R, R) -> B, call("{1+}"), [], from_zero, EXACT, |_a, b| b.plus, 0, 4),
    routine!("plus_less_equal" LessEqual(R, R) -> B, sum("~({0} > {1})"), [], plus, EXACT, |a, b| !b.less(a), 2, 14),
    routine!("less_equal" LessEqual(R, R) -> B, sum("~Log.less({1}, {1+}, {0}, {0+})"), ["Log.less"], everywhere, EXACT, |a, b| !b.less(a), 14, 32),
    routine!("equal" Equal(R, R) -> B, sum("({0} = {1}) & ({0+} = {1+})"), [], everywhere, EXACT, |a, b| a == b, 5, 24),
];

/// The routines of logarithms, and those of ints.
pub(super) static ALL: [Routine; REALS.len() + INTS.len()] = joined(REALS, INTS);
