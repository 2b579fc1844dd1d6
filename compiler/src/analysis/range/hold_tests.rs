//! What is said of values holds for those that they have.
#![allow(clippy::unwrap_used)]

use super::{Ranges, Slack, ranges};
use crate::backend::emit;
use crate::eval::arithmetic::{Exact, Tagged};
use crate::eval::heard::{Heard, Listener};
use crate::eval::run::Run;
use crate::ir::graph::*;
use crate::ir::tree::Tree;
use crate::plan::Goal;
use crate::planner::PlannedScene;
use crate::planner::plan;
use crate::scene::check;
use crate::schedule::statements::schedule;
use crate::sema::Options;
use crate::targets::{default_mode, find};
use slowlight_routine::{Op, Range};
use std::cell::RefCell;

/// Compares each operation that runs with what is said of it.
struct Compared<'r> {
    ranges: &'r Ranges,
    /// What is not looked at.
    left: Vec<bool>,
    wrong: RefCell<Vec<String>>,
}

/// Whether a value lies in a range, but for roundings.
fn holds(range: Range, value: Tagged) -> bool {
    let x = value.real();
    let off = 1e-7 * (1.0 + x.abs());
    range.lo - off <= x && x <= range.hi + off
}

impl Listener<Tagged> for Compared<'_> {
    fn applied(&self, id: NodeId, op: Op, args: &[Tagged], result: Tagged) {
        let at = id.0 as usize;
        if self.left[at] {
            return;
        }
        let all = self.ranges.args[at].into_iter().zip(args.iter().copied());
        for (range, value) in all.chain([(self.ranges.result[at], result)]) {
            let mut wrong = self.wrong.borrow_mut();
            if !holds(range, value) && wrong.len() < 5 {
                wrong.push(format!("{id} {op:?}: {value:?} in {range:?}"));
            }
        }
    }
}

/// What is made of what a loop has found. Normals of hits are trusted to have their length, which
/// is so where there is a hit; where a plan works them out before it asks for that, nothing is
/// made of them (csg, for rays that miss).
fn behind_loops(graph: &Graph) -> Vec<bool> {
    let mut behind = vec![false; graph.nodes.len()];
    for id in graph.ids() {
        let node = graph.node(id);
        let made = node.operands().any(|id| behind[id.0 as usize]);
        behind[id.0 as usize] = made || matches!(node, Node::Result { .. });
    }
    behind
}

/// What is said wrongly of the values at some pixels of a scene.
fn wrong(graph: &Graph, tree: &Tree, ranges: &Ranges) -> Vec<String> {
    wrong_but(graph, tree, ranges, vec![false; graph.nodes.len()])
}

/// The same but for some of them.
fn wrong_but(graph: &Graph, tree: &Tree, ranges: &Ranges, left: Vec<bool>) -> Vec<String> {
    let compared = Compared {
        ranges,
        left,
        wrong: RefCell::default(),
    };
    let heard = Heard {
        arithmetic: Exact(graph),
        listener: compared,
    };
    let mut run = Run::within(graph, tree, &heard, 20_000_000);
    let Image { width, height, .. } = graph.image;
    for k in 0..97 {
        let (x, y) = (k * 61 % 97 * width / 97, k * height / 97);
        run.pixel(x as i32, y as i32);
    }
    heard.listener.wrong.take()
}

/// Two inks of 8 by 8 pixels, by a real.
fn scene(real: &str) -> String {
    format!("image 8 x 8 inks black, white;\ndraw (x, y) = ink(if ({real}) > 0.5 then 1 else 0);")
}

fn graph(name: &str, text: &str, options: &Options) -> Graph {
    let scene = check(name, text);
    assert!(scene.is_right(), "{name}: {:?}", scene.diagnostics);
    scene.lower(options).unwrap()
}

/// A scene as it is lowered for a Micro.
fn lowered(name: &str, text: &str) -> Graph {
    let target = find("bbc:micro").unwrap();
    let real = target.runtime.real;
    let options = Options {
        offset: target.offset,
        epsilon: real.epsilon(),
        floats: !real.is_fixed(),
        mantissas: real.has_mantissa(),
        ..Options::default()
    };
    graph(name, text, &options)
}

fn planned(name: &str, graph: &Graph) -> PlannedScene {
    let target = find("bbc:micro").unwrap();
    let goal = Goal {
        name: name.to_owned(),
        mode: default_mode(target, graph.image.width, graph.image.height).unwrap(),
        rows: None,
        plot: true,
    };
    plan(graph, target, &goal).unwrap()
}

/// As it is written, and as it is planned, in which there are other loops and conditions.
fn holds_for(name: &str, text: &str) {
    let exact = graph(name, text, &Options::default());
    let tree = schedule(&exact);
    let said = ranges(&exact, &tree, &Slack::exact());
    assert_eq!(wrong(&exact, &tree, &said), Vec::<String>::new(), "{name}");
    let plan = planned(name, &lowered(name, text));
    // The one where that happens.
    let left = |graph: &Graph| match name.ends_with("csg.scn") {
        true => behind_loops(graph),
        false => vec![false; graph.nodes.len()],
    };
    let found = wrong_but(&plan.graph, &plan.tree, &plan.ranges, left(&plan.graph));
    assert_eq!(found, Vec::<String>::new(), "{name}, planned");
    let called = plan.outlined(&|_| None).unwrap();
    let found = wrong_but(
        &called.graph,
        &called.tree,
        &called.ranges,
        left(&called.graph),
    );
    assert_eq!(found, Vec::<String>::new(), "{name}, with subroutines");
}

#[test]
fn what_is_said_of_values_in_the_examples_holds() {
    let dir = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples");
    for entry in std::fs::read_dir(dir).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|e| e == "scn") {
            let text = std::fs::read_to_string(&path).unwrap();
            holds_for(&path.display().to_string(), &text);
        }
    }
}

/// Loops whose values are bounded, each by another of the ways in which that is found.
const BOUNDED: [(&str, &str); 6] = [
    (
        "squares that end a loop",
        "loop (p = x / 8, q = y / 8) max 500 {
           if p * p + q * q > 4 then p else next(p * p - q * q + 0.3, 2 * p * q + 0.5)
         } else 0",
    ),
    (
        "what a turn adds",
        "loop (t = 0.0, k = 0) max 5000 {
           if k == 4000 then t * t + x else next(t + 0.5 + abs(x - y) / 4, k + 1)
         } else 0",
    ),
    (
        "a distance where the loop goes on",
        "loop (t = 0.0, s = 0.0) max 3000 {
           let d = sqrt((t - 3) * (t - 3) + x) - 0.5;
           if d < 0.01 then s * t else if t > 20 then t * t else next(t + d, d * d)
         } else 0",
    ),
    (
        "a distance by a loop of its own where the loop goes on",
        "loop (t = 0.0, s = 0.0) max 3000 {
           let d = loop (k = 0, z = t + x / 8) max 6 {
             if z > 2 or k == 4 then z * z / 4 else next(k + 1, z * z + t / 9)
           } else 0;
           if d < 0.01 then s * t else if t > 20 then t * t else next(t + d, d * d)
         } else 0",
    ),
    (
        "a counter that a loop ends at",
        "loop (k = 0, s = 0.0) max 900 {
           if k == 700 then s * s else next(k + 1, 1 / (701 - k + x))
         } else 0",
    ),
    (
        "a condition that one of two others decides",
        "loop (t = 0.0, near = true) max 1024 {
           let d = abs(t * x - 5);
           let far = d > 0.001;
           if not (if far then t + d <= 1000 else near) then t * t
           else next(if far then t + d else t + 0.001, not far)
         } else 0",
    ),
];

#[test]
fn what_is_bounded_is_computed_without_tests() {
    for (by, real) in BOUNDED {
        let text = scene(real);
        holds_for(by, &text);
        let plan = planned(by, &graph(by, &text, &Options::default()));
        let routines = plan.graph.ids().filter_map(|id| plan.routine(id));
        let tested = routines.filter(|r| r.name.starts_with("FN"));
        let tested: Vec<&str> = tested.map(|r| r.name).collect();
        assert_eq!(tested, Vec::<&str>::new(), "{by}");
    }
}

/// A search by halves always goes on, so that the result of its end is undefined.
#[test]
fn what_is_undefined_bounds_nothing() {
    let text = "image 8 x 8 inks black, white;
        shape lump() {
          f(p) = 1 - 1 / max(dot(p, p), 0.02);
          bound = sphere((0, 0, 0), 1.8);
          steps = 8;
        }
        scene world { lump() is 0.9; }
        draw (x, y) = {
          let r = pinhole((0, 0.3, 4), at: (0, 0, 0), field: 50deg).through(x, y);
          let v = if let h = world.trace(r, far: 20) then h.tag * lambert(h, (3, 5, 4)) else 0.05;
          ink(if v > 0.5 then 1 else 0)
        };";
    holds_for("a search", text);
    let plan = planned("a search", &graph("a search", text, &Options::default()));
    let mut routines = plan.graph.ids().filter_map(|id| plan.routine(id));
    assert!(!routines.any(|r| r.name == "FNmul"));
    let text = &emit(&plan)[0].text;
    assert!(!text.contains("TRUE THEN"), "{text}");
}

#[test]
fn what_nothing_bounds_is_tested() {
    let real = "loop (t = 1.0, k = 0) max 5000 {
        if k == 4000 + x then sqrt(t) else next(t * 3, k + 1)
    } else 0";
    let text = scene(real);
    holds_for("tripled", &text);
    let plan = planned("tripled", &graph("tripled", &text, &Options::default()));
    let mut routines = plan.graph.ids().filter_map(|id| plan.routine(id));
    assert!(routines.any(|r| r.name == "FNmul"));
}
