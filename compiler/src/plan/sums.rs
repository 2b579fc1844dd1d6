//! Which sums are put in another form.
//!
//! What several sums have in common pays only where all of them are gathered, so all
//! are at first, and each is left as it is where that is cheaper. Then values are
//! tried that others are made of.

use super::price::Price;
use super::settled::Settled;
use super::thrift::Thrift;
use super::workshop::Workshop;
use crate::passes::sums::{Site, regrouped, sites};

/// By how much a sum's form must make a plan cheaper.
const GAIN: f64 = 0.9999;

/// How many nodes may be scheduled again to find out which sums pay.
const PATIENCE: usize = 60_000;

/// The plan with sums in other forms where that makes it cheaper.
pub fn with_sums(plan: Settled, shop: &Workshop, thrift: Thrift) -> Settled {
    let found = sites(&plan.graph, &plan.ranges, shop.runtime);
    let price = Price::new(&plan, shop.runtime, thrift);
    let rewritten = |sites: &[Site]| {
        let next = regrouped(&plan.graph, &plan.ranges, shop.runtime, sites)?;
        let next = shop.settle(&next);
        Some((price.of(&next), next))
    };
    let mut tries = PATIENCE / plan.graph.nodes.len().max(1);
    let (mut gathered, others): (Vec<Site>, Vec<Site>) =
        (found.into_iter()).partition(|site| matches!(site, Site::Gathered(_)));
    let now = price.of(&plan);
    let (mut least, mut best) = (now, None);
    if let Some((cost, next)) = rewritten(&gathered) {
        (least, best) = (cost, Some(next));
    }
    for site in gathered.clone().into_iter().take(tries) {
        tries -= 1;
        let rest: Vec<Site> = gathered.iter().copied().filter(|s| *s != site).collect();
        let (cost, next) = match rewritten(&rest) {
            Some((cost, next)) => (cost, Some(next)),
            None => (now, None),
        };
        if cost <= least {
            (least, best, gathered) = (cost, next, rest);
        }
    }
    for site in others.into_iter().take(tries) {
        let more: Vec<Site> = gathered.iter().copied().chain([site]).collect();
        if let Some((cost, next)) = rewritten(&more)
            && cost < GAIN * least
        {
            (least, best, gathered) = (cost, Some(next), more);
        }
    }
    best.filter(|_| least < GAIN * now).unwrap_or(plan)
}
