//! Sums as the Hack's processor has them: which of two is greater is dear to tell there, and
//! its ROM is small, so that subroutines do more. By name and value those of the VM's list,
//! which has their domains.

use super::routines::ALL;
use slowlight_routine::log::LOG as R;
use slowlight_routine::log::domains::never;
use slowlight_routine::log::model::{Log, Log as Real};
use slowlight_routine::{Form, Op, Routine};

use Form::Statement as Do;

/// A sum of two values whose signs may differ, where `$same` says whether they do not:
/// its sign then is `$plus`, else `$greater`.
macro_rules! either {
    ($name:literal $op:ident, $same:literal, $plus:literal, $greater:literal, $difference:literal, $model:ident) => {
        routine!($name $op(R, R) -> R, Do(concat!(
            "if (", $same, ") {\nlet {r} = Log.sum({0}, {1});\nlet {r+} = ", $plus, ";\n}\nelse {\nlet {r+} = ", $greater,
            ";\nlet {r} = ", $difference, "({0}, {1});\n}"
        )), ["Log.sum", $difference], never, Log::DIFFERENCES, |a, b| a.$model(b), 36, 60)
    };
}

/// A difference of two values that have one sign each, which are known.
macro_rules! left {
    ($name:literal $op:ident, $greater:literal, $difference:literal, $model:ident) => {
        routine!($name $op(R, R) -> R, Do(concat!("let {r+} = ", $greater, ";\nlet {r} = ", $difference, "({0}, {1});")),
            [$difference], never, Log::DIFFERENCES, |a, b| a.$model(b), 36, 24)
    };
}

#[rustfmt::skip]
const SHORT: &[Routine] = &[
    left!("ample_sum_less" Add, "~({0} < {1})", "Log.leave", add),
    left!("sum_less" Add, "~({0} < {1})", "Log.difference", add),
    left!("ample_less_sum" Add, "{0} < {1}", "Log.leave", add),
    left!("less_sum" Add, "{0} < {1}", "Log.difference", add),
    left!("ample_difference" Sub, "~({0} < {1})", "Log.leave", sub),
    left!("difference" Sub, "~({0} < {1})", "Log.difference", sub),
    left!("ample_minus_difference" Sub, "{0} < {1}", "Log.leave", sub),
    left!("minus_difference" Sub, "{0} < {1}", "Log.difference", sub),
    either!("ample_add_plus_first" Add, "{1+}", "true", "~({0} < {1})", "Log.leave", add),
    either!("add_plus_first" Add, "{1+}", "true", "~({0} < {1})", "Log.difference", add),
    either!("ample_add_minus_first" Add, "~{1+}", "false", "{0} < {1}", "Log.leave", add),
    either!("add_minus_first" Add, "~{1+}", "false", "{0} < {1}", "Log.difference", add),
    either!("ample_add_plus_second" Add, "{0+}", "true", "{0} < {1}", "Log.leave", add),
    either!("add_plus_second" Add, "{0+}", "true", "{0} < {1}", "Log.difference", add),
    either!("ample_add_minus_second" Add, "~{0+}", "false", "~({0} < {1})", "Log.leave", add),
    either!("add_minus_second" Add, "~{0+}", "false", "~({0} < {1})", "Log.difference", add),
    either!("ample_sub_plus_first" Sub, "~{1+}", "true", "~({0} < {1})", "Log.leave", sub),
    either!("sub_plus_first" Sub, "~{1+}", "true", "~({0} < {1})", "Log.difference", sub),
    either!("ample_sub_minus_first" Sub, "{1+}", "false", "{0} < {1}", "Log.leave", sub),
    either!("sub_minus_first" Sub, "{1+}", "false", "{0} < {1}", "Log.difference", sub),
    either!("ample_sub_plus_second" Sub, "~{0+}", "false", "~({0} < {1})", "Log.leave", sub),
    either!("sub_plus_second" Sub, "~{0+}", "false", "~({0} < {1})", "Log.difference", sub),
    either!("ample_sub_minus_second" Sub, "{0+}", "true", "{0} < {1}", "Log.leave", sub),
    either!("sub_minus_second" Sub, "{0+}", "true", "{0} < {1}", "Log.difference", sub),
    either!("ample_add" Add, "{0+} = {1+}", "{0+}", "(~({0} < {1})) = {0+}", "Log.leave", add),
    either!("add" Add, "{0+} = {1+}", "{0+}", "(~({0} < {1})) = {0+}", "Log.difference", add),
    either!("ample_sub" Sub, "{0+} = (~{1+})", "{0+}", "(~({0} < {1})) = {0+}", "Log.leave", sub),
    either!("sub" Sub, "{0+} = (~{1+})", "{0+}", "(~({0} < {1})) = {0+}", "Log.difference", sub),
    routine!("any_add" Add(R, R) -> R, Do("let {r} = Log.clamp(Log.add({0}, {0+}, {1}, {1+}));\nlet {r+} = Log.plus();"), ["Log.add", "Log.clamp"], never, Log::DIFFERENCES, |a, b| a.add(b), 61, 36),
    routine!("any_sub" Sub(R, R) -> R, Do("let {r} = Log.clamp(Log.add({0}, {0+}, {1}, ~{1+}));\nlet {r+} = Log.plus();"), ["Log.add", "Log.clamp"], never, Log::DIFFERENCES, |a, b| a.sub(b), 62, 37),
];

/// The routine that a program for the processor has for one of the VM's.
pub fn on_processor(routine: &'static Routine) -> &'static Routine {
    let is_same = |short: &&Routine| short.name == routine.name && short.op == routine.op;
    let listed = ALL.iter().any(|own| std::ptr::eq(own, routine));
    let short = SHORT.iter().find(is_same).filter(|_| listed);
    short.unwrap_or(routine)
}
