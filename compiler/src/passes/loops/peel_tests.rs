//! A loop whose first turn stands before it draws the same.

use super::peel::peel;
use crate::analysis::verify::verify;
use crate::eval::drawn::{grid, picture};
use crate::eval::random_graphs;
use crate::ir::graph::*;
use crate::passes::claim_tests::{claiming, hold_claims};
use crate::passes::simplify::fold::fold;
use crate::schedule::statements::schedule;

#[test]
fn peeled_loops_draw_the_same() {
    let (mut peeled, mut claims) = (0, 0);
    for seed in 0..300 {
        let graph = claiming(&fold(&random_graphs::graph(seed)));
        let places = grid(7, 5, 1);
        let plain = picture(&graph, &schedule(&graph), &places);
        for k in 0..graph.loops.len() {
            let Some(other) = peel(&graph, LoopId(k as u32), 1000) else {
                continue;
            };
            peeled += 1;
            verify(&other).unwrap_or_else(|broken| panic!("seed {seed}, loop {k}: {broken}"));
            let tree = schedule(&other);
            let found = picture(&other, &tree, &places);
            assert_eq!(plain, found, "seed {seed}, loop {k}:\n{tree}");
            claims += hold_claims(&other, seed);
        }
    }
    assert!(peeled > 30 && claims > 100, "{peeled} {claims}");
}
