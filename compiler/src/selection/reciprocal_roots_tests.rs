//! One over a root is that quotient.

use super::reciprocal_roots::reciprocal_roots;
use crate::eval::drawn::assert_same;
use crate::eval::random_graphs;
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use crate::passes::simplify::fold::fold;
use crate::schedule::statements::schedule;
use slowlight_routine::{Op, Value};

/// A graph at random in which quotients are by the root of 1 and a square, as 1 over it or in
/// one, and half of the roots are read by others as well.
fn graph(seed: u64) -> Graph {
    let graph = fold(&random_graphs::graph(seed));
    let next = rebuild_old(&graph, &mut |b, made, id, span| {
        let Node::Apply(Op::Mul | Op::Add, [x, y]) = graph.node(id) else {
            return None;
        };
        let of = |k: NodeId| made.get(k.0 as usize).copied().flatten();
        let (x, y) = (of(x)?, of(y)?);
        let one = b.constant(Value::Real(1.0), span);
        let square = b.apply(Op::Mul, &[x, x], span);
        let more = b.apply(Op::Add, &[square, one], span);
        let root = b.apply(Op::Sqrt, &[more], span);
        let inverse = match id.0 & 1 {
            0 => b.apply(Op::Div, &[one, root], span),
            _ => b.apply(Op::Div, &[y, root], span),
        };
        Some(match id.0 & 2 {
            0 => b.apply(Op::Add, &[inverse, root], span),
            _ => b.apply(Op::Mul, &[inverse, y], span),
        })
    });
    fold(&next)
}

fn count(graph: &Graph, tree: &Tree, wanted: Op) -> usize {
    let mut count = 0;
    for block in tree.blocks() {
        walk(block, &mut |statement| {
            let node = match statement {
                Statement::Let(id) => graph.node(*id),
                _ => return,
            };
            count += usize::from(matches!(node, Node::Apply(op, _) if op == wanted));
        });
    }
    count
}

#[test]
fn quotients_of_one_by_roots_draw_the_same() {
    let (mut made, mut fewer, mut kept) = (0, 0, 0);
    for seed in 0..300 {
        let graph = graph(seed);
        let tree = schedule(&graph);
        let (mut other, mut second) = (graph.clone(), tree.clone());
        reciprocal_roots(&mut other, &mut second);
        let found = count(&other, &second, Op::ReciprocalRoot);
        let gone = count(&graph, &tree, Op::Div) - count(&other, &second, Op::Div);
        assert_eq!(found, gone, "seed {seed}");
        made += found;
        fewer += count(&graph, &tree, Op::Sqrt) - count(&other, &second, Op::Sqrt);
        kept += count(&other, &second, Op::Div);
        assert_same((&graph, &tree), (&other, &second), seed);
    }
    // Some roots are read by others, and what is no 1 is divided as before.
    assert!(
        made > 40 && fewer > 20 && fewer < made && kept > 40,
        "{made} {fewer} {kept}"
    );
}
