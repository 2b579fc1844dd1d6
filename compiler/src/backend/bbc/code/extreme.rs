//! Minima and maxima as an IF.

use super::Code;
use crate::backend::bbc::Style;
use crate::ir::graph::{Node, NodeId};
use crate::ir::tree::Place;
use slowlight_routine::Op;

impl Code<'_> {
    /// The smaller or larger of two values by an IF, which is quicker than a
    /// function; whether the node is one.
    pub(super) fn extreme(&mut self, id: NodeId) -> bool {
        if self.values.style == Style::Listing {
            return false;
        }
        let Node::Apply(op, [a, b]) = self.values.plan.graph.node(id) else {
            return false;
        };
        let sign = match op {
            Op::Min | Op::IntMin => ">",
            Op::Max | Op::IntMax => "<",
            _ => return false,
        };
        if !self.values.simple(b) {
            return false;
        }
        let (first, second) = (self.values.read(a), self.values.read(b).text);
        let home = self.values.names.home(Place::Node(id)).to_owned();
        let quick = matches!(self.values.style, Style::Fast | Style::Lean);
        self.assign_before();
        let text = match home == second {
            // One that is no expression: a variable, or an entry of an array.
            true if first.is_simple() || !self.values.plan.folded(a) => {
                format!("IF {home}{sign}{0} THEN {home}={0}", first.text)
            }
            true => return false,
            // What is a variable is compared first, and one of the two assigned: not both in turn.
            false if quick && first.is_simple() && first.text != home => format!(
                "IF {0}{sign}{second} THEN {home}={second} ELSE {home}={0}",
                first.text
            ),
            false => {
                self.assign(&home, &first);
                format!("IF {home}{sign}{second} THEN {home}={second}")
            }
        };
        self.lines.line(text, self.span);
        true
    }
}
