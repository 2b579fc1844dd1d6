//! Search over scalar expansion: which values are computed once a column, of what
//! [`crate::passes::loops::scalar_expansion`] offers, where that makes the plan cheaper, also
//! after products are made term by term.

use crate::cost::size_budget::SizeBudget;
use crate::ir::graph::NodeId;
use crate::passes::algebra::distribute::distribute;
use crate::passes::loops::scalar_expansion::{columns, tabulated};
use crate::planner::context::Context;
use crate::planner::pipeline::Pass;
use crate::schedule::analysed::Analysed;
use crate::targets::Target;
use std::collections::BTreeSet;

/// By how much arrays must make the plan cheaper.
const CHEAPER: f64 = 0.98;

/// The plan with what hangs on the column alone in arrays, where that pays; after all
/// passes that rebuild the graph.
pub fn in_columns(
    plan: Analysed,
    cx: &Context,
    target: &'static Target,
    budget: SizeBudget,
) -> Analysed {
    if plan.graph.image.width > target.columns {
        return plan;
    }
    let expand = |plan: &Analysed| cx.always(Pass::ScalarExpansion, || expanded(plan, cx, budget));
    let found = expand(&plan);
    // A product leaves the pixel where what it is of is in arrays, and not before.
    let apart = || {
        let graph = distribute(&plan.graph, &plan.ranges)?;
        let next = expand(&cx.simplified(&graph))?;
        let price = cx.price(budget);
        let now = price.of(found.as_ref().unwrap_or(&plan));
        (price.of(&next) < CHEAPER * now).then_some(next)
    };
    let apart = match cx.fuel.spent() {
        true => None,
        false => cx.always(Pass::Distribute, apart),
    };
    apart.or(found).unwrap_or(plan)
}

fn expanded(plan: &Analysed, cx: &Context, budget: SizeBudget) -> Option<Analysed> {
    let found = columns(&plan.graph)?;
    let price = cx.price(budget);
    let with = |chosen: &BTreeSet<NodeId>| {
        let next = cx.scheduled(tabulated(&plan.graph, &found, chosen));
        (price.of(&next), next)
    };
    let mut chosen: BTreeSet<NodeId> = found.all.iter().copied().collect();
    let mut best = with(&chosen);
    // What takes less than to be kept and read again is computed where it is needed.
    for id in &found.all {
        if found.made_in_loops.contains(id) {
            continue;
        }
        if cx.fuel.spent() {
            break;
        }
        chosen.remove(id);
        let next = with(&chosen);
        match next.0 < best.0 {
            true => best = next,
            false => drop(chosen.insert(*id)),
        }
    }
    (best.0 < CHEAPER * price.of(plan)).then_some(best.1)
}
