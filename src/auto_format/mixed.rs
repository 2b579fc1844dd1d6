//! Mixed word lengths by default: where the quickest format within the goal is one of long
//! numbers, the same with as many of them short as the picture allows.
//!
//! Which values are short is found by trials (`wordlength/precision.rs` of the compiler), so
//! that is not looked for in formats that others are quicker than.

use super::candidates::{CANDIDATE, expected, is_short};
use super::{Chosen, Why};
use crate::estimate;
use crate::failure::{Failure, Outcome};
use crate::scene::Scene;
use crate::target_args::ScreenArgs;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::targets::{Target, formats};

/// The plan that was chosen, or one of the same numbers of which some are shorter, if that is
/// quicker and within the goal.
///
/// # Errors
/// As for [`ScreenArgs::plan`], but for what makes the other plan impossible.
pub(super) fn mixed(screen: &ScreenArgs, scene: &Scene, chosen: Chosen) -> Outcome<Chosen> {
    let target = chosen.plan.target;
    let long = target.runtime.real;
    let has_short = |t: &&'static Target| t.runtime.narrow.is_some() && t.runtime.real == long;
    let (Some(why), false) = (&chosen.why, is_short(long)) else {
        return Ok(chosen);
    };
    let Some(other) = formats(target).find(has_short) else {
        return Ok(chosen);
    };
    // On the same screen: that long numbers fit into another was seen to be none.
    let mode = Some(chosen.plan.mode.name.to_owned()).filter(|name| !name.is_empty());
    let by = ScreenArgs {
        mode,
        ..screen.in_format_of(other)
    };
    let plan = match by.plan(scene, target, &[]) {
        Err(Failure::TooLarge(_) | Failure::Scene(_)) => return Ok(chosen),
        plan => plan?,
    };
    // The whole picture is looked at, whatever rows are asked for.
    let rows = match screen.rows {
        Some(_) => screen.unsearched(scene, other)?.rows,
        None => plan.rows,
    };
    let whole = |plan: &PlannedScene| {
        let mut whole = plan.clone();
        whole.rows = rows;
        whole
    };
    let cycles = |plan: &PlannedScene| estimate::sampled(plan, CANDIDATE.0, CANDIDATE.1).cycles();
    let (before, now) = (whole(&chosen.plan), whole(&plan));
    let share = expected(scene, &now, why.goal);
    match share.filter(|share| share.most <= why.goal) {
        Some(share) if cycles(&now) < cycles(&before) => {
            let why = Some(Why {
                expected: share.expected,
                ..why.clone()
            });
            Ok(Chosen {
                plan,
                why,
                tabled: None,
            })
        }
        _ => Ok(chosen),
    }
}
