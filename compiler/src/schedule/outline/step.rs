//! Steps: statements whose blocks stand elsewhere, by number.

use crate::ir::graph::*;
use crate::ir::tree::{Origin, Place, SubroutineId};

/// Which block of a forest.
pub(super) type BlockId = usize;

/// A statement, its blocks elsewhere.
#[derive(Clone, Debug)]
pub(super) enum Step {
    Let(NodeId),
    Set {
        place: Place,
        from: Origin,
    },
    If {
        cond: NodeId,
        arms: [BlockId; 2],
    },
    Loop {
        of: LoopId,
        again: NodeId,
        parts: [BlockId; 5],
    },
    Call(SubroutineId),
}
