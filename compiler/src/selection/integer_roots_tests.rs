//! Roots of ints are those of the reals that they replace.

use crate::analysis::range::{Slack, ranges};
use crate::eval::drawn::assert_same;
use crate::eval::random_graphs;
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use crate::passes::simplify::fold::fold;
use crate::schedule::statements::schedule;
use crate::selection::integer_roots::int_roots;
use slowlight_routine::Op;

/// A graph at random in which the root of what was an int is added to it, or that of its
/// negative, and half of them are read by nobody else.
fn graph(seed: u64) -> Graph {
    let graph = fold(&random_graphs::graph(seed));
    let next = rebuild_old(&graph, &mut |b, made, id, span| {
        let Node::Apply(Op::ToReal, [whole, _]) = graph.node(id) else {
            return None;
        };
        let whole = made.get(whole.0 as usize).copied().flatten()?;
        let real = b.apply(Op::ToReal, &[whole], span);
        let of = match id.0 & 1 {
            0 => b.apply(Op::Neg, &[real], span),
            _ => real,
        };
        let root = b.apply(Op::Sqrt, &[of], span);
        Some(match id.0 & 2 {
            0 => b.apply(Op::Add, &[real, root], span),
            _ => root,
        })
    });
    fold(&next)
}

fn statements(tree: &Tree) -> usize {
    let mut count = 0;
    for block in tree.blocks() {
        walk(block, &mut |_| count += 1);
    }
    count
}

#[test]
fn roots_of_ints_draw_the_same() {
    let (mut made, mut fewer) = (0, 0);
    for seed in 0..500 {
        let graph = graph(seed);
        let tree = schedule(&graph);
        let found = ranges(&graph, &tree, &Slack::exact());
        let (mut other, mut second) = (graph.clone(), tree.clone());
        int_roots(&mut other, &mut second, &found, 0.0);
        let roots = other.ids().map(|id| other.node(id));
        made += roots
            .filter(|node| matches!(node, Node::Apply(Op::IntRoot, _)))
            .count();
        fewer += statements(&tree) - statements(&second);
        assert_same((&graph, &tree), (&other, &second), seed);
    }
    assert!(made > 40 && fewer > 20, "{made} {fewer}");
}

/// What a real holds as it is stays one.
#[test]
fn small_ints_stay_reals() {
    for seed in 0..20 {
        let graph = graph(seed);
        let tree = schedule(&graph);
        let found = ranges(&graph, &tree, &Slack::exact());
        let (mut other, mut second) = (graph.clone(), tree.clone());
        int_roots(&mut other, &mut second, &found, f64::INFINITY);
        assert_eq!((&other.nodes, &second), (&graph.nodes, &tree));
    }
}
