//! What is found in a context is what would be made.
#![allow(clippy::unwrap_used)]

use super::SEARCH;
use super::made::{candidate, plan};
use super::planned::Rewriting;
use crate::cost::size_budget::SizeBudget;
use crate::fuel::Fuel;
use crate::plan::{Goal, Plan};
use crate::planner::context::Context;
use crate::planner::search::stepped::Steps;
use crate::scene::check;
use crate::sema::Options;
use crate::targets::{default_mode, find};
use std::sync::Arc;

/// A plan with less memory that was made after another is the one made by itself.
#[test]
fn plans_made_again_are_those_made_anew() {
    let scene = check("mirrors", include_str!("../../../examples/mirrors.scn"));
    let target = find("bbc:micro").unwrap();
    let graph = scene.lower(&Options::default()).unwrap();
    let goal = Goal {
        name: "mirrors".to_owned(),
        mode: default_mode(target, 320, 256).unwrap(),
        rows: None,
        plot: true,
    };
    let text = |plan: &Plan| crate::backend::emit(plan)[0].text.clone();
    let plenty = plan(&graph, target, &goal).unwrap();
    let step = 4;
    let again = plenty
        .thriftier(step)
        .and_then(|made| plenty.completed(made))
        .unwrap();
    let budget = SizeBudget::step(step).unwrap();
    let anew = candidate(
        &Arc::new(Context::new(graph, target.runtime)),
        target,
        &goal,
        (
            Rewriting::Fast {
                budget,
                steps: Steps::All,
            },
            Fuel::new(SEARCH),
        ),
    );
    assert_eq!(
        text(&again),
        text(&anew.unwrap().assembled_to_run(target, &goal).unwrap())
    );
    assert_ne!(text(&again), text(&plenty), "another plan");
}
