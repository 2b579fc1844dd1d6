//! Uses and definitions: where a node's value is read, and the places that a statement tree's
//! blocks write.

use crate::ir::graph::*;
use crate::ir::tree::*;

/// What each subroutine computes itself. What it sets for those that it calls
/// may have been set before: that is not forgotten.
pub(super) fn own_places(graph: &Graph, tree: &Tree) -> Vec<Vec<Place>> {
    let of = |subroutine: &Subroutine| {
        let mut own = Vec::new();
        walk(&subroutine.body, &mut |s| match s {
            Statement::Let(id) => own.push(Place::Node(*id)),
            Statement::Set { place, .. } => own.push(*place),
            _ => {}
        });
        let slot = |place: &Place| match place {
            Place::Node(id) => matches!(graph.node(*id), Node::Slot(_)),
            _ => false,
        };
        own.retain(|place| !slot(place));
        own
    };
    tree.subroutines.iter().map(of).collect()
}

/// What a block writes, subroutines included.
pub(super) fn places(tree: &Tree, block: &[Statement]) -> Vec<Place> {
    let mut all = Vec::new();
    let mut called = vec![false; tree.subroutines.len()];
    let mut todo = vec![block];
    while let Some(block) = todo.pop() {
        walk(block, &mut |s| match s {
            Statement::Let(id) => all.push(Place::Node(*id)),
            Statement::Set { place, .. } => all.push(*place),
            Statement::Call(id) => {
                if let Some(called) = called.get_mut(id.0 as usize)
                    && !std::mem::replace(called, true)
                {
                    todo.push(tree.body(*id));
                }
            }
            _ => {}
        });
    }
    all
}

/// Where a node's value is found.
#[derive(Clone, Copy)]
pub(super) enum Source {
    /// Among what is held.
    Held(u32),
    /// The pixel's place.
    Column,
    Row,
    /// Its column's number in a pass of so many.
    Pass(i32),
    Received,
    Neighbour(Neighbour),
    /// To be worked out from its coefficients.
    Ramp,
}

/// Where a node is read, what each loop carries beginning at those numbers.
pub(super) fn source(graph: &Graph, carried: &[u32], id: NodeId) -> Source {
    match graph.node(id) {
        Node::Axis(Axis::X | Axis::Run) => Source::Column,
        Node::Axis(Axis::Y) => Source::Row,
        Node::Axis(Axis::Pass(n)) => Source::Pass(n.max(1) as i32),
        Node::Received => Source::Received,
        Node::Neighbour(which) => Source::Neighbour(which),
        Node::Carried { of, index } | Node::Last { of, index } => {
            Source::Held(carried.get(of.0 as usize).map_or(id.0, |at| at + index))
        }
        Node::Ramp { .. } => Source::Ramp,
        _ => Source::Held(id.0),
    }
}
