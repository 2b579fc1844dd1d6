//! Loop-invariant code motion, where it makes a plan cheaper: by a profile of the plan's own
//! statements ([`crate::passes::invariant`]).

use super::price::Price;
use super::settled::Settled;
use super::thrift::Thrift;
use super::workshop::Workshop;
use crate::flow::graph::Graph;
use crate::passes::invariant::invariant;

/// By how much that must make the plan cheaper: what a variable more costs is not known so well.
const CHEAPER: f64 = 0.99;

/// The plan with what its loops' turns have in common before them, where that pays; after all
/// passes that rebuild the graph.
pub fn before_loops(plan: Settled, shop: &Workshop, thrift: Thrift) -> Settled {
    if plan.graph.loops.is_empty() {
        return plan;
    }
    let price = Price::by_few(&plan, shop.runtime, thrift);
    let counts = price.counts(&plan);
    let found = counts.map(|ran| invariant(&plan.graph, &plan.tree.pixel, &ran));
    let invariant = found.unwrap_or_default();
    if invariant.is_empty() {
        return plan;
    }
    let next = shop.scheduled(Graph {
        invariant,
        ..plan.graph.clone()
    });
    match price.anew(&next) < CHEAPER * price.anew(&plan) {
        true => next,
        false => plan,
    }
}
