//! Greedy selection of sites: at which of the sites of a pass its form pays.

use super::{NODES, PATIENCE, Rewrite, Site};
use crate::ir::graph::*;
use crate::passes::algebra::polynomial::Verdicts;
use crate::planner::memo::{Rewritten, Workshop};
use crate::planner::pipeline::Pass;
use crate::schedule::analysed::Settled;
use slowlight_routine::Type;
use std::collections::BTreeMap;

impl Site<'_> {
    /// A plan with what a pass puts at the sites where that pays.
    pub(super) fn sited(&self, plain: Settled, part: f64, rewrite: Rewrite) -> Settled {
        let pass = match rewrite {
            Rewrite::Forms => Pass::PolynomialForms,
            Rewrite::Identities => Pass::Identities,
            Rewrite::Spans => Pass::ScanlineSpans,
        };
        let run = |plain: &Settled| self.where_it_pays(plain, part, rewrite);
        self.shop.pass(pass, plain, run)
    }

    /// The same; nothing where it pays nowhere.
    fn where_it_pays(&self, plain: &Settled, part: f64, pass: Rewrite) -> Option<Settled> {
        if plain.graph.nodes.len() > NODES {
            return None;
        }
        let verdicts = Verdicts::default();
        let pass = (pass, &verdicts);
        let all = self.with(self.shop, plain, pass, &[])?;
        let sites = all.1;
        let now = self.cost(plain);
        let few = sites.len() * plain.graph.nodes.len() < PATIENCE;
        // Each has fuel of its own, or what one finds would hang on how far the other is.
        let [one, other] = [(); 2].map(|()| self.shop.with(self.shop.fuel.share()));
        let (fewer, more) = rayon::join(
            || self.fewer(&one, plain, pass, (&sites, all.0)),
            || few.then(|| self.more(&other, (now, plain), pass, &sites)),
        );
        self.shop.fuel.settle(&one.fuel);
        self.shop.fuel.settle(&other.fuel);
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
        shop: &Workshop,
        plain: &'p Settled,
        pass: (Rewrite, &Verdicts<'p>),
        (sites, all): (&[NodeId], Settled),
    ) -> (f64, Settled) {
        let value = |id: &&NodeId| plain.graph.ty(**id) != Type::Bool;
        let mut tries: Vec<Vec<NodeId>> = vec![sites.iter().filter(value).copied().collect()];
        tries.extend(together(&plain.graph, sites));
        if sites.len() * plain.graph.nodes.len() < PATIENCE {
            tries.extend(sites.iter().map(|id| vec![*id]));
        }
        let from = (self.cost(&all), Vec::new(), all);
        self.stepwise((shop, plain), pass, from, tries, |without, leave| {
            without.iter().chain(leave).copied().collect()
        })
    }

    /// The same from no form: each is put where that is cheaper.
    fn more<'p>(
        &self,
        shop: &Workshop,
        (now, plain): (f64, &'p Settled),
        pass: (Rewrite, &Verdicts<'p>),
        sites: &[NodeId],
    ) -> (f64, Settled) {
        let mut tries: Vec<Vec<NodeId>> = sites.iter().map(|id| vec![*id]).collect();
        tries.extend(together(&plain.graph, sites));
        let from = (now, sites.to_vec(), plain.clone());
        self.stepwise((shop, plain), pass, from, tries, |without, put| {
            let rest = without.iter().copied().filter(|o| !put.contains(o));
            rest.collect()
        })
    }

    /// From a plan without a pass at some sites, and its cost, to another wherever
    /// that is cheaper: `out` says what is left out after each of the tries.
    fn stepwise<'p>(
        &self,
        (shop, plain): (&Workshop, &'p Settled),
        pass: (Rewrite, &Verdicts<'p>),
        (mut limit, mut without, mut best): (f64, Vec<NodeId>, Settled),
        tries: Vec<Vec<NodeId>>,
        out: impl Fn(&[NodeId], &[NodeId]) -> Vec<NodeId>,
    ) -> (f64, Settled) {
        for sites in tries {
            if shop.fuel.spent() {
                break;
            }
            let out = out(&without, &sites);
            let Some((next, _)) = self.with(shop, plain, pass, &out) else {
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
        shop: &Workshop,
        plain: &'p Settled,
        pass: (Rewrite, &Verdicts<'p>),
        without: &[NodeId],
    ) -> Rewritten {
        let (pass, verdicts) = pass;
        shop.rewritten(plain, pass, without, || {
            let may = |id: NodeId| !without.contains(&id);
            let found = pass.rule()(&plain.graph, &plain.ranges, self.runtime, &may, verdicts)?;
            Some((shop.settle(&found.graph), found.sites))
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
