//! Search over branch passes: operations in the arms of selects
//! ([`crate::passes::branches::push_into_select`]), factors that are chosen by the values that
//! they take ([`crate::passes::branches::specialise_factors`]), and conditions that are asked
//! only where they matter ([`crate::passes::branches::shannon`]).

use crate::cost::price::Price;
use crate::cost::size_budget::SizeBudget;
use crate::ir::graph::{Graph, NodeId};
use crate::passes::branches::prune_minima::prune_minima;
use crate::passes::branches::push_into_select::{conditions, push_into_select};
use crate::passes::branches::shannon;
use crate::passes::branches::shannon::shannon;
use crate::passes::branches::specialise_factors::specialise_factors;
use crate::passes::simplify::fold::fold;
use crate::planner::context::Context;
use crate::planner::context::NODES;
use crate::planner::pipeline::{Pass, REWRITES, Rewrite};
use crate::schedule::analysed::Analysed;
use slowlight_routine::Format;
use std::cell::Cell;

/// By how much operations in arms must make the plan cheaper: each choice is asked once
/// more.
const ARMS: f64 = 0.99;

/// By how much a choice must make the plan cheaper: what a jump more costs is not known
/// so well.
const CHOICE: f64 = 0.999;

/// How many factors are chosen.
const FACTORS: usize = 8;

/// With operations made in the arms of choices where they are none in one of them.
pub fn in_arms(plan: Analysed, cx: &Context, budget: SizeBudget) -> Analysed {
    cx.pass(Pass::PushIntoSelect, plan, |plan| {
        let price = cx.price(budget);
        each_condition(plan, cx, &price, conditions, |plan, cond| {
            push_into_select(&plan.graph, &plan.ranges, cond)
        })
    })
}

/// The plan rewritten by its conditions, each in turn where that makes it cheaper; nothing
/// where it nowhere does.
fn each_condition(
    plan: &Analysed,
    cx: &Context,
    price: &Price,
    conditions: fn(&Graph) -> Vec<NodeId>,
    by: impl Fn(&Analysed, NodeId) -> Option<Graph>,
) -> Option<Analysed> {
    let mut best = None;
    for k in 0..conditions(&plan.graph).len() {
        let now = best.as_ref().unwrap_or(plan);
        if !cx.may_look(&now.graph) {
            break;
        }
        let cond = conditions(&now.graph).get(k).copied();
        let next = cond.and_then(|cond| by(now, cond));
        if let Some(next) = next.map(|graph| cx.simplified(&graph))
            && price.of(&next) < ARMS * price.of(now)
        {
            best = Some(next);
        }
    }
    best
}

/// With conditions asked only where the ink is not the same either way.
pub fn asked_where_it_matters(plan: Analysed, cx: &Context, budget: SizeBudget) -> Analysed {
    // Where each value has its own point, shades that nobody asks for in full would have
    // none that suits them, and errors of shades could not be told.
    let scaled = matches!(cx.runtime.real, Format::Scaled { .. });
    if cx.every_shade || scaled || cx.fuel.spent() {
        return plan;
    }
    let price = cx.price(budget);
    cx.pass(Pass::Shannon, plan, |plan| {
        each_condition(plan, cx, &price, shannon::conditions, |plan, cond| {
            shannon(&plan.graph, cond).map(|graph| fold(&graph))
        })
    })
}

/// With what each of [`REWRITES`] makes of the plan, where that is cheaper.
///
/// Minima whose terms are bounded and the same terms as polynomials are seldom both had: which
/// of the two comes first is decided by the price of what all make of it.
pub fn rewritten(plan: Analysed, cx: &Context, budget: SizeBudget) -> Analysed {
    let price = cx.price(budget);
    let polynomials = Cell::new(false);
    let by = |plan: Analysed, (pass, rewrite): &(Pass, Rewrite)| {
        cx.pass(*pass, plan, |plan| {
            let next = cx.simplified(&rewrite(&plan.graph, &plan.ranges, cx.runtime)?);
            let kept = price.of(&next) < GAIN * price.of(plan);
            polynomials.set(polynomials.get() || kept && *pass == Pass::LoopPolynomials);
            kept.then_some(next)
        })
    };
    let first = REWRITES.iter().fold(plan.clone(), by);
    if !polynomials.get() || prune_minima(&plan.graph, &plan.ranges, cx.runtime).is_none() {
        return first;
    }
    let (early, late): (Vec<_>, Vec<_>) =
        (REWRITES.iter()).partition(|(pass, _)| *pass != Pass::LoopPolynomials);
    let second = early.into_iter().chain(late).fold(plan, by);
    match price.of(&second) < price.of(&first) {
        true => second,
        false => first,
    }
}

/// By how much one of [`REWRITES`] must make a plan cheaper: prices are no nearer than that.
const GAIN: f64 = 0.998;

/// The plan with what is multiplied by one of few numbers chosen by which that is, each
/// in the cheapest way; nothing where that pays nowhere.
pub fn chosen(plan: &Analysed, cx: &Context, price: &Price) -> Option<Analysed> {
    let mut best: Option<Analysed> = None;
    if plan.graph.nodes.len() > NODES {
        return best;
    }
    for _ in 0..FACTORS {
        if cx.fuel.spent() {
            break;
        }
        let now = best.as_ref().unwrap_or(plan);
        let ways = specialise_factors(&now.graph, &now.ranges, cx.runtime);
        let next = price.cheapest(ways.map(|graph| cx.simplified(&graph)));
        let limit = CHOICE * price.of(now);
        let Some(next) = next.filter(|next| price.of(next) < limit) else {
            break;
        };
        best = Some(next);
    }
    best
}
