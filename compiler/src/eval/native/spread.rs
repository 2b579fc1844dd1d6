//! The native evaluation of a graph that spreads errors.
//!
//! What a pixel receives is known only when the pixels before it are drawn, so
//! whatever depends on it is computed pixel by pixel, in one lane. Most of a
//! scene does not: what every pixel needs whatever it receives is computed for
//! the whole block first.

use super::{Block, Native, Pixel, blocks};
use crate::eval::diffuse::Pending;
use crate::ir::graph::*;
use slowlight_routine::{Op, Type, Value};
use std::ops::Range;

/// What a graph that spreads errors needs besides its nodes.
pub(super) struct Spreading {
    /// What later pixels will receive.
    pending: Pending<f64>,
    /// What is needed in any case and depends on nothing received.
    early: Vec<u32>,
    /// Where the pixel's own error goes.
    shares: Vec<Share>,
}

impl Spreading {
    /// `None` where the graph spreads nothing.
    pub fn new(graph: &Graph) -> Option<Spreading> {
        Some(Spreading {
            pending: Pending::new(graph, 0.0)?,
            early: early(graph),
            shares: graph.shares().collect(),
        })
    }
}

/// The nodes that every pixel needs and that depend on nothing received or left by others,
/// those alone that something else needs.
pub(super) fn early(graph: &Graph) -> Vec<u32> {
    let mut late = vec![false; graph.nodes.len()];
    for id in graph.ids() {
        let mut references = graph.references(id).into_iter();
        late[id.0 as usize] = matches!(graph.node(id), Node::Received | Node::Neighbour(_))
            || references.any(|n| late.get(n.0 as usize) == Some(&true));
    }
    let mut seen = vec![false; graph.nodes.len()];
    let mut early = Vec::new();
    let mut todo: Vec<NodeId> = graph.outputs().collect();
    while let Some(id) = todo.pop() {
        let at = id.0 as usize;
        match seen.get_mut(at) {
            Some(seen) if !*seen => *seen = true,
            _ => continue,
        }
        match graph.node(id) {
            _ if !late[at] => early.push(id.0),
            Node::Select { cond, .. } => todo.push(cond),
            Node::Result { of, .. } => {
                let found = graph.loops.get(of.0 as usize);
                todo.extend(found.into_iter().flat_map(|l| l.init.iter().copied()));
            }
            node => todo.extend(node.operands()),
        }
    }
    early
}

impl Native<'_> {
    /// Appends the pixels of some columns of row `y`, after drawing those that
    /// they receive something from.
    pub(super) fn spread(&mut self, columns: Range<i32>, y: i32, out: &mut Vec<Pixel>) {
        let width = i32::try_from(self.graph.image.width).unwrap_or(i32::MAX);
        let left = columns.start..columns.end.min(0);
        let inside = columns.start.max(0)..columns.end.min(width);
        let right = columns.start.max(width)..columns.end;
        self.spread_row(left, y, out);
        if let Some(spreading) = &mut self.spreading
            && !inside.is_empty()
        {
            let due = spreading.pending.due(inside.start, y);
            let mut number = due.start;
            let mut unseen = Vec::new();
            while let Some(pending) = self.spreading.as_ref().map(|s| &s.pending)
                && number < due.end
            {
                let (x, y) = pending.place(number);
                let count = i64::from(width - x).min(due.end - number);
                self.spread_row(x..x + count as i32, y, &mut unseen);
                unseen.clear();
                number += count;
            }
        }
        self.spread_row(inside, y, out);
        self.spread_row(right, y, out);
    }

    fn spread_row(&mut self, columns: Range<i32>, y: i32, out: &mut Vec<Pixel>) {
        for block in blocks(columns, y, self.lanes.lanes()) {
            self.spread_block(block, out);
        }
    }

    /// Draws pixels that are the next in order.
    fn spread_block(&mut self, block: Block, out: &mut Vec<Pixel>) {
        self.enter(block, block.x..);
        let Some(mut spreading) = self.spreading.take() else {
            return;
        };
        for &node in &spreading.early {
            self.need(node, block.mask());
        }
        let (pending, y) = (&mut spreading.pending, block.y);
        for (lane, x) in (0..block.count).zip(block.x..) {
            let received = Value::Real(pending.receive(x, y));
            for &slot in &self.plan.received {
                self.lanes.set(Type::Real, slot, lane, received);
            }
            let mask = 1 << lane;
            self.shown(mask);
            out.push(self.look(lane));
            for &share in &spreading.shares {
                self.need(share.node.0, mask);
                let sent = self.get(share.node, lane).real();
                let add = |a, b| Op::Add.eval_real(a, b).real();
                pending.send(x, y, share, sent, add);
            }
        }
        self.spreading = Some(spreading);
    }
}
