//! How a plan is made: the passes in their order, then a routine for each value.

use super::cheaper::{apart_at_last, cheaper, steps_ahead, with_inks_split, with_recipes_followed};
use super::chosen::{asked_where_it_matters, in_arms, rewritten};
use super::licm::licm;
use super::narrowed::narrowed;
use super::params::{self, ParamPlan};
use super::pipeline::{Pass, PassSet, Pipeline};
use super::price::Price;
use super::settled::{Known, Settled};
use super::stepped::{Steps, stepped};
use super::sums::with_sums;
use super::tabulated::in_columns;
use super::thrift::Thrift;
use super::whole_forms::cheapest_form;
use super::workshop::Workshop;
use super::{Copies, Goal, Plan, SEARCH, choose, fold_uses, names, points, recipes};
use crate::flow::graph::*;
use crate::flow::tree::*;
use crate::flow::verify::verify;
use crate::fuel::Fuel;
use crate::passes::along::along;
use crate::passes::early::{everywhere, without};
use crate::passes::fold::fold;
use crate::passes::int_roots::int_roots;
use crate::passes::int_signs::int_signs;
use crate::passes::interlace::{interlaced, passes};
use crate::passes::ramps::runs::is_exact;
use crate::passes::reciprocal_roots::reciprocal_roots;
use crate::passes::schedule::missing;
use crate::passes::stable::stable;
use crate::passes::still::still;
use crate::passes::units::units;
use crate::passes::whole_parts::whole_parts;
use crate::range::Ranges;
use crate::source::Diagnostic;
use crate::target::{Mode, Target};
use slowlight_routine::{Format, Op, Range, Routine, Runtime, scale};
use std::sync::Arc;

/// Plans a graph that `sema` lowered for this target's inks and offset.
pub fn plan(graph: &Graph, target: &'static Target, goal: &Goal) -> Result<Plan, Vec<Diagnostic>> {
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
) -> Result<Plan, Vec<Diagnostic>> {
    let all = Rewriting::Fast {
        thrift: Thrift::default(),
        steps: Steps::All,
    };
    let mut shop = Workshop::new(graph.clone(), target.runtime);
    shop.draft = fuel == 0;
    shop.pipeline = Pipeline::without(without);
    planned(&Arc::new(shop), target, goal, (all, Fuel::new(fuel)))
}

/// The same with every shade in full, even where the ink is known before: what that is less
/// than [`plan`] is saved by [`crate::passes::either`].
pub fn plan_with_every_shade(
    graph: &Graph,
    target: &'static Target,
    goal: &Goal,
) -> Result<Plan, Vec<Diagnostic>> {
    let mut shop = Workshop::new(graph.clone(), target.runtime);
    shop.every_shade = true;
    let all = Rewriting::Fast {
        thrift: Thrift::default(),
        steps: Steps::All,
    };
    planned(&Arc::new(shop), target, goal, (all, Fuel::new(SEARCH)))
}

/// The same without the passes that rewrite formulas ([`crate::passes::stable`]
/// and those for speed): every one as the scene has it. For warnings about what the formulas lose, and to show what the pass does.
pub fn plan_as_written(
    graph: &Graph,
    target: &'static Target,
    goal: &Goal,
) -> Result<Plan, Vec<Diagnostic>> {
    let none = (Rewriting::None, Fuel::new(SEARCH));
    let shop = Workshop::new(graph.clone(), target.runtime);
    planned(&Arc::new(shop), target, goal, none)
}

/// Which passes may rewrite formulas.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rewriting {
    /// None: every formula as the scene has it.
    None,
    /// [`crate::passes::stable`].
    Stable,
    /// Those for speed, too; perhaps with little memory.
    Fast { thrift: Thrift, steps: Steps },
}

/// By how much shortcuts must make a plan cheaper: each is a test more to be read.
const SOONER: f64 = 0.95;

/// How often stable forms are looked for: what one makes may let another in.
const STABLE_ROUNDS: u32 = 4;

/// What a pixel of a pass takes more, in cycles: it says its column. In BASIC that is
/// nothing beside what passes save.
const APART: f64 = 30.0;

/// A plan, in passes where these make it cheaper.
pub(super) fn planned(
    shop: &Arc<Workshop>,
    target: &'static Target,
    goal: &Goal,
    (rewriting, fuel): (Rewriting, Fuel),
) -> Result<Plan, Vec<Diagnostic>> {
    let steps = steps_ahead(target.runtime);
    let first = shop.with(fuel.share());
    let plan = planned_in((shop, &first), target, goal, rewriting, true)?;
    fuel.settle(&first.fuel);
    let mut plan = match steps && passes(&plan.graph) > 1 {
        true => {
            // What is left, and some in any case: the other way may be the better one.
            let second = shop.with(Fuel::new(fuel.left().max(fuel.given() / 4)));
            let other = planned_in((shop, &second), target, goal, rewriting, false)?;
            fuel.settle(&second.fuel);
            match other.cycles_a_pixel() < plan.cycles_a_pixel() + APART {
                true => other,
                false => plan,
            }
        }
        false => plan,
    };
    (plan.work, plan.cut) = (fuel.burnt(), fuel.was_cut());
    plan.allowance = fuel.given();
    if plan.runtime.narrow.is_none() {
        return Ok(plan);
    }
    let wide = plan.clone();
    let narrow = shop.always(Pass::WordLengths, || Some(narrowed(plan)));
    Ok(narrow.unwrap_or(wide))
}

/// A plan by a workshop that is kept for other plans, with the fuel for this one.
fn planned_in(
    (kept, shop): (&Arc<Workshop>, &Workshop),
    target: &'static Target,
    goal: &Goal,
    rewriting: Rewriting,
    apart: bool,
) -> Result<Plan, Vec<Diagnostic>> {
    let (origin, runtime) = (&*shop.origin, target.runtime);
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
    let whole = |graph: Graph| match (logs, rounds > 0 && steps_ahead(runtime)) {
        (true, _) => {
            let made = shop.always(Pass::IntegerParts, || Some(whole_parts(&graph)));
            made.unwrap_or(graph)
        }
        (_, true) => {
            let made = shop.always(Pass::IntegerSigns, || Some(int_signs(&graph)));
            made.unwrap_or(graph)
        }
        _ => graph,
    };
    let drawn = |graph: Graph| match rewriting {
        Rewriting::Fast { thrift, .. } if apart && thrift.passes() && runtime.segments => {
            let made = shop.always(Pass::StripMine, || {
                interlaced(&graph, in_byte(&graph, target, goal))
            });
            made.unwrap_or(graph)
        }
        _ => graph,
    };
    let ready = |graph: &Graph| steady(shop, &whole(drawn(fold(&without(graph)))), rounds);
    let mut now = ready(origin);
    let form = match rewriting {
        Rewriting::Fast { thrift, .. } => cheapest_form((origin, &now), &ready, shop, thrift),
        _ => None,
    };
    let origin = form.as_ref().map_or(origin, |(graph, _)| graph);
    if let Some((_, plan)) = &form {
        now = plan.clone();
    }
    if let Rewriting::Fast { thrift, steps } = rewriting {
        let exits = !origin.early.is_empty() && !shop.pipeline.without.has(Pass::EarlyExit);
        let early = exits.then(|| steady(shop, &whole(drawn(fold(origin))), rounds));
        now = in_arms(now, shop, thrift);
        let early = early.map(|plan| in_arms(plan, shop, thrift));
        let early = early.as_ref().map(|settled| &settled.graph);
        let price = Price::new(shop, thrift);
        let cheapest = |all: Vec<Settled>| {
            let all = all
                .into_iter()
                .map(|plan| asked_where_it_matters(plan, shop, thrift))
                .map(|plan| rewritten(plan, shop, thrift))
                .map(|plan| with_recipes_followed(plan, shop, thrift))
                .map(|plan| stepped(plan, shop, target, thrift, steps))
                .map(|plan| with_sums(plan, shop, thrift))
                .map(|plan| with_inks_split(plan, shop, thrift));
            price.cheapest(all)
        };
        let mut all = cheaper(now.clone(), early, shop, thrift);
        let other = shop.always(Pass::RayParameter, || points_along(&now.graph, runtime));
        if let Some(other) = other {
            let early = early.map(|graph| along(graph).unwrap_or(graph.clone()));
            all.extend(cheaper(shop.settle(&other), early.as_ref(), shop, thrift));
        }
        let usual = cheapest(all).unwrap_or(now);
        // Where spans of columns tell what a row meets, shortcuts outside of loops do not pay.
        let spans = runtime.segments && !steps_ahead(runtime);
        let sooner = early.filter(|_| !spans).and_then(everywhere);
        let sooner = sooner
            .and_then(|graph| cheapest(cheaper(shop.settle(&graph), None, shop, thrift)))
            .filter(|sooner| price.of(sooner) < SOONER * price.of(&usual));
        now = sooner.unwrap_or(usual);
        now = apart_at_last(now, shop, thrift);
        now = in_columns(now, shop, target, thrift);
        now = licm(now, shop, thrift);
    }
    let Known {
        graph,
        tree,
        ranges,
        ..
    } = &*now;
    // What the last passes placed anew must still begin with its run.
    if let Rewriting::Fast { thrift, steps } = rewriting
        && steps != Steps::None
        && !is_exact(graph, tree, ranges)
    {
        let steps = Steps::None;
        let without = Rewriting::Fast { thrift, steps };
        return planned_in((kept, shop), target, goal, without, apart);
    }
    if let Some(id) = missing(graph, tree) {
        let message = format!("the schedule lost {id}: a fault of the compiler, please report it");
        return Err(vec![Diagnostic::error(graph.span(id), message)]);
    }
    let origin = (kept.clone(), rewriting);
    let (graph, tree, ranges) = (graph.clone(), tree.clone(), ranges.clone());
    assemble(graph, tree, ranges, params, target, goal, origin)
}

/// A graph with stable forms of its formulas.
fn steady(shop: &Workshop, origin: &Graph, rounds: u32) -> Settled {
    let mut now = shop.scheduled(fold(origin));
    for _ in 0..rounds {
        let next = shop.always(Pass::AccuracyRules, || {
            stable(&now.graph, &now.ranges, shop.slack())
        });
        let Some(next) = next else {
            break;
        };
        now = shop.scheduled(fold(&next));
    }
    if rounds > 0
        && let Some(next) = shop.always(Pass::UnitVectors, || units(&now.graph, &now.ranges))
    {
        now = shop.scheduled(fold(&next));
    }
    shop.settle(&now.graph)
}

/// A plan of statements whose ranges are known.
pub(super) fn assemble(
    mut graph: Graph,
    mut tree: Tree,
    mut ranges_now: Ranges,
    mut params: Vec<ParamPlan>,
    target: &'static Target,
    goal: &Goal,
    origin: (Arc<Workshop>, Rewriting),
) -> Result<Plan, Vec<Diagnostic>> {
    let runtime = target.runtime;
    if runtime.has(Op::IntRoot) {
        let most = scale::most(runtime.real.bits()) as f64;
        int_roots(&mut graph, &mut tree, &ranges_now, most);
    }
    if runtime.has(Op::ReciprocalRoot) {
        reciprocal_roots(&mut graph, &mut tree);
    }
    let mut tables = recipes::made(&graph, runtime);
    let mut points = None;
    let looks = match origin.0.draft {
        true => points::sample::DRAFT,
        false => points::sample::PATIENCE,
    };
    if let Some((found, ranges)) = points::pointed(&graph, &tree, runtime, looks) {
        points::held::hold(&graph, runtime, &found, &mut tables, &mut params);
        (points, ranges_now) = (Some(found), ranges);
    }
    let routines = choose::choose(&graph, &tree, &ranges_now, runtime, points.as_ref())?;
    let gather = graph.diffusion.as_ref().and_then(|_| gathering(runtime));
    let runs = !tree.segment.is_empty();
    let still = runs.then(|| still(&graph)).flatten();
    let folded = fold_uses::folded(&graph, &tree, still.as_ref(), &routines);
    let (offset, columns, rows) = frame(&graph.image, &goal.mode);
    let rows = match goal.rows {
        Some((first, last)) => (first.clamp(rows.0, rows.1), last.clamp(rows.0, rows.1)),
        None => rows,
    };
    let homes = names::homes(&graph, &tree);
    Ok(Plan {
        name: goal.name.clone(),
        target,
        runtime,
        mode: goal.mode,
        offset,
        columns,
        rows,
        plot: goal.plot,
        tight: false,
        listing: false,
        statics: false,
        items: Vec::new(),
        drawn: None,
        lean: false,
        copies: Copies::None,
        brief: false,
        scant: false,
        undocumented: false,
        page: None,
        ranges: ranges_now,
        params,
        routines,
        points,
        tables,
        gather,
        folded,
        still,
        homes,
        graph,
        tree,
        work: 0,
        cut: false,
        allowance: SEARCH,
        origin,
    })
}

/// The graph with points by their distance along a ray, where polynomials that are stepped
/// may tell what is met.
fn points_along(graph: &Graph, runtime: &Runtime) -> Option<Graph> {
    steps_ahead(runtime).then(|| along(graph)).flatten()
}

/// How many of the picture's pixels share a byte of the screen, where that matters.
fn in_byte(graph: &Graph, target: &Target, goal: &Goal) -> u32 {
    match graph.image.block {
        (1, 1) => (target.pixels)(&goal.mode),
        _ => 1,
    }
}

/// The addition that is right for all arguments: what a pixel receives has no
/// bounds that could be known beforehand.
fn gathering(runtime: &'static Runtime) -> Option<&'static Routine> {
    let all = Range::ALL;
    let fits = |r: &&Routine| r.op == Op::Add && (r.domain)(&[all, all], all);
    runtime.routines.iter().find(fits)
}

/// Where the picture stands on the screen, and which of it is seen: centred
/// where the screen is larger, cropped where it is smaller.
pub(super) fn frame(image: &Image, mode: &Mode) -> ((i32, i32), (u32, u32), (u32, u32)) {
    let axis = |count: u32, block: u32, screen: u32| {
        let (count, block, screen) = (i64::from(count), i64::from(block), i64::from(screen));
        let offset = (screen - count * block).div_euclid(2);
        // Whole blocks only.
        let first = (-offset).max(0).div_euclid(block) + i64::from((-offset).max(0) % block > 0);
        let last = ((screen - offset).div_euclid(block) - 1).min(count - 1);
        (offset as i32, (first as u32, last.max(first) as u32))
    };
    let (left, columns) = axis(image.width, image.block.0, mode.width);
    let (top, rows) = axis(image.height, image.block.1, mode.height);
    ((left, top), columns, rows)
}
