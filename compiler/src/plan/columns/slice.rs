//! The ink's slice, evaluated in the plan's arithmetic where some of its values are given.

use super::Refusal;
use crate::eval::arithmetic::Arithmetic;
use crate::ir::graph::*;
use crate::ir::tree::Place;
use crate::plan::Plan;
use crate::plan::model::Model;
use rustc_hash::FxHashMap;
use slowlight_routine::{Bits, Value};

/// How many nodes are evaluated at most for all pixels.
const FUEL: u64 = 30_000_000;

/// The ink's slice at a pixel, some values given.
pub(super) struct Slice<'p> {
    plan: &'p Plan,
    pub model: Model<'p>,
    /// Values that are given.
    pub given: FxHashMap<NodeId, Bits>,
    held: FxHashMap<NodeId, Bits>,
    at: (i32, i32),
    fuel: u64,
}

impl<'p> Slice<'p> {
    pub fn of(plan: &'p Plan) -> Slice<'p> {
        Slice {
            plan,
            model: Model::of(plan),
            given: FxHashMap::default(),
            held: FxHashMap::default(),
            at: (0, 0),
            fuel: FUEL,
        }
    }

    /// Another pixel, with nothing given.
    pub fn begin(&mut self, at: (i32, i32)) {
        self.at = at;
        self.given.clear();
        self.held.clear();
    }

    /// A node's bits there.
    ///
    /// # Errors
    /// Where it hangs on what is not given.
    pub fn value(&mut self, id: NodeId) -> Result<Bits, Refusal> {
        let known = self.given.get(&id).or(self.held.get(&id));
        if let Some(bits) = known {
            return Ok(*bits);
        }
        let graph = &self.plan.graph;
        let refused = |why: &str| Err(Refusal::at(graph, id, why));
        let Some(left) = self.fuel.checked_sub(1) else {
            return refused("the ink takes too much work to see what it hangs on");
        };
        self.fuel = left;
        let int = |slice: &Self, value: i32| slice.model.constant(Value::Int(value));
        let bits = match graph.node(id) {
            Node::Const(c) => self.model.constant(c.value()),
            Node::Axis(Axis::X | Axis::Run) => int(self, self.at.0),
            Node::Axis(Axis::Y) => int(self, self.at.1),
            Node::Axis(Axis::Pass(n)) => int(self, self.at.0.rem_euclid(n as i32)),
            Node::Apply(op, [a, b]) => {
                let a = self.value(a)?;
                let b = if op.arity() > 1 { self.value(b)? } else { a };
                self.model.apply(id, op, &[a, b][..op.arity()])
            }
            Node::Select { cond, yes, no } => {
                let cond = self.value(cond)?;
                let arm = if self.model.truth(cond) { yes } else { no };
                let value = self.value(arm)?;
                self.model.copied(Place::Node(id), arm, value)
            }
            Node::Lookup { table, column, row } => {
                let (column, row) = (self.value(column)?, self.value(row)?);
                let (column, row) = (self.model.int(column), self.model.int(row));
                let found = graph.tables.get(table.0 as usize);
                self.plan
                    .entry(table, found.map_or(0, |t| t.index(column, row)))
            }
            Node::Tabulated(of) => {
                let value = self.value(of)?;
                self.model.copied(Place::Node(id), of, value)
            }
            _ => return refused("the ink hangs on this"),
        };
        self.held.insert(id, bits);
        Ok(bits)
    }
}
