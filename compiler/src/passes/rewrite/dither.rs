//! Rewriting of what lies between a picture's shade and its ink, apart from what the shade is
//! made of: the same expression may take part in both.

use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::source::Span;
use rustc_hash::FxHashMap;

/// What the dither works out, and what stands for it in a new graph.
pub struct Dither<'g> {
    graph: &'g Graph,
    /// By node: whether the dither works it out.
    own: Vec<bool>,
    /// What stands for a node in the dither, where that is another than elsewhere.
    stands: FxHashMap<NodeId, NodeId>,
}

impl<'g> Dither<'g> {
    /// That of a graph; nothing where its picture has no dither.
    pub fn of(graph: &'g Graph) -> Dither<'g> {
        Dither {
            graph,
            own: own(graph),
            stands: FxHashMap::default(),
        }
    }

    /// Puts something else in a node's place in the dither.
    pub fn put(&mut self, id: NodeId, stands: NodeId) {
        self.stands.insert(id, stands);
    }

    /// What stands for an operand in the dither.
    pub fn seen(&self, made: &[Option<NodeId>], id: NodeId) -> Option<NodeId> {
        let plain = || made.get(id.0 as usize).copied().flatten();
        self.stands.get(&id).copied().or_else(plain)
    }

    /// Whether the dither works out a node and reads another there.
    pub fn reads(&self, id: NodeId, read: NodeId) -> bool {
        self.has(id) && self.graph.refers(id).any(|operand| operand == read)
    }

    fn has(&self, id: NodeId) -> bool {
        self.own.get(id.0 as usize) == Some(&true)
    }

    /// Makes a node anew, if it is the dither's: as it is, over what its operands are.
    pub fn make(
        &mut self,
        b: &mut Builder,
        made: &[Option<NodeId>],
        (id, moved): (NodeId, Node),
        span: Span,
    ) {
        if self.has(id)
            && let Some(own) = self.made(b, made, (id, moved), span)
        {
            self.put(id, own);
        }
    }

    fn made(
        &self,
        b: &mut Builder,
        made: &[Option<NodeId>],
        (id, moved): (NodeId, Node),
        span: Span,
    ) -> Option<NodeId> {
        let seen = |id| self.seen(made, id);
        Some(match (self.graph.node(id), moved) {
            (Node::Axis(axis), _) => b.axis(axis, span),
            (Node::Apply(op, args), _) => {
                let args: Option<Vec<NodeId>> =
                    args[..op.arity()].iter().map(|a| seen(*a)).collect();
                b.apply(op, &args?, span)
            }
            (Node::Select { cond, yes, no }, _) => {
                b.select(seen(cond)?, seen(yes)?, seen(no)?, span)
            }
            (Node::Lookup { column, row, .. }, Node::Lookup { table, .. }) => {
                b.lookup(table, seen(column)?, seen(row)?, span)
            }
            _ => return None,
        })
    }
}

/// What is between the shade and what comes out.
fn own(graph: &Graph) -> Vec<bool> {
    let mut found = vec![false; graph.nodes.len()];
    let Some(shade) = graph.shade else {
        return found;
    };
    let mut todo: Vec<NodeId> = graph.roots().collect();
    while let Some(id) = todo.pop() {
        let Some(flag) = found.get_mut(id.0 as usize) else {
            continue;
        };
        if id == shade || std::mem::replace(flag, true) {
            continue;
        }
        todo.extend(graph.references(id));
    }
    found
}
