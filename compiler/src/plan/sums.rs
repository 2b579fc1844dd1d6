//! Which sums are put in another form.
//!
//! What several sums have in common pays only where all of them are gathered, so all
//! are at first, and each is left as it is where that is cheaper. Then values are
//! tried that others are made of.

use super::price::Price;
use super::settled::Settled;
use super::thrift::Thrift;
use super::workshop::Workshop;
use crate::passes::skip::skip;
use crate::passes::sums::{Site, Sums, sunk};

/// By how much a sum's form must make a plan cheaper.
const GAIN: f64 = 0.9995;

/// How many nodes may be scheduled again to find out which sums pay.
const PATIENCE: usize = 60_000;

/// How often sums are looked at: what is known of some lets others be made.
const ROUNDS: u32 = 3;

/// The plan with sums in other forms where that makes it cheaper.
pub fn with_sums(plan: Settled, shop: &Workshop, thrift: Thrift) -> Settled {
    let mut best = plan;
    for _ in 0..ROUNDS {
        if shop.fuel.spent() {
            break;
        }
        let Some(next) = cheaper(&best, shop, thrift) else {
            break;
        };
        best = next;
    }
    best
}

/// The same once; nothing where it makes nothing cheaper.
fn cheaper(plan: &Settled, shop: &Workshop, thrift: Thrift) -> Option<Settled> {
    let sums = Sums::new(&plan.graph, &plan.ranges, shop.runtime);
    let found = sums.sites();
    let price = Price::new(plan, shop.runtime, thrift);
    let made = |sites: &[Site]| {
        shop.may_look(&plan.graph);
        sums.regrouped(sites)
    };
    let rewritten = |sites: &[Site]| {
        let next = shop.settle(&made(sites)?.0);
        Some((price.of(&next), next))
    };
    let gathers = |site: &&Site| matches!(site, Site::Gathered(_));
    let mut gathered: Vec<Site> = found.iter().filter(gathers).copied().collect();
    let changed = made(&gathered).map_or(Vec::new(), |(_, changed)| changed);
    gathered.retain(|site| matches!(site, Site::Gathered(id) if changed.contains(id)));
    let others = found
        .iter()
        .filter(|site| !gathers(site) && made(&[**site]).is_some());
    let now = price.of(plan);
    let mut best = Best {
        least: now,
        sites: Vec::new(),
        plan: None,
    };
    if let Some((cost, next)) = rewritten(&gathered) {
        best = Best {
            least: cost,
            sites: gathered.clone(),
            plan: Some(next),
        };
    }
    let tries = PATIENCE / plan.graph.nodes.len().max(1);
    // What pays beside others may not without them, and the other way round.
    for site in gathered
        .iter()
        .rev()
        .chain(others)
        .chain(&gathered)
        .take(tries)
    {
        if shop.fuel.spent() {
            break;
        }
        let (has, mut sites) = (best.sites.contains(site), best.sites.clone());
        match has {
            true => sites.retain(|other| other != site),
            false => sites.push(*site),
        }
        let tried = rewritten(&sites);
        let cost = tried.as_ref().map_or(now, |(cost, _)| *cost);
        let limit = if has { best.least } else { GAIN * best.least };
        if cost <= limit {
            best = Best {
                least: cost,
                sites,
                plan: tried.map(|(_, next)| next),
            };
        }
    }
    let Best {
        least, plan: found, ..
    } = best;
    found.filter(|_| least < GAIN * now)
}

/// The plan with no loop started that its first turn ends, and sums looked at again:
/// those behind the loop are of what it starts with now.
pub fn with_loops_skipped(plan: Settled, shop: &Workshop, thrift: Thrift) -> Settled {
    let price = Price::new(&plan, shop.runtime, thrift);
    let skipped = |plan: &Settled| skip(&plan.graph).map(|next| shop.scheduled(next));
    let Some(usual) = skipped(&plan) else {
        return plan;
    };
    let sunk = sunk(&usual.graph).map(|graph| shop.settle(&graph));
    let other = sunk.map(|plan| cheaper(&plan, shop, thrift).unwrap_or(plan));
    match other {
        Some(other) if price.of(&other) < GAIN * price.of(&usual) => other,
        _ => usual,
    }
}

/// The cheapest so far: at which sites.
struct Best {
    least: f64,
    sites: Vec<Site>,
    plan: Option<Settled>,
}
