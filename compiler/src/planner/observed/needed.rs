//! Dead code elimination over statements: what nothing reads is not computed.

use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::schedule::constant_runs::Still;
use rustc_hash::FxHashSet;

/// What nothing reads may be what was read by something that goes: so many rounds at most.
const ROUNDS: usize = 64;

/// Leaves out statements whose values nothing needs.
pub(super) fn keep(graph: &Graph, tree: &mut Tree, still: Option<&Still>) {
    for _ in 0..ROUNDS {
        let read = read(graph, tree, still);
        let mut gone = 0;
        tree.blocks_mut()
            .for_each(|block| gone += drop_unread(block, &read));
        if gone == 0 {
            break;
        }
    }
}

/// The places that are read.
fn read(graph: &Graph, tree: &Tree, still: Option<&Still>) -> FxHashSet<Place> {
    let mut found = FxHashSet::default();
    let mut add = |id: NodeId| {
        found.insert(match graph.node(id) {
            Node::Carried { of, index } | Node::Last { of, index } => Place::Carried(of, index),
            Node::Stepped { first, .. } => Place::Node(first),
            _ => Place::Node(id),
        });
        found.insert(Place::Node(id));
    };
    add(graph.ink);
    graph.left_to_others().for_each(&mut add);
    graph.reports.iter().for_each(|id| add(*id));
    let of_runs = still.into_iter().flat_map(|still| still.reads(graph));
    of_runs.for_each(&mut add);
    // A ramp's steps are read where it is stepped.
    for id in graph.ids() {
        if matches!(graph.node(id), Node::Ramp { .. } | Node::Stepped { .. }) {
            graph.node(id).operands().for_each(&mut add);
        }
    }
    let mut scratch = Vec::new();
    for block in tree.blocks() {
        walk(block, &mut |statement| match statement {
            Statement::Let(id) => graph.node(*id).inputs().for_each(&mut add),
            Statement::Set {
                from: Origin::Node(id),
                ..
            } => add(*id),
            Statement::Set {
                from: Origin::Scratch(of, k),
                ..
            } => scratch.push(Place::Scratch(*of, *k)),
            Statement::If { cond, .. } => add(*cond),
            Statement::Loop(turns) => add(turns.again),
            Statement::Call(_) => {}
        });
    }
    found.extend(scratch);
    found
}

/// Leaves them out of a block; answers how many.
fn drop_unread(block: &mut Block, read: &FxHashSet<Place>) -> usize {
    let mut gone = 0;
    for statement in block.iter_mut() {
        match statement {
            Statement::If { yes, no, .. } => {
                gone += drop_unread(yes, read) + drop_unread(no, read);
            }
            Statement::Loop(turns) => {
                for block in turns.blocks_mut() {
                    gone += drop_unread(block, read);
                }
            }
            _ => {}
        }
    }
    let before = block.len();
    block.retain(|statement| match statement {
        Statement::Let(id) => read.contains(&Place::Node(*id)),
        Statement::Set { place, .. } => read.contains(place),
        Statement::If { yes, no, .. } => !(yes.is_empty() && no.is_empty()),
        Statement::Loop(_) | Statement::Call(_) => true,
    });
    gone + before - block.len()
}
