//! What is said of values holds for those that they have.
#![allow(clippy::unwrap_used)]

use super::{Ranges, Slack, ranges};
use crate::eval::arithmetic::Exact;
use crate::eval::heard::{Heard, Listener};
use crate::eval::run::Run;
use crate::flow::graph::*;
use crate::flow::tree::Tree;
use crate::passes::schedule::schedule;
use crate::plan::{Goal, plan};
use crate::scene::check;
use crate::sema::Options;
use crate::target::{default_mode, find};
use slowlight_routine::{Op, Range, Value};
use std::cell::RefCell;

/// Compares each operation that runs with what is said of it.
struct Compared<'r> {
    ranges: &'r Ranges,
    wrong: RefCell<Vec<String>>,
}

/// Whether a value lies in a range, but for roundings.
fn holds(range: Range, value: Value) -> bool {
    let x = value.real();
    let off = 1e-7 * (1.0 + x.abs());
    range.lo - off <= x && x <= range.hi + off
}

impl Listener<Value> for Compared<'_> {
    fn applied(&self, id: NodeId, op: Op, args: &[Value], result: Value) {
        let at = id.0 as usize;
        let all = self.ranges.args[at].into_iter().zip(args.iter().copied());
        for (range, value) in all.chain([(self.ranges.result[at], result)]) {
            let mut wrong = self.wrong.borrow_mut();
            if !holds(range, value) && wrong.len() < 5 {
                wrong.push(format!("{id} {op:?}: {value:?} in {range:?}"));
            }
        }
    }
}

/// What is said wrongly of the values at some pixels of a scene.
fn wrong(graph: &Graph, tree: &Tree, ranges: &Ranges) -> Vec<String> {
    let compared = Compared {
        ranges,
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

fn graph(name: &str, text: &str) -> Graph {
    let scene = check(name, text);
    assert!(scene.is_right(), "{name}: {:?}", scene.diagnostics);
    scene.lower(&Options::default()).unwrap()
}

/// As it is written, and as it is planned, in which there are other loops and conditions.
fn holds_for(name: &str, text: &str) {
    let exact = graph(name, text);
    let tree = schedule(&exact);
    let said = ranges(&exact, &tree, &Slack::exact());
    assert_eq!(wrong(&exact, &tree, &said), Vec::<String>::new(), "{name}");
    let target = find("bbc:micro").unwrap();
    let goal = Goal {
        name: name.to_owned(),
        mode: default_mode(target, exact.image.width, exact.image.height).unwrap(),
        rows: None,
        plot: true,
    };
    let plan = plan(&exact, target, &goal).unwrap();
    let found = wrong(&plan.graph, &plan.tree, &plan.ranges);
    assert_eq!(found, Vec::<String>::new(), "{name}, planned");
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
