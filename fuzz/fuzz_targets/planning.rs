//! Any bytes as a scene, planned for a target that they choose, and written down.
//!
//! What is held is that a search ends by the work that it has done: little more of it than it
//! may do, whatever the scene, and nothing that hangs (`-timeout`) or grows without bounds
//! (`-rss_limit_mb`) beside what is counted. The last byte says which target.
#![no_main]

mod library;

use libfuzzer_sys::fuzz_target;
use library::with_library;
use slowlight_compiler::planner::pass_manager::PassSet;
use slowlight_compiler::plan::Goal;
use slowlight_compiler::planner::plan_within;
use slowlight_compiler::sema::{self, Options};
use slowlight_compiler::source::Diagnostic;
use slowlight_compiler::syntax;
use slowlight_compiler::backend::TARGETS;

/// What a search may burn: little, so that many inputs are tried and most large ones are cut.
const FUEL: u64 = 2_000_000;

/// What may be burnt beyond that: what was begun is ended, of a graph as large as inputs make.
const BEYOND: u64 = 50 * FUEL;

/// Values of a graph, at most: the work that a first plan takes without any search grows with
/// it, and inputs that only do that are found for ever.
const NODES: usize = 5_000;

fuzz_target!(|bytes: &[u8]| {
    let Some((which, bytes)) = bytes.split_last() else {
        return;
    };
    let (text, _) = syntax::decode(bytes, 0);
    let (tree, said) = syntax::parse(&text, 0);
    if said.iter().any(Diagnostic::is_error) {
        return;
    }
    with_library(tree, |files| {
        let (program, said) = sema::check(files);
        if said.iter().any(Diagnostic::is_error) {
            return;
        }
        let target = TARGETS[usize::from(*which) % TARGETS.len()];
        let mode = target.modes[usize::from(*which) / TARGETS.len() % target.modes.len()];
        let options = Options {
            inks: Some(mode.inks),
            offset: target.offset,
            ..Options::default()
        };
        let Ok(graph) = sema::lower(&program, &options) else {
            return;
        };
        if graph.nodes.len() > NODES {
            return;
        }
        let goal = Goal {
            name: "scene".to_owned(),
            mode,
            rows: None,
            plot: true,
        };
        if let Ok(plan) = plan_within(&graph, target, &goal, FUEL, PassSet::default()) {
            assert!(plan.work() <= FUEL + BEYOND, "{} units", plan.work());
            (target.emit)(&plan);
        }
    });
});
