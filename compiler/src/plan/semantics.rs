//! Semantics of a plan's statements on bits: what its routines, points and ranges make of what
//! places hold. The model ([`crate::plan::model`]) and constant folding evaluate by these.

use super::Plan;
use crate::ir::graph::*;
use crate::ir::tree::Place;
use slowlight_routine::{Bits, Type};

impl Plan {
    /// What an operation's routine makes of its operands' bits, as the node's place keeps it.
    pub fn computed(&self, id: NodeId, args: &[Bits]) -> Bits {
        let Some(routine) = self.routine(id) else {
            return 0;
        };
        let bits = match &self.points {
            Some(points) => {
                let (all, count) = points.operands(&self.graph, id, args);
                (routine.model)(&all[..count])
            }
            None => (routine.model)(args),
        };
        match self.ranges.result.get(id.0 as usize) {
            Some(range) if self.format(id) == self.runtime.real => {
                (self.runtime.kept)(bits, *range)
            }
            _ => bits,
        }
    }

    /// What a pixel has received when it is sent more.
    pub fn gathered(&self, received: Bits, sent: Bits) -> Bits {
        match (self.gather(), &self.points) {
            (Some(routine), Some(_)) => (routine.model)(&[received, sent, 0]),
            (Some(routine), None) => (routine.model)(&[received, sent]),
            (None, _) => received,
        }
    }

    /// What a node's bits are when they are sent to another pixel.
    pub fn sent(&self, from: NodeId, bits: Bits) -> Bits {
        match &self.points {
            Some(points) => points.read(
                &self.graph,
                from,
                bits,
                (points.received(), points.widths().most()),
            ),
            None => bits,
        }
    }

    /// What a place holds that is given a node's bits.
    pub fn copied(&self, place: Place, from: NodeId, bits: Bits) -> Bits {
        match &self.points {
            Some(points) if self.graph.ty(from) == Type::Real => points.read(
                &self.graph,
                from,
                bits,
                (points.place(place), points.widths().place(place)),
            ),
            _ => bits,
        }
    }
}
