//! Loop-invariant code motion, where it makes a plan cheaper: by a profile of the plan's own
//! statements ([`crate::passes::loops::licm`]).

use crate::cost::size_budget::SizeBudget;
use crate::ir::graph::{Graph, LoopId, NodeId};
use crate::passes::loops::licm::hoisted;
use crate::planner::context::Context;
use crate::planner::pipeline::Pass;
use crate::schedule::analysed::Analysed;
use std::collections::BTreeSet;

/// By how much that must make the plan cheaper: what a variable more costs is not known so well.
const CHEAPER: f64 = 0.99;

/// The plan with what its loops' turns have in common before them, where that pays; after all
/// passes that rebuild the graph.
pub fn licm(plan: Analysed, cx: &Context, budget: SizeBudget) -> Analysed {
    if plan.graph.loops.is_empty() {
        return plan;
    }
    let next = cx.always(Pass::Licm, || hoisted_where_cheaper(&plan, cx, budget));
    next.unwrap_or(plan)
}

fn hoisted_where_cheaper(plan: &Analysed, cx: &Context, budget: SizeBudget) -> Option<Analysed> {
    let price = cx.price(budget);
    let counts = price.counts(plan);
    let found = counts.map(|ran| hoisted(&plan.graph, &plan.tree.pixel, &ran));
    let hoisted: BTreeSet<(NodeId, LoopId)> = found.unwrap_or_default().into_keys().collect();
    if hoisted.is_empty() {
        return None;
    }
    let next = cx.scheduled(Graph {
        hoisted,
        ..plan.graph.clone()
    });
    (price.as_it_stands(&next) < CHEAPER * price.as_it_stands(plan)).then_some(next)
}
