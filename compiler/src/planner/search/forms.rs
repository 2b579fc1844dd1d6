//! Search over algebraic forms and copies of loops: which rewrites for speed are worth it on a
//! machine, and in what order.
//!
//! The ink is found by comparisons, the first turn of a loop is copied before
//! it, directions are held at their own length, algebra looks at all of it,
//! comparisons with thresholds included. What is kept of that is what makes the
//! whole plan cheaper ([`crate::cost::price`]). A formula that is cheaper by itself may cost more than
//! it saves where others needed its parts, or where the ranges cannot see its
//! sign and it needs a guard.

mod sites;

use super::sums::with_loops_skipped;
use crate::analysis::range::Ranges;
use crate::cost::price::Price;
use crate::cost::size_budget::Thrift;
use crate::ir::graph::*;
use crate::passes::algebra::identities::{around, identities};
use crate::passes::algebra::polynomial::{Cheaper, Verdicts, algebra, allowance, decided, spans};
use crate::passes::algebra::unnormalised::{homogeneous, lengths};
use crate::passes::branches::early_exit::in_loops;
use crate::passes::branches::invert_monotone::threshold;
use crate::passes::branches::unswitch::split;
use crate::passes::loops::guard::guard;
use crate::passes::loops::peel::peel;
use crate::passes::rematerialise::apart;
use crate::planner::memo::Workshop;
use crate::planner::pipeline::Pass;
use crate::planner::search::branches::chosen;
use crate::schedule::analysed::Settled;
use slowlight_routine::{Format, Runtime};
use std::sync::atomic::{AtomicBool, Ordering};

/// How many nodes of a loop's body are copied at most.
const BODY: usize = 160;

/// By how much a copy of a loop's body must make the plan cheaper.
const COPY: f64 = 0.9;

/// From where on forms are thought to do something for a loop.
const FORMED: f64 = 0.97;

/// By how much a guard before its second turn must.
const GUARD: f64 = 0.999;

/// By how much algebra must make the plan cheaper: what a statement costs beside
/// its routines is not known so well.
const FORMS: f64 = 0.9;

/// By how much identities must: they take no more statements.
const SHORTER: f64 = 0.99;

/// By how much spans must.
const SPANS: f64 = 0.99;

/// How often values are taken apart: what one needs may be taken apart after it.
const APART: usize = 6;

/// How many directions are tried at their own length.
const LENGTHS: usize = 4;

/// How many nodes a graph may have to be looked at by algebra, and how many may
/// be scheduled again to find out which forms pay.
pub(crate) const NODES: usize = 1000;
const PATIENCE: usize = 10_000;

/// Graphs that give the same picture in fewer cycles: the cheapest one, and the
/// cheapest with directions so long that their products are whole, too, where that
/// is another. Which of them is cheaper is seen only when values are stepped.
/// `early` is the same graph with the scene's shortcuts in it, if it has any.
pub fn cheaper(
    plain: Settled,
    early: Option<&Graph>,
    shop: &Workshop,
    thrift: Thrift,
) -> Vec<Settled> {
    if shop.fuel.spent() {
        return vec![plain];
    }
    let mut site = Site {
        shop,
        runtime: shop.runtime,
        price: Price::new(shop, thrift),
        thrift,
        products: false,
        other: AtomicBool::new(false),
    };
    let mut all = vec![site.cheapest(&plain, early)];
    if site.other.load(Ordering::Relaxed) {
        site.products = true;
        all.push(site.cheapest(&plain, early));
    }
    all
}

/// A pass that puts something in the place of nodes that may be replaced.
type Rule = for<'g> fn(
    &'g Graph,
    &'g Ranges,
    &Runtime,
    &dyn Fn(NodeId) -> bool,
    &Verdicts<'g>,
) -> Option<Cheaper>;

/// Which of these.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Rewrite {
    Forms,
    Identities,
    Spans,
}

impl Rewrite {
    fn rule(self) -> Rule {
        match self {
            Rewrite::Forms => algebra,
            Rewrite::Identities => identities,
            Rewrite::Spans => spans,
        }
    }
}

/// With inks chosen by the one bool that runs of columns do not know, if that is worth
/// the memory.
pub fn with_inks_split(plan: Settled, shop: &Workshop, thrift: Thrift) -> Settled {
    if plan.tree.segment.is_empty() {
        return plan;
    }
    shop.pass(Pass::Unswitch, plan, |plan| {
        let next = shop.settle(&split(&plan.graph)?);
        let price = Price::new(shop, thrift);
        (price.of(&next) < price.of(plan)).then_some(next)
    })
}

/// With values computed where they are needed rather than once for all, where
/// that is less often: the last of the passes.
pub fn apart_at_last(plan: Settled, shop: &Workshop, thrift: Thrift) -> Settled {
    let price = Price::new(shop, thrift);
    // Where copies are joined, what chooses what a loop starts with costs nothing.
    let mut best = match shop.runtime.stepping {
        Some(_) => with_loops_skipped(plan, shop, thrift),
        None => plan,
    };
    for _ in 0..APART {
        let before = best.serial();
        best = shop.pass(Pass::Rematerialise, best, |plan| {
            let next = apart(&plan.graph, &plan.tree, &price.worth(plan));
            next.map(|graph| shop.scheduled(graph))
        });
        if best.serial() == before {
            break;
        }
    }
    best
}

struct Site<'s> {
    shop: &'s Workshop,
    runtime: &'static Runtime,
    price: Price,
    thrift: Thrift,
    /// Whether directions are so long that their products are whole, too.
    products: bool,
    /// Whether that makes a difference.
    other: AtomicBool,
}

impl Site<'_> {
    fn cost(&self, plan: &Settled) -> f64 {
        self.price.of(plan)
    }

    /// The cheapest plan, with turns of loops before them or not.
    fn cheapest(&self, plain: &Settled, early: Option<&Graph>) -> Settled {
        let mut best = self.rewritten(plain).unwrap_or(plain.clone());
        // A copy that is dearer as it stands is for what forms make of it.
        let limit = match self.cost(&best) < FORMED * self.cost(plain) {
            true => f64::INFINITY,
            false => self.cost(plain),
        };
        for k in 0..plain.graph.loops.len() {
            if self.shop.fuel.spent() {
                break;
            }
            let of = LoopId(k as u32);
            let Some(peeled) = peel(&plain.graph, of, BODY) else {
                continue;
            };
            let guarded = guard(&peeled, of, 1, BODY);
            let early = early.and_then(|graph| peel(graph, of, BODY));
            let sooner = || guard(&in_loops(early.as_ref()?)?, of, 2, BODY);
            self.keep(Pass::Peel, &mut best, || Some(peeled), (COPY, limit));
            self.keep(Pass::LoopGuard, &mut best, || guarded, (GUARD, limit));
            self.keep(Pass::EarlyExit, &mut best, sooner, (GUARD, limit));
        }
        best
    }

    /// Whether a graph makes a plan that is cheaper than such a part of the best one, which it is
    /// then. What costs more than the limit before forms are looked for is not looked at.
    fn keep(
        &self,
        pass: Pass,
        best: &mut Settled,
        graph: impl FnOnce() -> Option<Graph>,
        (part, limit): (f64, f64),
    ) -> bool {
        let found = self.shop.always(pass, || {
            let tried = self.shop.settle(&graph()?);
            if self.cost(&tried) > limit {
                return None;
            }
            let found = self.rewritten(&tried)?;
            (self.cost(&found) < part * self.cost(best)).then_some(found)
        });
        let kept = found.is_some();
        if let Some(found) = found {
            *best = found;
        }
        kept
    }

    /// A plan with thresholds, directions at their own length and algebra, as far
    /// as they make it cheaper; nothing where they do not.
    fn rewritten(&self, plain: &Settled) -> Option<Settled> {
        if self.shop.fuel.spent() {
            return None;
        }
        let (shop, runtime) = (self.shop, self.runtime);
        let mut now = shop.pass(Pass::InvertMonotone, plain.clone(), |plan| {
            let next = shop.settle(&threshold(&plan.graph, &plan.ranges, runtime)?);
            (self.cost(&next) < self.cost(plan)).then_some(next)
        });
        let base = now.clone();
        now = self.sited(now, FORMS, Rewrite::Forms);
        now = shop.pass(Pass::Unnormalised, now, |plan| {
            let mut best = None;
            for held in self.held(&base) {
                let found = self.sited(held, FORMS, Rewrite::Forms);
                if self.cost(&found) < self.cost(best.as_ref().unwrap_or(plan)) {
                    best = Some(found);
                }
            }
            best
        });
        now = self.specialised(now);
        now = shop.pass(Pass::LengthTests, now, |plan| self.around(plan));
        now = self.sited(now, SHORTER, Rewrite::Identities);
        if self.thrift.runs() {
            now = self.sited(now, SPANS, Rewrite::Spans);
        }
        (now.serial() != plain.serial()).then_some(now)
    }

    /// The plan with factors of few values chosen by these, where that is cheaper.
    fn specialised(&self, plan: Settled) -> Settled {
        let shop = self.shop;
        shop.pass(Pass::SpecialiseFactors, plan, |plan| {
            chosen(plan, shop, &self.price)
        })
    }

    /// The graph with one of its directions at its own length, each in turn.
    fn held(&self, plain: &Settled) -> impl Iterator<Item = Settled> {
        // A fixed point has the digits for directions of length 1, but where each has its
        // own, and logarithms have no room for the squares of long ones.
        let narrow = (self.runtime.real.is_fixed() && allowance(self.runtime) < 1.0)
            || matches!(self.runtime.real, Format::Log { .. });
        let few = plain.graph.nodes.len() <= NODES && !narrow;
        let all = match few {
            true => lengths(&plain.graph, &plain.ranges),
            false => Vec::new(),
        };
        all.into_iter().take(LENGTHS).filter_map(|length| {
            if self.shop.fuel.spent() {
                return None;
            }
            let (held, longer) = homogeneous(&plain.graph, &plain.ranges, length)?;
            self.other.fetch_or(longer.is_some(), Ordering::Relaxed);
            let held = longer.filter(|_| self.products).unwrap_or(held);
            Some(self.decided(self.shop.settle(&held)))
        })
    }

    /// The plan without comparisons that the length of a vector decides.
    fn around(&self, plan: &Settled) -> Option<Settled> {
        let few = plan.graph.nodes.len() <= NODES;
        let next = few.then(|| around(&plan.graph, &plan.ranges, self.runtime))??;
        Some(self.shop.settle(&next))
    }

    /// The plan without comparisons that come out the same at every pixel.
    fn decided(&self, plan: Settled) -> Settled {
        if plan.graph.nodes.len() > NODES {
            return plan;
        }
        match decided(&plan.graph, &plan.ranges, self.runtime, &self.shop.proofs) {
            Some(next) => self.shop.settle(&next),
            None => plan,
        }
    }
}
