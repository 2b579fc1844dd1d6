//! Arithmetics that statements are run in: how values are held, and what an operation makes of
//! them.

use crate::ir::graph::*;
use crate::ir::ramp;
use crate::ir::tree::*;
use slowlight_routine::{Op, Type, Value};

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

/// A [`Value`] as interpreters hold it, its tag and its bits: in two words, each of which is written and read as a
/// whole. A value by itself is written by its parts and copied as a whole, and processors wait
/// for that (Fog, The microarchitecture of Intel, AMD and VIA CPUs, "store forwarding").
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tagged {
    ty: Type,
    bits: u64,
}

impl From<Value> for Tagged {
    #[inline]
    fn from(value: Value) -> Tagged {
        let bits = match value {
            Value::Bool(b) => u64::from(b),
            Value::Int(i) => u64::from(i.cast_unsigned()),
            Value::Real(r) => r.to_bits(),
        };
        Tagged {
            ty: value.ty(),
            bits,
        }
    }
}

impl From<Tagged> for Value {
    #[inline]
    fn from(tagged: Tagged) -> Value {
        match tagged.ty {
            Type::Bool => Value::Bool(tagged.bits != 0),
            Type::Int => Value::Int((tagged.bits as u32).cast_signed()),
            Type::Real => Value::Real(f64::from_bits(tagged.bits)),
        }
    }
}

impl Tagged {
    /// Of a type and its bits.
    #[inline]
    pub(crate) fn of(ty: Type, bits: u64) -> Tagged {
        Tagged { ty, bits }
    }

    /// Its type and its bits.
    #[inline]
    pub(crate) fn parts(self) -> (Type, u64) {
        (self.ty, self.bits)
    }

    /// As [`Value::ty`].
    #[inline]
    pub fn ty(self) -> Type {
        self.ty
    }

    /// As [`Value::real`].
    #[inline]
    pub fn real(self) -> f64 {
        Value::from(self).real()
    }

    /// As [`Value::int`].
    #[inline]
    pub fn int(self) -> i32 {
        Value::from(self).int()
    }

    /// As [`Value::truth`].
    #[inline]
    pub fn truth(self) -> bool {
        Value::from(self).truth()
    }
}

/// An operation as [`Op::eval`] defines it.
#[inline]
pub fn computed(op: Op, args: &[Tagged]) -> Tagged {
    let at = |k: usize| {
        args.get(k)
            .map_or(Value::Int(0), |tagged| Value::from(*tagged))
    };
    Tagged::from(op.eval(&[at(0), at(1)]))
}

/// The graph's own arithmetic: `f64` and `i32`, as [`Op::eval`] defines them.
pub struct Exact<'g>(pub &'g Graph);

impl Arithmetic for Exact<'_> {
    type Value = Tagged;

    fn constant(&self, value: Value) -> Tagged {
        value.into()
    }

    fn param(&self, id: ParamId) -> Tagged {
        super::native::param_value(self.0, id).into()
    }

    fn apply(&self, _: NodeId, op: Op, args: &[Tagged]) -> Tagged {
        computed(op, args)
    }

    fn gather(&self, received: Tagged, sent: Tagged) -> Tagged {
        computed(Op::Add, &[received, sent])
    }

    fn truth(&self, tagged: Tagged) -> bool {
        tagged.truth()
    }

    fn int(&self, tagged: Tagged) -> i32 {
        tagged.int()
    }
}
