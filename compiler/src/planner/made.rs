//! The planning driver: the passes in their order, then a routine for each value.

use super::SEARCH;
use super::assemble::{Scheduled, assemble};
use super::pass_manager::{PassSet, Pipeline};
use super::pipeline::Pass;
use super::planned::{PlannedScene, Rewriting};
use crate::analysis::verify::verify;
use crate::cost::size_budget::SizeBudget;
use crate::fuel::Fuel;
use crate::ir::graph::*;
use crate::passes::accuracy::accurate;
use crate::passes::algebra::ray_parameter::by_ray_parameter;
use crate::passes::branches::early_exit::{everywhere, without};
use crate::passes::branches::square_comparisons::square_comparisons;
use crate::passes::loops::strength_reduction::runs::is_exact;
use crate::passes::loops::strip_mine::strip_mined;
use crate::passes::simplify::fold::fold;
use crate::passes::simplify::integer_parts::integer_parts;
use crate::passes::simplify::unit_vectors::unit_vectors;
use crate::plan::Goal;
use crate::plan::params;
use crate::plan::params::ParamPlan;
use crate::planner::context::Context;
use crate::planner::search::branches::{asked_where_it_matters, in_arms, rewritten};
use crate::planner::search::columns::in_columns;
use crate::planner::search::forms::{apart_at_last, cheaper, with_inks_split};
use crate::planner::search::licm::licm;
use crate::planner::search::stepped::{Steps, stepped};
use crate::planner::search::sums::with_sums;
use crate::planner::search::whole_forms::cheapest_form;
use crate::schedule::analysed::{Analysed, Known};
use crate::schedule::statements::missing;
use crate::source::Diagnostic;
use crate::targets::Target;
use crate::wordlength::precision::{MODELLED, narrowed};
use rayon::prelude::*;
use slowlight_routine::Format;
use std::sync::Arc;
use std::sync::atomic::Ordering;

/// Plans a graph that `sema` lowered for this target's inks and offset.
pub fn plan(
    graph: &Graph,
    target: &'static Target,
    goal: &Goal,
) -> Result<PlannedScene, Vec<Diagnostic>> {
    plan_within(graph, target, goal, SEARCH, PassSet::default())
}

/// The same where the search may do so much work, in units of [`Fuel`], and some passes are left
/// out; by no work the plan is a draft.
pub fn plan_within(
    graph: &Graph,
    target: &'static Target,
    goal: &Goal,
    fuel: u64,
    without: PassSet,
) -> Result<PlannedScene, Vec<Diagnostic>> {
    plan_among(graph, target, goal, (fuel, MODELLED), without)
}

/// Passes after which a comparison of a column's height with the row need not be one any more:
/// machines that draw columns alone find them by it ([`crate::backend::mos6502`]).
const HIDES_COLUMNS: [Pass; 2] = [Pass::InvertMonotone, Pass::PolynomialForms];

/// The same for a plan among many, where fewer statements than usual may run in the routines'
/// models to find values' widths: where that is not enough, the plan was cut.
pub fn plan_among(
    graph: &Graph,
    target: &'static Target,
    goal: &Goal,
    (fuel, modelled): (u64, u64),
    without: PassSet,
) -> Result<PlannedScene, Vec<Diagnostic>> {
    let all = Rewriting::Fast {
        budget: SizeBudget::default(),
        steps: Steps::All,
    };
    let mut cx = Context::new(graph.clone(), target.runtime);
    cx.tables = target.columns_only;
    cx.draft = fuel == 0;
    cx.modelled = modelled.min(MODELLED);
    let without = match target.columns_only {
        true => HIDES_COLUMNS.into_iter().fold(without, PassSet::with),
        false => without,
    };
    cx.pipeline = Pipeline::without(without);
    candidate(&Arc::new(cx), target, goal, (all, Fuel::new(fuel)))?.assembled_to_run(target, goal)
}

/// The same with every shade in full, even where the ink is known before: what that is less
/// than [`plan`] is saved by [`crate::passes::branches::shannon`].
pub fn plan_with_every_shade(
    graph: &Graph,
    target: &'static Target,
    goal: &Goal,
) -> Result<PlannedScene, Vec<Diagnostic>> {
    let mut cx = Context::new(graph.clone(), target.runtime);
    cx.tables = target.columns_only;
    cx.every_shade = true;
    let all = Rewriting::Fast {
        budget: SizeBudget::default(),
        steps: Steps::All,
    };
    candidate(&Arc::new(cx), target, goal, (all, Fuel::new(SEARCH)))?.assembled_to_run(target, goal)
}

/// The same without the passes that rewrite formulas ([`crate::passes::accuracy`]
/// and those for speed): every one as the scene has it. For warnings about what the formulas lose, and to show what the pass does.
pub fn plan_as_written(
    graph: &Graph,
    target: &'static Target,
    goal: &Goal,
) -> Result<PlannedScene, Vec<Diagnostic>> {
    let none = (Rewriting::None, Fuel::new(SEARCH));
    let cx = Context::new(graph.clone(), target.runtime);
    candidate(&Arc::new(cx), target, goal, none)?.assembled_to_run(target, goal)
}

/// By how much shortcuts must make a plan cheaper: each is a test more to be read.
const SOONER: f64 = 0.95;

/// From where on only plans with them are looked at, where runs of columns may tell what exits
/// would: there the plan without may gain more by the other passes.
const SURELY: f64 = 0.75;

/// How often stable forms are looked for: what one makes may let another in.
const STABLE_ROUNDS: u32 = 4;

/// What the passes made of a scene: scheduled, but with no routine selected yet.
pub struct Candidate {
    cx: Arc<Context>,
    rewriting: Rewriting,
    params: Vec<ParamPlan>,
    plan: Analysed,
    /// What it took, whether it was cut short, and by how much fuel.
    work: u64,
    cut: bool,
    allowance: u64,
}

impl Candidate {
    /// What [`PlannedScene::cycles_a_pixel`] says of the plan that it makes.
    pub fn cycles_a_pixel(&self) -> f64 {
        self.cx
            .price(SizeBudget::default())
            .cycles_known(&self.plan)
    }

    /// What searching for it took, in units of [`Fuel`].
    pub fn work(&self) -> u64 {
        self.work
    }

    /// Whether two make the same plan.
    pub fn is(&self, other: &Candidate) -> bool {
        self.plan.serial() == other.plan.serial() || self.plan.graph == other.plan.graph
    }

    /// The plan with its routines; to place points so many statements are run.
    pub(super) fn assembled(
        self,
        target: &'static Target,
        goal: &Goal,
        looks: u64,
    ) -> Result<PlannedScene, Vec<Diagnostic>> {
        let Known {
            graph,
            tree,
            ranges,
            ..
        } = &*self.plan;
        let scheduled = Scheduled {
            graph: graph.clone(),
            tree: tree.clone(),
            ranges: ranges.clone(),
        };
        let mut plan = assemble(scheduled, self.params, target, goal, looks)?;
        plan.cut = self.cut;
        if plan.runtime.narrow.is_some() {
            let narrow = (self.cx).always(Pass::WordLengths, || {
                let (plan, ran) = narrowed(plan.clone(), self.cx.may_model());
                self.cx.ran.fetch_add(ran, Ordering::Relaxed);
                Some(plan)
            });
            plan = narrow.unwrap_or(plan);
        }
        Ok(PlannedScene {
            plan,
            rewriting: self.rewriting,
            work: self.work,
            allowance: self.allowance,
            looks: self.cx.looks(),
            looked: looks,
            cx: self.cx,
        })
    }

    /// The same with its points placed as usual.
    pub(super) fn assembled_to_run(
        self,
        target: &'static Target,
        goal: &Goal,
    ) -> Result<PlannedScene, Vec<Diagnostic>> {
        let looks = self.cx.looks();
        self.assembled(target, goal, looks)
    }
}

/// What the passes make of a scene, by a context that is kept for other plans, with the fuel
/// for this one.
pub(crate) fn candidate(
    kept: &Arc<Context>,
    target: &'static Target,
    goal: &Goal,
    (rewriting, fuel): (Rewriting, Fuel),
) -> Result<Candidate, Vec<Diagnostic>> {
    let allowance = fuel.given();
    let cx = &kept.with(fuel);
    let (origin, runtime) = (&*cx.origin, target.runtime);
    if let Err(broken) = verify(origin) {
        let message =
            format!("the graph is broken: {broken}; a fault of the compiler, please report it");
        return Err(vec![Diagnostic::error(origin.span(broken.node), message)]);
    }
    let params = params::params(origin, runtime)?;
    let rounds = match rewriting {
        Rewriting::None => 0,
        _ => STABLE_ROUNDS,
    };
    // Where sums are rounded to as few bits as that, tiles' edges move by whole pixels.
    let logs = rounds > 0 && matches!(runtime.real, Format::Log { .. });
    let whole = |graph: Graph| {
        let made = logs.then(|| cx.always(Pass::IntegerParts, || Some(integer_parts(&graph))));
        made.flatten().unwrap_or(graph)
    };
    let drawn = |graph: Graph| match rewriting {
        Rewriting::Fast { budget, .. } if budget.runs() && runtime.segments => {
            let made = cx.always(Pass::StripMine, || {
                strip_mined(&graph, in_byte(&graph, target, goal))
            });
            made.unwrap_or(graph)
        }
        _ => graph,
    };
    let ready = |graph: &Graph| steady(cx, &whole(drawn(fold(&without(graph)))), rounds);
    let mut now = ready(origin);
    let form = match rewriting {
        Rewriting::Fast { budget, .. } => cheapest_form((origin, &now), &ready, cx, budget),
        _ => None,
    };
    let origin = form.as_ref().map_or(origin, |(graph, _)| graph);
    if let Some((_, plan)) = &form {
        now = plan.clone();
    }
    if let Rewriting::Fast { budget, steps } = rewriting {
        let exits = !origin.early.is_empty() && !cx.pipeline.without.has(Pass::EarlyExit);
        let early = exits.then(|| steady(cx, &whole(drawn(fold(origin))), rounds));
        now = searched((now, early), cx, target, budget, steps);
    }
    let Known {
        graph,
        tree,
        ranges,
        ..
    } = &*now;
    // What the last passes placed anew must still begin with its run.
    if let Rewriting::Fast { budget, steps } = rewriting
        && steps != Steps::None
        && !is_exact(graph, tree, ranges)
    {
        let steps = Steps::None;
        let without = Rewriting::Fast { budget, steps };
        let mut made = candidate(kept, target, goal, (without, cx.fuel.share()))?;
        made.work += cx.fuel.burnt();
        made.cut |= cx.fuel.was_cut();
        made.allowance = allowance;
        return Ok(made);
    }
    if let Some(id) = missing(graph, tree) {
        let message = format!("the schedule lost {id}: a fault of the compiler, please report it");
        return Err(vec![Diagnostic::error(graph.span(id), message)]);
    }
    Ok(Candidate {
        cx: kept.clone(),
        rewriting,
        params,
        plan: now,
        work: cx.fuel.burnt(),
        cut: cx.fuel.was_cut(),
        allowance,
    })
}

/// The cheapest plan that the passes that search find from one; `early` is the same with the
/// scene's exits in it.
fn searched(
    (plain, early): (Analysed, Option<Analysed>),
    cx: &Context,
    target: &'static Target,
    budget: SizeBudget,
    steps: Steps,
) -> Analysed {
    let price = cx.price(budget);
    let plain = in_arms(plain, cx, budget);
    let early = early.map(|plan| in_arms(plan, cx, budget));
    let early = early.as_ref().map(|settled| &settled.graph);
    let exits = early
        .and_then(everywhere)
        .map(|graph| cx.simplified(&graph));
    // How much the exits outside of loops gain hardly hangs on the other passes, but for spans.
    let part = (exits.as_ref()).map_or(1.0, |exits| price.of(exits) / price.of(&plain));
    let exits = exits.filter(|_| part < SOONER);
    let mut starts = Vec::new();
    let surely = match cx.runtime.segments {
        true => SURELY,
        false => SOONER,
    };
    let alone = exits.is_some() && part < surely;
    if !alone {
        starts.push((plain.clone(), early.cloned()));
        // Where runs of columns are drawn as a whole, points by their distance along a ray may
        // tell where these end.
        let along_rays = || {
            cx.runtime
                .segments
                .then(|| by_ray_parameter(&plain.graph))
                .flatten()
        };
        if let Some(other) = cx.always(Pass::RayParameter, along_rays) {
            let early = early.map(|graph| by_ray_parameter(graph).unwrap_or(graph.clone()));
            starts.push((cx.simplified(&other), early));
        }
    }
    let usual = starts.len();
    starts.extend(exits.map(|exits| (exits, None)));
    let found: Vec<(Analysed, Fuel)> = (starts.into_par_iter())
        .map(|(plain, early)| {
            let cx = cx.with(cx.fuel.share());
            let all = cheaper(plain.clone(), early.as_ref(), &cx, budget)
                .into_iter()
                .map(|plan| asked_where_it_matters(plan, &cx, budget))
                .map(|plan| rewritten(plan, &cx, budget))
                .map(|plan| stepped(plan, &cx, target, budget, steps))
                .map(|plan| with_sums(plan, &cx, budget))
                .map(|plan| with_inks_split(plan, &cx, budget));
            (price.cheapest(all).unwrap_or(plain), cx.fuel)
        })
        .collect();
    found.iter().for_each(|(_, fuel)| cx.fuel.settle(fuel));
    let mut found = found.into_iter().map(|(plan, _)| plan);
    let best = price.cheapest(found.by_ref().take(usual));
    let sooner = found.next().filter(|sooner| {
        let cost = |best| SOONER * price.of(best);
        best.as_ref()
            .is_none_or(|best| price.of(sooner) < cost(best))
    });
    let mut now = sooner.or(best).unwrap_or(plain);
    now = apart_at_last(now, cx, budget);
    now = in_columns(now, cx, target, budget);
    licm(now, cx, budget)
}

/// A graph with stable forms of its formulas.
fn steady(cx: &Context, origin: &Graph, rounds: u32) -> Analysed {
    let mut now = cx.scheduled(fold(origin));
    for _ in 0..rounds {
        let next = cx.always(Pass::AccuracyRules, || {
            accurate(&now.graph, &now.ranges, cx.slack())
        });
        let Some(next) = next else {
            break;
        };
        now = cx.scheduled(fold(&next));
    }
    if rounds > 0
        && let Some(next) = cx.always(Pass::UnitVectors, || unit_vectors(&now.graph, &now.ranges))
    {
        now = cx.scheduled(fold(&next));
    }
    let squared = || square_comparisons(&now.graph, &now.ranges);
    if rounds > 0
        && let Some(next) = cx.always(Pass::SquareComparisons, squared)
    {
        now = cx.scheduled(fold(&next));
    }
    cx.simplified(&now.graph)
}

/// How many of the picture's pixels share a byte of the screen, where that matters.
fn in_byte(graph: &Graph, target: &Target, goal: &Goal) -> u32 {
    match graph.image.block {
        (1, 1) => (target.pixels)(&goal.mode),
        _ => 1,
    }
}
