//! Early exits: which of the shortcuts that a scene or the prelude offers are taken.
//!
//! `early(c)` says that what follows from c would come out the same without it, but
//! later: a ray that leaves a sphere from outside of it does not meet it, which
//! its roots would tell, too. Where c is cheap and often holds it saves what comes
//! after it; elsewhere it costs cycles and memory. Which it is depends on the scene,
//! the machine and the place, so the planner tries.

use crate::analysis::rate::{Dependence, rates};
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use slowlight_routine::Value;
use std::collections::BTreeSet;

/// The graph without shortcuts.
pub fn without(graph: &Graph) -> Graph {
    chosen(graph, &|_| false)
}

/// The graph with the shortcuts in its loops and without the others; nothing
/// where there are none. Of one after the other the first is taken: the next asks
/// for what a loop would have to compute anew.
///
/// Where one of several conditions suffices for a shortcut, the last of them is taken.
pub fn in_loops(graph: &Graph) -> Option<Graph> {
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
    let any = graph.early.iter().any(|id| turns(*id));
    any.then(|| chosen(graph, &turns))
}

/// The graph with all shortcuts, each by the last of its conditions; nothing where there
/// are none.
pub fn everywhere(graph: &Graph) -> Option<Graph> {
    (!graph.early.is_empty()).then(|| chosen(graph, &|_| true))
}

/// The last of the conditions of which any suffices for a shortcut.
fn last(graph: &Graph, shortcut: NodeId) -> Option<NodeId> {
    let holds = |id| graph.constant(id) == Some(Value::Bool(true));
    let Node::Select { mut cond, .. } = graph.node(shortcut) else {
        return None;
    };
    while let Node::Select { yes, no, .. } = graph.node(cond)
        && holds(yes)
    {
        cond = no;
    }
    Some(cond)
}

/// The graph with the shortcuts that `taken` says, as choices like any other: by their last
/// condition.
fn chosen(graph: &Graph, taken: &dyn Fn(NodeId) -> bool) -> Graph {
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
        match taken(id) {
            true => made.get(last(graph, id)?.0 as usize).copied().flatten(),
            false => Some(b.constant(Value::Bool(false), span)),
        }
    })
}
