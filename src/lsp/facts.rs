//! What the graph says of an expression: with what its value changes, and between which
//! bounds it stays.

use slowlight_compiler::analysis::range::{Ranges, Slack, ranges};
use slowlight_compiler::analysis::rate::{Dependence, Rates, rates};
use slowlight_compiler::ir::graph::{Graph, NodeId};
use slowlight_compiler::schedule::statements::schedule;
use slowlight_compiler::source::Span;
use std::collections::BTreeSet;

/// A graph's rates and ranges.
#[derive(Debug)]
pub struct Facts {
    rates: Rates,
    ranges: Ranges,
}

/// What is known of an expression, over all places where it is computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Known {
    /// What its value changes with, the seldomest first; nothing for a constant.
    pub rate: Vec<&'static str>,
    /// The least and the greatest value, infinite where none is known.
    pub range: (f64, f64),
}

impl Facts {
    /// Of a graph in exact arithmetic.
    pub fn new(graph: &Graph) -> Facts {
        Facts {
            rates: rates(graph),
            ranges: ranges(graph, &schedule(graph), &Slack::exact()),
        }
    }

    /// Of an expression: of the nodes that were made for its place those that no other of
    /// them uses. None where nothing was left to compute.
    pub fn of(&self, graph: &Graph, span: Span) -> Option<Known> {
        let here: BTreeSet<NodeId> = graph.ids().filter(|id| graph.span(*id) == span).collect();
        let inner: BTreeSet<NodeId> = here.iter().flat_map(|id| graph.references(*id)).collect();
        let results: Vec<NodeId> = here.difference(&inner).copied().collect();
        let mut words = BTreeSet::new();
        let mut range = (f64::INFINITY, f64::NEG_INFINITY);
        for id in &results {
            words.extend(self.rates.rate(*id).iter().map(word));
            if let Some(found) = self.ranges.result.get(id.0 as usize) {
                range = (range.0.min(found.lo), range.1.max(found.hi));
            }
        }
        (!results.is_empty()).then(|| Known {
            rate: words.into_iter().map(|(_, word)| word).collect(),
            range,
        })
    }
}

/// As `explain` calls them, by how often they change.
fn word(dependence: &Dependence) -> (u8, &'static str) {
    match dependence {
        Dependence::Frame => (0, "param"),
        Dependence::Row => (1, "row"),
        Dependence::Pass => (2, "pass"),
        Dependence::Column => (3, "column"),
        Dependence::Loop(_) | Dependence::Last(_) => (4, "loop"),
    }
}
