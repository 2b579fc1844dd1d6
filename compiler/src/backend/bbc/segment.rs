//! Segments: a row's loop over its columns, cut where a comparison changes.
//!
//! What depends on the column only through comparisons with what the row knows
//! stands in the plan's segment block. It is carried out at a run's first column;
//! each comparison in it, as it is met, also says how far the run goes at most.
//! So a comparison that is not reached there ends no run.

use super::Style;
use super::code::{Code, Ends};
use super::lines::{Label, Lines};
use super::ramp;
use crate::analysis::rate::rates;
use crate::ir::graph::*;
use crate::plan::Plan;
use crate::schedule::constant_runs::{Inks, Still};
use crate::schedule::segment::bounds_segment;
use slowlight_routine::Op;
use slowlight_runtime_bbc::level::OPERAND;

/// How often a segment's statements are carried out, roughly: for the weights
/// of names only.
pub const SEGMENT: u64 = 1_500;

/// The same for the pixels of runs whose ink is known.
const STILL: u64 = 20_000;

/// A row in runs of columns.
pub struct Segments {
    /// The variable of a run's last column.
    end: String,
    /// The last column of all.
    last: u32,
}

impl Segments {
    /// Where the plan has such.
    pub fn new(plan: &Plan, code: &mut Code<'_>) -> Option<Segments> {
        (!plan.tree.segment.is_empty()).then(|| Segments {
            end: code.values.names.unique("end", "%"),
            last: plan.computed_columns().1,
        })
    }

    /// The variable of a run's last column.
    pub fn end(&self) -> &str {
        &self.end
    }

    /// The statements at a run's first column. Where `draw` says how, runs whose ink
    /// is known are drawn there; then X% is behind the run's end.
    pub fn begin(&self, plan: &Plan, code: &mut Code<'_>, draw: Option<&Draw>) {
        let weight = std::mem::replace(&mut code.lines.weight, SEGMENT);
        code.statement(format!("{}={}", self.end, self.last));
        let rates = rates(&plan.graph);
        let bounds = plan.graph.ids();
        code.ends = Some(Ends {
            end: self.end.clone(),
            bounds: bounds
                .filter(|id| bounds_segment(&plan.graph, &rates, *id))
                .collect(),
        });
        code.block(&plan.tree.segment);
        code.ends_called = code.ends.take();
        if let (Some(still), Some(draw)) = (&plan.still, draw) {
            self.still(still, plan, code, draw);
        }
        code.lines.weight = weight;
    }

    /// Goes behind a run that was drawn. Where one condition says of every run
    /// whether it is, that is known at the pixels of the others.
    pub fn drawn(&self, plan: &Plan, code: &mut Code<'_>, behind_run: Label) {
        let Some(still) = &plan.still else {
            return;
        };
        code.line(format!("IF X%>{} THEN {behind_run}", self.end));
        code.known = still.otherwise();
    }
}

/// How a run is drawn whose inks are known.
pub struct Draw {
    /// What counts its pixels: a variable, up to where, and how far it goes each time.
    pub count: String,
    pub to: String,
    pub by: u32,
    /// What is done behind it.
    pub behind: Option<String>,
    /// Variables of what is drawn for one ink and for another.
    pub names: [String; 2],
    /// What stands before an ink for that.
    pub of: String,
    /// What is done once and at every column where all show the first.
    pub once: Vec<String>,
    pub each: Vec<String>,
    /// What is done at a column for each, and then.
    pub either: [String; 2],
    pub then: Vec<String>,
}

impl Draw {
    /// The beginning of a loop over a run.
    pub fn head(&self) -> String {
        let Draw { count, to, by, .. } = self;
        format!("FOR {count}={count} TO {to}{}", ramp::strided(*by))
    }

    fn set(&self, which: usize, ink: NodeId, code: &mut Code<'_>) {
        let ink = code.values.read(ink).at(OPERAND);
        code.statement(format!("{}={}{ink}", self.names[which], self.of));
    }

    fn behind(&self, code: &mut Code<'_>) {
        code.statement("NEXT");
        if let Some(text) = &self.behind {
            code.statement(text);
        }
    }
}

impl Segments {
    /// Draws a run whose inks are known.
    fn still(&self, still: &Still, plan: &Plan, code: &mut Code<'_>, draw: &Draw) {
        let other = code.labels.next();
        for &(cond, holds) in &still.conditions {
            let fails = code.values.condition(cond, !holds);
            code.line(format!("IF {fails} THEN {other}"));
        }
        match still.inks {
            Inks::One(ink) => {
                draw.set(0, ink, code);
                self.one(plan, code, draw);
            }
            Inks::Either { cond, yes, no } => {
                draw.set(0, yes, code);
                if code.values.style == Style::Fast && still.may_agree(&plan.graph) {
                    self.agreeing([yes, no], plan, code, draw, other);
                }
                draw.set(1, no, code);
                self.either(cond, plan, code, draw);
            }
        }
        code.lines.place(other);
    }

    /// Draws a run of the first ink.
    fn one(&self, plan: &Plan, code: &mut Code<'_>, draw: &Draw) {
        draw.once.iter().for_each(|text| code.line(text));
        code.statement(draw.head());
        let weight = std::mem::replace(&mut code.lines.weight, STILL);
        draw.each
            .iter()
            .for_each(|text| code.statement_or_test(text));
        ramp::step(plan, code);
        code.lines.weight = weight;
        draw.behind(code);
    }

    /// Where two inks are one after all, nothing is asked at the pixels.
    fn agreeing(
        &self,
        inks: [NodeId; 2],
        plan: &Plan,
        code: &mut Code<'_>,
        draw: &Draw,
        other: Label,
    ) {
        let [yes, no] = inks.map(|ink| code.values.read(ink).at(OPERAND));
        let weight = code.lines.weight;
        let outer = std::mem::replace(&mut code.lines, Lines::of_weight(STILL));
        self.one(plan, code, draw);
        let lines = std::mem::replace(&mut code.lines, outer);
        match lines.in_one_line() {
            Some(text) => code.line(format!("IF {yes}={no} THEN {text}:GOTO {other}")),
            None => {
                let differ = code.labels.next();
                code.line(format!("IF {yes}<>{no} THEN {differ}"));
                code.lines.append(lines);
                code.line(format!("GOTO {other}"));
                code.lines.place(differ);
            }
        }
        code.lines.weight = weight;
    }

    /// Draws a run of two inks.
    fn either(&self, cond: NodeId, plan: &Plan, code: &mut Code<'_>, draw: &Draw) {
        ramp::catch_up(plan, code, &draw.count, draw.by);
        code.line(draw.head());
        let weight = std::mem::replace(&mut code.lines.weight, STILL);
        let cond = code.values.compute(cond).text;
        let [yes, no] = &draw.either;
        code.line(format!("IF {cond} THEN {yes} ELSE {no}"));
        draw.then
            .iter()
            .for_each(|text| code.statement_or_test(text));
        ramp::step(plan, code);
        ramp::step_late(code);
        code.lines.weight = weight;
        draw.behind(code);
        ramp::are_at(code, &draw.count);
    }
}

impl Code<'_> {
    /// Ends the run before a comparison with the column changes, if the node is one.
    pub fn end_run(&mut self, id: NodeId) {
        let Some(Ends { end, bounds }) = &self.ends else {
            return;
        };
        let Node::Apply(op, [a, b]) = self.values.plan.graph.node(id) else {
            return;
        };
        if !bounds.contains(&id) {
            return;
        }
        let end = end.clone();
        let first = self.values.plan.graph.node(a) == Node::Axis(Axis::X);
        let column = self.values.read(if first { b } else { a }).text;
        // x < c and c <= x change at c, the others behind it.
        let text = match (op == Op::IntLess) == first {
            true => format!("IF X%<{column} THEN IF {column}<={end} THEN {end}={column}-1"),
            false => format!("IF X%<={column} THEN IF {column}<{end} THEN {end}={column}"),
        };
        self.lines.line(text, self.span());
    }
}
