//! The graph of a scene as a target is to run it: whether shapes that are alike are a table and a
//! loop, or code each, is decided by what plans of both without a search are said to take.

use super::ScreenArgs;
use crate::estimate;
use crate::failure::Outcome;
use crate::need;
use crate::scene::{Limits, Precision, Scene};
use slowlight_compiler::ir::graph::Graph;
use slowlight_compiler::plan::Goal;
use slowlight_compiler::planner::{PlannedScene, plan_within};
use slowlight_compiler::sema::{INSTANCES, Ways};
use slowlight_compiler::targets::Target;

/// Of how many shapes a scene may be for each to be code of its own, where it could be otherwise.
const MOST: usize = 40;

impl ScreenArgs {
    /// The graph of a scene.
    ///
    /// # Errors
    /// Where it does not compile.
    pub(super) fn lowered(
        &self,
        scene: &Scene,
        target: &'static Target,
        goal: &Goal,
        set: &[(String, Vec<f64>)],
    ) -> Outcome<Graph> {
        let limits = self.limits();
        let lower = |limits: Limits| {
            scene.graph_within(Some(goal.mode.inks), Precision::of(target), set, limits)
        };
        let together = lower(limits)?;
        let counts = scene.checked.program.scenes.iter().map(|s| s.members.len());
        let most = counts.max().unwrap_or(0);
        if limits.ways.separate || !(INSTANCES..=MOST).contains(&most) {
            return Ok(together);
        }
        let separate = lower(Limits {
            ways: Ways {
                separate: true,
                ..limits.ways
            },
            ..limits
        })?;
        if separate.nodes.len() == together.nodes.len() {
            return Ok(together);
        }
        let takes = |graph: &Graph| {
            let whole = Goal {
                rows: None,
                ..goal.clone()
            };
            let plan = plan_within(graph, target, &whole, 0, self.passes.left_out()).ok()?;
            fits(&plan).then(|| estimate::cycles(&plan))
        };
        Ok(match (takes(&together), takes(&separate)) {
            (Some(a), Some(b)) if b < a => separate,
            (None, Some(_)) => separate,
            _ => together,
        })
    }
}

/// Whether a plan's program is small enough as it is.
fn fits(plan: &PlannedScene) -> bool {
    need::first(plan).is_ok_and(|need| need.is_none_or(|need| need.fits()))
}
