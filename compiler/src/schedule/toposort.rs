//! Topological order of a block's units: each after those that it reads from.

use crate::analysis::region::RegionId;
use crate::ir::graph::*;
use rustc_hash::FxHashMap;
use std::collections::{BTreeMap, BTreeSet};

/// What is emitted as one step of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Unit {
    /// An operation or lookup.
    Compute(NodeId),
    /// A loop with all its results.
    Loop(LoopId),
    /// A select.
    Choose(NodeId),
    /// A value inside an arm, read from outside it.
    Inside(NodeId, RegionId),
}

/// Which of the ready units comes first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// Values, then loops, then what stands under conditions: few `If`s.
    #[default]
    Ready,
    /// The one that stands first in the graph.
    Graph,
}

/// Units that wait for the units that they read from.
#[derive(Default)]
pub struct Queue {
    order: Order,
    /// Each unit's place in the graph.
    nodes: FxHashMap<Unit, NodeId>,
    /// How many units each one still waits for.
    waits: FxHashMap<Unit, usize>,
    /// Who waits for each unit.
    readers: FxHashMap<Unit, Vec<Unit>>,
    /// The condition of each unit that has one.
    conditions: FxHashMap<Unit, NodeId>,
    /// How many units on each condition are not ready yet.
    late: FxHashMap<NodeId, usize>,
    /// What can be emitted alone.
    single: BTreeSet<Unit>,
    /// What can be emitted under one `If`.
    groups: BTreeMap<NodeId, Vec<Unit>>,
}

impl Queue {
    /// An empty queue.
    pub fn new(order: Order) -> Queue {
        Queue {
            order,
            ..Queue::default()
        }
    }

    /// Whether a unit was added.
    pub fn holds(&self, unit: Unit) -> bool {
        self.waits.contains_key(&unit)
    }

    /// Adds a unit, its place in the graph, its condition if it stands under
    /// one, and what it waits for.
    pub fn add(
        &mut self,
        unit: Unit,
        node: NodeId,
        condition: Option<NodeId>,
        reads: BTreeSet<Unit>,
    ) {
        self.nodes.insert(unit, node);
        self.waits.insert(unit, reads.len());
        if let Some(cond) = condition {
            self.conditions.insert(unit, cond);
            *self.late.entry(cond).or_default() += 1;
        }
        if reads.is_empty() {
            self.ready(unit);
        }
        for read in reads {
            self.readers.entry(read).or_default().push(unit);
        }
    }

    fn ready(&mut self, unit: Unit) {
        match self.conditions.get(&unit) {
            Some(&cond) => {
                if let Some(late) = self.late.get_mut(&cond) {
                    *late -= 1;
                }
                self.groups.entry(cond).or_default().push(unit);
            }
            None => {
                self.single.insert(unit);
            }
        }
    }

    /// The next units to emit: one value or loop, or the ready units on one
    /// condition (one that is ready as a whole, if there is one, since it then
    /// needs no second `If`). Nothing when all is emitted.
    pub fn take(&mut self) -> Vec<Unit> {
        let step = match self.order {
            Order::Ready => self.take_ready(),
            Order::Graph => self.take_first(),
        };
        for unit in &step {
            for reader in self.readers.remove(unit).unwrap_or_default() {
                if let Some(waits) = self.waits.get_mut(&reader) {
                    *waits -= 1;
                    if *waits == 0 {
                        self.ready(reader);
                    }
                }
            }
        }
        step
    }

    fn take_ready(&mut self) -> Vec<Unit> {
        if let Some(unit) = self.single.pop_first() {
            return vec![unit];
        }
        let whole = self.groups.keys().find(|cond| self.is_whole(**cond));
        let cond = whole.or_else(|| self.groups.keys().next()).copied();
        cond.map_or(Vec::new(), |cond| self.take_group(cond))
    }

    fn take_first(&mut self) -> Vec<Unit> {
        let node = |unit: &Unit| self.nodes.get(unit).copied();
        let single = self.single.iter().map(|u| (node(u), *u)).min();
        let of_group = |(cond, units): (&NodeId, &Vec<Unit>)| {
            let first = units.iter().map(node).min().flatten();
            (!self.is_whole(*cond), first, *cond)
        };
        let group = self.groups.iter().map(of_group).min();
        match (single, group) {
            (Some((at, _)), Some((false, first, cond))) if first < at => self.take_group(cond),
            (Some((_, unit)), _) => {
                self.single.remove(&unit);
                vec![unit]
            }
            (None, Some((_, _, cond))) => self.take_group(cond),
            (None, None) => Vec::new(),
        }
    }

    /// Whether no unit on a condition is still to come.
    fn is_whole(&self, cond: NodeId) -> bool {
        self.late.get(&cond) == Some(&0)
    }

    fn take_group(&mut self, cond: NodeId) -> Vec<Unit> {
        let mut units = self.groups.remove(&cond).unwrap_or_default();
        units.sort_unstable();
        units
    }
}
