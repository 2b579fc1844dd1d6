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
use crate::cost::size_budget::SizeBudget;
use crate::ir::graph::*;
use crate::passes::algebra::identities::{around, identities};
use crate::passes::algebra::polynomial::{
    Cheaper, Verdicts, allowance, decided, normal_forms, spans,
};
use crate::passes::algebra::unnormalised::{lengths, unnormalised};
use crate::passes::branches::early_exit::in_loops;
use crate::passes::branches::invert_monotone::invert_monotone;
use crate::passes::branches::unswitch::unswitch;
use crate::passes::loops::guard::guard;
use crate::passes::loops::peel::peel;
use crate::passes::rematerialise::rematerialise;
use crate::planner::context::Context;
use crate::planner::context::NODES;
use crate::planner::context::Rewrite;
use crate::planner::pipeline::Pass;
use crate::planner::search::branches::chosen;
use crate::schedule::analysed::Analysed;
use slowlight_routine::{Format, Runtime};
use std::sync::atomic::{AtomicBool, Ordering};

/// How many nodes of a loop's body are copied at most.
const BODY: usize = 160;

/// From where on forms are thought to do something for a loop.
const FORMED: f64 = 0.97;

/// By how much a guard before a loop's second turn must make the plan cheaper.
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

/// How many nodes may be scheduled again to find out which forms pay.
const PATIENCE: usize = 10_000;

/// Graphs that give the same picture in fewer cycles: the cheapest one, and the
/// cheapest with directions so long that their products are whole, too, where that
/// is another. Which of them is cheaper is seen only when values are stepped.
/// `early` is the same graph with the scene's shortcuts in it, if it has any.
pub fn cheaper(
    plain: Analysed,
    early: Option<&Graph>,
    cx: &Context,
    budget: SizeBudget,
) -> Vec<Analysed> {
    if cx.fuel.spent() {
        return vec![plain];
    }
    let mut site = Site {
        cx,
        runtime: cx.runtime,
        price: cx.price(budget),
        budget,
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

impl Rewrite {
    fn rule(self) -> Rule {
        match self {
            Rewrite::Forms => normal_forms,
            Rewrite::Identities => identities,
            Rewrite::Spans => spans,
        }
    }
}

/// With inks chosen by the one bool that runs of columns do not know, if that is worth
/// the memory.
pub fn with_inks_split(plan: Analysed, cx: &Context, budget: SizeBudget) -> Analysed {
    if plan.tree.segment.is_empty() {
        return plan;
    }
    cx.pass(Pass::Unswitch, plan, |plan| {
        let next = cx.simplified(&unswitch(&plan.graph)?);
        let price = cx.price(budget);
        (price.of(&next) < price.of(plan)).then_some(next)
    })
}

/// With values computed where they are needed rather than once for all, where
/// that is less often: the last of the passes.
pub fn apart_at_last(plan: Analysed, cx: &Context, budget: SizeBudget) -> Analysed {
    let price = cx.price(budget);
    // Where copies are joined, what chooses what a loop starts with costs nothing.
    let mut best = match cx.runtime.overhead.step {
        Some(_) => with_loops_skipped(plan, cx, budget),
        None => plan,
    };
    for _ in 0..APART {
        let before = best.serial();
        best = cx.pass(Pass::Rematerialise, best, |plan| {
            let next = rematerialise(&plan.graph, &plan.tree, &price.worth(plan));
            next.map(|graph| cx.scheduled(graph))
        });
        if best.serial() == before {
            break;
        }
    }
    best
}

struct Site<'s> {
    cx: &'s Context,
    runtime: &'static Runtime,
    price: Price,
    budget: SizeBudget,
    /// Whether directions are so long that their products are whole, too.
    products: bool,
    /// Whether that makes a difference.
    other: AtomicBool,
}

impl Site<'_> {
    fn cost(&self, plan: &Analysed) -> f64 {
        self.price.of(plan)
    }

    /// The cheapest plan, with turns of loops before them or not.
    fn cheapest(&self, plain: &Analysed, early: Option<&Graph>) -> Analysed {
        let mut best = self.rewritten(plain).unwrap_or(plain.clone());
        // A copy that is dearer as it stands is for what forms make of it.
        let limit = match self.cost(&best) < FORMED * self.cost(plain) {
            true => f64::INFINITY,
            false => self.cost(plain),
        };
        for k in 0..plain.graph.loops.len() {
            if self.cx.fuel.spent() {
                break;
            }
            let of = LoopId(k as u32);
            let Some(peeled) = peel(&plain.graph, of, BODY) else {
                continue;
            };
            let guarded = guard(&peeled, of, 1, BODY);
            let early = early.and_then(|graph| peel(graph, of, BODY));
            let sooner = || guard(&in_loops(early.as_ref()?)?, of, 2, BODY);
            self.keep(Pass::LoopGuard, &mut best, || guarded, limit);
            self.keep(Pass::EarlyExit, &mut best, sooner, limit);
        }
        best
    }

    /// Puts the plan that a graph makes in the best one's place where it is cheaper. What costs
    /// more than the limit before forms are looked for is not looked at.
    fn keep(
        &self,
        pass: Pass,
        best: &mut Analysed,
        graph: impl FnOnce() -> Option<Graph>,
        limit: f64,
    ) {
        let found = self.cx.always(pass, || {
            let tried = self.cx.simplified(&graph()?);
            if self.cost(&tried) > limit {
                return None;
            }
            let found = self.rewritten(&tried)?;
            (self.cost(&found) < GUARD * self.cost(best)).then_some(found)
        });
        if let Some(found) = found {
            *best = found;
        }
    }

    /// A plan with thresholds, directions at their own length and algebra, as far
    /// as they make it cheaper; nothing where they do not.
    fn rewritten(&self, plain: &Analysed) -> Option<Analysed> {
        if self.cx.fuel.spent() {
            return None;
        }
        let (cx, runtime) = (self.cx, self.runtime);
        let mut now = cx.pass(Pass::InvertMonotone, plain.clone(), |plan| {
            let next = cx.simplified(&invert_monotone(&plan.graph, &plan.ranges, runtime)?);
            (self.cost(&next) < self.cost(plan)).then_some(next)
        });
        let base = now.clone();
        now = self.sited(now, FORMS, Rewrite::Forms);
        now = cx.pass(Pass::Unnormalised, now, |plan| {
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
        now = cx.pass(Pass::LengthTests, now, |plan| self.around(plan));
        now = self.sited(now, SHORTER, Rewrite::Identities);
        if self.budget.runs() {
            now = self.sited(now, SPANS, Rewrite::Spans);
        }
        (now.serial() != plain.serial()).then_some(now)
    }

    /// The plan with factors of few values chosen by these, where that is cheaper.
    fn specialised(&self, plan: Analysed) -> Analysed {
        let cx = self.cx;
        cx.pass(Pass::SpecialiseFactors, plan, |plan| {
            chosen(plan, cx, &self.price)
        })
    }

    /// The graph with one of its directions at its own length, each in turn.
    fn held(&self, plain: &Analysed) -> impl Iterator<Item = Analysed> {
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
            if self.cx.fuel.spent() {
                return None;
            }
            let (held, longer) = unnormalised(&plain.graph, &plain.ranges, length)?;
            self.other.fetch_or(longer.is_some(), Ordering::Relaxed);
            let held = longer.filter(|_| self.products).unwrap_or(held);
            Some(self.decided(self.cx.simplified(&held)))
        })
    }

    /// The plan without comparisons that the length of a vector decides.
    fn around(&self, plan: &Analysed) -> Option<Analysed> {
        let few = plan.graph.nodes.len() <= NODES;
        let next = few.then(|| around(&plan.graph, &plan.ranges, self.runtime))??;
        Some(self.cx.simplified(&next))
    }

    /// The plan without comparisons that come out the same at every pixel.
    fn decided(&self, plan: Analysed) -> Analysed {
        if plan.graph.nodes.len() > NODES {
            return plan;
        }
        match decided(&plan.graph, &plan.ranges, self.runtime, &self.cx.proofs) {
            Some(next) => self.cx.simplified(&next),
            None => plan,
        }
    }
}
