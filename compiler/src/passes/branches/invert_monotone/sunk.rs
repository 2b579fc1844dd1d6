//! Sinking of a comparison into loop exits: a shade is compared where the loop ends that gives
//! it.

use super::invert::Chain;
use crate::ir::build::Builder;
use crate::ir::graph::*;

/// How deep in choices a loop's result is looked for, and how deep what selects
/// a threshold may be.
const DEEP: u32 = 12;

/// The results of loops that a shade is chosen from and that nothing else needs:
/// instead of them the loops may end in inks.
pub fn results(graph: &Graph, chain: &Chain) -> Vec<(LoopId, u32)> {
    let mut uses = vec![0u32; graph.nodes.len()];
    let reached = graph.reached();
    for id in graph.ids().filter(|id| reached[id.0 as usize]) {
        let used = graph.references(id).into_iter();
        used.for_each(|used| uses[used.0 as usize] += 1);
    }
    graph.roots().for_each(|id| uses[id.0 as usize] += 1);
    let mut found = Vec::new();
    // A step that is looked at itself, when the picture's error is measured, say, is
    // computed, and so is what it is made of.
    if chain.steps.iter().any(|step| uses[step.0 as usize] > 1) {
        return found;
    }
    // The shade itself is looked at by the first of the steps alone.
    let mut todo = vec![(chain.value, 0)];
    while let Some((id, deep)) = todo.pop() {
        if uses[id.0 as usize] != 1 || deep > DEEP {
            continue;
        }
        match graph.node(id) {
            Node::Select { yes, no, .. } => todo.extend([(yes, deep + 1), (no, deep + 1)]),
            Node::Result { of, index } => found.push((of, index)),
            _ => {}
        }
    }
    found
}

/// Old values in a graph that is rebuilt, copied before their turn where they
/// stand after what needs them.
pub struct Copy<'g> {
    pub graph: &'g Graph,
    pub made: Vec<Option<NodeId>>,
}

impl Copy<'_> {
    pub fn of(&mut self, b: &mut Builder, old: NodeId) -> Option<NodeId> {
        self.deep(b, old, 0)
    }

    fn deep(&mut self, b: &mut Builder, old: NodeId, deep: u32) -> Option<NodeId> {
        if let Some(made) = self.made.get(old.0 as usize).copied().flatten() {
            return Some(made);
        }
        if deep > DEEP {
            return None;
        }
        let span = self.graph.span(old);
        let made = match self.graph.node(old) {
            Node::Const(c) => b.constant(c.value(), span),
            Node::Axis(axis) => b.axis(axis, span),
            Node::Apply(op, args) => {
                let mut new = Vec::with_capacity(2);
                for arg in &args[..op.arity()] {
                    new.push(self.deep(b, *arg, deep + 1)?);
                }
                b.apply(op, &new, span)
            }
            _ => return None,
        };
        self.made[old.0 as usize] = Some(made);
        Some(made)
    }
}
