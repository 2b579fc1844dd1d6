//! Strength reduction along runs of columns: ints that are stepped.
//!
//! Where a row is drawn in runs of columns ([`crate::schedule::segment`]), an int may
//! be set where a run begins and stepped at each of its pixels, which are next to
//! each other in their pass. So it is stepped only where it is needed, under
//! conditions that are the same for the whole run, and it may be one polynomial
//! in some runs and another one in others: a choice by such a condition.
//!
//! A step is taken before the int is used, so the run begins with what the int was
//! a column before ([`Axis::Run`] less the stride): the same formula there. A
//! polynomial of the second degree is stepped by its difference, which is stepped
//! itself. All of them are proved to stay within 32 bits where they are computed
//! ([`is_exact`]), so a machine need not wrap.
//!
//! A real sum of ints and something else is that and one int, which is exact.

mod find;
mod make;

use super::{Degrees, Part, Put, WHOLE};
use crate::analysis::beginnings::of_beginnings;
use crate::analysis::needed::needed;
use crate::analysis::range::Ranges;
use crate::ir::graph::*;
use crate::ir::tree::{Place, Statement, Tree, walk};
use crate::passes::rewrite::rebuild::rebuild_old;
use find::{Find, Whole};
use make::Make;
use slowlight_routine::Type;
use std::collections::BTreeSet;

/// Values that could be stepped along runs.
pub fn runs(graph: &Graph, ranges: &Ranges) -> Vec<NodeId> {
    let find = Find::of(graph, ranges);
    let reached = graph.reached();
    let mut read = vec![false; graph.nodes.len()];
    for id in graph.ids().filter(|id| reached[id.0 as usize]) {
        for operand in graph.references(id) {
            let part = match graph.ty(operand) {
                Type::Int => find.ints.at(id).is_some(),
                _ => find.reals[id.0 as usize].is_some(),
            };
            read[operand.0 as usize] |= !part;
        }
    }
    graph.roots().for_each(|id| read[id.0 as usize] = true);
    let site = |id: &NodeId| read[id.0 as usize] && *id != graph.ink && find.may_step(*id);
    graph.ids().filter(site).collect()
}

/// The graph with some of them stepped, and all ints of the same value; none where
/// they might not be exact.
pub fn in_runs(graph: &Graph, ranges: &Ranges, at: &[NodeId]) -> Option<Graph> {
    let find = Find::of(graph, ranges);
    let mut all: Vec<(NodeId, Whole)> = Vec::new();
    rebuild_old(graph, &mut |builder, made, id, span| {
        if find.ints.at(id).is_some_and(|degree| degree > 0) || at.contains(&id) {
            let split = Make::new(&find, builder, made, span).split(id);
            all.extend(split.map(|split| (id, split.whole)));
        }
        None
    });
    let wanted = all.iter().filter(|(id, _)| at.contains(id));
    let wanted: Vec<&Whole> = wanted.map(|(_, whole)| whole).collect();
    let int = |id: NodeId| graph.ty(id) == Type::Int && may_be_read(graph, id);
    let alike = all
        .iter()
        .filter(|(id, whole)| int(*id) && wanted.contains(&whole));
    let alike: BTreeSet<NodeId> = alike.map(|(id, _)| *id).chain(at.iter().copied()).collect();
    let mut exact = true;
    let mut known: Vec<(Whole, NodeId)> = Vec::new();
    let made = rebuild_old(graph, &mut |builder, made, id, span| {
        if !alike.contains(&id) {
            return None;
        }
        let found = Make::new(&find, builder, made, span).stepped(id, &mut known);
        exact &= found.is_some();
        found
    });
    exact.then_some(made)
}

/// The column itself needs no stepping.
fn may_be_read(graph: &Graph, id: NodeId) -> bool {
    matches!(graph.node(id), Node::Apply(..) | Node::Select { .. })
}

/// Whether all that is stepped along runs, and what it begins with, stays within
/// 32 bits and is set where a run begins.
pub fn is_exact(graph: &Graph, tree: &Tree, ranges: &Ranges) -> bool {
    let stepped = |id: &NodeId| matches!(graph.node(*id), Node::Stepped { .. });
    if !graph.ids().any(|id| stepped(&id)) {
        return true;
    }
    let mut set = BTreeSet::new();
    walk(&tree.segment, &mut |statement| match statement {
        Statement::Let(id)
        | Statement::Set {
            place: Place::Node(id),
            ..
        } => {
            set.insert(*id);
        }
        _ => {}
    });
    let firsts = graph.nodes.iter().filter_map(|node| match node {
        Node::Stepped { first, .. } => Some(*first),
        _ => None,
    });
    let mut once = BTreeSet::new();
    if !firsts.into_iter().all(|first| once.insert(first)) {
        return false;
    }
    let (needed, begins) = (needed(graph), of_beginnings(graph));
    let within = |id: NodeId| ranges.exact[id.0 as usize].within(-WHOLE, WHOLE);
    let mut all = graph.ids().filter(|id| needed[id.0 as usize]);
    all.all(|id| match graph.node(id) {
        Node::Stepped { first, step } => {
            let apart = begins[first.0 as usize] && !begins[step.0 as usize];
            apart && set.contains(&first) && within(id)
        }
        Node::Apply(..) if begins[id.0 as usize] => set.contains(&id) && within(id),
        _ => true,
    })
}
