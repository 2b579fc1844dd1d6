//! Loop peeling: the first turn of a loop stands before it.
//!
//! What a loop carries starts with values of which much may be known: that the
//! rays of a row all start at the eye, that a direction is an affine function of
//! the column divided by its length. In the loop's body this is lost, since the
//! body serves every turn. In a copy of the body with the starting values in the
//! place of the carried ones the other passes can use it; and most pixels of a
//! picture need no second turn.
//!
//! The loop then starts with what the first turn carries on, and may take one
//! turn less. Whether the copy is worth its memory is for the caller to judge.

use crate::analysis::rate::{Dependence, Rates, rates};
use crate::ir::graph::*;
use crate::passes::rewrite::arena::Arena;

/// The graph with the first turn of a loop before it; nothing where the loop
/// has no second turn, stands in another loop or has one in its body, or where
/// its body has more than `most` nodes.
pub fn peel(graph: &Graph, of: LoopId, most: usize) -> Option<Graph> {
    let turns = graph.loops.get(of.0 as usize)?;
    let rates = rates(graph);
    let body = body(graph, &rates, of);
    if turns.max < 2 || body.len() > most || !alone(graph, &rates, of, &body) {
        return None;
    }
    Some(Surgery::new(graph, of, body, &rates).done())
}

/// What is computed in each turn of a loop, operands first.
pub(crate) fn body(graph: &Graph, rates: &Rates, of: LoopId) -> Vec<NodeId> {
    let mut seen = vec![false; graph.nodes.len()];
    let turns = &graph.loops[of.0 as usize];
    let mut todo = vec![turns.again];
    todo.extend(turns.next.iter().chain(&turns.done));
    while let Some(id) = todo.pop() {
        if let Some(flag) = seen.get_mut(id.0 as usize)
            && !*flag
        {
            *flag = true;
            todo.extend(graph.refers(id));
        }
    }
    let inside = |id: &NodeId| seen[id.0 as usize] && rates.depends(*id, Dependence::Loop(of));
    graph.ids().filter(inside).collect()
}

/// What may stand before a loop: what needs nothing of it, up to where it ends.
pub(crate) fn before(graph: &Graph, rates: &Rates, of: LoopId) -> Vec<NodeId> {
    let end = graph.loops[of.0 as usize].roots().max();
    let own = [Dependence::Loop(of), Dependence::Last(of)];
    let fits = |id: &NodeId| {
        let made = matches!(graph.node(*id), Node::Result { of: l, .. } if l == of);
        Some(*id) <= end && !made && own.iter().all(|d| !rates.depends(*id, *d))
    };
    graph.ids().filter(fits).collect()
}

/// Whether no other loop is in a loop's body, nor the loop in another's.
pub(crate) fn alone(graph: &Graph, rates: &Rates, of: LoopId, body: &[NodeId]) -> bool {
    let other = |id: &NodeId| {
        matches!(graph.node(*id), Node::Result { of: l, .. } if l != of)
            || (rates.rate(*id).iter())
                .any(|d| matches!(d, Dependence::Loop(l) | Dependence::Last(l) if *l != of))
    };
    let starts = graph.loops[of.0 as usize].init.iter();
    !body.iter().chain(starts).any(other)
}

/// The body's nodes that values need, operands first.
pub(crate) fn cone(graph: &Graph, roots: &[NodeId], body: &[NodeId]) -> Vec<NodeId> {
    let mut needed = Vec::new();
    let mut todo = roots.to_vec();
    while let Some(id) = todo.pop() {
        if body.binary_search(&id).is_ok() && !needed.contains(&id) {
            needed.push(id);
            todo.extend(graph.node(id).operands());
        }
    }
    needed.sort_unstable();
    needed
}

/// The new arena: what stands before the loop, the copy, the loop, the rest.
struct Surgery<'g> {
    graph: &'g Graph,
    of: LoopId,
    out: Arena<'g>,
    /// The new id of each old node.
    moved: Vec<Option<NodeId>>,
    /// The new id of each old node in the first turn.
    first: Vec<Option<NodeId>>,
}

impl<'g> Surgery<'g> {
    fn new(graph: &'g Graph, of: LoopId, body: Vec<NodeId>, rates: &Rates) -> Surgery<'g> {
        let mut made = Surgery {
            graph,
            of,
            out: Arena::new(graph),
            moved: vec![None; graph.nodes.len()],
            first: vec![None; graph.nodes.len()],
        };
        let before = before(graph, rates, of);
        before.into_iter().for_each(|id| made.keep(id));
        body.iter().for_each(|id| made.copy(*id));
        graph.ids().for_each(|id| made.keep(id));
        made
    }

    /// An old node in the new arena, once.
    fn keep(&mut self, id: NodeId) {
        if self.moved[id.0 as usize].is_some() {
            return;
        }
        match self.graph.node(id) {
            Node::Result { of, .. } if of == self.of => self.results(),
            node => {
                let node = node.with(|a| self.at(a));
                self.moved[id.0 as usize] = Some(self.out.push(node, id));
            }
        }
    }

    /// All of the loop's results, which stand together, and behind them what
    /// chooses between them and the first turn's.
    fn results(&mut self) {
        let graph = self.graph;
        let result = |id: NodeId| match graph.node(id) {
            Node::Result { of, index } if of == self.of => Some((id, index)),
            _ => None,
        };
        let all: Vec<(NodeId, u32)> = graph.ids().filter_map(result).collect();
        let push = |(id, _): &(NodeId, u32)| self.out.push(graph.node(*id), *id);
        let made: Vec<NodeId> = all.iter().map(push).collect();
        for ((id, index), result) in all.into_iter().zip(made) {
            self.moved[id.0 as usize] = Some(self.ended(id, result, index));
        }
    }

    /// A result: the loop's where the first turn went on, else that turn's.
    fn ended(&mut self, id: NodeId, result: NodeId, index: u32) -> NodeId {
        let turns = &self.graph.loops[self.of.0 as usize];
        let done = turns.done.get(index as usize).copied().unwrap_or(id);
        let choice = Node::Select {
            cond: self.in_first(turns.again),
            yes: result,
            no: self.in_first(done),
        };
        self.out.push(choice, id)
    }

    /// A node of the body, as it is in the first turn.
    fn copy(&mut self, id: NodeId) {
        let made = match self.graph.node(id) {
            Node::Carried { of, index } if of == self.of => {
                let init = self.graph.loops[of.0 as usize].init.get(index as usize);
                init.map_or(NodeId(0), |init| self.at(*init))
            }
            node => {
                let node = node.with(|a| self.in_first(a));
                self.out.push(node, id)
            }
        };
        self.first[id.0 as usize] = Some(made);
    }

    fn at(&self, id: NodeId) -> NodeId {
        self.moved[id.0 as usize].unwrap_or(NodeId(0))
    }

    fn in_first(&self, id: NodeId) -> NodeId {
        self.first[id.0 as usize].unwrap_or_else(|| self.at(id))
    }

    fn done(self) -> Graph {
        let old = &self.graph.loops[self.of.0 as usize];
        let init = old.next.iter().map(|id| self.in_first(*id)).collect();
        let moved = |id: NodeId| self.moved[id.0 as usize].unwrap_or(NodeId(0));
        let mut out = self.out.finish(&self.moved);
        let turns = &mut out.loops[self.of.0 as usize];
        turns.init = init;
        turns.max -= 1;
        for (id, (op, args)) in &self.graph.claims {
            // In the first turn the same is claimed of what stands there.
            if let Some(id) = self.first[id.0 as usize] {
                let args = args.map(|a| self.first[a.0 as usize].unwrap_or(moved(a)));
                out.claims.insert(id, (*op, args));
            }
        }
        out
    }
}
