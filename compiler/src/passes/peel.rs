//! Peel: the first turn of a loop stands before it.
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

use super::rate::{Dependence, Rates, rates};
use crate::flow::graph::*;

/// The graph with the first turn of a loop before it; nothing where the loop
/// has no second turn, stands in another loop or has one in its body, or where
/// its body has more than `most` nodes.
pub fn peel(graph: &Graph, of: LoopId, most: usize) -> Option<Graph> {
    let turns = graph.loops.get(of.0 as usize)?;
    let rates = rates(graph);
    let inside = |id: NodeId| rates.depends(id, Dependence::Loop(of));
    let body: Vec<NodeId> = body(graph, turns)
        .into_iter()
        .filter(|n| inside(*n))
        .collect();
    if turns.max < 2 || body.len() > most || !alone(graph, &rates, of, &body) {
        return None;
    }
    Some(Surgery::new(graph, of, body, &rates).done())
}

/// What a turn of a loop needs, operands first.
fn body(graph: &Graph, turns: &Loop) -> Vec<NodeId> {
    let mut seen = vec![false; graph.nodes.len()];
    let mut todo = vec![turns.again];
    todo.extend(turns.next.iter().chain(&turns.done));
    while let Some(id) = todo.pop() {
        if let Some(flag) = seen.get_mut(id.0 as usize)
            && !*flag
        {
            *flag = true;
            todo.extend(graph.references(id));
        }
    }
    graph.ids().filter(|id| seen[id.0 as usize]).collect()
}

/// Whether no other loop is in a loop's body, nor the loop in another's.
fn alone(graph: &Graph, rates: &Rates, of: LoopId, body: &[NodeId]) -> bool {
    let other = |id: &NodeId| {
        matches!(graph.node(*id), Node::Result { of: l, .. } if l != of)
            || (rates.rate(*id).iter())
                .any(|d| matches!(d, Dependence::Loop(l) | Dependence::Last(l) if *l != of))
    };
    let starts = graph.loops[of.0 as usize].init.iter();
    !body.iter().chain(starts).any(other)
}

/// The new arena: what stands before the loop, the copy, the loop, the rest.
struct Surgery<'g> {
    graph: &'g Graph,
    of: LoopId,
    out: Graph,
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
            out: Graph {
                nodes: Vec::new(),
                types: Vec::new(),
                spans: Vec::new(),
                names: Default::default(),
                directions: Default::default(),
                claims: Default::default(),
                ..graph.clone()
            },
            moved: vec![None; graph.nodes.len()],
            first: vec![None; graph.nodes.len()],
        };
        let end = graph.loops[of.0 as usize]
            .roots()
            .max()
            .unwrap_or(NodeId(0));
        let before = |id: &NodeId| {
            let own = [Dependence::Loop(of), Dependence::Last(of)];
            *id <= end && !own.iter().any(|d| rates.depends(*id, *d)) && !made_by(graph, of, *id)
        };
        graph.ids().filter(before).for_each(|id| made.keep(id));
        body.iter().for_each(|id| made.copy(*id));
        graph.ids().for_each(|id| made.keep(id));
        made
    }

    fn push(&mut self, node: Node, like: NodeId) -> NodeId {
        let id = NodeId(self.out.nodes.len() as u32);
        self.out.nodes.push(node);
        self.out.types.push(self.graph.ty(like));
        self.out.spans.push(self.graph.span(like));
        if let Some(name) = self.graph.names.get(&like) {
            self.out.names.insert(id, name.clone());
        }
        if let Some(length) = self.graph.directions.get(&like) {
            self.out.directions.insert(id, *length);
        }
        id
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
                self.moved[id.0 as usize] = Some(self.push(node, id));
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
        let of = |(id, _): &(NodeId, u32)| self.push(graph.node(*id), *id);
        let made: Vec<NodeId> = all.iter().map(of).collect();
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
        self.push(choice, id)
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
                self.push(node, id)
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

    fn done(mut self) -> Graph {
        for k in 0..self.graph.loops.len() {
            let old = self.graph.loops[k].clone();
            let at = |list: &[NodeId]| list.iter().map(|id| self.at(*id)).collect();
            let own = k == self.of.0 as usize;
            let start = |id: &NodeId| self.in_first(*id);
            let new = Loop {
                max: old.max - u32::from(own),
                init: match own {
                    true => old.next.iter().map(start).collect(),
                    false => at(&old.init),
                },
                again: self.at(old.again),
                next: at(&old.next),
                done: at(&old.done),
                otherwise: at(&old.otherwise),
                ..old
            };
            self.out.loops[k] = new;
        }
        let graph = self.graph;
        self.out.ink = self.at(graph.ink);
        self.out.shade = graph.shade.map(|id| self.at(id));
        self.out.reports = graph.reports.iter().map(|id| self.at(*id)).collect();
        if let (Some(new), Some(old)) = (&mut self.out.diffusion, &graph.diffusion) {
            let moved = &self.moved;
            for (new, old) in new.shares.iter_mut().zip(&old.shares) {
                new.node = moved[old.node.0 as usize].unwrap_or(NodeId(0));
            }
        }
        for (id, (op, args)) in &graph.claims {
            // In the first turn the same is claimed of what stands there.
            let first = (self.in_first(*id), (*op, args.map(|a| self.in_first(a))));
            let kept = (self.at(*id), (*op, args.map(|a| self.at(a))));
            self.out.claims.extend([first, kept]);
        }
        self.out
    }
}

fn made_by(graph: &Graph, of: LoopId, id: NodeId) -> bool {
    matches!(graph.node(id), Node::Result { of: l, .. } if l == of)
}
