//! What is found in a context is what would be made.
#![allow(clippy::unwrap_used)]

use super::SEARCH;
use super::made::{candidate, plan};
use super::planned::{PlannedScene, Rewriting};
use crate::cost::size_budget::SizeBudget;
use crate::fuel::Fuel;
use crate::plan::{Goal, Plan};
use crate::planner::context::Context;
use crate::planner::search::stepped::Steps;
use crate::scene::check;
use crate::sema::Options;
use crate::targets::{default_mode, find, formats};
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

/// A way to another plan of the scene.
type Way = fn(&PlannedScene) -> PlannedScene;

/// Plans whose points were placed by few pixels, to see how large they are, are settled to those
/// that would have been made at once.
#[test]
fn plans_on_trial_are_settled_to_those_made_at_once() {
    let scene = check("torus", include_str!("../../../examples/torus.scn"));
    let mut all = formats(find("6502:plain").unwrap());
    let target = all.find(|t| t.runtime.format == "fixed16").unwrap();
    let graph = scene.lower(&Options::default()).unwrap();
    let goal = Goal {
        name: "torus".to_owned(),
        mode: default_mode(target, 320, 240).unwrap(),
        rows: None,
        plot: true,
    };
    let text = |plan: &Plan| crate::backend::emit(plan)[0].text.clone();
    let plenty = plan(&graph, target, &goal).unwrap();
    let usual = plenty.cx.looks();
    assert!(plenty.on_trial().settled().is_none(), "its own points are");
    let ways: [Way; 3] = [
        |plan| plan.stable().unwrap(),
        |plan| {
            plan.thriftier(4)
                .and_then(|made| plan.completed(made))
                .unwrap()
        },
        |plan| plan.outlined(&|_| None).unwrap(),
    ];
    for way in ways {
        let (at_once, tried) = (way(&plenty), way(&plenty.on_trial()));
        assert!(tried.looked < at_once.looked);
        let settled = tried.settled().unwrap();
        assert_eq!(text(&settled), text(&at_once));
        assert_eq!((settled.looks, settled.looked), (usual, usual));
        assert_eq!(tried.off_trial().looks, usual);
    }
}
