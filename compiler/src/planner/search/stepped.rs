//! Search over strength reduction: which values are stepped from column to column.
//!
//! A step is taken at every pixel, so it pays where most pixels need the value,
//! or where computing it takes several multiplications. It is weighed against
//! whole statements, with what is read and assigned, since a step is one.

use crate::analysis::range::Ranges;
use crate::cost::price::Price;
use crate::cost::size_budget::SizeBudget;
use crate::ir::graph::*;
use crate::passes::loops::strength_reduction::phase::{parities, phases};
use crate::passes::loops::strength_reduction::runs::{in_runs, is_exact, runs};
use crate::planner::context::Context;
use crate::planner::pipeline::Pass;
use crate::schedule::analysed::Analysed;
use crate::targets::Target;
use slowlight_routine::Op;

/// By how much a ramp must make a plan cheaper.
const GAIN: f64 = 0.995;

/// How many nodes may be scheduled again to find out which ramps pay.
const PATIENCE: usize = 20_000;

/// What may be stepped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Steps {
    /// Values along runs of columns, and phases, which take some memory once a row.
    All,
    /// Values along runs of columns.
    Runs,
    /// Nothing.
    None,
}

/// The plan with ramps where they make it cheaper.
pub fn stepped(
    plain: Analysed,
    cx: &Context,
    target: &'static Target,
    budget: SizeBudget,
    steps: Steps,
) -> Analysed {
    if target.runtime.overhead.step.is_none() || steps == Steps::None {
        return plain;
    }
    let site = Site {
        cx,
        price: cx.price(budget),
    };
    let phased = match target.wraps && steps == Steps::All {
        true => {
            let found = parities(&plain.graph, &plain.ranges, target.runtime);
            site.taken(Pass::Phases, plain, found, phases)
        }
        false => plain,
    };
    let found = match phased.tree.segment.is_empty() {
        true => Vec::new(),
        false => runs(&phased.graph, &phased.ranges),
    };
    site.taken(Pass::ScanlineRuns, phased, found, in_runs)
}

struct Site<'s> {
    cx: &'s Context,
    price: Price,
}

/// What rewrites a graph at some of its nodes.
type Rewrite = fn(&Graph, &Ranges, &[NodeId]) -> Option<Graph>;

impl Site<'_> {
    /// A plan rewritten where that makes it cheaper.
    fn taken(&self, pass: Pass, plain: Analysed, found: Vec<NodeId>, rewrite: Rewrite) -> Analysed {
        let many = found.len() * plain.graph.nodes.len() > PATIENCE;
        if found.is_empty() || many {
            return plain;
        }
        self.cx
            .pass(pass, plain, |plain| self.cheaper(plain, found, rewrite))
    }

    /// The same; nothing where that makes it cheaper nowhere.
    fn cheaper(&self, plain: &Analysed, found: Vec<NodeId>, rewrite: Rewrite) -> Option<Analysed> {
        let cost = |plan: &Analysed| self.price.of(plan);
        let rewritten = |at: &[NodeId]| {
            let next = (self.cx).simplified(&rewrite(&plain.graph, &plain.ranges, at)?);
            is_exact(&next.graph, &next.tree, &next.ranges).then(|| (cost(&next), next))
        };
        let mut taken: Vec<NodeId> = Vec::new();
        let mut least = cost(plain);
        let mut best: Option<Analysed> = None;
        for &site in &found {
            if self.cx.fuel.spent() {
                break;
            }
            taken.push(site);
            match rewritten(&taken) {
                Some((cost, next)) if cost < GAIN * least => (least, best) = (cost, Some(next)),
                _ => {
                    taken.pop();
                }
            }
        }
        // One that paid by itself may not beside those that came after it.
        for site in found {
            let rest: Vec<NodeId> = taken.iter().copied().filter(|id| *id != site).collect();
            if rest.is_empty() || rest.len() == taken.len() || self.cx.fuel.spent() {
                continue;
            }
            if let Some((cost, next)) = rewritten(&rest)
                && cost < least
            {
                (least, best, taken) = (cost, Some(next), rest);
            }
        }
        // What is made of one may take its place.
        for (site, of) in made_of(&plain.graph, &taken) {
            let others = taken.iter().copied().filter(|id| *id != of);
            let other: Vec<NodeId> = others.chain([site]).collect();
            if other.len() == taken.len()
                && !self.cx.fuel.spent()
                && let Some((cost, next)) = rewritten(&other)
                && cost < least
            {
                (least, best, taken) = (cost, Some(next), other);
            }
        }
        best
    }
}

/// Sums of one of some values and a constant, which are none of these themselves.
fn made_of(graph: &Graph, values: &[NodeId]) -> Vec<(NodeId, NodeId)> {
    let mut all = Vec::new();
    for id in graph.ids().filter(|id| !values.contains(id)) {
        if let Node::Apply(Op::IntAdd | Op::IntSub, [a, b]) = graph.node(id) {
            let constant = |id| graph.constant(id).is_some();
            let of = match (constant(a), constant(b)) {
                (true, false) => b,
                (false, true) => a,
                _ => continue,
            };
            if values.contains(&of) {
                all.push((id, of));
            }
        }
    }
    all
}
