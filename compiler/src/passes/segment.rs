//! What is the same for a run of columns: what depends on the column only through
//! comparisons with what the row knows.

use super::rate::{Dependence, Rates};
use crate::flow::graph::*;
use slowlight_routine::Op;

/// How many comparisons may cut a row into runs, and how many columns there
/// should be for each at least. Whether the runs pay is for the plan to find out.
const RUNS: usize = 32;
const COLUMNS: usize = 10;

/// Whether an operation compares the column with what is the same for a whole row.
pub fn bounds_segment(graph: &Graph, rates: &Rates, id: NodeId) -> bool {
    let Node::Apply(Op::IntLess | Op::IntLessEqual, [a, b]) = graph.node(id) else {
        return false;
    };
    let column = |id| graph.node(id) == Node::Axis(Axis::X);
    let still = |id| rates.is_still(id);
    column(a) && still(b) || column(b) && still(a)
}

/// Which values depend on the column through such comparisons alone; none where
/// those cut a row into too many runs.
pub fn by_segment(graph: &Graph, rates: &Rates, needed: &[bool]) -> Vec<bool> {
    let mut found = vec![false; graph.nodes.len()];
    let mut bounds = 0;
    for id in graph.ids().filter(|id| needed[id.0 as usize]) {
        if bounds_segment(graph, rates, id) {
            found[id.0 as usize] = true;
            bounds += 1;
            continue;
        }
        let fits = |a: NodeId| found[a.0 as usize] || !rates.depends(a, Dependence::Column);
        found[id.0 as usize] = match graph.node(id) {
            Node::Axis(Axis::Run) => true,
            node @ (Node::Apply(..) | Node::Select { .. } | Node::Lookup { .. }) => {
                rates.depends(id, Dependence::Column) && node.operands().all(fits)
            }
            _ => false,
        };
    }
    if bounds >= RUNS || (bounds + 1) * COLUMNS > graph.image.width as usize {
        return vec![false; graph.nodes.len()];
    }
    found
}
