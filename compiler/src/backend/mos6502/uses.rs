//! How often the program reads and writes what it keeps: the most used is in the zero page.

use super::memory::Machine;
use super::moved::{self, Moved};
use super::slots::{Sampling, Slot, of_axis};
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::passes::loops::strip_mine::passes;
use crate::plan::Plan;
use rustc_hash::FxHashMap;
use std::collections::{BTreeMap, BTreeSet};

/// How often each slot is read and written, roughly, where some places share a home and
/// some bools have none.
pub(super) fn counted(
    plan: &Plan,
    moved: &BTreeSet<Moved>,
    shared: &FxHashMap<Place, Place>,
    fused: &BTreeSet<NodeId>,
) -> BTreeMap<Slot, u64> {
    let mut uses = Uses {
        plan,
        moved,
        shared,
        fused,
        weight: 1,
        count: BTreeMap::new(),
    };
    uses.frame();
    uses.count
}

/// Counts reads and writes of slots, loops eightfold, pixels and rows more.
struct Uses<'p> {
    plan: &'p Plan,
    moved: &'p BTreeSet<Moved>,
    shared: &'p FxHashMap<Place, Place>,
    fused: &'p BTreeSet<NodeId>,
    weight: u64,
    count: BTreeMap<Slot, u64>,
}

impl Uses<'_> {
    /// All that the program does.
    fn frame(&mut self) {
        for slot in [Slot::Rows(false), Slot::Rows(true), Slot::Which] {
            self.add(slot);
        }
        for k in 0..self.plan.params.len() as u32 {
            self.add(Slot::Param(k));
        }
        let tree = &self.plan.tree;
        for id in tabulated(&self.plan.graph, tree) {
            self.add(Slot::Column(id));
        }
        for (block, weight) in [
            (&tree.step, 1),
            (&tree.frame, 1),
            (&tree.column, 1 << 8),
            (&tree.row, 1 << 8),
            (&tree.pass, 1 << 10),
            (&tree.segment, 1 << 11),
            (&tree.pixel, 1 << 16),
        ] {
            self.weight = weight;
            self.block(block);
        }
        for (id, by) in self.plan.ramps() {
            self.read(id);
            self.read(by);
        }
        let graph = &self.plan.graph;
        self.read(graph.ink);
        graph.reports.iter().for_each(|&id| self.read(id));
        if let Some(rows) = self.plan.error_rows() {
            rows.shares.iter().for_each(|s| self.read(s.node));
            self.add(Slot::Received);
            // Only what is in the zero page can point.
            let pointers = (0..rows.rows).map(|k| (Slot::Errors(k), u64::MAX));
            self.count.extend(pointers);
        }
        if let Some(refinement) = graph.refinement {
            self.read(refinement.kept);
            for which in Neighbour::ALL {
                self.add(Slot::Neighbour(which));
            }
            for what in Sampling::ALL {
                match what.points() {
                    true => drop(self.count.insert(Slot::Sampling(what), u64::MAX)),
                    false => self.add(Slot::Sampling(what)),
                }
            }
        }
        self.add(Slot::Axis(Axis::X));
        self.add(Slot::Axis(Axis::Y));
        let passes = passes(graph);
        if passes > 1 {
            self.add(Slot::Axis(Axis::Pass(passes)));
            self.add(Slot::PassFirst);
        }
        if !tree.segment.is_empty() {
            // Each pixel reads both of its bytes.
            self.add(Slot::RunEnd);
            self.add(Slot::RunEnd);
        }
        if let Some(still) = &self.plan.still {
            still.reads(graph).for_each(|id| self.read(id));
        }
        if self.plan.plot && Machine::of(self.plan) != Machine::Plain {
            self.count.insert(Slot::ScreenAt, u64::MAX);
            self.add(Slot::ScreenByte);
            self.add(Slot::ScreenLine);
        } else if graph.image.block != (1, 1) {
            self.add(Slot::Block(Axis::X));
            self.add(Slot::Block(Axis::Y));
        }
    }

    fn add_place(&mut self, place: Place) {
        self.add(Slot::Value(
            self.shared.get(&place).copied().unwrap_or(place),
        ));
    }

    fn add(&mut self, slot: Slot) {
        *self.count.entry(slot).or_default() += self.weight;
    }

    fn read(&mut self, id: NodeId) {
        if self.fused.contains(&id) {
            return;
        }
        match (self.plan.place(id), self.plan.graph.node(id)) {
            (Some(place), _) => self.add_place(place),
            (None, Node::Param(p)) => self.add(Slot::Param(p.0)),
            (None, Node::Axis(axis)) => self.add(of_axis(axis)),
            (None, Node::Received) => self.add(Slot::Received),
            (None, Node::Neighbour(which)) => self.add(Slot::Neighbour(which)),
            _ => {}
        }
    }

    fn block(&mut self, block: &[Statement]) {
        for statement in block {
            match statement {
                Statement::Let(id) => {
                    self.plan
                        .graph
                        .node(*id)
                        .inputs()
                        .for_each(|operand| self.read(operand));
                    let (plan, moved) = (self.plan, self.moved);
                    moved::each_read(plan, *id, &mut |arg, to| {
                        if moved.contains(&(arg, to)) {
                            self.add(Slot::Moved((arg, to)));
                        }
                    });
                    for at in moved.range((*id, i8::MIN)..=(*id, i8::MAX)) {
                        self.add(Slot::Moved(*at));
                    }
                    self.read(*id);
                }
                Statement::Set { place, from } => {
                    self.add_place(*place);
                    match *from {
                        Origin::Node(id) => self.read(id),
                        Origin::Scratch(l, k) => self.add_place(Place::Scratch(l, k)),
                    }
                }
                Statement::If { cond, yes, no } => {
                    self.read(*cond);
                    self.block(yes);
                    self.block(no);
                }
                Statement::Loop(turns) => {
                    self.block(&turns.start);
                    let outside = self.weight;
                    self.weight = self.weight.saturating_mul(8);
                    self.add(Slot::Turns(turns.of));
                    self.block(&turns.body);
                    self.read(turns.again);
                    self.block(&turns.next);
                    self.weight = outside;
                    self.block(&turns.done);
                    self.block(&turns.otherwise);
                }
                Statement::Call(id) => self.block(self.plan.tree.body(*id)),
            }
        }
    }
}
