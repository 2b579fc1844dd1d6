//! A graph with what the ranges decide folded.

use crate::flow::graph::*;
use crate::flow::tree::Tree;
use crate::passes::schedule::{schedule, schedule_in_segments};
use crate::range::{Ranges, Slack, ranges};
use std::ops::Deref;
use std::sync::{Arc, OnceLock};

/// A graph, when each value of it is computed, and what each stays within. Copies
/// share what is known of it.
#[derive(Clone)]
pub struct Settled(Arc<Known>);

/// What is known of a graph.
pub struct Known {
    pub graph: Graph,
    pub tree: Tree,
    pub ranges: Ranges,
    /// Cycles and memory, pixels' and around them, as [`super::price`] has them: at
    /// pixels, and where there are none to be looked at; the same where steps are foreseen.
    pub(super) costs: [OnceLock<(f64, [f64; 2])>; 4],
}

impl Deref for Settled {
    type Target = Known;

    fn deref(&self) -> &Known {
        &self.0
    }
}

impl Settled {
    /// Something that is the same as long as the graph is there, and of no other.
    pub(super) fn address(&self) -> usize {
        Arc::as_ptr(&self.0) as usize
    }
}

/// A graph as it is, scheduled, with its ranges.
pub fn scheduled(graph: Graph, slack: &Slack) -> Settled {
    let tree = match slack.segments() {
        true => schedule_in_segments(&graph),
        false => schedule(&graph),
    };
    let ranges = ranges(&graph, &tree, slack);
    Settled(Arc::new(Known {
        graph,
        tree,
        ranges,
        costs: Default::default(),
    }))
}
