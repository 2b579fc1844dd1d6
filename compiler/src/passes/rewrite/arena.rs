//! Graph copies without hash-consing: a new arena of nodes that are copies of an old graph's,
//! which passes share that copy nodes more than once, and which a rebuilding by equal nodes would
//! undo.

use crate::ir::graph::*;
use slowlight_routine::Value;

/// The new graph while it is made; its loops and outputs are those of the old one
/// until [`Arena::finish`].
pub struct Arena<'g> {
    pub graph: &'g Graph,
    out: Graph,
}

impl<'g> Arena<'g> {
    pub fn new(graph: &'g Graph) -> Arena<'g> {
        let out = Graph {
            nodes: Vec::new(),
            types: Vec::new(),
            spans: Vec::new(),
            names: Default::default(),
            directions: Default::default(),
            claims: Default::default(),
            early: Default::default(),
            hoisted: Default::default(),
            ..graph.clone()
        };
        Arena { graph, out }
    }

    /// Appends a node that is like an old one.
    pub fn push(&mut self, node: Node, like: NodeId) -> NodeId {
        let id = NodeId(self.out.nodes.len() as u32);
        self.out.nodes.push(node);
        self.out.types.push(self.graph.ty(like));
        self.out.spans.push(self.graph.span(like));
        if let Some(name) = self.graph.names.get(&like) {
            self.out.names.insert(id, name.clone());
        }
        // Other nodes may be pushed like a shortcut, which they are not.
        if self.graph.early.contains(&like) && self.is_shortcut(node) {
            self.out.early.insert(id);
        }
        if let Some(length) = self.graph.directions.get(&like) {
            self.out.directions.insert(id, *length);
        }
        id
    }

    /// The same, of a shortcut that is taken in any case.
    pub fn push_taken(&mut self, node: Node, like: NodeId) -> NodeId {
        let id = self.push(node, like);
        self.out.early.remove(&id);
        id
    }

    fn is_shortcut(&self, node: Node) -> bool {
        let truth = |id, value| self.out.constant(id) == Some(Value::Bool(value));
        matches!(node, Node::Select { yes, no, .. } if truth(yes, true) && truth(no, false))
    }

    /// The new graph, its loops and outputs what `moved` says stands for the old
    /// ones, and so its claims where all of one are there.
    pub fn finish(self, moved: &[Option<NodeId>]) -> Graph {
        let (graph, mut out) = (self.graph, self.out);
        let there = |id: NodeId| moved.get(id.0 as usize).copied().flatten();
        let at = |id: NodeId| there(id).unwrap_or(NodeId(0));
        for turns in &mut out.loops {
            let lists = [
                &mut turns.init,
                &mut turns.next,
                &mut turns.done,
                &mut turns.otherwise,
            ];
            for id in lists.into_iter().flatten() {
                *id = at(*id);
            }
            turns.again = at(turns.again);
        }
        out.ink = at(graph.ink);
        out.shade = graph.shade.map(at);
        out.reports.iter_mut().for_each(|id| *id = at(*id));
        if let Some(diffusion) = &mut out.diffusion {
            let shares = diffusion.shares.iter_mut();
            shares.for_each(|share| share.node = at(share.node));
        }
        if let Some(refinement) = &mut out.refinement {
            refinement.kept = at(refinement.kept);
        }
        for (id, (op, [a, b])) in &graph.claims {
            if let (Some(id), Some(a), Some(b)) = (there(*id), there(*a), there(*b)) {
                out.claims.insert(id, (*op, [a, b]));
            }
        }
        out
    }
}
