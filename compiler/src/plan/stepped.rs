//! Which values are stepped from column to column.
//!
//! A step is taken at every pixel, so it pays where most pixels need the value,
//! or where computing it takes several multiplications. It is weighed against
//! whole statements, with what is read and assigned, since a step is one.

use super::price::Price;
use super::settled::{Settled, settle};
use crate::flow::graph::*;
use crate::flow::ramp;
use crate::passes::ramps::{ramps, sites};
use crate::range::Slack;
use crate::target::Target;

/// By how much a ramp must make a plan cheaper.
const GAIN: f64 = 0.995;

/// How many nodes may be scheduled again to find out which ramps pay.
const PATIENCE: usize = 20_000;

/// The plan with ramps where they make it cheaper.
pub fn stepped(plain: Settled, slack: &Slack, target: &'static Target) -> Settled {
    if target.runtime.stepping.is_none() {
        return plain;
    }
    let found = sites(&plain.graph, &plain.ranges);
    if found.len() * plain.graph.nodes.len() > PATIENCE {
        return plain;
    }
    let mut taken: Vec<NodeId> = Vec::new();
    let mut best = plain.clone();
    let price = Price::new(&plain, target.runtime, false);
    let mut least = price.of(&best);
    for site in found {
        taken.push(site);
        let next = ramps(&plain.graph, &plain.ranges, &taken)
            .map(|graph| settle(&graph, slack))
            .filter(|next| target.wraps || bounded(next));
        match next.map(|next| (price.of(&next), next)) {
            Some((cost, next)) if cost < GAIN * least => (least, best) = (cost, next),
            _ => {
                taken.pop();
            }
        }
    }
    best
}

/// Whether no ramp ever wraps, stepped once behind the last column too.
fn bounded(plan: &Settled) -> bool {
    let graph = &plan.graph;
    let width = graph.image.width as i32;
    let result = |id: NodeId| plan.ranges.result[id.0 as usize];
    let mut all = graph.ids().filter(|id| is_ramp(graph, *id));
    all.all(|id| {
        ramp::range(graph, id, 0..=width, result).within(f64::from(i32::MIN), f64::from(i32::MAX))
    })
}

fn is_ramp(graph: &Graph, id: NodeId) -> bool {
    matches!(graph.node(id), Node::Ramp { .. })
}
