//! Availability at a place: whether a forest's nodes are computed there.

use super::Extent;
use super::forest::Forest;
use super::step::BlockId;
use crate::analysis::region::Fact;
use crate::ir::graph::*;
use crate::ir::tree::SubroutineId;

impl Forest {
    /// Whether a node is computed on every way to a statement.
    pub fn is_assigned(&self, graph: &Graph, id: NodeId, block: BlockId, at: usize) -> bool {
        match graph.node(id) {
            Node::Const(_) | Node::Param(_) | Node::Axis(_) => return true,
            Node::Received | Node::Neighbour(_) => return true,
            Node::Carried { .. } | Node::Last { .. } => return true,
            // Set by every call.
            Node::Slot(_) if !self.ways.contains(&id) => {
                return self.node_owner[id.0 as usize] == self.owner[block];
            }
            _ => {}
        }
        let mut found = self.assigned.get(&id).copied();
        while let Some((home, after)) = found {
            let mut here = Some((block, at));
            while let Some((block, at)) = here {
                if block == home {
                    return after < at;
                }
                here = self.before[block];
            }
            // What an arm computes is there where its condition came out the same.
            let same = self.facts[home].filter(|fact| self.holds(*fact, block));
            found = same.and_then(|_| self.around[home]);
        }
        false
    }

    /// Whether a condition is known to have come out so where a block is carried out.
    fn holds(&self, fact: Fact, block: BlockId) -> bool {
        let mut here = Some(block).filter(|_| self.extent != Extent::All);
        while let Some(block) = here {
            if self.facts[block] == Some(fact) {
                return true;
            }
            here = self.around[block].map(|(block, _)| block);
        }
        false
    }

    /// Whether a node must be the same in all runs of one shape: what another
    /// subroutine than the run's own has, and the column, by whose comparisons runs of
    /// columns end.
    pub fn is_fixed(&self, graph: &Graph, id: NodeId, owner: Option<SubroutineId>) -> bool {
        let column = graph.node(id) == Node::Axis(Axis::X);
        let held = self.node_owner.get(id.0 as usize).copied().flatten();
        held.is_some() && held != owner || column && self.extent != Extent::All
    }

    /// Whether a run computes a node on every way through it.
    pub fn is_assigned_in(&self, id: NodeId, block: BlockId, run: std::ops::Range<usize>) -> bool {
        self.assigned
            .get(&id)
            .is_some_and(|(home, at)| *home == block && run.contains(at))
    }
}
