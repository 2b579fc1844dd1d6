//! Instrumentation of an arithmetic by a listener: for who counts, prices or looks for faults,
//! while all is computed as without them.

use super::arithmetic::Arithmetic;
use crate::ir::graph::*;
use crate::ir::tree::{Place, Statement};
use slowlight_routine::{Op, Value};

/// Who is told of what is computed.
pub trait Listener<V> {
    /// An operation was carried out: its node, its arguments, and what came of them.
    fn applied(&self, _id: NodeId, _op: Op, _args: &[V], _result: V) {}
    /// As for [`Arithmetic::turn`].
    fn turn(&self, _of: LoopId, _turn: u32, _carried: &[Option<V>]) {}
    /// As for [`Arithmetic::step`].
    fn step(&self, _statement: &Statement) {}
}

/// An arithmetic, and who is told of what it does.
pub struct Heard<A, L> {
    /// What computes.
    pub arithmetic: A,
    /// Who listens.
    pub listener: L,
}

impl<A: Arithmetic, L: Listener<A::Value>> Arithmetic for &Heard<A, L> {
    type Value = A::Value;

    fn constant(&self, value: Value) -> A::Value {
        self.arithmetic.constant(value)
    }

    fn entry(&self, table: TableId, at: usize, value: Value) -> A::Value {
        self.arithmetic.entry(table, at, value)
    }

    fn param(&self, id: ParamId) -> A::Value {
        self.arithmetic.param(id)
    }

    fn apply(&self, id: NodeId, op: Op, args: &[A::Value]) -> A::Value {
        let result = self.arithmetic.apply(id, op, args);
        self.listener.applied(id, op, args, result);
        result
    }

    fn copied(&self, place: Place, from: NodeId, value: A::Value) -> A::Value {
        self.arithmetic.copied(place, from, value)
    }

    fn sent(&self, from: NodeId, value: A::Value) -> A::Value {
        self.arithmetic.sent(from, value)
    }

    fn gather(&self, received: A::Value, sent: A::Value) -> A::Value {
        self.arithmetic.gather(received, sent)
    }

    fn ramp(&self, x: i32, coefficients: &[A::Value]) -> A::Value {
        self.arithmetic.ramp(x, coefficients)
    }

    fn truth(&self, value: A::Value) -> bool {
        self.arithmetic.truth(value)
    }

    fn int(&self, value: A::Value) -> i32 {
        self.arithmetic.int(value)
    }

    fn turn(&self, of: LoopId, turn: u32, carried: &[Option<A::Value>]) {
        self.arithmetic.turn(of, turn, carried);
        self.listener.turn(of, turn, carried);
    }

    fn step(&self, statement: &Statement) {
        self.arithmetic.step(statement);
        self.listener.step(statement);
    }
}
