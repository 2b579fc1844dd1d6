//! Use lists of loop-carried values: which node reads what a loop carries.

use crate::ir::graph::*;
use crate::ir::tree::*;
use rustc_hash::FxHashMap;

/// By whom carried values are read.
pub type Readers = FxHashMap<(LoopId, u32), NodeId>;

/// A node that reads each carried value.
pub fn readers(graph: &Graph) -> Readers {
    let of = |id: NodeId| match graph.node(id) {
        Node::Carried { of, index } => Some(((of, index), id)),
        _ => None,
    };
    graph.ids().filter_map(of).collect()
}

/// The node whose value a place holds.
pub fn held_by(carried: &Readers, place: Place) -> Option<NodeId> {
    match place {
        Place::Node(id) => Some(id),
        Place::Carried(of, index) | Place::Scratch(of, index) => carried.get(&(of, index)).copied(),
    }
}
