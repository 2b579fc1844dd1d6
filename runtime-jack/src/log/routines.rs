//! The list of routines for logarithmic reals: cheap and restricted before dear and total.

use crate::INT as I;
use crate::model::{int, int_bits, wrap};
use crate::routines::{INTS, call, sum};
use slowlight_routine::log::domains::*;
use slowlight_routine::log::model::{self, Log, Log as Real};
use slowlight_routine::log::{LOG as R, known_sign};
use slowlight_routine::{Error, Form, Format, Op, Range, Routine, everywhere, joined};

const B: Format = Format::Bool;
const EXACT: Error = Error::Exact;

/// Two arguments of known signs, and a sum that fits.
macro_rules! signs {
    ($a:ident $b:ident) => {
        |args: &[Range], result: Range| Log::signs(args, result, [sign!($a), sign!($b)])
    };
}
macro_rules! sign {
    (plus) => {
        Sign::Plus
    };
    (minus) => {
        Sign::Minus
    };
    (any) => {
        Sign::Any
    };
}

use Form::Statement as Do;

#[rustfmt::skip]
const REALS: &[Routine] = &[
    routine!("mul" Mul(R, R) -> R, Do("let {r} = {0} + {1};\nlet {r+} = {0+} = {1+};"), [], Log::inner_product, Log::PRODUCT, |a, b| a.mul(b), 5, 16),
    routine!("low_mul" Mul(R, R) -> R, Do("let {r} = {0} + {1};\nif ({r} < (-13312)) { let {r} = -13312; }\nlet {r+} = {0+} = {1+};"), [], Log::fits, Log::PRODUCT, |a, b| a.mul(b), 11, 32),
    routine!("loose_mul" Mul(R, R) -> R, Do("let {r} = {0} + {1};\nlet {r+} = {0+} = {1+};"), [], never, Log::PRODUCT, |a, b| a.loose_mul(b), 5, 16),
    routine!("any_mul" Mul(R, R) -> R, Do("let {r} = Log.clamp({0} + {1});\nlet {r+} = {0+} = {1+};"), ["Log.clamp"], everywhere, Log::PRODUCT, |a, b| a.mul(b), 19, 22),
    routine!("div" Div(R, R) -> R, Do("let {r} = {0} - {1};\nlet {r+} = {0+} = {1+};"), [], Log::inner_quotient, Log::PRODUCT, |a, b| a.div(b), 5, 16),
    routine!("low_div" Div(R, R) -> R, Do("let {r} = {0} - {1};\nif ({r} < (-13312)) { let {r} = -13312; }\nlet {r+} = {0+} = {1+};"), [], Log::low_quotient, Log::PRODUCT, |a, b| a.div(b), 11, 32),
    routine!("loose_div" Div(R, R) -> R, Do("let {r} = {0} - {1};\nlet {r+} = {0+} = {1+};"), [], never, Log::PRODUCT, |a, b| a.loose_div(b), 5, 16),
    routine!("high_div" Div(R, R) -> R, Do("let {r} = {0} - {1};\nif ({r} > 16383) { let {r} = 16383; }\nlet {r+} = {0+} = {1+};"), [], Log::high_quotient, Log::PRODUCT, |a, b| a.div(b), 10, 30),
    routine!("any_div" Div(R, R) -> R, Do("let {r} = Log.clamp({0} - {1});\nlet {r+} = {0+} = {1+};"), ["Log.clamp"], everywhere, Log::PRODUCT, |a, b| a.div(b), 19, 22),
    routine!("sum" Add(R, R) -> R, Do("let {r} = Log.sum({0}, {1});\nlet {r+} = true;"), ["Log.sum"], signs!(plus plus), Log::SUMS, |a, b| a.add(b), 26, 14),
    routine!("any_sum" Add(R, R) -> R, Do("let {r} = Log.sum({0}, {1});\nif ({r} > 16383) { let {r} = 16383; }\nlet {r+} = true;"), ["Log.sum"], plus, Log::SUMS, |a, b| a.add(b), 31, 40),
    routine!("minus_sum" Add(R, R) -> R, Do("let {r} = Log.sum({0}, {1});\nlet {r+} = false;"), ["Log.sum"], signs!(minus minus), Log::SUMS, |a, b| a.add(b), 25, 14),
    routine!("difference_sum" Sub(R, R) -> R, Do("let {r} = Log.sum({0}, {1});\nlet {r+} = true;"), ["Log.sum"], signs!(plus minus), Log::SUMS, |a, b| a.sub(b), 26, 14),
    routine!("minus_difference_sum" Sub(R, R) -> R, Do("let {r} = Log.sum({0}, {1});\nlet {r+} = false;"), ["Log.sum"], signs!(minus plus), Log::SUMS, |a, b| a.sub(b), 25, 14),
    routine!("root" Sqrt(R) -> R, Do("let {r} = Log.half({0});\nlet {r+} = true;"), ["Log.half"], plus, Log::ROOT, |a| a.sqrt(), 40, 14),
    routine!("any_root" Sqrt(R) -> R, Do("let {r} = Log.root({0}, {0+});\nlet {r+} = true;"), ["Log.root"], everywhere, Log::ROOT, |a| a.sqrt(), 34, 20),
    routine!("mod" Mod(R, R) -> R, Do("let {r} = Log.mod({0}, {0+}, {1}, {1+});\nlet {r+} = Log.plus();"), ["Log.mod"], everywhere, Log::UNKNOWN, |a, b| a.modulo(b), 217, 30),
    routine!("neg" Neg(R) -> R, Do("let {r+} = ~{0+};\nlet {r} = {0};"), [], everywhere, EXACT, |a| a.neg(), 3, 12),
    routine!("abs" Abs(R) -> R, Do("let {r} = {0};\nlet {r+} = true;"), [], everywhere, EXACT, |a| a.abs(), 3, 10),
    routine!("plus_min" Min(R, R) -> R, Do("let {r} = Math.min({0}, {1});\nlet {r+} = true;"), [], plus, EXACT, |a, b| a.min(b), 4, 14),
    routine!("min_plus_first" Min(R, R) -> R, Do("if ({1+} & ({0} < {1})) {\nlet {r} = {0};\nlet {r+} = true;\n}\nelse {\nlet {r} = {1};\nlet {r+} = {1+};\n}"), [], first_plus, EXACT, |a, b| a.min(b), 8, 50),
    routine!("min_plus_second" Min(R, R) -> R, Do("if ((~{0+}) | ({0} < {1})) {\nlet {r} = {0};\nlet {r+} = {0+};\n}\nelse {\nlet {r} = {1};\nlet {r+} = true;\n}"), [], second_plus, EXACT, |a, b| a.min(b), 9, 50),
    routine!("min" Min(R, R) -> R, Do("if (Log.less({0}, {0+}, {1}, {1+})) {\nlet {r} = {0};\nlet {r+} = {0+};\n}\nelse {\nlet {r} = {1};\nlet {r+} = {1+};\n}"), ["Log.less"], everywhere, EXACT, |a, b| a.min(b), 18, 60),
    routine!("plus_max" Max(R, R) -> R, Do("let {r} = Math.max({0}, {1});\nlet {r+} = true;"), [], plus, EXACT, |a, b| a.max(b), 4, 14),
    routine!("max_zero" Max(R, R) -> R, Do("if ({0+}) {\nlet {r} = {0};\n}\nelse {\nlet {r} = -13312;\n}\nlet {r+} = true;"), [], against_zero, EXACT, |a, _b| a.max(Log::ZERO), 5, 30),
    routine!("zero_max" Max(R, R) -> R, Do("if ({1+}) {\nlet {r} = {1};\n}\nelse {\nlet {r} = -13312;\n}\nlet {r+} = true;"), [], from_zero, EXACT, |_a, b| Log::ZERO.max(b), 6, 30),
    routine!("max_plus_first" Max(R, R) -> R, Do("if ({1+} & ({0} < {1})) {\nlet {r} = {1};\n}\nelse {\nlet {r} = {0};\n}\nlet {r+} = true;"), [], first_plus, EXACT, |a, b| a.max(b), 9, 44),
    routine!("max_plus_second" Max(R, R) -> R, Do("if ((~{0+}) | ({0} < {1})) {\nlet {r} = {1};\n}\nelse {\nlet {r} = {0};\n}\nlet {r+} = true;"), [], second_plus, EXACT, |a, b| a.max(b), 10, 44),
    routine!("max" Max(R, R) -> R, Do("if (Log.less({0}, {0+}, {1}, {1+})) {\nlet {r} = {1};\nlet {r+} = {1+};\n}\nelse {\nlet {r} = {0};\nlet {r+} = {0+};\n}"), ["Log.less"], everywhere, EXACT, |a, b| a.max(b), 18, 60),
    routine!("floor" Floor(R) -> I, call("Log.floor({0}, {0+})"), ["Log.floor"], everywhere, STEP, |a| a.floor(), 92, 20),
    routine!("round" Round(R) -> I, call("Log.round({0}, {0+})"), ["Log.round"], everywhere, STEP, |a| a.round(), 105, 20),
    routine!("sign" Sign(R) -> I, call("Log.sign({0+})"), ["Log.sign"], everywhere, EXACT, |a| a.sign(), 7, 14),
    routine!("from_int" ToReal(I) -> R, Do("let {r+} = ~({0} < 0);\nlet {r} = Log.fromInt({0});"), ["Log.fromInt"], everywhere, Log::WHOLE, |a| Log::from_int(a), 41, 24),
    routine!("negative" Less(R, R) -> B, sum("~{0+}"), [], against_zero, EXACT, |a, _b| !a.plus, 0, 6),
    routine!("positive" Less(R, R) -> B, sum("{1+} & ({1} > (-13312))"), [], from_zero, EXACT, |_a, b| b.plus && b.log > model::LEAST, 4, 24),
    routine!("plus_less" Less(R, R) -> B, sum("{0} < {1}"), [], plus, EXACT, |a, b| a.less(b), 1, 12),
    routine!("less_plus" Less(R, R) -> B, sum("(~{0+}) | ({0} < {1})"), [], second_plus, EXACT, |a, b| a.less(b), 4, 24),
    routine!("plus_less_any" Less(R, R) -> B, sum("{1+} & ({0} < {1})"), [], first_plus, EXACT, |a, b| a.less(b), 3, 22),
    routine!("minus_less" Less(R, R) -> B, sum("{1+} | ({1} < {0})"), [], first_minus, EXACT, |a, b| a.less(b), 3, 22),
    routine!("less_minus" Less(R, R) -> B, sum("(~{0+}) & ({1} < {0})"), [], second_minus, EXACT, |a, b| a.less(b), 4, 24),
    routine!("less" Less(R, R) -> B, call("Log.less({0}, {0+}, {1}, {1+})"), ["Log.less"], everywhere, EXACT, |a, b| a.less(b), 13, 30),
    routine!("not_positive" LessEqual(R, R) -> B, sum("~({0+} & ({0} > (-13312)))"), [], against_zero, EXACT, |a, _b| !(a.plus && a.log > model::LEAST), 5, 26),
    routine!("not_negative" LessEqual(R, R) -> B, call("{1+}"), [], from_zero, EXACT, |_a, b| b.plus, 0, 4),
    routine!("plus_less_equal" LessEqual(R, R) -> B, sum("~({0} > {1})"), [], plus, EXACT, |a, b| !b.less(a), 2, 14),
    routine!("plus_less_equal_any" LessEqual(R, R) -> B, sum("{1+} & (~({1} < {0}))"), [], first_plus, EXACT, |a, b| !b.less(a), 4, 26),
    routine!("less_equal_plus" LessEqual(R, R) -> B, sum("~({0+} & ({1} < {0}))"), [], second_plus, EXACT, |a, b| !b.less(a), 4, 26),
    routine!("minus_less_equal" LessEqual(R, R) -> B, sum("{1+} | (~({0} < {1}))"), [], first_minus, EXACT, |a, b| !b.less(a), 4, 26),
    routine!("less_equal_minus" LessEqual(R, R) -> B, sum("~({0+} | ({0} < {1}))"), [], second_minus, EXACT, |a, b| !b.less(a), 4, 26),
    routine!("less_equal" LessEqual(R, R) -> B, sum("~Log.less({1}, {1+}, {0}, {0+})"), ["Log.less"], everywhere, EXACT, |a, b| !b.less(a), 14, 32),
    routine!("is_zero" Equal(R, R) -> B, sum("{0} < (-13311)"), [], against_zero, EXACT, |a, _b| a.log <= model::LEAST, 2, 12),
    routine!("equal" Equal(R, R) -> B, sum("({0} = {1}) & ({0+} = {1+})"), [], everywhere, EXACT, |a, b| a == b, 5, 24),
];

/// What is left where the signs differ: the first's sign is `$first`, the second's `$second`.
macro_rules! unlike {
    ($first:literal, $second:literal, $left:literal) => {
        concat!(
            "if ({0} < {1}) {\nlet {r} = ",
            $left,
            "({1}, {1} - {0});\nlet {r+} = ",
            $second,
            ";\n}\nelse {\nlet {r} = ",
            $left,
            "({0}, {0} - {1});\nlet {r+} = ",
            $first,
            ";\n}"
        )
    };
}

/// A sum of two values whose signs may differ, where `$same` says whether they do not:
/// its sign then is `$plus`, else that of the greater, `$first` or `$second`.
macro_rules! either {
    ($name:literal $op:ident, $same:literal, $plus:literal, [$first:literal $second:literal], $left:literal, $domain:expr, $model:ident, $cycles:literal) => {
        either!($name $op, $same, $plus, [$first $second], "", $left, $domain, $model, $cycles, 96)
    };
    ($name:literal $op:ident, $same:literal, $plus:literal, [$first:literal $second:literal], $high:literal, $left:literal, $domain:expr, $model:ident, $cycles:literal, $bytes:literal) => {
        routine!($name $op(R, R) -> R, Do(concat!(
            "if (", $same, ") {\nlet {r} = Log.sum({0}, {1});\n", $high, "let {r+} = ", $plus, ";\n}\nelse {\n",
            unlike!($first, $second, $left), "\n}"
        )), ["Log.sum", $left], $domain, Log::DIFFERENCES, |a, b| a.$model(b), $cycles, $bytes)
    };
}

/// A difference of two values that have one sign each, which are known.
macro_rules! left {
    ($name:literal $op:ident, [$first:literal $second:literal], $left:literal, $domain:expr, $model:ident, $cycles:literal) => {
        routine!($name $op(R, R) -> R, Do(unlike!($first, $second, $left)),
            [$left], $domain, Log::DIFFERENCES, |a, b| a.$model(b), $cycles, 68)
    };
}

/// The same where the sign of what is left is known, too, so that nobody writes it.
macro_rules! known_left {
    ($name:literal $op:ident, $difference:literal, $domain:expr, $model:ident, $cycles:literal) => {
        routine!($name $op(R, R) -> R, Do(concat!("let {r+} = {0+} = (~({0} < {1}));\nlet {r} = ", $difference, "({0}, {1});")),
            [$difference], $domain, Log::DIFFERENCES, |a, b| a.$model(b), $cycles, 20)
    };
}

/// The domain of those.
macro_rules! known {
    ($a:ident $b:ident | $c:ident $d:ident) => {
        |args: &[Range], result: Range| {
            known_sign(result).is_some()
                && (Log::signs(args, result, [sign!($a), sign!($b)])
                    || Log::signs(args, result, [sign!($c), sign!($d)]))
        }
    };
    ($a:ident $b:ident | $c:ident $d:ident, ample) => {
        |args: &[Range], result: Range| known!($a $b | $c $d)(args, result) && Log::ample(args)
    };
}

/// The domain of the one where nothing that is left needs clamping.
macro_rules! ample {
    ($a:ident $b:ident) => {
        |args: &[Range], result: Range| {
            Log::signs(args, result, [sign!($a), sign!($b)]) && Log::ample(args)
        }
    };
}

#[rustfmt::skip]
const SUMS_OF_SIGNS: &[Routine] = &[
    known_left!("ample_known_sum" Add, "Log.leave", known!(plus minus | minus plus, ample), add, 26),
    known_left!("known_sum" Add, "Log.difference", known!(plus minus | minus plus), add, 33),
    known_left!("ample_known_difference" Sub, "Log.leave", known!(plus plus | minus minus, ample), sub, 26),
    known_left!("known_difference" Sub, "Log.difference", known!(plus plus | minus minus), sub, 33),
    left!("ample_sum_less" Add, ["true" "false"], "Log.rest", ample!(plus minus), add, 28),
    left!("sum_less" Add, ["true" "false"], "Log.left", signs!(plus minus), add, 32),
    left!("ample_less_sum" Add, ["false" "true"], "Log.rest", ample!(minus plus), add, 28),
    left!("less_sum" Add, ["false" "true"], "Log.left", signs!(minus plus), add, 32),
    left!("ample_difference" Sub, ["true" "false"], "Log.rest", ample!(plus plus), sub, 28),
    left!("difference" Sub, ["true" "false"], "Log.left", signs!(plus plus), sub, 32),
    left!("ample_minus_difference" Sub, ["false" "true"], "Log.rest", ample!(minus minus), sub, 28),
    left!("minus_difference" Sub, ["false" "true"], "Log.left", signs!(minus minus), sub, 32),
    either!("ample_add_plus_first" Add, "{1+}", "true", ["true" "false"], "Log.rest", ample!(plus any), add, 30),
    either!("add_plus_first" Add, "{1+}", "true", ["true" "false"], "Log.left", signs!(plus any), add, 32),
    either!("ample_add_minus_first" Add, "~{1+}", "false", ["false" "true"], "Log.rest", ample!(minus any), add, 30),
    either!("add_minus_first" Add, "~{1+}", "false", ["false" "true"], "Log.left", signs!(minus any), add, 32),
    either!("ample_add_plus_second" Add, "{0+}", "true", ["false" "true"], "Log.rest", ample!(any plus), add, 30),
    either!("add_plus_second" Add, "{0+}", "true", ["false" "true"], "Log.left", signs!(any plus), add, 32),
    either!("ample_add_minus_second" Add, "~{0+}", "false", ["true" "false"], "Log.rest", ample!(any minus), add, 30),
    either!("add_minus_second" Add, "~{0+}", "false", ["true" "false"], "Log.left", signs!(any minus), add, 32),
    either!("ample_sub_plus_first" Sub, "~{1+}", "true", ["true" "false"], "Log.rest", ample!(plus any), sub, 31),
    either!("sub_plus_first" Sub, "~{1+}", "true", ["true" "false"], "Log.left", signs!(plus any), sub, 33),
    either!("ample_sub_minus_first" Sub, "{1+}", "false", ["false" "true"], "Log.rest", ample!(minus any), sub, 29),
    either!("sub_minus_first" Sub, "{1+}", "false", ["false" "true"], "Log.left", signs!(minus any), sub, 31),
    either!("ample_sub_plus_second" Sub, "~{0+}", "false", ["true" "false"], "Log.rest", ample!(any plus), sub, 30),
    either!("sub_plus_second" Sub, "~{0+}", "false", ["true" "false"], "Log.left", signs!(any plus), sub, 32),
    either!("ample_sub_minus_second" Sub, "{0+}", "true", ["false" "true"], "Log.rest", ample!(any minus), sub, 30),
    either!("sub_minus_second" Sub, "{0+}", "true", ["false" "true"], "Log.left", signs!(any minus), sub, 32),
    either!("ample_add" Add, "{0+} = {1+}", "{0+}", ["{0+}" "{1+}"], "Log.rest", |args, result| Log::high(result) && Log::ample(args), add, 31),
    either!("add" Add, "{0+} = {1+}", "{0+}", ["{0+}" "{1+}"], "Log.left", Log::fits, add, 33),
    either!("ample_sub" Sub, "{0+} = (~{1+})", "{0+}", ["{0+}" "~{1+}"], "Log.rest", |args, result| Log::high(result) && Log::ample(args), sub, 32),
    either!("sub" Sub, "{0+} = (~{1+})", "{0+}", ["{0+}" "~{1+}"], "Log.left", Log::fits, sub, 34),
    either!("any_add" Add, "{0+} = {1+}", "{0+}", ["{0+}" "{1+}"], "if ({r} > 16383) { let {r} = 16383; }\n", "Log.left", everywhere, add, 40, 120),
    either!("any_sub" Sub, "{0+} = (~{1+})", "{0+}", ["{0+}" "~{1+}"], "if ({r} > 16383) { let {r} = 16383; }\n", "Log.left", everywhere, sub, 41, 120),
];

#[rustfmt::skip]
const FUNCTIONS: &[Routine] = &[
    routine!("near_sin" Sin(R) -> R, Do("let {r} = Log.sin({0}, {0+});\nlet {r+} = Log.plus();"), ["Log.sin"], near_angle, NEAR_SINE, |a| a.sin(), 282, 26),
    routine!("sin" Sin(R) -> R, Do("let {r} = Log.sin({0}, {0+});\nlet {r+} = Log.plus();"), ["Log.sin"], angle, SINE, |a| a.sin(), 282, 26),
    routine!("any_sin" Sin(R) -> R, Do("let {r} = Log.sin({0}, {0+});\nlet {r+} = Log.plus();"), ["Log.sin"], everywhere, ANY_SINE, |a| a.sin(), 282, 26),
    routine!("near_cos" Cos(R) -> R, Do("let {r} = Log.quarterSine({0}, 1);\nlet {r+} = Log.plus();"), ["Log.sine"], near_angle, NEAR_SINE, |a| a.cos(), 287, 24),
    routine!("cos" Cos(R) -> R, Do("let {r} = Log.quarterSine({0}, 1);\nlet {r+} = Log.plus();"), ["Log.sine"], angle, SINE, |a| a.cos(), 287, 24),
    routine!("any_cos" Cos(R) -> R, Do("let {r} = Log.quarterSine({0}, 1);\nlet {r+} = Log.plus();"), ["Log.sine"], everywhere, ANY_SINE, |a| a.cos(), 287, 24),
    routine!("tan" Tan(R) -> R, Do("let {r} = Log.tan({0}, {0+});\nlet {r+} = Log.plus();"), ["Log.tan"], near_tangent, Log::TANGENT, |a| a.tan(), 497, 26),
    routine!("any_tan" Tan(R) -> R, Do("let {r} = Log.tan({0}, {0+});\nlet {r+} = Log.plus();"), ["Log.tan"], everywhere, Log::UNKNOWN, |a| a.tan(), 516, 26),
    routine!("asin" Asin(R) -> R, Do("let {r} = Log.asin({0});\nlet {r+} = {0+};"), ["Log.asin"], everywhere, Log::ARC, |a| a.asin(), 139, 22),
    routine!("acos" Acos(R) -> R, Do("let {r} = Log.acos({0}, {0+});\nlet {r+} = true;"), ["Log.acos"], everywhere, Log::ARC, |a| a.acos(), 163, 24),
    routine!("atan2" Atan2(R, R) -> R, Do("let {r} = Log.atan2({0}, {1}, {1+});\nlet {r+} = {0+};"), ["Log.atan2"], everywhere, Log::ARC, |a, b| a.atan2(b), 188, 30),
    routine!("near_exp" Exp(R) -> R, Do("let {r} = Log.exp({0}, {0+});\nlet {r+} = true;"), ["Log.exp"], near_angle, NEAR_EXP, |a| a.exp(), 232, 24),
    routine!("exp" Exp(R) -> R, Do("let {r} = Log.exp({0}, {0+});\nlet {r+} = true;"), ["Log.exp"], everywhere, Log::EXP, |a| a.exp(), 200, 24),
    routine!("log" Log(R) -> R, Do("let {r} = Log.log({0}, {0+});\nlet {r+} = Log.plus();"), ["Log.log"], Log::above_zero, Log::LOGARITHM, |a| a.log(), 71, 26),
    routine!("any_log" Log(R) -> R, Do("let {r} = Log.log({0}, {0+});\nlet {r+} = Log.plus();"), ["Log.log"], everywhere, Log::UNKNOWN, |a| a.log(), 51, 26),
    routine!("pow" Pow(R, R) -> R, Do("let {r} = Log.pow({0}, {0+}, {1}, {1+});\nlet {r+} = Log.plus();"), ["Log.pow"], Log::above_zero, Log::POWER, |a, b| a.pow(b), 286, 36),
    routine!("any_pow" Pow(R, R) -> R, Do("let {r} = Log.pow({0}, {0+}, {1}, {1+});\nlet {r+} = Log.plus();"), ["Log.pow"], everywhere, Log::UNKNOWN, |a, b| a.pow(b), 203, 36),
];

/// The routines of logarithms, and those of ints.
pub(super) static ALL: [Routine; OF_REALS.len() + INTS.len()] = joined(OF_REALS, INTS);

const OF_REALS: &[Routine] = &joined::<{ REALS.len() + SUMS_OF_SIGNS.len() + FUNCTIONS.len() }>(
    &joined::<{ REALS.len() + SUMS_OF_SIGNS.len() }>(REALS, SUMS_OF_SIGNS),
    FUNCTIONS,
);
