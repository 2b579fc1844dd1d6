//! Tables of functions: kept where a picture stays within its error goal with them.
//!
//! Formats of few bits are judged with their tables, as all that they do is inexact. Of a machine
//! that has one format, or of a format that is asked for, tables may be all that is. Tables with
//! lines between their entries come after those without, exact functions last.

use super::candidates::{Share, expected};
use crate::estimate;
use crate::failure::{Failure, Outcome};
use crate::scene::Scene;
use crate::target_args::{ScreenArgs, TABLES};
use slowlight_compiler::passes::simplify::function_tables::{
    has_function_tables, has_periods_in_open_loops,
};
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::planner::pipeline::Pass;
use slowlight_compiler::targets::Target;

/// What is left out, step by step.
const LEFT_OUT: [&[Pass]; 2] = [&[TABLES[0]], &TABLES];

/// Of the pixels that are wrong with tables, at most such a part is without where these are left out.
const BLAMED: f64 = 0.75;

/// A scene's plans with ever fewer tables of functions, as long as there are any.
pub(super) struct Fewer<'s> {
    screen: &'s ScreenArgs,
    scene: &'s Scene,
    target: &'static Target,
    step: usize,
}

impl<'s> Fewer<'s> {
    pub fn new(screen: &'s ScreenArgs, scene: &'s Scene, target: &'static Target) -> Fewer<'s> {
        Fewer {
            screen,
            scene,
            target,
            step: 0,
        }
    }

    /// The next after a plan; nothing where that has no tables, or is impossible without.
    ///
    /// # Errors
    /// As for [`ScreenArgs::plan`], but for what makes the other plan impossible.
    pub fn after(&mut self, plan: &PlannedScene) -> Outcome<Option<PlannedScene>> {
        if !has_function_tables(&plan.graph) {
            return Ok(None);
        }
        if self.step == 0 && plan.pipeline().count(TABLES[0]).kept == 0 {
            self.step = 1;
        }
        let Some(passes) = LEFT_OUT.get(self.step) else {
            return Ok(None);
        };
        self.step += 1;
        let by = (passes.iter()).fold(self.screen.clone(), |by, pass| by.without(*pass));
        match by.plan(self.scene, self.target, &[]) {
            Err(Failure::TooLarge(_) | Failure::Scene(_)) => Ok(None),
            other => other.map(Some),
        }
    }
}

/// A plan, or one with fewer tables of functions where these are beyond the goal; and what part
/// of the pixels is expected to be wrong by tables, if there are any.
///
/// # Errors
/// As for [`ScreenArgs::plan`], but for what makes the other plan impossible.
pub(super) fn within_goal(
    screen: &ScreenArgs,
    scene: &Scene,
    plan: PlannedScene,
) -> Outcome<(PlannedScene, Option<f64>)> {
    if !has_function_tables(&plan.graph) {
        return Ok((plan, None));
    }
    let target = plan.target;
    // The whole picture is looked at, whatever rows are asked for.
    let rows = match screen.rows {
        Some(_) => screen.unsearched(scene, target)?.rows,
        None => plan.rows,
    };
    let goal = screen.error_goal();
    let seen = |plan: PlannedScene| {
        let mut whole = plan.clone();
        whole.rows = rows;
        let share = expected(scene, &whole, goal);
        Seen {
            cycles: estimate::cycles(&whole),
            share,
            plan,
        }
    };
    let mut fewer = Fewer::new(screen, scene, target);
    let mut all = vec![seen(plan)];
    while let Some(last) = all.last()
        && (!last.is_within(goal) || last.may_be_slower())
        && let Some(next) = fewer.after(&last.plan)?
    {
        all.push(seen(next));
    }
    let within = all
        .iter()
        .enumerate()
        .filter(|(_, one)| one.is_within(goal));
    let quickest = within.min_by(|(_, a), (_, b)| a.cycles.total_cmp(&b.cycles));
    // Where the format itself is as wrong, tables are not to blame.
    let wrong = |at: usize| Some(all.get(at)?.share?.expected);
    let last = all.len() - 1;
    let blamed = match (wrong(0), wrong(last)) {
        (Some(with), Some(without)) => without < BLAMED * with,
        _ => true,
    };
    let at = quickest.map_or(if blamed { last } else { 0 }, |(at, _)| at);
    let Seen { plan, share, .. } = all.swap_remove(at);
    let tabled = has_function_tables(&plan.graph);
    let expected = share.filter(|_| tabled).map(|share| share.expected);
    Ok((plan, expected))
}

/// A plan, its cycles, and what is known of its picture.
struct Seen {
    plan: PlannedScene,
    cycles: f64,
    share: Option<Share>,
}

impl Seen {
    /// Whether the same may be quicker without tables: where these take memory that others need, or
    /// loops go on for longer.
    fn may_be_slower(&self) -> bool {
        self.plan.is_made_small() || has_periods_in_open_loops(&self.plan.graph)
    }

    /// Whether its picture is known to be within the goal: without tables it is what was asked for.
    fn is_within(&self, goal: f64) -> bool {
        self.share.is_some_and(|share| share.most <= goal)
    }
}

/// What is said of that on the terminal.
pub(super) fn text(wrong: f64) -> String {
    format!(
        "sines and cosines of what changes from pixel to pixel are looked up in tables; by that \
         some {:.1}% of the pixels may be wrong (--tables no works them out)",
        100.0 * wrong
    )
}
