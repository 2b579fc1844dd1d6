//! Arithmetics that statements are run in: how values are held, and what an operation makes of
//! them.

use crate::ir::graph::*;
use crate::ir::ramp;
use crate::ir::tree::*;
use slowlight_routine::{Op, Value};

/// How values are held and computed.
pub trait Arithmetic {
    /// A value.
    type Value: Copy;
    /// A constant of the graph.
    fn constant(&self, value: Value) -> Self::Value;
    /// An entry of a table.
    fn entry(&self, _table: TableId, _at: usize, value: Value) -> Self::Value {
        self.constant(value)
    }
    /// A live param.
    fn param(&self, id: ParamId) -> Self::Value;
    /// A node's operation on its arguments.
    fn apply(&self, id: NodeId, op: Op, args: &[Self::Value]) -> Self::Value;
    /// What a place holds that is given a node's value.
    fn copied(&self, _place: Place, _from: NodeId, value: Self::Value) -> Self::Value {
        value
    }
    /// What a node's value is when it is sent to another pixel.
    fn sent(&self, _from: NodeId, value: Self::Value) -> Self::Value {
        value
    }
    /// Adds what a pixel sends to what another has received so far.
    fn gather(&self, received: Self::Value, sent: Self::Value) -> Self::Value;
    /// A ramp at a column by its number in its pass, its first value and its steps' given.
    fn ramp(&self, x: i32, coefficients: &[Self::Value]) -> Self::Value {
        let ints: Vec<i32> = coefficients.iter().map(|&c| self.int(c)).collect();
        self.constant(Value::Int(ramp::at(x, &ints)))
    }
    /// A condition.
    fn truth(&self, value: Self::Value) -> bool;
    /// An int.
    fn int(&self, value: Self::Value) -> i32;
    /// Told what a loop carries into its turn number `turn`, the first after
    /// the start being 1; for who measures.
    fn turn(&self, _of: LoopId, _turn: u32, _carried: &[Option<Self::Value>]) {}
    /// Told of each statement before it runs; for who measures.
    fn step(&self, _statement: &Statement) {}
}

/// The graph's own arithmetic: `f64` and `i32`, as [`Op::eval`] defines them.
pub struct Exact<'g>(pub &'g Graph);

impl Arithmetic for Exact<'_> {
    type Value = Value;

    fn constant(&self, value: Value) -> Value {
        value
    }

    fn param(&self, id: ParamId) -> Value {
        super::native::param_value(self.0, id)
    }

    fn apply(&self, _: NodeId, op: Op, args: &[Value]) -> Value {
        op.eval(args)
    }

    fn gather(&self, received: Value, sent: Value) -> Value {
        Op::Add.eval(&[received, sent])
    }

    fn truth(&self, value: Value) -> bool {
        value.truth()
    }

    fn int(&self, value: Value) -> i32 {
        value.int()
    }
}
