//! Data dependence on the start of a run of columns: which values are made of the column where a
//! run begins.

use crate::ir::graph::*;

/// Which values are made of the column where a run begins, other than by stepping.
pub fn of_beginnings(graph: &Graph) -> Vec<bool> {
    let mut found: Vec<bool> = Vec::with_capacity(graph.nodes.len());
    for id in graph.ids() {
        let of = match graph.node(id) {
            Node::Axis(Axis::Run) => true,
            Node::Stepped { .. } => false,
            node => node.operands().any(|operand| found[operand.0 as usize]),
        };
        found.push(of);
    }
    found
}
