//! The back ends: from a plan to source text, with the scene's line behind each line.
//!
//! Emission cannot fail: what does not fit a machine is found by whoever
//! measures the text with the machine's own tools.

pub mod bbc;
pub mod colours;
pub mod jack;
pub mod mos6502;
mod starts;

use crate::plan::Plan;
use crate::source::Span;
use crate::targets::Language;

/// A generated source file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Document {
    /// Its file name.
    pub name: String,
    /// Its text, with `\n` line ends.
    pub text: String,
    /// For each line, the place in the scene that it comes from, if any.
    pub lines: Vec<Option<Span>>,
    /// Where statements of a line come from other places than its first: the line, from
    /// which statement on (both counted from 0), and the place; in this order.
    pub later: Vec<(usize, usize, Option<Span>)>,
}

impl Document {
    /// The place in the scene that a statement of a line comes from, if any; both are
    /// counted from 0.
    pub fn span(&self, line: usize, statement: usize) -> Option<Span> {
        let after = self
            .later
            .partition_point(|(l, s, _)| (*l, *s) <= (line, statement));
        let before = after.checked_sub(1).and_then(|at| self.later.get(at));
        match before {
            Some((found, _, span)) if *found == line => *span,
            _ => self.lines.get(line).copied().flatten(),
        }
    }
}

/// Writes a plan down.
pub fn emit(plan: &Plan) -> Vec<Document> {
    match plan.target.system.language() {
        Language::Jack => jack::emit(plan),
        Language::Basic => bbc::emit(plan),
        Language::Assembly => mos6502::emit(plan),
    }
}

/// Cycles that a plan's program takes before it begins the scene, about: for tables, params and
/// constants, and to open the screen.
pub fn starts(plan: &Plan) -> u64 {
    match plan.target.system.language() {
        Language::Jack => jack::starts(plan),
        Language::Basic => bbc::starts(plan),
        Language::Assembly => mos6502::starts(plan),
    }
}
