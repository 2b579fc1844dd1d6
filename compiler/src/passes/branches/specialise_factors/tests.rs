//! What is chosen by a factor's few values is what the factor made.
#![allow(clippy::unwrap_used)]

use super::specialise_factors;
use crate::analysis::range::{Slack, ranges};
use crate::analysis::verify::verify;
use crate::eval::drawn::{grid, picture};
use crate::eval::native::Native;
use crate::eval::random_graphs;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild;
use crate::passes::simplify::fold::fold;
use crate::plan::Goal;
use crate::planner::plan;
use crate::scene::check;
use crate::schedule::statements::schedule;
use crate::sema::Options;
use crate::targets::{default_mode, find};
use slowlight_routine::{Format, Op, Runtime};

fn runtime(target: &str) -> &'static Runtime {
    find(target).unwrap().runtime
}

fn graph(draw: &str) -> Graph {
    let source = format!("image 61 x 47 inks black, red, yellow, white;\ndraw (x, y) = {draw};");
    let scene = check("test", &source);
    assert!(scene.is_right(), "{source}: {:?}", scene.diagnostics);
    fold(&scene.lower(&Options::default()).unwrap())
}

/// Every way there is, one at a time.
fn ways(graph: &Graph, runtime: &Runtime) -> Vec<Graph> {
    let found = ranges(graph, &schedule(graph), &Slack::exact());
    specialise_factors(graph, &found, runtime)
        .map(|next| fold(&next))
        .collect()
}

fn inks(graph: &Graph) -> Vec<u8> {
    let mut native = Native::new(graph);
    let places = (0..47).flat_map(|y| (0..61).map(move |x| (x, y)));
    places.map(|(x, y)| native.pixel(x, y).ink).collect()
}

/// How many products and quotients a graph has.
fn products(graph: &Graph) -> usize {
    let product = |id: &NodeId| matches!(graph.node(*id), Node::Apply(Op::Mul | Op::Div, _));
    graph.ids().filter(product).count()
}

/// Something that is another at every pixel, and no short decimal.
const OTHER: &str = "sqrt(x * 1.37 + y * 3.11 + 0.7)";

const SWITCHES: [&str; 4] = [
    "((floor(sqrt(x * 7.3) - y * 0.9) + y) mod 2 / 2 + 0.3)",
    "(if sin((x + y) * 1rad) > 0.1 then 0.8 else 0.3)",
    "(0.25 - sign(sin((x * 0.7 + y) * 1rad)) * 0.75)",
    "((floor(sqrt(x * 7.3) - y * 0.9) + y) mod 2)",
];

#[test]
fn comparisons_with_what_a_factor_leaves_draw_the_same() {
    let mut made = 0;
    for switch in SWITCHES {
        for shade in [
            "@ * #",
            "-(@ * #)",
            "@ * # * (@ * #) / (x + 3)",
            "# * @ / (y + 1.1)",
            "@ / (# + 1.7)",
        ] {
            for test in ["> 1.9", "<= y / 13 - 1", "< if y > 20 then 1.3 else -2.3"] {
                let shade = shade.replace('@', OTHER).replace('#', switch);
                let draw =
                    format!("ink(if {shade} {test} then 2 else if {shade} > 0.7 then 1 else 0)");
                let graph = graph(&draw);
                let before = inks(&graph);
                for next in ways(&graph, runtime("bbc:micro")) {
                    made += 1;
                    verify(&next).unwrap_or_else(|broken| panic!("{draw}: {broken}"));
                    assert_eq!(inks(&next), before, "{draw}\n{next}");
                }
            }
        }
    }
    assert!(made > 100, "{made}");
}

#[test]
fn a_factor_goes_over_to_the_threshold() {
    let draw = format!("ink(if {OTHER} * {} < 1.9 then 2 else 0)", SWITCHES[0]);
    let graph = graph(&draw);
    let widest = ways(&graph, runtime("bbc:micro")).remove(0);
    // The product with the factor and the half are gone.
    assert_eq!(products(&widest) + 2, products(&graph), "{widest}");
}

/// A graph whose products are of a value and another's sign.
fn with_signs(graph: &Graph) -> Graph {
    fold(&rebuild(graph, &mut |b, _, node, span| {
        let Node::Apply(Op::Mul, [value, other]) = node else {
            return None;
        };
        let sign = b.apply(Op::Sign, &[other], span);
        Some(b.apply(Op::Mul, &[value, sign], span))
    }))
}

/// Where nothing goes over, the same operations meet the same numbers.
#[test]
fn choices_alone_draw_what_they_choose_from() {
    let fixed = runtime("6502:plain");
    assert!(matches!(fixed.real, Format::Fixed { .. }));
    let mut made = 0;
    for seed in 0..300 {
        let graph = with_signs(&random_graphs::graph(seed));
        let places = grid(7, 5, 1);
        let plain = picture(&graph, &schedule(&graph), &places);
        for next in ways(&graph, fixed) {
            made += 1;
            verify(&next).unwrap_or_else(|broken| panic!("seed {seed}: {broken}"));
            let tree = schedule(&next);
            assert_eq!(
                picture(&next, &tree, &places),
                plain,
                "seed {seed}:\n{tree}"
            );
        }
    }
    assert!(made > 30, "{made}");
}

#[test]
fn other_factors_are_left_alone() {
    for factor in [
        "(x * y mod 7 + 1.5)",
        "sqrt(x)",
        "(y mod 2 / 2 + 0.3)",
        "0.8",
    ] {
        let graph = graph(&format!("ink(if {OTHER} * {factor} < 4.1 then 2 else 0)"));
        assert!(ways(&graph, runtime("bbc:micro")).is_empty(), "{factor}");
    }
}

/// Two sides that are different at every pixel have none for a threshold.
#[test]
fn what_differs_on_both_sides_keeps_its_products() {
    let switch = SWITCHES[1];
    let draw = format!("ink(if {OTHER} * {switch} < sin(x * 0.3rad) * 4 then 2 else 0)");
    let graph = graph(&draw);
    for next in ways(&graph, runtime("bbc:micro")) {
        assert!(products(&next) >= products(&graph), "{next}");
    }
}

/// A plan asks sooner where many pixels are spared a product, and does not where
/// hardly one is.
#[test]
fn plans_choose_where_that_pays() {
    let asked = |seldom: &str| {
        let shade = format!("{OTHER} * {} < 1.9", SWITCHES[0]);
        let graph = graph(&format!(
            "ink(if {seldom} then (if {shade} then 2 else 0) else 1)"
        ));
        let target = find("bbc:micro").unwrap();
        let goal = Goal {
            name: "test".to_owned(),
            mode: default_mode(target, 61, 47).unwrap(),
            rows: None,
            plot: true,
        };
        let plan = plan(&graph, target, &goal).unwrap();
        let asks = |id: NodeId| match plan.graph.node(id) {
            Node::Select { cond, .. } => {
                matches!(plan.graph.node(cond), Node::Apply(Op::IntLess, [_, of])
                    if matches!(plan.graph.node(of), Node::Apply(Op::BitAnd, _)))
            }
            _ => false,
        };
        plan.graph.ids().any(asks)
    };
    assert!(asked("true"));
    assert!(!asked(
        "x == 59 and y == 46 and sqrt(sin(x * 1rad) + 3) > 1.1"
    ));
}
