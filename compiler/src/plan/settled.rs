//! A graph with what the ranges decide folded.

use crate::flow::graph::*;
use crate::flow::tree::Tree;
use crate::passes::fold::fold;
use crate::passes::narrow::narrow;
use crate::passes::schedule::{schedule, schedule_in_segments};
use crate::range::{Ranges, Slack, ranges};

/// A graph, when each value of it is computed, and what each stays within.
#[derive(Clone)]
pub struct Settled {
    pub graph: Graph,
    pub tree: Tree,
    pub ranges: Ranges,
}

/// What is equal by algebra or decided by the ranges is folded. What the
/// ranges decide may let more be folded; a few rounds settle it.
pub fn settle(graph: &Graph, slack: &Slack) -> Settled {
    let mut now = scheduled(fold(graph), slack);
    for _ in 0..3 {
        let next = fold(&narrow(&now.graph, &now.ranges));
        if next.nodes == now.graph.nodes {
            break;
        }
        now = scheduled(next, slack);
    }
    now
}

/// A graph as it is, scheduled, with its ranges.
pub fn scheduled(graph: Graph, slack: &Slack) -> Settled {
    let tree = match slack.segments() {
        true => schedule_in_segments(&graph),
        false => schedule(&graph),
    };
    let ranges = ranges(&graph, &tree, slack);
    Settled {
        graph,
        tree,
        ranges,
    }
}
