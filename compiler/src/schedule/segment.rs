//! Run-invariant code: what depends on the column only through comparisons with what the row
//! knows, and so is the same for a run of columns.

use crate::analysis::needed::needed;
use crate::analysis::rate::{Dependence, Rates, rates};
use crate::ir::graph::*;
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

/// What runs of columns know of a graph.
pub struct Known<'g> {
    pub graph: &'g Graph,
    rates: Rates,
    runs: Vec<bool>,
}

impl<'g> Known<'g> {
    pub fn of(graph: &'g Graph) -> Known<'g> {
        let rates = rates(graph);
        let runs = by_segment(graph, &rates, &needed(graph));
        Known { graph, rates, runs }
    }

    /// Whether a value is known before a run's first pixel.
    pub fn before(&self, id: NodeId) -> bool {
        self.rates.is_still(id) || self.runs[id.0 as usize]
    }

    /// Whether a bool is another at each pixel and costs little to ask: a comparison of
    /// what is stepped from column to column with what is the same for the pass.
    pub fn stepped(&self, id: NodeId) -> bool {
        let Node::Apply(op, args) = self.graph.node(id) else {
            return false;
        };
        let ramp = |id: &NodeId| matches!(self.graph.node(*id), Node::Ramp { .. });
        matches!(op, Op::IntLess | Op::IntLessEqual | Op::IntEqual)
            && args.iter().any(ramp)
            && args.iter().all(|id| ramp(id) || self.rates.is_still(*id))
    }
}
