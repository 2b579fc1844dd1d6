//! An analysed graph: with its statements and ranges.

use crate::analysis::range::{Ranges, Slack, ranges_counted};
use crate::ir::graph::*;
use crate::ir::tree::Tree;
use crate::schedule::statements::schedule_counted;
use std::ops::Deref;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};

/// Units of work for each node of a graph, for each that the schedule meets and each statement
/// that the ranges walk; and to run the pixels that are priced, a node and at most.
const NODE: u64 = 40;
/// Of so many nodes more each takes a unit more: conditions stand deeper in each other.
const MANY: u64 = 4;
const VISIT: u64 = 1;
const WALKED: u64 = 3;
const LOOKED_AT: u64 = 40;
const PRICED: u64 = 20_000;

/// What a plan costs, as [`crate::cost::price`] has it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cost {
    /// Cycles a pixel.
    pub cycles: f64,
    /// Of these what loop-invariant code motion will spare ([`crate::passes::loops::licm`]),
    /// which comes last.
    pub hoisted: f64,
    /// Memory.
    pub statements: f64,
}

/// A graph, when each value of it is computed, and what each stays within. Copies
/// share what is known of it.
#[derive(Clone)]
pub struct Analysed(Arc<Known>);

/// What is known of a graph.
pub struct Known {
    pub graph: Graph,
    pub tree: Tree,
    pub ranges: Ranges,
    /// What it took to know this, and to price it, in units of [`crate::fuel::Fuel`].
    pub(crate) work: u64,
    /// Its number: of no other.
    serial: u64,
    /// What it costs, once that was asked for.
    pub(crate) cost: OnceLock<Cost>,
}

impl Deref for Analysed {
    type Target = Known;

    fn deref(&self) -> &Known {
        &self.0
    }
}

impl Analysed {
    /// Something that copies of it have, and no other.
    pub(crate) fn serial(&self) -> u64 {
        self.0.serial
    }
}

/// A graph as it is, scheduled, with its ranges.
pub fn scheduled(graph: Graph, slack: &Slack) -> Analysed {
    static SERIAL: AtomicU64 = AtomicU64::new(0);
    let (tree, visits) = schedule_counted(&graph, slack.segments());
    let (ranges, walked) = ranges_counted(&graph, &tree, slack);
    let nodes = graph.nodes.len() as u64;
    Analysed(Arc::new(Known {
        work: (NODE + nodes / MANY) * nodes
            + VISIT * visits
            + WALKED * walked
            + PRICED.min(LOOKED_AT * nodes),
        serial: SERIAL.fetch_add(1, Ordering::Relaxed),
        graph,
        tree,
        ranges,
        cost: OnceLock::new(),
    }))
}
