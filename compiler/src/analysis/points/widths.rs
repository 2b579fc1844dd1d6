//! Word lengths: in how many bits each real is held, in formats that have two widths
//! ([`slowlight_routine::Runtime::narrow`]); in all others each has the format's.
//!
//! An operation is carried out in one width: that of its result or, where that is no real, in
//! the widest of its operands'. Operands of another width are read in it: one of fewer bits as
//! it is, one of more rounded to the scale wanted, and held to the ends. Roots and quotients of
//! 8 bits are made of 16: what is left of an operand in 8 may have far fewer that count.

use super::Points;
use super::unify::{Other, agreed};
use crate::ir::graph::*;
use crate::ir::tree::Place;
use slowlight_routine::{Format, Op, Routine, Type};

/// What a byte has.
pub(crate) const BYTE: u8 = 8;

/// The bits of a graph's reals.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Widths {
    /// The most, of what none are told for.
    most: u8,
    /// Each node's.
    values: Vec<u8>,
    /// Those in which each operation is carried out.
    operations: Vec<u8>,
    /// Those in which each operation's operands are read.
    operands: Vec<u8>,
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
        let operations: Vec<u8> = graph.ids().map(operation).collect();
        let operands = |(id, of): (NodeId, &u8)| match (graph.node(id), *of) {
            (Node::Apply(Op::Sqrt | Op::ReciprocalRoot | Op::Div, _), BYTE) => bits,
            (_, of) => of,
        };
        Widths {
            most: bits,
            operands: graph.ids().zip(&operations).map(operands).collect(),
            operations,
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

    /// Those in which an operation's operands are read.
    pub fn operands(&self, id: NodeId) -> u8 {
        let found = self.operands.get(id.0 as usize).copied();
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

    /// Whether a routine is for the widths of an operation.
    pub fn is_as_wide(&self, id: NodeId, routine: &Routine) -> bool {
        let is = |format: &Format, wanted: u8| match format {
            Format::Scaled { bits } => *bits == wanted,
            _ => true,
        };
        let operands = self.widths.operands(id);
        is(&routine.result, self.widths.operation(id))
            && routine.args.iter().all(|format| is(format, operands))
    }
}
