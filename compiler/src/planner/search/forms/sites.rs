//! Greedy selection of sites: at which of the sites of a pass its form pays.

use super::{PATIENCE, Site};
use crate::ir::graph::*;
use crate::passes::algebra::polynomial::Verdicts;
use crate::planner::context::NODES;
use crate::planner::context::Rewrite;
use crate::planner::context::{Context, Rewritten};
use crate::planner::pipeline::Pass;
use crate::schedule::analysed::Analysed;
use slowlight_routine::Type;
use std::collections::BTreeMap;

impl Site<'_> {
    /// A plan with what a pass puts at the sites where that pays.
    pub(super) fn sited(&self, plain: Analysed, part: f64, rewrite: Rewrite) -> Analysed {
        let pass = match rewrite {
            Rewrite::Forms => Pass::PolynomialForms,
            Rewrite::Identities => Pass::Identities,
            Rewrite::Spans => Pass::ScanlineSpans,
        };
        let run = |plain: &Analysed| self.where_it_pays(plain, part, rewrite);
        self.cx.pass(pass, plain, run)
    }

    /// The same; nothing where it pays nowhere.
    fn where_it_pays(&self, plain: &Analysed, part: f64, pass: Rewrite) -> Option<Analysed> {
        if plain.graph.nodes.len() > NODES {
            return None;
        }
        let verdicts = Verdicts::default();
        let pass = (pass, &verdicts);
        let all = self.with(self.cx, plain, pass, &[])?;
        let sites = all.1;
        let now = self.cost(plain);
        let few = sites.len() * plain.graph.nodes.len() < PATIENCE;
        // Each has fuel of its own, or what one finds would hang on how far the other is.
        let [one, other] = [(); 2].map(|()| self.cx.with(self.cx.fuel.share()));
        let (fewer, more) = rayon::join(
            || self.fewer(&one, plain, pass, (&sites, all.0)),
            || few.then(|| self.more(&other, (now, plain), pass, &sites)),
        );
        self.cx.fuel.settle(&one.fuel);
        self.cx.fuel.settle(&other.fuel);
        let (cost, best) = match more {
            Some(more) if more.0 < fewer.0 => more,
            _ => fewer,
        };
        (cost < part * now).then_some(best)
    }

    /// The cost and plan from forms everywhere: each is left out where that is cheaper,
    /// values first together, since what one needs another may have.
    fn fewer<'p>(
        &self,
        cx: &Context,
        plain: &'p Analysed,
        pass: (Rewrite, &Verdicts<'p>),
        (sites, all): (&[NodeId], Analysed),
    ) -> (f64, Analysed) {
        let value = |id: &&NodeId| plain.graph.ty(**id) != Type::Bool;
        let mut tries: Vec<Vec<NodeId>> = vec![sites.iter().filter(value).copied().collect()];
        tries.extend(together(&plain.graph, sites));
        if sites.len() * plain.graph.nodes.len() < PATIENCE {
            tries.extend(sites.iter().map(|id| vec![*id]));
        }
        let from = (self.cost(&all), Vec::new(), all);
        self.stepwise((cx, plain), pass, from, tries, |without, leave| {
            without.iter().chain(leave).copied().collect()
        })
    }

    /// The same from no form: each is put where that is cheaper.
    fn more<'p>(
        &self,
        cx: &Context,
        (now, plain): (f64, &'p Analysed),
        pass: (Rewrite, &Verdicts<'p>),
        sites: &[NodeId],
    ) -> (f64, Analysed) {
        let mut tries: Vec<Vec<NodeId>> = sites.iter().map(|id| vec![*id]).collect();
        tries.extend(together(&plain.graph, sites));
        let from = (now, sites.to_vec(), plain.clone());
        self.stepwise((cx, plain), pass, from, tries, |without, put| {
            let rest = without.iter().copied().filter(|o| !put.contains(o));
            rest.collect()
        })
    }

    /// From a plan without a pass at some sites, and its cost, to another wherever
    /// that is cheaper: `out` says what is left out after each of the tries.
    fn stepwise<'p>(
        &self,
        (cx, plain): (&Context, &'p Analysed),
        pass: (Rewrite, &Verdicts<'p>),
        (mut limit, mut without, mut best): (f64, Vec<NodeId>, Analysed),
        tries: Vec<Vec<NodeId>>,
        out: impl Fn(&[NodeId], &[NodeId]) -> Vec<NodeId>,
    ) -> (f64, Analysed) {
        for sites in tries {
            if cx.fuel.spent() {
                break;
            }
            let out = out(&without, &sites);
            let Some((next, _)) = self.with(cx, plain, pass, &out) else {
                continue;
            };
            let cost = self.cost(&next);
            if cost < limit {
                (limit, without, best) = (cost, out, next);
            }
        }
        (limit, best)
    }

    /// The plan with a pass everywhere but at some nodes, and where it was.
    fn with<'p>(
        &self,
        cx: &Context,
        plain: &'p Analysed,
        pass: (Rewrite, &Verdicts<'p>),
        without: &[NodeId],
    ) -> Rewritten {
        let (pass, verdicts) = pass;
        cx.rewritten(plain, pass, without, || {
            let may = |id: NodeId| !without.contains(&id);
            let found = pass.rule()(&plain.graph, &plain.ranges, self.runtime, &may, verdicts)?;
            Some((cx.simplified(&found.graph), found.sites))
        })
    }
}

/// Sites that look at one value: what it costs is saved only where none of them is left.
fn together(graph: &Graph, sites: &[NodeId]) -> Vec<Vec<NodeId>> {
    let mut by_value: BTreeMap<NodeId, Vec<NodeId>> = BTreeMap::new();
    for &site in sites {
        for used in graph.node(site).operands() {
            if graph.constant(used).is_none() {
                by_value.entry(used).or_default().push(site);
            }
        }
    }
    by_value
        .into_values()
        .filter(|group| group.len() > 1)
        .collect()
}
