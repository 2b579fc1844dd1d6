//! What stands behind a picture's statements: reports, the set-up, procedures, and those of
//! the runtime's functions that are called.

use super::super::code::Code;
use super::super::pieces::{Piece, pieces};
use super::super::short::SELDOM;
use super::super::tables;
use super::super::{Style, is_first};
use crate::ir::graph::ParamId;
use crate::ir::tree::SubroutineId;
use crate::plan::Plan;
use slowlight_routine::{Part, Source, Type};

/// A table's index clamped to 0..n.
const FN_INDEX: &str = "\
DEF FNindex(i%,n%)
IF i%<0 THEN =0
IF i%>n% THEN =n% ELSE =i%
";

/// The file of what a graph reports.
const REPORTS: &str = "REPORTS";

/// Writes what the graph reports to a file, in the machine's own bytes.
pub(super) fn reports(plan: &Plan, code: &mut Code<'_>) {
    if plan.graph.reports.is_empty() {
        return;
    }
    let channel = code.values.names.unique("channel", "%");
    code.line(format!("{channel}=OPENOUT(\"{REPORTS}\")"));
    for &id in &plan.graph.reports {
        let value = code.values.read(id).text;
        code.line(format!("PRINT#{channel},{value}"));
    }
    code.line(format!("CLOSE#{channel}"));
}

/// The parts that the program calls or reads, as far as it is written, and those that
/// they need: an expression may have taken a function's place.
pub fn called(plan: &Plan, code: &Code<'_>) -> Vec<&'static Part> {
    let has = |text: &str, part: &Part| match is_first(part) {
        true => pieces(text).contains(&Piece::Name(part.name)),
        false => text.contains(&format!("{}(", part.name)),
    };
    let parts = plan.runtime.parts.iter();
    let names: Vec<&'static str> = parts
        .filter(|part| code.lines.texts().any(|text| has(text, part)))
        .map(|part| part.name)
        .collect();
    plan.runtime.closure(names)
}

/// Whether functions are called only where a test fails, and where little is done.
pub(super) fn called_rarely(code: &Code<'_>) -> bool {
    let tests = code.values.style == Style::Fast;
    tests
        && code.lines.weighted().all(|(text, weight)| {
            let usual = match text.split_once(" ELSE ") {
                Some((usual, _)) if usual.starts_with("IF ") => usual,
                _ => text,
            };
            weight <= SELDOM || !usual.contains("FN")
        })
}

pub(super) fn setup(plan: &Plan, code: &mut Code<'_>, parts: &[&Part], first: &str, last: &str) {
    code.line("DEF PROCsetup");
    let must = match plan.brief {
        true => ":",
        false => " must be from",
    };
    for (k, (param, written)) in plan.graph.params.iter().zip(&plan.params).enumerate() {
        if plan.is_held(ParamId(k as u32)) {
            continue;
        }
        let name = code.values.names.param(k).to_owned();
        if let Some((lo, hi)) = &written.range {
            code.lines.line(
                format!(
                    "IF {name}<{lo} OR {name}>{hi} THEN PRINT \"{name}{must} {lo} to {hi}\":END"
                ),
                Some(param.span),
            );
        }
        if param.ty == Type::Bool {
            code.statement(format!("{name}={name}<>0"));
        }
    }
    let (top, bottom) = plan.shown_rows();
    code.line(format!(
        "IF {first}<{top} OR {last}>{bottom} OR {first}>{last} THEN PRINT \"rows{must} {top} to {bottom}\":END"
    ));
    for part in parts {
        if is_first(part)
            && let Source::Text(text) = part.source
        {
            text.lines().for_each(|l| code.statement(l));
        }
    }
    let names = &code.values.names;
    let constants: Vec<String> = names.constants().chain(names.copies()).collect();
    for text in constants {
        code.statement(text);
    }
    tables::make(plan, code);
    code.line("ENDPROC");
}

/// What is called from several places.
pub fn procedures(plan: &Plan, code: &mut Code<'_>) {
    code.ends = code.ends_called.take();
    for (k, subroutine) in plan.tree.subroutines.iter().enumerate() {
        let id = SubroutineId(k as u32);
        let name = code.values.names.procedure(id).to_owned();
        let span = Some(subroutine.span);
        if code.values.style == Style::Listing {
            let calls = plan.tree.calls(id);
            let about = format!("REM {}, called from {calls} places", subroutine.label());
            code.lines.line(about, span);
        }
        code.lines.line(format!("DEF PROC{name}"), span);
        code.block(&subroutine.body);
        code.lines.line("ENDPROC", span);
    }
    code.ends = None;
}

pub fn functions(code: &mut Code<'_>, parts: &[&Part]) {
    let mut whole = |text: &str| text.lines().for_each(|l| code.line(l));
    for part in parts {
        if let Source::Text(text) = part.source
            && text.starts_with("DEF")
        {
            whole(text);
        }
    }
    if code.values.clamps {
        FN_INDEX.lines().for_each(|l| code.line(l));
    }
}
