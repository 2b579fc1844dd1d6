//! What formulas compute with, and what inputs are drawn from.

use super::big::Big;

#[derive(Clone, Debug)]
pub enum Value {
    Nothing,
    Truth(bool),
    /// A number, and whether it is an integer by type: those are never rounded.
    Number(Big, bool),
    List(Vec<Value>),
    /// What a call of no known function is, with its arguments.
    Called,
}

impl Value {
    pub fn real(x: Big) -> Value {
        Value::Number(x, false)
    }

    pub fn number(&self) -> &Big {
        match self {
            Value::Number(x, _) => x,
            other => panic!("{other:?} is no number"),
        }
    }

    pub fn truth(&self) -> bool {
        match self {
            Value::Truth(truth) => *truth,
            Value::Number(x, _) => !x.is_zero(),
            other => panic!("{other:?} is no truth"),
        }
    }

    pub fn list(self) -> Vec<Value> {
        match self {
            Value::List(all) => all,
            one => vec![one],
        }
    }
}

/// What functions draw from: xorshift.
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D)
    }

    /// From 0 to below 1.
    pub fn part(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }
}
