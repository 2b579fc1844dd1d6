//! Copies draw what the values draw that they are copies of.

use super::claim_tests::{claiming, hold_claims};
use crate::analysis::rate::{Dependence, rates};
use crate::eval::drawn::assert_same;
use crate::eval::random_graphs;
use crate::ir::graph::*;
use crate::passes::rematerialise::rematerialise;
use crate::passes::rewrite::rebuild::rebuild_old;
use crate::passes::simplify::fold::fold;
use crate::schedule::statements::schedule;
use slowlight_routine::{Op, Type, Value};

/// A graph at random, with a value at each choice that few of its ways need, on
/// either side: `if c then (if p then f(v) else a) else (if q then f(v) else b)`.
pub(super) fn graph(seed: u64) -> Graph {
    let graph = fold(&random_graphs::graph(seed));
    let rates = rates(&graph);
    let turns = |id: NodeId| {
        let turn = |d: &&Dependence| matches!(d, Dependence::Loop(_) | Dependence::Last(_));
        rates.rate(id).iter().filter(turn).collect::<Vec<_>>()
    };
    let next = rebuild_old(&graph, &mut |b, made, id, span| {
        let Node::Select { cond, yes, no } = graph.node(id) else {
            return None;
        };
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        // The last ones that may be used here, none that only a loop further in has.
        let here = turns(id);
        let seen = |ty: Type| {
            let fits = |old: &NodeId| turns(*old).iter().all(|d| here.contains(d));
            let all = (0..id.0).rev().map(NodeId).filter(fits);
            all.filter(|old| graph.ty(*old) == ty).collect::<Vec<_>>()
        };
        let mut tests = seen(Type::Bool)
            .into_iter()
            .filter(|old| *old != cond)
            .filter_map(new);
        let (p, q) = (tests.next()?, tests.next()?);
        let rare = seen(Type::Int).into_iter().find_map(new)?;
        let own = b.constant(Value::Int(id.0 as i32), span);
        let (cond, yes, no) = (new(cond)?, new(yes)?, new(no)?);
        let rare = match graph.ty(id) {
            Type::Bool => b.apply(Op::IntLess, &[rare, own], span),
            _ => b.apply(Op::IntMul, &[rare, own], span),
        };
        let mut arm = |test: NodeId, plain: NodeId| {
            let more = match b.ty(plain) {
                Type::Bool => b.apply(Op::Not, &[rare], span),
                Type::Int => b.apply(Op::IntAdd, &[rare, plain], span),
                Type::Real => {
                    let rare = b.apply(Op::ToReal, &[rare], span);
                    b.apply(Op::Add, &[rare, plain], span)
                }
            };
            b.select(test, more, plain, span)
        };
        let (yes, no) = (arm(p, yes), arm(q, no));
        Some(b.select(cond, yes, no, span))
    });
    fold(&next)
}

/// Copies wherever there may be some, one after another, as plans have them.
fn copied(graph: &Graph) -> Graph {
    let mut now = graph.clone();
    for _ in 0..3 {
        let Some(next) = rematerialise(&now, &schedule(&now), &|_, _, _| true) else {
            break;
        };
        now = next;
    }
    now
}

#[test]
fn copies_draw_the_same() {
    let mut made = 0;
    for seed in 0..300 {
        let graph = graph(seed);
        let other = copied(&graph);
        made += other.nodes.len() - graph.nodes.len();
        let (first, second) = (schedule(&graph), schedule(&other));
        assert_same((&graph, &first), (&other, &second), seed);
    }
    assert!(made > 300, "{made}");
}

/// What is claimed of a value is claimed of it and its copies afterwards, and
/// not of others.
#[test]
fn claims_go_with_their_values() {
    let (mut kept, mut more) = (0, 0);
    for seed in 0..300 {
        let graph = claiming(&graph(seed));
        let other = copied(&graph);
        assert!(other.claims.len() >= graph.claims.len(), "seed {seed}");
        more += other.claims.len() - graph.claims.len();
        kept += hold_claims(&other, seed);
    }
    assert!(kept > 300 && more > 0, "{kept} {more}");
}
