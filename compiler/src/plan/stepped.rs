//! Which values are stepped from column to column.
//!
//! A step is taken at every pixel, so it pays where most pixels need the value,
//! or where computing it takes several multiplications. It is weighed against
//! whole statements, with what is read and assigned, since a step is one.

use super::cheaper::{Weigh, bounds};
use super::choose::choose;
use super::fold_uses::folded;
use super::settled::{Settled, settle};
use crate::flow::graph::*;
use crate::flow::ramp;
use crate::flow::tree::*;
use crate::passes::ramps::{ramps, sites};
use crate::range::Slack;
use crate::target::Target;
use slowlight_routine::{Runtime, Stepping, Type};

/// By how much a ramp must make a plan cheaper.
const GAIN: f64 = 0.995;

/// How many nodes may be scheduled again to find out which ramps pay.
const PATIENCE: usize = 20_000;

/// The plan with ramps where they make it cheaper.
pub fn stepped(plain: Settled, slack: &Slack, target: &'static Target) -> Settled {
    let Some(stepping) = target.runtime.stepping else {
        return plain;
    };
    let found = sites(&plain.graph, &plain.ranges);
    if found.len() * plain.graph.nodes.len() > PATIENCE {
        return plain;
    }
    let mut taken: Vec<NodeId> = Vec::new();
    let mut best = plain.clone();
    let mut least = cost(&best, target.runtime, stepping);
    for site in found {
        taken.push(site);
        let next = ramps(&plain.graph, &plain.ranges, &taken)
            .map(|graph| settle(&graph, slack))
            .filter(|next| target.wraps || bounded(next));
        match next.map(|next| (cost(&next, target.runtime, stepping), next)) {
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

/// Cycles for a pixel of which nothing is known.
fn cost(plan: &Settled, runtime: &'static Runtime, stepping: Stepping) -> f64 {
    let Ok(routines) = choose(&plan.graph, &plan.tree, &plan.ranges, runtime) else {
        return f64::INFINITY;
    };
    let graph = &plan.graph;
    let folded = folded(graph, &plan.tree);
    let inline = |id: NodeId| folded.get(id.0 as usize) == Some(&true);
    let kind = |id: NodeId| usize::from(graph.ty(id) == Type::Real);
    let read = |id: NodeId| match graph.constant(id) {
        _ if inline(id) => 0,
        Some(value) if graph.ty(id) == Type::Int => {
            stepping.digit * value.int().unsigned_abs().to_string().len() as u32
        }
        _ => stepping.read[kind(id)],
    };
    let computed = |id: NodeId| {
        let operands: u32 = graph.node(id).operands().map(read).sum();
        let own = match graph.node(id) {
            Node::Lookup { .. } => stepping.entry,
            _ => routines[id.0 as usize].map_or(0, |r| r.cycles),
        };
        let kept = if inline(id) {
            0
        } else {
            stepping.write[kind(id)]
        };
        own + operands + kept
    };
    let own = |statement: &Statement| {
        f64::from(match statement {
            Statement::Let(id) => computed(*id),
            Statement::Set { place, from } => {
                let reading = match from {
                    Origin::Node(id) => read(*id),
                    Origin::Scratch(..) => stepping.read[1],
                };
                let kind = match place {
                    Place::Node(id) => kind(*id),
                    _ => 1,
                };
                reading + stepping.write[kind]
            }
            Statement::If { cond, .. } => stepping.test + read(*cond),
            Statement::Loop(_) | Statement::Call(_) => stepping.test,
        })
    };
    let weigh = Weigh { own: &own };
    let mut steps = 0;
    walk(&plan.tree.row, &mut |statement| {
        steps += u32::from(matches!(statement, Statement::Let(id) if is_ramp(graph, *id)));
    });
    let width = f64::from(graph.image.width.max(1));
    let runs = 1.0 + bounds(plan) as f64;
    weigh.block(&plan.tree.row) / width
        + weigh.block(&plan.tree.segment) * runs / width
        + weigh.block(&plan.tree.pixel)
        + f64::from(steps * stepping.ramp)
}
