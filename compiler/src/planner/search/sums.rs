//! Search over reassociation: which sums are put in another form.
//!
//! What several sums have in common pays only where all of them are gathered, so all
//! are at first, and each is left as it is where that is cheaper. Then values are
//! tried that others are made of.

use crate::cost::size_budget::SizeBudget;
use crate::passes::algebra::reassociate::{Site, Sums, sunk};
use crate::passes::loops::bypass::skip;
use crate::passes::loops::trip_counts::trip_counts;
use crate::passes::simplify::fold::fold;
use crate::planner::context::Context;
use crate::planner::pipeline::Pass;
use crate::schedule::analysed::Analysed;

/// By how much a sum's form must make a plan cheaper.
const GAIN: f64 = 0.9995;

/// How many nodes may be rewritten to find out by counts which sums pay.
const PATIENCE: usize = 60_000;

/// By how much forms that are settled to be compared may differ by counts, and how many of
/// those there are: so many nodes together, and at most.
const DOUBT: f64 = 1.003;
const EARNEST: usize = 6_000;
const MOST: usize = 16;

/// How often sums are looked at: what is known of some lets others be made.
const ROUNDS: u32 = 3;

/// The plan with sums in other forms where that makes it cheaper.
pub fn with_sums(plan: Analysed, cx: &Context, budget: SizeBudget) -> Analysed {
    let mut best = plan;
    for _ in 0..ROUNDS {
        let before = best.serial();
        best = cx.pass(Pass::Reassociate, best, |plan| cheaper(plan, cx, budget));
        if best.serial() == before {
            break;
        }
    }
    best
}

/// The same once; nothing where it makes nothing cheaper.
///
/// Which sites pay is found by what graphs cost at the plan's own counts ([`crate::cost::profile`]).
/// What comes of that, and of all sums together, is settled and priced; beside the cheaper of
/// the two a few others are, that are nearly as good by counts.
fn cheaper(plan: &Analysed, cx: &Context, budget: SizeBudget) -> Option<Analysed> {
    let sums = Sums::new(&plan.graph, &plan.ranges, cx.runtime);
    let price = cx.price(budget);
    let profile = price.profile(plan)?;
    let made = |sites: &[Site]| {
        cx.may_look(&plan.graph);
        sums.regrouped(sites)
    };
    let gathers = |site: &Site| matches!(site, Site::Gathered(_));
    let (mut gathered, others): (Vec<Site>, Vec<Site>) =
        sums.sites().into_iter().partition(gathers);
    let changed = made(&gathered).map_or(Vec::new(), |made| made.changed);
    gathered.retain(|site| matches!(site, Site::Gathered(id) if changed.contains(id)));
    let about = |sites: &[Site]| {
        let found = made(sites).map(|made| profile.cost(&made.graph, &made.trace));
        let (cycles, more) = found.unwrap_or((profile.own(), 0.0));
        price.beside(plan, cycles, more)
    };
    let mut best = gathered.clone();
    let mut least = about(&best);
    // What pays beside others may not without them, and the other way round.
    let tries = gathered.iter().rev().chain(&others).chain(&gathered);
    let mut doubtful: Vec<(f64, Site)> = Vec::new();
    for &site in tries.take(PATIENCE / plan.graph.nodes.len().max(1)) {
        if cx.fuel.spent() {
            break;
        }
        let sites = toggled(&best, site);
        let (cost, has) = (about(&sites), best.contains(&site));
        doubtful.retain(|(_, other)| *other != site);
        doubtful.push((cost / least, site));
        if cost <= if has { least } else { GAIN * least } {
            (least, best) = (cost, sites);
        }
    }
    let settled = |sites: &[Site]| match made(sites) {
        Some(made) => cx.simplified(&made.graph),
        None => plan.clone(),
    };
    let mut found = settled(&best);
    let all = settled(&gathered);
    if price.of(&all) < price.of(&found) {
        (found, best) = (all, gathered);
    }
    // What a quotient's sign is asked for needs no division: that shows in earnest alone.
    let divides = |site: &Site| matches!(site, Site::Divided(_));
    doubtful.retain(|(part, site)| divides(site) || (1.0 / DOUBT..DOUBT).contains(part));
    // The fewer, the better.
    doubtful.sort_by(|(a, one), (b, other)| {
        let rank = |site: &Site| (!divides(site), !best.contains(site));
        rank(one).cmp(&rank(other)).then(a.total_cmp(b))
    });
    let few = (EARNEST / plan.graph.nodes.len().max(1)).clamp(1, MOST);
    for (_, site) in doubtful.into_iter().take(few) {
        if cx.fuel.spent() {
            break;
        }
        let sites = toggled(&best, site);
        let tried = settled(&sites);
        let limit = if best.contains(&site) { 1.0 } else { GAIN };
        if price.of(&tried) <= limit * price.of(&found) {
            (found, best) = (tried, sites);
        }
    }
    (price.of(&found) < GAIN * price.of(plan)).then_some(found)
}

/// Some sites with another one, or without it.
fn toggled(sites: &[Site], site: Site) -> Vec<Site> {
    let mut sites = sites.to_vec();
    match sites.iter().position(|other| *other == site) {
        Some(at) => drop(sites.remove(at)),
        None => sites.push(site),
    }
    sites
}

/// The plan with no loop started that its first turn ends, and sums looked at again:
/// those behind the loop are of what it starts with now.
pub fn with_loops_skipped(plan: Analysed, cx: &Context, budget: SizeBudget) -> Analysed {
    let next = cx.always(Pass::LoopBypass, || bypassed(&plan, cx, budget));
    next.unwrap_or(plan)
}

fn bypassed(plan: &Analysed, cx: &Context, budget: SizeBudget) -> Option<Analysed> {
    let price = cx.price(budget);
    let next = skip(&plan.graph)?;
    // A loop that its first turn does not end may be counted now.
    let counted = cx.always(Pass::TripCounts, || {
        trip_counts(&next, &plan.ranges, cx.runtime)
    });
    let usual = cx.scheduled(counted.map_or(next, |graph| fold(&graph)));
    let sunk = sunk(&usual.graph).map(|graph| cx.simplified(&graph));
    let other = sunk.map(|plan| cheaper(&plan, cx, budget).unwrap_or(plan));
    Some(match other {
        Some(other) if price.of(&other) < GAIN * price.of(&usual) => other,
        _ => usual,
    })
}
