//! What is computed later draws what is computed before.

use super::apart_tests;
use super::later::later;
use super::schedule::{missing, schedule, schedule_in_segments};
use crate::eval::drawn::{grid, picture};
use crate::flow::build::Builder;
use crate::flow::graph::*;
use crate::flow::tree::*;
use crate::flow::verify::verify;
use crate::source::Span;
use slowlight_routine::{Op, Value};

/// `if x < 3 then 0 else v` and behind it `if y < 2 then v else 0`, where v is a square.
fn partly() -> (Graph, NodeId) {
    let (mut b, at) = (Builder::new(), Span::default());
    let [x, y] = [Axis::X, Axis::Y].map(|axis| b.axis(axis, at));
    let number = |b: &mut Builder, n| b.constant(Value::Int(n), at);
    let [zero, two, three] = [0, 2, 3].map(|n| number(&mut b, n));
    let sum = b.apply(Op::IntAdd, &[x, y], at);
    let v = b.apply(Op::IntMul, &[sum, sum], at);
    let left = b.apply(Op::IntLess, &[x, three], at);
    let first = b.select(left, zero, v, at);
    let odd = b.apply(Op::IntMod, &[first, three], at);
    let top = b.apply(Op::IntLess, &[y, two], at);
    let more = b.apply(Op::IntMul, &[v, odd], at);
    let second = b.select(top, more, odd, at);
    let ink = b.apply(Op::IntMod, &[second, three], at);
    let image = Image {
        block: (1, 1),
        width: 7,
        height: 5,
        palette: vec![[0; 3]; 3],
    };
    (b.finish(image, ink, None), v)
}

/// How often a pixel computes squares.
fn squares(graph: &Graph, tree: &Tree) -> usize {
    let mut found = 0;
    walk(&tree.pixel, &mut |statement| {
        if let Statement::Let(id) = statement
            && let Node::Apply(Op::IntMul, [a, b]) = graph.node(*id)
        {
            found += usize::from(a == b);
        }
    });
    found
}

#[test]
fn a_value_goes_to_the_way_that_needs_it() {
    let (graph, _) = partly();
    let tree = schedule(&graph);
    let top = |graph: &Graph, tree: &Tree| {
        let all = tree.pixel.iter();
        let all = all.filter(|s| {
            matches!(s, Statement::Let(id) if {
                matches!(graph.node(*id), Node::Apply(Op::IntMul, [a, b]) if a == b)
            })
        });
        all.count()
    };
    assert_eq!((squares(&graph, &tree), top(&graph, &tree)), (1, 1));
    let all = later(&graph, &slowlight_runtime_jack::F316);
    let moved = all.iter().map(|graph| (graph, schedule(graph)));
    let found = moved
        .filter(|(graph, tree)| squares(graph, tree) == 2 && top(graph, tree) == 0)
        .count();
    assert!(found > 0, "{tree}");
}

#[test]
fn what_is_computed_later_draws_the_same() {
    let mut made = 0;
    let places = grid(7, 5, 1);
    for seed in 0..600 {
        let graph = apart_tests::graph(seed);
        for segments in [false, true] {
            let runtime = match segments {
                true => &slowlight_runtime_bbc::RUNTIME,
                false => &slowlight_runtime_jack::F316,
            };
            let scheduled = |graph: &Graph| match segments {
                true => schedule_in_segments(graph),
                false => schedule(graph),
            };
            let first = picture(&graph, &scheduled(&graph), &places);
            for other in later(&graph, runtime).into_iter().take(6) {
                made += 1;
                verify(&other).unwrap_or_else(|broken| panic!("seed {seed}: {broken}"));
                let tree = scheduled(&other);
                assert_eq!(missing(&other, &tree), None, "seed {seed}");
                assert_eq!(
                    picture(&other, &tree, &places),
                    first,
                    "seed {seed}:\n{tree}"
                );
            }
        }
    }
    assert!(made > 20, "{made}");
}
