//! Blocks: the same picture, computed once for several pixels of the screen.
//!
//! A block's shade is that of the pixel at its middle; its dither sees the block's own
//! column and row, as it would in a smaller picture. Were it to see the pixel's, only
//! every nth entry of its matrix would ever be met, and those need not have the
//! matrix's mean.

use super::rebuild::{End, Rewrite, rebuild_by};
use crate::flow::build::Builder;
use crate::flow::graph::*;
use crate::source::Span;
use slowlight_routine::{Op, Value};
use std::collections::HashMap;

/// The graph of a picture of blocks, each so many columns wide and rows high. Its image
/// counts blocks; both sides of the picture must be whole numbers of them.
pub fn coarse(graph: &Graph, block: (u32, u32)) -> Graph {
    if block == (1, 1) {
        return graph.clone();
    }
    let mut rewrite = Coarse {
        graph,
        block,
        dithers: dithers(graph),
        dithered: HashMap::new(),
    };
    let mut made = rebuild_by(graph, &mut rewrite);
    made.image.width = (graph.image.width / block.0).max(1);
    made.image.height = (graph.image.height / block.1).max(1);
    made.image.block = (graph.image.block.0 * block.0, graph.image.block.1 * block.1);
    made
}

/// What is between the shade and what comes out: what the dither works out.
fn dithers(graph: &Graph) -> Vec<bool> {
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

struct Coarse<'g> {
    graph: &'g Graph,
    block: (u32, u32),
    /// By node: whether the dither works it out.
    dithers: Vec<bool>,
    /// What stands for a node in the dither, where that is another than elsewhere.
    dithered: HashMap<NodeId, NodeId>,
}

impl Coarse<'_> {
    /// The middle of the block: its column or row times its size, and half of that.
    fn middle(&self, b: &mut Builder, axis: Axis, span: Span) -> NodeId {
        let size = match axis {
            Axis::Y => self.block.1,
            _ => self.block.0,
        };
        let own = b.axis(axis, span);
        if size == 1 {
            return own;
        }
        let [size, half] = [size, size / 2].map(|n| b.constant(Value::Int(n as i32), span));
        let first = b.apply(Op::IntMul, &[own, size], span);
        b.apply(Op::IntAdd, &[first, half], span)
    }

    /// What stands for an operand in the dither.
    fn seen(&self, made: &[Option<NodeId>], id: NodeId) -> Option<NodeId> {
        let plain = || made.get(id.0 as usize).copied().flatten();
        self.dithered.get(&id).copied().or_else(plain)
    }

    /// The dither's node: as it is, over what the dither's operands are.
    fn dither(
        &self,
        b: &mut Builder,
        made: &[Option<NodeId>],
        id: NodeId,
        moved: Node,
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

impl Rewrite for Coarse<'_> {
    fn node(
        &mut self,
        b: &mut Builder,
        made: &[Option<NodeId>],
        id: NodeId,
        moved: Node,
        span: Span,
    ) -> Option<NodeId> {
        if self.dithers.get(id.0 as usize) == Some(&true)
            && let Some(own) = self.dither(b, made, id, moved, span)
        {
            self.dithered.insert(id, own);
        }
        match moved {
            Node::Axis(axis) => Some(self.middle(b, axis, span)),
            _ => None,
        }
    }

    fn end(
        &mut self,
        _: &mut Builder,
        made: &[Option<NodeId>],
        id: NodeId,
        end: End,
    ) -> Option<NodeId> {
        match end {
            End::Ink | End::Output if Some(id) != self.graph.shade => self.seen(made, id),
            _ => None,
        }
    }
}
