//! What stands in a loop's arm and does not change with its turns is computed before the loop,
//! where turns come to the arm often; in no other case.
#![allow(clippy::unwrap_used)]

use crate::eval::native::Native;
use crate::ir::graph::*;
use crate::ir::tree::{Block, Statement, walk};
use crate::plan::Goal;
use crate::planner::plan;
use crate::scene::check;
use crate::sema::Options;
use crate::targets::default_mode;
use crate::targets::{bbc, jack, mos6502};
use slowlight_routine::Op;

/// A loop of 90 turns of which about so many in 9,973 add a root that none of them changes.
fn scene(turns: u32) -> Graph {
    let text = format!(
        "image 64 x 48 inks black, white;
        draw (x, y) = {{
          let v = loop (s = 0, k = 0) max 100 {{
            if k == 90 then s
            else next(if (x * 7 + y * 131 + k * 31) mod 9973 < {turns} then s + sqrt(y + 0.5 + x / 64) else s, k + 1)
          }} else 0;
          threshold(v / 1000, 0.5)
        }};"
    );
    let scene = check("test", &text);
    assert!(scene.is_right(), "{:?}", scene.diagnostics);
    scene.lower(&Options::default()).unwrap()
}

/// How many roots stand in a loop.
fn roots(graph: &Graph, block: &Block) -> usize {
    let root = |s: &Statement| match s {
        Statement::Let(id) => matches!(graph.node(*id), Node::Apply(Op::Sqrt, _)),
        _ => false,
    };
    let mut inside = 0;
    walk(block, &mut |s| {
        if let Statement::Loop(turns) = s {
            for block in turns.blocks() {
                walk(block, &mut |s| inside += usize::from(root(s)));
            }
        }
    });
    inside
}

#[test]
fn what_many_turns_need_is_computed_before_them() {
    for target in [&bbc::MICRO, &jack::JACK, &mos6502::PLAIN] {
        for (turns, expected) in [(5000, 0), (20, 1)] {
            let graph = scene(turns);
            let goal = Goal {
                name: "test".to_owned(),
                mode: default_mode(target, 64, 48).unwrap(),
                rows: None,
                plot: true,
            };
            let plan = plan(&graph, target, &goal).unwrap();
            // A turn that stands before the loop may have one of its own.
            let inside = roots(&plan.graph, &plan.tree.pixel);
            assert_eq!(inside, expected, "{}: {turns}", target.name);
            let [mut before, mut after] = [&graph, &plan.graph].map(Native::new);
            for (x, y) in [(0, 0), (31, 20), (63, 47)] {
                assert_eq!(before.pixel(x, y).ink, after.pixel(x, y).ink);
            }
        }
    }
}
