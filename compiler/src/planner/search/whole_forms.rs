//! Search over forms of the whole scene, before all else: loops whose turns are counted unrolled,
//! tables of what hangs on counters or few ints, sines of arcs by addition theorems; each where
//! it makes the plan cheaper.

use crate::cost::size_budget::SizeBudget;
use crate::ir::graph::*;
use crate::passes::algebra::angle_addition::angle_addition;
use crate::passes::loops::collect::collected;
use crate::passes::loops::induction_tables::{ENTRY, induction_tables, tables_of_ints};
use crate::passes::loops::unroll::unroll;
use crate::passes::simplify::fold::fold;
use crate::planner::context::Context;
use crate::planner::pipeline::Pass;
use crate::schedule::analysed::Analysed;
use slowlight_routine::{Op, Type};

/// The cheapest such form, with its plan by `ready`; nothing where the plan of the scene as it
/// is is cheaper.
pub fn cheapest_form(
    (origin, plan): (&Graph, &Analysed),
    ready: &dyn Fn(&Graph) -> Analysed,
    cx: &Context,
    budget: SizeBudget,
) -> Option<(Graph, Analysed)> {
    let all = forms(origin, cx, budget);
    let price = (!all.is_empty()).then(|| cx.price(budget))?;
    let mut best = (price.of(plan), None);
    for graph in all {
        let other = ready(&graph);
        let takes = price.of(&other);
        if takes < best.0 {
            best = (takes, Some((graph, other)));
        }
    }
    best.1
}

/// The forms of a scene that differ from it.
fn forms(origin: &Graph, cx: &Context, budget: SizeBudget) -> Vec<Graph> {
    let folded = |graph: Graph| fold(&graph);
    // Where memory is short, a sum of an entry is rather computed than looked up.
    let worth = if budget.is_plenty() { 2 } else { 4 } * ENTRY;
    let mut bases = vec![origin.clone()];
    let arcs = cx.always(Pass::AngleAddition, || angle_addition(origin));
    bases.extend(arcs.map(folded));
    bases = (bases.into_iter())
        .map(|graph| with_few_ints(graph, cx))
        .collect();
    let mut all = Vec::new();
    for base in bases {
        if budget.counts() && !base.loops.is_empty() {
            let unrolled = cx.always(Pass::Unroll, || unroll(&base)).map(folded);
            let collected = cx.always(Pass::Collect, || {
                let known = cx.scheduled(base.clone());
                collected(&known.graph, &known.ranges, cx.runtime)
            });
            let collected = collected.map(folded);
            let both = [Some(&base), collected.as_ref(), unrolled.as_ref()];
            let both = both.into_iter().flatten();
            let tables =
                |graph| cx.always(Pass::InductionTables, || induction_tables(graph, worth));
            all.extend(both.filter_map(tables));
            // What is collected has less in each turn.
            let collected = collected.and_then(|graph| cx.always(Pass::Unroll, || unroll(&graph)));
            all.extend(collected.map(folded));
            all.extend(unrolled);
        }
        all.push(base);
    }
    all.retain(|graph| graph.nodes != origin.nodes);
    all
}

/// The graph with tables of what hangs on ints that are rounded and stay within few values.
fn with_few_ints(graph: Graph, cx: &Context) -> Graph {
    let cheap = cx.tables;
    let rounds = |id: NodeId| match graph.node(id) {
        Node::Apply(Op::Round | Op::Floor, _) => true,
        Node::Lookup { .. } => graph.ty(id) == Type::Int,
        Node::Axis(Axis::X) | Node::Apply(Op::IntMod, _) => cheap,
        _ => false,
    };
    if !graph.ids().any(rounds) {
        return graph;
    }
    let known = cx.scheduled(graph);
    // An int must be moved to where the table begins, and be held to its ends perhaps.
    let tables = cx.always(Pass::IntegerTables, || {
        tables_of_ints(
            &known.graph,
            &known.ranges,
            (if cheap { 2 } else { 4 } * ENTRY, cheap),
        )
    });
    tables.map_or_else(|| known.graph.clone(), |graph| fold(&graph))
}
