//! Still inks: runs of columns of which one ink is known before their first pixel.
//!
//! What a run of columns knows (`Tree::segment`) may decide its ink: where nothing
//! is met along it, say, and its shade crosses no threshold. Then the pixels
//! need no computing at all; a target draws them in a loop that does nothing else.

use super::needed::needed;
use super::rate::rates;
use super::region::Fact;
use super::segment::by_segment;
use crate::flow::graph::*;
use slowlight_routine::{Op, Value};

/// Conditions that are known before a run's first pixel, and the ink of all its
/// pixels where they hold, which is known there as well.
#[derive(Clone, Debug, PartialEq)]
pub struct Still {
    pub conditions: Vec<Fact>,
    pub ink: NodeId,
}

impl Still {
    /// What a target reads before a run's first pixel.
    pub fn reads(&self) -> impl Iterator<Item = NodeId> {
        let conditions = self.conditions.iter().map(|(cond, _)| *cond);
        conditions.chain([self.ink])
    }
}

/// The still inks of a graph whose pixels do not depend on each other, if it has any.
pub fn still(graph: &Graph) -> Option<Still> {
    if graph.diffusion.is_some() || !graph.reports.is_empty() {
        return None;
    }
    let rates = rates(graph);
    let runs = by_segment(graph, &rates, &needed(graph));
    let find = Find {
        graph,
        known: &|id| rates.is_still(id) || runs[id.0 as usize],
    };
    if (find.known)(graph.ink) {
        return None;
    }
    let mut conditions = Vec::new();
    find.conditions(graph.ink, &mut conditions);
    let facts = conditions.into_iter().flat_map(|c| [(c, true), (c, false)]);
    facts.into_iter().find_map(|fact| find.ink(fact))
}

struct Find<'f> {
    graph: &'f Graph,
    /// Whether something is known before a run's first pixel.
    known: &'f dyn Fn(NodeId) -> bool,
}

impl Find<'_> {
    /// Conditions known before the run among those that an ink is chosen by, and
    /// those that these are chosen by.
    fn conditions(&self, id: NodeId, found: &mut Vec<NodeId>) {
        let (mut todo, mut seen) = (vec![id], std::collections::BTreeSet::new());
        while let Some(id) = todo.pop() {
            if !seen.insert(id) {
                continue;
            }
            match self.graph.node(id) {
                Node::Select { cond, yes, no } if (self.known)(cond) => {
                    if !found.contains(&cond) {
                        found.push(cond);
                    }
                    todo.extend([no, yes]);
                }
                Node::Select { cond, yes, no } => todo.extend([no, yes, cond]),
                Node::Apply(Op::Not, [a, _]) => todo.push(a),
                _ => {}
            }
        }
    }

    /// The ink where something holds, perhaps with more conditions.
    fn ink(&self, fact: Fact) -> Option<Still> {
        let mut conditions = vec![fact];
        loop {
            let ink = self.resolved(self.graph.ink, &conditions);
            if (self.known)(ink) {
                return Some(Still { conditions, ink });
            }
            let Node::Select { cond, yes, no } = self.graph.node(ink) else {
                return None;
            };
            if !(self.known)(cond) {
                return None;
            }
            let of = |id| (self.known)(self.resolved(id, &conditions));
            match (of(yes), of(no)) {
                (true, _) => conditions.push((cond, true)),
                (_, true) => conditions.push((cond, false)),
                _ => return None,
            }
        }
    }

    /// What a value is where some conditions hold.
    fn resolved(&self, mut id: NodeId, facts: &[Fact]) -> NodeId {
        while let Node::Select { cond, yes, no } = self.graph.node(id) {
            id = match self.truth(cond, facts) {
                Some(true) => yes,
                Some(false) => no,
                None => break,
            };
        }
        id
    }

    fn truth(&self, cond: NodeId, facts: &[Fact]) -> Option<bool> {
        if let Some((_, holds)) = facts.iter().find(|(of, _)| *of == cond) {
            return Some(*holds);
        }
        match self.graph.node(cond) {
            Node::Const(_) => self.graph.constant(cond).map(Value::truth),
            Node::Apply(Op::Not, [a, _]) => self.truth(a, facts).map(|a| !a),
            Node::Select { .. } => match self.resolved(cond, facts) {
                other if other == cond => None,
                other => self.truth(other, facts),
            },
            _ => None,
        }
    }
}
