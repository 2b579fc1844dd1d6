//! Early-outs: which of the shortcuts that a scene or the prelude offers are taken.
//!
//! `early(c)` says that what follows from c would come out the same without it, but
//! later: a ray that leaves a sphere from outside of it does not meet it, which
//! its roots would tell, too. Where c is cheap and often holds it saves what comes
//! after it; elsewhere it costs cycles and memory. Which it is depends on the scene,
//! the machine and the place, so the planner tries.

use super::rate::{Dependence, rates};
use super::rebuild::rebuild_old;
use crate::flow::graph::*;
use slowlight_routine::Value;
use std::collections::BTreeSet;

/// The graph without shortcuts.
pub fn without(graph: &Graph) -> Graph {
    chosen(graph, &|_| None)
}

/// The graph with the shortcuts in its loops and without the others; nothing
/// where there are none. Of one after the other the first is taken: the next asks
/// for what a loop would have to compute anew.
///
/// Where one of several conditions suffices for a shortcut, the last of them is taken,
/// and after the one that `beside` counts, if there are so many: nothing where no
/// shortcut has them. These are shortcuts still: what is copied of a loop keeps both
/// conditions, and the loop has the last alone, taken once more.
pub fn in_loops(graph: &Graph, beside: Option<usize>) -> Option<Graph> {
    let rates = rates(graph);
    let asked = |id: NodeId| match graph.node(id) {
        Node::Select { cond, no, .. } => graph.early.contains(&cond).then_some((cond, no)),
        _ => None,
    };
    let next = |id| asked(asked(id)?.1).map(|(cond, _)| cond);
    let after: BTreeSet<NodeId> = graph.ids().filter_map(next).collect();
    let turns = |id: NodeId| {
        let mut all = rates.rate(id).iter();
        !after.contains(&id) && all.any(|d| matches!(d, Dependence::Loop(_)))
    };
    let fits = |id: &NodeId| turns(*id) && beside.is_none_or(|k| k + 1 < ways(graph, *id).len());
    let any = graph.early.iter().any(fits);
    any.then(|| chosen(graph, &|id| turns(id).then_some(beside)))
}

/// The graph with all shortcuts, each by the last of its conditions; nothing where there
/// are none.
pub fn everywhere(graph: &Graph) -> Option<Graph> {
    (!graph.early.is_empty()).then(|| chosen(graph, &|_| Some(None)))
}

/// The conditions of which any suffices for a shortcut.
fn ways(graph: &Graph, shortcut: NodeId) -> Vec<NodeId> {
    let holds = |id| graph.constant(id) == Some(Value::Bool(true));
    let Node::Select { cond, .. } = graph.node(shortcut) else {
        return Vec::new();
    };
    let (mut all, mut rest) = (Vec::new(), vec![cond]);
    while let Some(next) = rest.pop() {
        match graph.node(next) {
            Node::Select { cond, yes, no } if holds(yes) => rest.extend([no, cond]),
            _ => all.push(next),
        }
    }
    all
}

/// The graph with the shortcuts that `taken` says, as choices like any other: by the last
/// condition, after another perhaps.
fn chosen(graph: &Graph, taken: &dyn Fn(NodeId) -> Option<Option<usize>>) -> Graph {
    if graph.early.is_empty() {
        return graph.clone();
    }
    let plain = Graph {
        early: BTreeSet::new(),
        ..graph.clone()
    };
    rebuild_old(&plain, &mut |b, made, id, span| {
        if !graph.early.contains(&id) {
            return None;
        }
        let new = |id: &NodeId| made.get(id.0 as usize).copied().flatten();
        let Some(beside) = taken(id) else {
            return Some(b.constant(Value::Bool(false), span));
        };
        let ways = ways(graph, id);
        let (last, others) = ways.split_last()?;
        let last = new(last)?;
        Some(match beside.and_then(|k| others.get(k)) {
            Some(first) => {
                let yes = b.constant(Value::Bool(true), span);
                let any = b.select(new(first)?, yes, last, span);
                b.early(any, span)
            }
            None => last,
        })
    })
}
