//! In how many bits each real is held, in formats that have two widths
//! ([`slowlight_routine::Runtime::narrow`]); in all others each has the format's.
//!
//! An operation is carried out in one width: that of its result or, where that is no real, in
//! the widest of its operands'. Operands of another width are read in it: one of fewer bits as
//! it is, one of more rounded to the scale wanted, and held to the ends.

use super::Points;
use super::agreed::{Other, agreed};
use crate::flow::graph::*;
use crate::flow::tree::Place;
use slowlight_routine::{Format, Routine, Type};

/// The bits of a graph's reals.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Widths {
    /// The most, of what none are told for.
    most: u8,
    /// Each node's.
    values: Vec<u8>,
    /// Those in which each operation is carried out.
    operations: Vec<u8>,
    /// Each carried value's, by loop.
    carried: Vec<Vec<u8>>,
}

impl Widths {
    /// All the same.
    pub fn uniform(bits: u8) -> Widths {
        Widths {
            most: bits,
            ..Widths::default()
        }
    }

    /// Of `bits`, some nodes in fewer where all that share a place with them are.
    pub fn mixed(graph: &Graph, (bits, fewer): (u8, u8), narrow: &[bool]) -> Widths {
        let mut values: Vec<u8> = (graph.ids())
            .map(|id| match (graph.node(id), narrow.get(id.0 as usize)) {
                // What comes from elsewhere is made in all bits.
                (Node::Param(_) | Node::Received, _) => bits,
                (_, Some(true)) => fewer,
                _ => bits,
            })
            .collect();
        let table = |node: &Node| match node {
            Node::Lookup { table, .. } => Some(table.0 as usize),
            _ => None,
        };
        let tables = (graph.tables.len(), table as Other);
        let carried = agreed(graph, &mut values, (fewer, u8::max), tables);
        let operation = |id: NodeId| match graph.node(id) {
            Node::Apply(op, args) if op.result() != Type::Real => {
                let real = |k: &usize| op.args().get(*k) == Some(&Type::Real);
                let known = |k: &usize| graph.constant(args[*k]).is_none();
                let of = |k: usize| values[args[k].0 as usize];
                let widest = (0..op.arity()).filter(real).filter(known).map(of).max();
                widest.unwrap_or(bits)
            }
            _ => values[id.0 as usize],
        };
        Widths {
            most: bits,
            operations: graph.ids().map(operation).collect(),
            values,
            carried,
        }
    }

    /// The most bits.
    pub fn most(&self) -> u8 {
        self.most
    }

    /// All that there are.
    pub fn all(&self) -> impl Iterator<Item = u8> + use<> {
        let mut all = self.values.clone();
        all.push(self.most);
        all.sort_unstable();
        all.dedup();
        all.into_iter()
    }

    /// A node's.
    pub fn value(&self, id: NodeId) -> u8 {
        self.values.get(id.0 as usize).copied().unwrap_or(self.most)
    }

    /// Those in which an operation is carried out.
    pub fn operation(&self, id: NodeId) -> u8 {
        let found = self.operations.get(id.0 as usize).copied();
        found.unwrap_or(self.most)
    }

    /// Those of what a place holds.
    pub fn place(&self, place: Place) -> u8 {
        match place {
            Place::Node(id) => self.value(id),
            Place::Carried(l, k) | Place::Scratch(l, k) => {
                let found = self.carried.get(l.0 as usize);
                let found = found.and_then(|l| l.get(k as usize)).copied();
                found.unwrap_or(self.most)
            }
        }
    }
}

impl Points {
    /// In how many bits values are held.
    pub fn widths(&self) -> &Widths {
        &self.widths
    }

    /// Whether a routine is for the width of an operation.
    pub fn is_as_wide(&self, id: NodeId, routine: &Routine) -> bool {
        let of = |format: &Format| match format {
            Format::Scaled { bits } => *bits == self.widths.operation(id),
            _ => true,
        };
        of(&routine.result) && routine.args.iter().all(of)
    }
}
