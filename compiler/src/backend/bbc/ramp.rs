//! Ramps: variables that are set where a row or pass begins and stepped where a pixel ends.
//!
//! Every way through a pixel comes to its end, whatever it jumped over, and what
//! steps another ramp is stepped after it, so that each is right at the next column.

use super::Style;
use super::code::{Code, Late};
use super::reads;
use super::text::Text;
use crate::ir::graph::{Node, NodeId};
use crate::ir::tree::Place;
use crate::plan::Plan;
use crate::schedule::constant_runs::Inks;

/// Brings the ramps to a row's or pass's first column, which takes so many steps.
pub fn start(plan: &Plan, code: &mut Code<'_>, steps: &str) {
    if !plan.ramps().is_empty() {
        code.line(format!("FOR I%=1 TO {steps}"));
        for (id, by) in plan.ramps() {
            code.add_step(id, by);
        }
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

/// Brings the ramps to the next column, but for those that are stepped late.
pub fn step(plan: &Plan, code: &mut Code<'_>) {
    for (id, by) in plan.ramps() {
        let late = |late: &Late| late.ramps.contains(&(id, by));
        if !code.late.as_ref().is_some_and(late) {
            code.add_step(id, by);
        }
    }
}

/// Adds a step to what is stepped.
impl Code<'_> {
    /// Adds a step to what is stepped.
    pub fn add_step(&mut self, id: NodeId, by: NodeId) {
        let text = added(self.values.plan, self, id, by);
        self.statement(text);
    }
}

fn added(plan: &Plan, code: &mut Code<'_>, id: NodeId, by: NodeId) -> String {
    let place = Place::of(&plan.graph, id);
    let home = code.values.names.home(place).to_owned();
    let by = amount(plan, code, by);
    match by.strip_prefix('-') {
        Some(less) => format!("{home}={home}-{less}"),
        None => format!("{home}={home}+{by}"),
    }
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

impl Late {
    /// Those of a plan whose runs of known inks are drawn apart.
    pub fn of(plan: &Plan, code: &mut Code<'_>) -> Option<Late> {
        let Some(Inks::Either { .. }) = plan.still.as_ref().map(|still| still.inks) else {
            return None;
        };
        let all = plan.ramps();
        let elsewhere = [reads::pixel(plan), reads::segment(plan)];
        let ramp = |id: NodeId| matches!(plan.graph.node(id), Node::Ramp { .. });
        let free = |id: NodeId| {
            let read = elsewhere.iter().any(|reads| reads.read(id));
            !read && all.iter().all(|(_, by)| *by != id)
        };
        let ramps: Vec<(NodeId, NodeId)> = all
            .iter()
            .copied()
            .filter(|(id, by)| free(*id) && !ramp(*by))
            .collect();
        (!ramps.is_empty()).then(|| Late {
            ramps,
            at: code.values.names.unique("stepped", "%"),
        })
    }
}

/// Where a row or pass begins, or behind a run for which late ramps were stepped: they
/// stand at what `at` counts.
pub fn are_at(code: &mut Code<'_>, at: &str) {
    if let Some(late) = &code.late {
        let text = format!("{}={at}", late.at);
        code.statement(text);
    }
}

/// Brings late ramps to where `at` is, which grows by so much from column to column.
pub fn catch_up(plan: &Plan, code: &mut Code<'_>, at: &str, by: u32) {
    let Some(late) = code.late.take() else {
        return;
    };
    let own = &late.at;
    let steps = late
        .ramps
        .iter()
        .map(|(id, step)| added(plan, code, *id, *step));
    let steps: Vec<String> = steps.collect();
    code.line(format!(
        "IF {own}<{at} THEN FOR {own}={own} TO {at}-{by}{}:{}:NEXT",
        strided(by),
        steps.join(":")
    ));
    code.late = Some(late);
}

/// Steps late ramps at a pixel of a run that reads them.
pub fn step_late(code: &mut Code<'_>) {
    let ramps = code.late.as_ref().map(|late| late.ramps.clone());
    for (id, by) in ramps.unwrap_or_default() {
        code.add_step(id, by);
    }
}

/// How a FOR loop says by how much it counts.
pub fn strided(by: u32) -> String {
    match by {
        1 => String::new(),
        n => format!(" STEP {n}"),
    }
}
