//! Branch probabilities of a plan's pixels, as far as they decide which blocks are cold.

use super::meter::Meter;
use super::pixels::{PATIENCE, spread};
use crate::eval::run::Run;
use crate::ir::graph::NodeId;
use crate::ir::often;
use crate::ir::tree::{Statement, walk};
use crate::plan::Plan;
use std::collections::BTreeMap;

/// A way is seldom taken if not every such choice takes it.
const SELDOM: u32 = 4;

impl Plan {
    /// The choices of pixels of which one way has a loop and is seldom taken, and which
    /// way that is: what a loop takes is much beside a jump to it. Nothing is known of
    /// pixels that depend on each other.
    pub fn seldom(&self) -> BTreeMap<NodeId, bool> {
        let mut asked: BTreeMap<NodeId, (bool, [u32; 2])> = BTreeMap::new();
        walk(&self.tree.pixel, &mut |s| {
            if let Statement::If { cond, yes, no } = s
                && often::loops(yes) != often::loops(no)
            {
                asked.insert(*cond, (often::loops(yes), [0; 2]));
            }
        });
        if asked.is_empty() || self.listing || self.graph.is_in_order() {
            return BTreeMap::new();
        }
        let meter = Meter::new(&self.graph, |_: &Statement| 0.0);
        let mut run = Run::within(&self.graph, &self.tree, &meter, PATIENCE + 1);
        for (x, y) in spread(&self.graph.image) {
            run.pixel(x, y);
            for (cond, (_, taken)) in &mut asked {
                if let Some(value) = run.last(*cond) {
                    taken[usize::from(value.truth())] += 1;
                }
            }
            if meter.ran.get() > PATIENCE {
                return BTreeMap::new();
            }
        }
        let rare = |(cond, (way, taken)): (NodeId, (bool, [u32; 2]))| {
            let so = taken[usize::from(way)];
            (SELDOM * so < taken[0] + taken[1]).then_some((cond, way))
        };
        asked.into_iter().filter_map(rare).collect()
    }
}
