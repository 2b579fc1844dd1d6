//! Available expressions: whether what a comparison compares is at hand anyway, needed as it is
//! by something else.

use super::Site;
use crate::ir::graph::*;
use slowlight_routine::Type;

impl Site<'_> {
    /// Whether a comparison costs no more than itself: what it compares is computed as it
    /// is for something else.
    pub(super) fn at_hand(&self, id: NodeId, replaced: &[NodeId]) -> bool {
        let graph = self.forms.graph;
        let Node::Apply(op, _) = graph.node(id) else {
            return false;
        };
        let value = |user: &NodeId| graph.ty(*user) != Type::Bool;
        op.result() == Type::Bool
            && graph.node(id).operands().all(|x| {
                let there = || self.users[x.0 as usize].iter().any(value);
                !self.forms.pixel(x) || (there() && !replaced.contains(&x))
            })
    }
}
