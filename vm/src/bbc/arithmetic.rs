//! Operators on two numbers: what they give, and what BASIC II takes for it.

use std::cmp::Ordering;

use slowlight_isa::real40::{Real40, arith, elementary};

use super::Dialect;
use super::ast::{Compare, Op2};
use super::error::Error;
use super::state::State;
use super::values::Num;
use super::work;

type Result<T> = std::result::Result<T, Error>;

#[inline]
pub(super) fn truth(b: bool) -> Num {
    Num::Int(-i32::from(b))
}

impl State {
    #[inline]
    pub fn op2(&mut self, op: Op2, a: Num, b: Num) -> Result<Num> {
        let on_ints = matches!(op, Op2::IntDiv | Op2::Mod | Op2::And | Op2::Or | Op2::Eor);
        match (a, b) {
            (Num::Real(x), Num::Real(y)) if !on_ints => return self.real_op2(op, x, y),
            (Num::Int(x), Num::Int(y)) => return self.int_op2(op, x, y),
            _ => {}
        }
        if on_ints {
            let (x, y) = (self.whole(a)?, self.whole(b)?);
            return self.int_op2(op, x, y);
        }
        let (x, y) = (self.real_of(a), self.real_of(b));
        if let (Num::Int(_), Num::Real(_)) = (a, b) {
            self.cycles += work::LEFT_INT;
            if op == Op2::Mul {
                // It comes to be the side whose bits are scanned.
                return self.real_op2(op, y, x);
            }
        }
        self.real_op2(op, x, y)
    }

    /// `+ - * / ^` on reals.
    #[inline]
    fn real_op2(&mut self, op: Op2, x: Real40, y: Real40) -> Result<Num> {
        let (result, cost) = match op {
            Op2::Sub => {
                let difference = arith::sub(x, y)?;
                (difference, work::SUBTRACT + work::add(x, y, difference))
            }
            Op2::Mul => {
                let product = arith::mul(x, y)?;
                (product, work::mul(x, y, product))
            }
            Op2::Div => {
                let quotient = arith::div(x, y)?;
                (quotient, work::div(x, quotient))
            }
            Op2::Pow => (elementary::pow(x, y)?, work::pow(y)),
            _ => {
                let sum = arith::add(x, y)?;
                (sum, work::add(x, y, sum))
            }
        };
        self.cycles += u64::from(cost);
        Ok(Num::Real(result))
    }

    fn int_op2(&mut self, op: Op2, a: i32, b: i32) -> Result<Num> {
        let micro = self.config.dialect == Dialect::Micro;
        let real = |n| Real40::from_i32(n);
        self.cycles += u64::from(match op {
            Op2::Add => 117,
            Op2::Sub => 125,
            Op2::IntDiv | Op2::Mod => work::int_div(a, b),
            Op2::Mul => work::int_mul(a, b).unwrap_or(0),
            _ => 0,
        });
        Ok(Num::Int(match op {
            Op2::Add => match a.checked_add(b) {
                Some(sum) => sum,
                None if micro => a.wrapping_add(b),
                None => return Ok(Num::Real(arith::add(real(a), real(b))?)),
            },
            Op2::Sub => match a.checked_sub(b) {
                Some(difference) => difference,
                None if micro => a.wrapping_sub(b),
                None => return Ok(Num::Real(arith::sub(real(a), real(b))?)),
            },
            Op2::Mul if work::int_mul(a, b).is_some() => a.wrapping_mul(b),
            // Too long for the ROM's product of 16 bits: real from here on.
            Op2::Mul | Op2::Div | Op2::Pow => {
                let (x, y) = (self.real_of(Num::Int(a)), self.real_of(Num::Int(b)));
                return self.real_op2(op, x, y);
            }
            Op2::IntDiv | Op2::Mod if b == 0 => match self.config.dialect {
                // Measured on the Z80 interpreters: -1, and no error.
                Dialect::Agon => -1,
                _ => return Err(Error::DivisionByZero),
            },
            // Measured: the ROM has no size for this one, and finds neither quotient nor rest.
            Op2::IntDiv | Op2::Mod if micro && a == i32::MIN => 0,
            Op2::IntDiv => a.wrapping_div(b),
            Op2::Mod => a.wrapping_rem(b),
            Op2::And => a & b,
            Op2::Or => a | b,
            Op2::Eor => a ^ b,
        }))
    }

    /// A comparison of numbers.
    #[inline]
    pub fn compare(&mut self, op: Compare, a: Num, b: Num) -> bool {
        if let (Num::Int(a), Num::Int(b)) = (a, b) {
            self.cycles += 208;
            return holds(op, a.cmp(&b));
        }
        self.cycles += 311;
        if let Num::Int(_) = a {
            self.cycles += work::LEFT_INT;
        }
        let (a, b) = (self.real_of(a), self.real_of(b));
        holds(op, a.compare(b))
    }
}

#[inline]
pub(super) fn order(a: Num, b: Num) -> Ordering {
    match (a, b) {
        (Num::Int(a), Num::Int(b)) => a.cmp(&b),
        (a, b) => a.real().compare(b.real()),
    }
}

#[inline]
pub(super) fn holds(op: Compare, order: Ordering) -> bool {
    match op {
        Compare::Eq => order == Ordering::Equal,
        Compare::Ne => order != Ordering::Equal,
        Compare::Lt => order == Ordering::Less,
        Compare::Le => order != Ordering::Greater,
        Compare::Gt => order == Ordering::Greater,
        Compare::Ge => order != Ordering::Less,
    }
}
