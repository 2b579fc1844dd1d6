//! Sinking of sums into loop exits: what is added to a loop's result is added where the loop
//! ends.
//!
//! Behind a loop a sum is of a result, of which nothing is known; where the loop ends
//! it is of what was made there, and may be gathered with that. A loop that is left
//! out ([`crate::passes::loops::bypass`]) gives what it would start with, moved by as much.

use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::algebra::polynomial::users;
use crate::passes::rewrite::rebuild::{End, Rewrite, rebuild_by};
use crate::source::Span;
use slowlight_routine::{Op, Type, Value};
use std::collections::BTreeSet;

/// The graph with sums of a result and a constant in loops' ends, where nothing else
/// needs the result; nothing where there are none.
pub fn sunk(graph: &Graph) -> Option<Graph> {
    let users = users(graph);
    let mut found: Vec<Sunk> = (graph.ids())
        .filter_map(|id| {
            let Node::Result { of, index } = graph.node(id) else {
                return None;
            };
            let [user] = users[id.0 as usize][..] else {
                return None;
            };
            // What a loop that is left out would start with may stand beside it.
            let (value, sum, choice) = match (graph.node(user), &users[user.0 as usize][..]) {
                (Node::Select { cond, yes, no }, &[sum]) if cond != id => {
                    (user, sum, Some((cond, yes, no)))
                }
                _ => (id, user, None),
            };
            let Node::Apply(op @ (Op::Add | Op::Sub), args) = graph.node(sum) else {
                return None;
            };
            let at = args.iter().position(|arg| *arg == value)?;
            let other = graph.constant(args[1 - at])?;
            (graph.ty(id) == Type::Real).then_some(Sunk {
                of,
                index,
                sum,
                result: id,
                choice,
                make: (op, at, other),
            })
        })
        .collect();
    // Where both that are chosen between are results, the other is added to in its arm.
    let mut sums = BTreeSet::new();
    found.retain(|sunk| sums.insert(sunk.sum));
    let some = !found.is_empty();
    some.then(|| rebuild_by(graph, &mut Sinking(found)))
}

struct Sunk {
    of: LoopId,
    index: u32,
    sum: NodeId,
    result: NodeId,
    /// The choice between the result and something else that the sum is of, if any.
    choice: Option<(NodeId, NodeId, NodeId)>,
    /// The operation, which of its operands the result is, and the other.
    make: (Op, usize, Value),
}

struct Sinking(Vec<Sunk>);

impl Rewrite for Sinking {
    fn node(
        &mut self,
        builder: &mut Builder,
        made: &[Option<NodeId>],
        id: NodeId,
        _moved: Node,
        span: Span,
    ) -> Option<NodeId> {
        let sunk = self.0.iter().find(|sunk| sunk.sum == id)?;
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        let Some((cond, yes, no)) = sunk.choice else {
            return new(sunk.result);
        };
        let [yes, no] = [yes, no].map(|arm| match arm == sunk.result {
            true => new(arm),
            false => Some(sunk.added(builder, new(arm)?)),
        });
        Some(builder.select(new(cond)?, yes?, no?, span))
    }

    fn end(
        &mut self,
        builder: &mut Builder,
        made: &[Option<NodeId>],
        id: NodeId,
        end: End,
    ) -> Option<NodeId> {
        let End::Result(of, index) = end else {
            return None;
        };
        let at = |sunk: &&Sunk| (sunk.of, sunk.index) == (of, index);
        let sunk = self.0.iter().find(at)?;
        let value = made.get(id.0 as usize).copied().flatten()?;
        Some(sunk.added(builder, value))
    }
}

impl Sunk {
    /// The sum of a value.
    fn added(&self, builder: &mut Builder, value: NodeId) -> NodeId {
        let (op, at, other) = self.make;
        let other = builder.constant(other, Span::default());
        let args = match at {
            0 => [value, other],
            _ => [other, value],
        };
        builder.apply(op, &args, Span::default())
    }
}
