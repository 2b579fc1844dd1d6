//! The native evaluation of a graph of which not every pixel is traced.
//!
//! What a pixel's neighbours left is known only when they are drawn, so whatever depends on it
//! is computed pixel by pixel, in one lane, as where errors are spread.

use super::spread::early;
use super::{Block, Native, Pixel, blocks};
use crate::eval::neighbours::Neighbours;
use crate::ir::graph::*;
use slowlight_routine::{Type, Value};
use std::ops::Range;

/// What such a graph needs besides its nodes.
pub(super) struct Refining {
    neighbours: Neighbours,
    /// What is needed in any case and depends on no neighbour.
    early: Vec<u32>,
    kept: NodeId,
    /// How many pixels between key rows were traced, and how many there were.
    between: (u64, u64),
}

impl Refining {
    /// `None` where the graph traces every pixel.
    pub fn new(graph: &Graph) -> Option<Refining> {
        Some(Refining {
            neighbours: Neighbours::new(graph)?,
            early: early(graph),
            kept: graph.refinement?.kept,
            between: (0, 0),
        })
    }
}

impl Native<'_> {
    /// What share of the pixels between key rows were traced so far; 1 where there are none.
    pub fn traced_between(&self) -> f64 {
        match self.refining.as_ref().map(|refining| refining.between) {
            Some((traced, all @ 1..)) => traced as f64 / all as f64,
            _ => 1.0,
        }
    }

    /// Appends the pixels of some columns of row `y`, after drawing those that they hang on.
    pub(super) fn refine(&mut self, columns: Range<i32>, y: i32, out: &mut Vec<Pixel>) {
        let due = match &mut self.refining {
            Some(refining) => refining.neighbours.due(columns.start, y),
            None => Vec::new(),
        };
        let mut unseen = Vec::new();
        for row in due.chunk_by(|a, b| a.1 == b.1) {
            if let [(first, y), ..] = *row {
                self.refine_row(first..first + row.len() as i32, y, &mut unseen);
                unseen.clear();
            }
        }
        self.refine_row(columns, y, out);
    }

    fn refine_row(&mut self, columns: Range<i32>, y: i32, out: &mut Vec<Pixel>) {
        for block in blocks(columns, y, self.lanes.lanes()) {
            self.refine_block(block, out);
        }
    }

    /// Draws pixels that are the next in order.
    fn refine_block(&mut self, block: Block, out: &mut Vec<Pixel>) {
        self.enter(block, block.x..);
        let Some(mut refining) = self.refining.take() else {
            return;
        };
        for &node in &refining.early {
            self.need(node, block.mask());
        }
        let (neighbours, y) = (&mut refining.neighbours, block.y);
        for (lane, x) in (0..block.count).zip(block.x..) {
            let around = neighbours.around(x, y);
            for &(which, slot) in &self.plan.neighbours {
                let left = Value::Int(around[which as usize]);
                self.lanes.set(Type::Int, slot, lane, left);
            }
            let mask = 1 << lane;
            self.shown(mask);
            out.push(self.look(lane));
            self.need(refining.kept.0, mask);
            neighbours.keep(x, y, self.get(refining.kept, lane).int());
            if let Some(traced) = neighbours.traces_between(y, around) {
                refining.between.0 += u64::from(traced);
                refining.between.1 += 1;
            }
        }
        self.refining = Some(refining);
    }
}
