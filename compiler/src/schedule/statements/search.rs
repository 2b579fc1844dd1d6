//! Dependences of a block's units: searches through a graph, bounded by regions.

use super::Emitter;
use crate::analysis::region::*;
use crate::ir::graph::*;
use crate::schedule::toposort::Unit;
use std::collections::BTreeSet;

impl Emitter<'_> {
    /// The conditions of the arms from a region down to one inside it.
    fn conditions(&self, outer: RegionId, mut inner: RegionId) -> Vec<NodeId> {
        let mut all = Vec::new();
        while inner != outer {
            let region = self.regions.get(inner);
            if let RegionKind::Arm { cond, .. } = region.kind {
                all.push(cond);
            }
            match region.parent {
                Some(parent) => inner = parent,
                None => break,
            }
        }
        all
    }

    /// The units of a region that a unit of it reads from.
    pub(super) fn reads(&mut self, region: RegionId, unit: Unit) -> BTreeSet<Unit> {
        let graph = self.graph;
        let mut reads = match unit {
            Unit::Compute(id) => {
                let operands: Vec<NodeId> = graph.node(id).operands().collect();
                self.search(region, &operands, &[])
            }
            Unit::Choose(id) => {
                let Node::Select { cond, yes, no } = graph.node(id) else {
                    return BTreeSet::new();
                };
                let mut reads = self.search(region, &[cond], &[]);
                for (arm, holds) in [(yes, true), (no, false)] {
                    let open: Vec<RegionId> = self
                        .regions
                        .child(region, RegionKind::Arm { cond, holds })
                        .into_iter()
                        .collect();
                    reads.extend(self.search(region, &[arm], &open));
                }
                reads
            }
            Unit::Inside(id, arm) => {
                let home = self.regions.of[id.0 as usize].unwrap_or(arm);
                let mut asked = self.conditions(region, home);
                // What this arm computes itself is computed with it.
                asked.retain(|cond| {
                    let home = self.regions.of[cond.0 as usize];
                    home.is_none_or(|home| !self.regions.holds(arm, home))
                });
                let mut reads = self.search(region, &asked, &[]);
                reads.extend(self.search(region, &[id], &[arm]));
                reads
            }
            Unit::Loop(of) => {
                let parts = [RegionKind::Body(of), RegionKind::Otherwise(of)];
                let open: Vec<RegionId> = parts
                    .into_iter()
                    .filter_map(|k| self.regions.child(region, k))
                    .collect();
                let roots = self.loop_roots(of);
                self.search(region, &roots, &open)
            }
        };
        reads.remove(&unit);
        reads
    }

    /// Everything that a loop refers to and that is needed.
    fn loop_roots(&self, of: LoopId) -> Vec<NodeId> {
        let graph = self.graph;
        let found = &graph.loops[of.0 as usize];
        let mut roots = vec![found.again];
        for &index in &self.live[of.0 as usize] {
            roots.extend([found.init[index as usize], found.next[index as usize]]);
        }
        for &(_, index) in &self.results[of.0 as usize] {
            roots.extend([found.done[index], found.otherwise[index]]);
        }
        roots
    }

    /// The child of a search's region that holds another, or none. The conditions of the arms
    /// on the way up from there are added to `conds` the first time that the search comes by:
    /// regions may stand inside each other by the hundred.
    fn toward(
        &mut self,
        region: RegionId,
        inner: RegionId,
        conds: &mut Vec<NodeId>,
    ) -> Option<RegionId> {
        let (mut at, mut child) = (inner, None);
        let mut path = Vec::new();
        while let Some(parent) = self.regions.get(at).parent {
            let (stamp, known) = self.met[at.0 as usize];
            if stamp == self.stamp {
                child = known;
                break;
            }
            path.push(at);
            if parent == region {
                child = Some(at);
                break;
            }
            at = parent;
        }
        for at in path {
            self.met[at.0 as usize] = (self.stamp, child);
            if let RegionKind::Arm { cond, .. } = self.regions.get(at).kind
                && child.is_some_and(|child| child != at)
            {
                conds.push(cond);
            }
        }
        child
    }

    /// The units of `region` not yet emitted that `roots` lead to, looking
    /// through what stands in the child regions `open`.
    pub(super) fn search(
        &mut self,
        region: RegionId,
        roots: &[NodeId],
        open: &[RegionId],
    ) -> BTreeSet<Unit> {
        self.stamp += 1;
        let mut found = BTreeSet::new();
        let mut todo = roots.to_vec();
        let mut conds = Vec::new();
        while let Some(id) = todo.pop() {
            self.visits += 1;
            let at = id.0 as usize;
            if self.seen[at] == self.stamp {
                continue;
            }
            self.seen[at] = self.stamp;
            let Some(home) = self.regions.of[at] else {
                continue;
            };
            if home == region {
                let unit = match self.graph.node(id) {
                    Node::Select { .. } => Unit::Choose(id),
                    Node::Result { of, .. } => Unit::Loop(of),
                    _ => Unit::Compute(id),
                };
                if !self.is_emitted(unit) {
                    found.insert(unit);
                }
            } else if let Some(child) = self.toward(region, home, &mut conds) {
                if open.contains(&child) {
                    todo.append(&mut conds);
                    match self.graph.node(id) {
                        Node::Result { of, .. } => todo.extend(self.loop_roots(of)),
                        node => todo.extend(node.operands()),
                    }
                } else if !self.emitted[at] {
                    found.insert(Unit::Inside(id, child));
                }
                // Those of a child that is not looked through.
                conds.clear();
            }
        }
        found
    }

    fn is_emitted(&self, unit: Unit) -> bool {
        match unit {
            Unit::Compute(id) | Unit::Choose(id) | Unit::Inside(id, _) => {
                self.emitted[id.0 as usize]
            }
            Unit::Loop(of) => self.loops_done[of.0 as usize],
        }
    }
}
