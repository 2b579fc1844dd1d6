//! Whether what a comparison compares is at hand anyway: needed as it is by something
//! that is computed whichever way the comparison goes.

use super::Site;
use crate::flow::graph::*;
use rustc_hash::FxHashSet;
use slowlight_routine::Type;

impl Site<'_> {
    /// Whether a comparison costs no more than itself: what it compares is computed as it
    /// is for something else, and not only where the comparison says so.
    pub(super) fn at_hand(&self, id: NodeId, replaced: &[NodeId]) -> bool {
        let graph = self.forms.graph;
        let Node::Apply(op, _) = graph.node(id) else {
            return false;
        };
        let value = |user: &NodeId| graph.ty(*user) != Type::Bool;
        op.result() == Type::Bool
            && graph.node(id).operands().all(|x| {
                let there = || self.users[x.0 as usize].iter().any(value);
                // Where polynomials are not stepped for next to nothing, other forms are
                // the better start: with this, mirrors took BASIC a seventh longer.
                let steps = self.runtime.stepping.is_some_and(|s| s.foreseen);
                let free = || !steps || self.is_free(x, id);
                !self.forms.pixel(x) || (there() && !replaced.contains(&x) && free())
            })
    }

    /// Whether a value is needed by something that is no arm of a choice by a comparison.
    fn is_free(&self, value: NodeId, by: NodeId) -> bool {
        let graph = self.forms.graph;
        let decided = self.decided_by(by);
        let mut seen = FxHashSet::default();
        let known = |user: &NodeId| graph.ty(*user) != Type::Bool;
        let mut todo: Vec<(NodeId, NodeId)> = Vec::new();
        todo.extend(
            (self.users[value.0 as usize].iter().copied())
                .filter(known)
                .map(|u| (value, u)),
        );
        while let Some((of, user)) = todo.pop() {
            if !seen.insert((of, user)) || user == by {
                continue;
            }
            let mut next = vec![user];
            if user == of {
                if is_root(graph, of) {
                    return true;
                }
                next = self.results_of(of);
            } else if let Node::Select { cond, .. } = graph.node(user)
                && decided.contains(&cond)
                && cond != of
            {
                continue;
            }
            for at in next {
                todo.extend(self.users[at.0 as usize].iter().map(|u| (at, *u)));
            }
        }
        false
    }

    /// Conditions that a comparison has a part in, itself among them.
    fn decided_by(&self, by: NodeId) -> FxHashSet<NodeId> {
        let graph = self.forms.graph;
        let (mut found, mut todo) = (FxHashSet::default(), vec![by]);
        while let Some(id) = todo.pop() {
            if found.insert(id) {
                let users = self.users[id.0 as usize].iter().copied();
                todo.extend(users.filter(|user| graph.ty(*user) == Type::Bool));
            }
        }
        found
    }

    /// The results of the loops that a value is an end of.
    fn results_of(&self, id: NodeId) -> Vec<NodeId> {
        let graph = self.forms.graph;
        let loops = graph.loops.iter().enumerate();
        let of: Vec<u32> = loops
            .filter(|(_, l)| {
                let ends = [&l.init, &l.next, &l.done, &l.otherwise];
                l.again == id || ends.iter().any(|ends| ends.contains(&id))
            })
            .map(|(k, _)| k as u32)
            .collect();
        let result = |id: &NodeId| matches!(graph.node(*id), Node::Result { of: l, .. } if of.contains(&l.0));
        graph.ids().filter(result).collect()
    }
}

/// Whether the picture itself needs a value.
fn is_root(graph: &Graph, id: NodeId) -> bool {
    let shares = graph.diffusion.is_some() || graph.reports.contains(&id);
    graph.ink == id || graph.shade == Some(id) || shares
}
