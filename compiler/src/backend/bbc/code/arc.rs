//! An arc tangent of two values in line: a call with two parameters takes as long as two products.

use super::Code;
use crate::backend::bbc::Style;
use crate::ir::graph::{Node, NodeId};
use crate::ir::tree::Place;
use slowlight_routine::Op;

impl Code<'_> {
    /// The angle of a point by tests, as the function has it, which is called for what lies
    /// to the left alone; whether the node is one.
    pub(super) fn arc(&mut self, id: NodeId) -> bool {
        let Node::Apply(Op::Atan2, [y, x]) = self.values.plan.graph.node(id) else {
            return false;
        };
        let quick = self.values.style == Style::Fast;
        if !quick || !self.values.simple(y) || !self.values.simple(x) {
            return false;
        }
        let [y, x] = [y, x].map(|id| self.values.read(id).text);
        let home = self.values.names.home(Place::Node(id)).to_owned();
        self.assign_before();
        // Of several ELSE on a line BASIC goes to the next, whichever IF it is of.
        let text = format!(
            "IF ABS({y})>ABS({x}) THEN {home}=SGN({y})*QUARTER-ATN({x}/{y}) \
             ELSE IF {x}>0 THEN {home}=ATN({y}/{x}) ELSE {home}=FNatan2({y},{x})"
        );
        self.lines.line(text, self.span);
        true
    }
}
