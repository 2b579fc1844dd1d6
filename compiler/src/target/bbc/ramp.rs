//! Ramps: variables that are set where a row or pass begins and stepped where a pixel ends.
//!
//! Every way through a pixel comes to its end, whatever it jumped over, and what
//! steps another ramp is stepped after it, so that each is right at the next column.

use super::Style;
use super::code::Code;
use super::text::Text;
use crate::flow::graph::{Node, NodeId};
use crate::flow::tree::Place;
use crate::plan::Plan;

/// Brings the ramps to a row's or pass's first column, which takes so many steps.
pub fn start(plan: &Plan, code: &mut Code<'_>, steps: &str) {
    if !plan.ramps().is_empty() {
        code.line(format!("FOR I%=1 TO {steps}"));
        step(plan, code);
        code.line("NEXT");
    }
}

/// Brings the ramps to a pass's first column, X%; `surely` if that takes a step at least.
pub fn start_at(plan: &Plan, code: &mut Code<'_>, passes: u32, surely: bool) {
    if plan.ramps().is_empty() {
        return;
    }
    // FOR runs its body once whatever its bounds are.
    let there = code.labels.next();
    if !surely {
        code.line(format!("IF X%<{passes} THEN {there}"));
    }
    start(plan, code, &format!("X% DIV {passes}"));
    code.lines.place(there);
}

/// Brings the ramps to the next column.
pub fn step(plan: &Plan, code: &mut Code<'_>) {
    for (id, by) in plan.ramps() {
        add(plan, code, id, by);
    }
}

/// Adds a step to what is stepped.
pub fn add(plan: &Plan, code: &mut Code<'_>, id: NodeId, by: NodeId) {
    let place = Place::of(&plan.graph, id);
    let home = code.values.names.home(place).to_owned();
    let by = amount(plan, code, by);
    let text = match by.strip_prefix('-') {
        Some(less) => format!("{home}={home}-{less}"),
        None => format!("{home}={home}+{by}"),
    };
    code.statement(text);
}

/// A step. Each digit of a number takes BASIC II as long as a resident
/// variable's name, and a step is taken at every pixel.
fn amount(plan: &Plan, code: &mut Code<'_>, by: NodeId) -> String {
    let text = match plan.graph.node(by) {
        Node::Ramp { .. } => Text::operand(code.values.names.home(Place::Node(by))),
        _ => code.values.read(by),
    };
    let number = plan.graph.constant(by).map(|value| value.int());
    let quick = matches!(code.values.style, Style::Fast | Style::Lean);
    match number.filter(|n| quick && n.unsigned_abs() > 9) {
        Some(_) => code.values.names.whole(&text.text),
        None => text.at(slowlight_runtime_bbc::level::PRODUCT),
    }
}
