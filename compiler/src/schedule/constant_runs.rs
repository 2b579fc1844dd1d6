//! Runs of columns of constant ink: runs of which one ink is known before their first pixel, or
//! two that a bool chooses between.
//!
//! What a run of columns knows (`Tree::segment`) may decide its ink: where nothing
//! is met along it, say, and its shade crosses no threshold. Then the pixels
//! need no computing at all; a target draws them in a loop that does nothing else.

use super::segment::Known;
use crate::analysis::region::Fact;
use crate::ir::graph::*;
use slowlight_routine::{Op, Value};
use std::collections::BTreeSet;

/// Conditions that are known before a run's first pixel, and the inks of its pixels
/// where they hold, which are known there as well.
#[derive(Clone, Debug, PartialEq)]
pub struct Still {
    pub conditions: Vec<Fact>,
    pub inks: Inks,
}

/// What a run's pixels show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Inks {
    One(NodeId),
    /// One of two by a bool that is another at each pixel: the only thing that is
    /// asked there ([`Known::stepped`]).
    Either {
        cond: NodeId,
        yes: NodeId,
        no: NodeId,
    },
}

impl Still {
    /// What a target reads from a run's first pixel on.
    pub fn reads(&self, graph: &Graph) -> impl Iterator<Item = NodeId> {
        let conditions = self.conditions.iter().map(|(cond, _)| *cond);
        let (inks, of) = match self.inks {
            Inks::One(ink) => (vec![ink], None),
            Inks::Either { cond, yes, no } => (vec![yes, no], Some(graph.node(cond))),
        };
        let of: Vec<NodeId> = of.iter().flat_map(Node::operands).collect();
        conditions.chain(inks).chain(of)
    }

    /// What is known at pixels whose ink is not, where one condition says of every
    /// run whether it is.
    pub fn otherwise(&self) -> Option<Fact> {
        match self.conditions.as_slice() {
            [(cond, holds)] => Some((*cond, !holds)),
            _ => None,
        }
    }

    /// Whether the two inks of a run may be one after all, as far as their choices tell.
    pub fn may_agree(&self, graph: &Graph) -> bool {
        let Inks::Either { yes, no, .. } = self.inks else {
            return true;
        };
        let (yes, no) = (leaves(graph, yes), leaves(graph, no));
        let open = |leaf: &NodeId| graph.constant(*leaf).is_none();
        let same = |a: NodeId, b: NodeId| a == b || graph.constant(a) == graph.constant(b);
        let alike = |a: &NodeId| no.iter().any(|b| same(*a, *b));
        yes.iter().chain(&no).any(open) || yes.iter().any(alike)
    }
}

/// What a value may be chosen from.
fn leaves(graph: &Graph, id: NodeId) -> BTreeSet<NodeId> {
    let (mut todo, mut seen) = (vec![id], BTreeSet::new());
    while let Some(id) = todo.pop() {
        if let (true, Node::Select { yes, no, .. }) = (seen.insert(id), graph.node(id)) {
            todo.extend([yes, no]);
        }
    }
    seen.retain(|id| !matches!(graph.node(*id), Node::Select { .. }));
    seen
}

/// The still inks of a graph whose pixels do not depend on each other, if it has any.
pub fn still(graph: &Graph) -> Option<Still> {
    if graph.is_in_order() || !graph.reports.is_empty() && !graph.is_moving() {
        return None;
    }
    let known = Known::of(graph);
    if known.before(graph.ink) {
        return None;
    }
    let find = Find { graph, known };
    if let Some(inks) = find.known_inks(graph.ink) {
        let conditions = Vec::new();
        return Some(Still { conditions, inks });
    }
    let mut conditions = Vec::new();
    find.conditions(graph.ink, &mut conditions);
    let mut facts = conditions.into_iter().flat_map(|c| [(c, true), (c, false)]);
    facts.find_map(|fact| find.inks(vec![fact]))
}

struct Find<'g> {
    graph: &'g Graph,
    known: Known<'g>,
}

impl Find<'_> {
    /// Conditions known before the run among those that an ink is chosen by, and
    /// those that these are chosen by.
    fn conditions(&self, id: NodeId, found: &mut Vec<NodeId>) {
        let (mut todo, mut seen) = (vec![id], BTreeSet::new());
        while let Some(id) = todo.pop() {
            if !seen.insert(id) {
                continue;
            }
            match self.graph.node(id) {
                Node::Select { cond, yes, no } if self.known.before(cond) => {
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

    /// The inks where something holds, perhaps with more conditions.
    fn inks(&self, mut conditions: Vec<Fact>) -> Option<Still> {
        loop {
            let ink = self.resolved(self.graph.ink, &conditions);
            if let Some(inks) = self.known_inks(ink) {
                return Some(Still { conditions, inks });
            }
            let Node::Select { cond, yes, no } = self.graph.node(ink) else {
                return None;
            };
            if !self.known.before(cond) {
                return None;
            }
            let of = |id| self.known_inks(self.resolved(id, &conditions)).is_some();
            match (of(yes), of(no)) {
                (true, _) => conditions.push((cond, true)),
                (_, true) => conditions.push((cond, false)),
                _ => return None,
            }
        }
    }

    /// An ink that is known before its run, or one of two by what is stepped.
    fn known_inks(&self, ink: NodeId) -> Option<Inks> {
        match self.graph.node(ink) {
            _ if self.known.before(ink) => Some(Inks::One(ink)),
            Node::Select { cond, yes, no }
                if self.known.stepped(cond) && self.known.before(yes) && self.known.before(no) =>
            {
                Some(Inks::Either { cond, yes, no })
            }
            _ => None,
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
