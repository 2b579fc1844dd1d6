//! Programs in which what is done seldom calls subroutines, held against the model
//! and the native evaluation on the machines, in every style; and those that need none.
#![allow(clippy::unwrap_used)]

use crate::bbc::{differences, run, text};
use crate::runs::{HEIGHT, MACHINES, picture};
use slowlight::fit::fit;
use slowlight::need::need;
use slowlight_compiler::eval::native::Native;
use slowlight_compiler::ir::graph::Graph;
use slowlight_compiler::ir::tree::{Block, Statement, walk};
use slowlight_compiler::plan::model::ModelRun;
use slowlight_compiler::plan::{Copies, Goal};
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::planner::plan;
use slowlight_compiler::targets::{default_mode, find};
use slowlight_vm::Stop;
use slowlight_vm::bbc::Dialect;

fn planned(graph: &Graph, (name, dialect): (&str, Dialect)) -> PlannedScene {
    let target = find(name).unwrap();
    let goal = Goal {
        name: "seldom".to_owned(),
        mode: match dialect {
            Dialect::Micro => *target.modes.iter().find(|m| m.name == "1").unwrap(),
            _ => default_mode(target, graph.image.width, HEIGHT as u32).unwrap(),
        },
        rows: None,
        plot: true,
    };
    plan(graph, target, &goal).unwrap()
}

fn calls(block: &Block) -> usize {
    let mut calls = 0;
    walk(block, &mut |s| {
        calls += usize::from(matches!(s, Statement::Call(_)));
    });
    calls
}

#[test]
fn what_is_done_seldom_is_called_and_draws_the_same() {
    let (mut called, mut in_runs) = ([0; 3], 0);
    for seed in 0..360 {
        let width = [320, 77, 352][seed as usize % 3];
        let graph = picture(seed, width, seed % 2 == 0);
        let machine = (seed / 6 % 4) as usize % 3;
        let dialect = MACHINES[machine].1;
        let plain = planned(&graph, MACHINES[machine]);
        let Some(mut plan) = plain.outlined_where_seldom(true, &|_| Some("part".to_owned())) else {
            continue;
        };
        assert!(plan.calls_seldom() && calls(&plan.tree.pixel) == 0);
        (plan.listing, plan.tight) = (seed % 5 == 1, seed % 5 == 2);
        // What is to be read may be too large for the Micro.
        if !need(&plan).unwrap().is_none_or(|need| need.fits()) {
            continue;
        }
        called[machine] += 1;
        in_runs += calls(&plan.tree.segment);
        let text = text(&plan);
        let run = run(dialect, &text);
        assert_eq!(run.stop, Stop::Ended, "{seed}\n{text}");
        assert_eq!(differences(&plan, &run), 0, "{seed}\n{}\n{text}", plan.tree);
        // All is exact.
        let (mut native, mut model) = (Native::new(&graph), ModelRun::new(&plan));
        for y in 0..HEIGHT {
            for x in 0..width as i32 {
                let ink = native.pixel(x, y).ink;
                assert_eq!(ink, model.pixel(x, y).ink, "{seed} ({x}, {y})");
            }
        }
    }
    assert!(
        called.iter().all(|n| *n > 5) && in_runs > 50,
        "{called:?} {in_runs}"
    );
}

#[test]
fn what_fits_as_it_is_stays_so() {
    let mut could = 0;
    for seed in 0..24 {
        let graph = picture(seed, 320, seed % 2 == 0);
        let mut plan = planned(&graph, MACHINES[0]);
        could += usize::from(plan.outlined_where_seldom(true, &|_| None).is_some());
        // Where memory is left, ends are copied.
        plan.copies = Copies::Ends;
        // What does not fit is written shorter.
        if !need(&plan).unwrap().is_none_or(|need| need.fits()) {
            continue;
        }
        let as_it_is = text(&plan);
        let fits = fit(vec![plan.mode], &|_, _| Ok(plan.clone()), &|_| None).unwrap();
        assert_eq!(text(&fits), as_it_is, "{seed}");
    }
    assert!(could > 5, "{could}");
}
