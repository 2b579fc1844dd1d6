//! Accuracy rewriting by rules (as Herbie's): formulas that lose their bits to cancellation or
//! overflow are replaced by ones that do not.
//!
//! `b*b - (o.o - r*r)` is right on paper; in 14 bits, a hundred units from a
//! sphere of radius 0.03, nothing is left of it. `r*r - |o - b*d|^2` is the same
//! number, computed from small ones. Each rule is such a pair: equal over the
//! reals wherever its side condition holds, and more accurate where the ranges
//! say that cancellation may happen. Where they exclude it, nothing is touched:
//! a scene that is written well keeps its plan, its cost and its picture.
//!
//! The rules on one formula are a table of forms ([`rules::RULES`]); those on
//! sums ([`sums::SUMS`]) and on lengths look at all terms that meet. The native evaluation is
//! of the graph as written and knows nothing of this pass, so each checks the
//! other; [`crate::planner::plan_as_written`] leaves the pass out, to show what it
//! is for and to warn of what a scene's own formulas lose.
//!
//! Side conditions are proved from the ranges of the very plan that is being
//! made. Operations are total, and a rule is only equal where each of them means
//! what it means over the reals: a square root's argument must be proved to be no
//! negative where it is computed, a divisor to be no 0 unless the dividend is.

pub mod form;
mod lengths;
pub mod rules;
pub mod site;
pub mod sums;
#[cfg(test)]
mod tests;

use crate::analysis::range::{Ranges, Slack};
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use form::Out;
use site::{Known, Site};

/// The graph with the rules applied, each node once; nothing where none holds.
/// What a rule made is looked at when the pass runs again.
///
/// `slack` knows the ends of the format.
pub fn accurate(graph: &Graph, ranges: &Ranges, slack: &Slack) -> Option<Graph> {
    let (next, applied) = rewritten(graph, ranges, slack);
    (!applied.is_empty()).then_some(next)
}

/// The same, with the name of each rule that was applied.
fn rewritten(graph: &Graph, ranges: &Ranges, slack: &Slack) -> (Graph, Vec<&'static str>) {
    let known = Known::new(graph, ranges, slack);
    let parts = parts_of_sums(graph);
    let mut applied = Vec::new();
    let next = rebuild_old(graph, &mut |builder, made, id, span| {
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        let mut out = Out {
            builder,
            new: &new,
            span,
        };
        let put = formula(&known, id, &mut out).or_else(|| lengths::rewrite(&known, id, &mut out));
        let put = match put {
            None if !sums::inner(&known, &parts, id) => sums::rewrite(&known, id, &mut out),
            put => put,
        };
        let (name, put) = put?;
        applied.push(name);
        Some(put)
    });
    (next, applied)
}

/// Which nodes are operands of a sum.
fn parts_of_sums(graph: &Graph) -> Vec<bool> {
    let mut parts = vec![false; graph.nodes.len()];
    for id in graph.ids().filter(|id| sums::is_sum(graph, *id)) {
        for operand in graph.node(id).operands() {
            parts[operand.0 as usize] = true;
        }
    }
    parts
}

/// What the first rule that fits makes of a node.
fn formula(known: &Known<'_>, id: NodeId, out: &mut Out<'_>) -> Option<(&'static str, NodeId)> {
    rules::RULES.iter().find_map(|rule| {
        let bound = rule
            .left
            .iter()
            .find_map(|left| form::fits(known.graph, left, id))?;
        let site = Site {
            known,
            bound: &bound,
        };
        let holds = (rule.when)(&site);
        let put = holds.then(|| out.form(&rule.right, &bound))??;
        Some((rule.name, put))
    })
}
