//! Words that can be had without D: as A, or as M at an address in A.

use super::code::Code;
use super::expr::Expr;
use crate::hack::asm::instruction::{DEST_A, comp};
use crate::hack::vm::command::{Binary, SP};

/// The longest way to an operand or an address, in instructions, that is taken
/// to keep D. Beyond, D is put aside instead.
const LONGEST: u32 = 8;

/// Where an operand is: in A or in M.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operand {
    A,
    M,
}

/// Instructions that bring an operand there, or `None` if it takes D.
///
/// `sp` is by how much SP stands above the function's lowest stack word.
pub(super) fn near(e: &Expr, sp: i32) -> Option<u32> {
    let length = match e {
        Expr::Const(c) => 1 + u32::from(*c > 0x7fff),
        Expr::Cell(_) => 1,
        Expr::Field { offset, .. } => 1 + u32::from(*offset).max(1),
        Expr::Stacked(height) => 1 + (i32::from(*height) - sp).unsigned_abs().max(1),
        Expr::At(address) => match near_base(address) {
            Some((base, k)) => near(base, sp)? + k.unsigned_abs().max(1),
            None => near(address, sp)? + 1,
        },
        Expr::Neg(x) | Expr::Not(x) => near(x, sp)? + 1,
        Expr::Binary(Binary::Add, x, y) if is_one(y).is_some() => near(x, sp)? + 1,
        Expr::Binary(..) => return None,
    };
    (length <= LONGEST).then_some(length)
}

/// Instructions that bring the address of a word into A, or `None` if it takes D.
pub(super) fn near_address(e: &Expr, sp: i32) -> Option<u32> {
    matches!(
        e,
        Expr::Cell(_) | Expr::Field { .. } | Expr::Stacked(_) | Expr::At(_)
    )
    .then(|| near(e, sp))
    .flatten()
}

/// An address that is a word and a few more or less.
fn near_base(address: &Expr) -> Option<(&Expr, i32)> {
    let Expr::Binary(Binary::Add, x, y) = address else {
        return None;
    };
    let Expr::Const(c) = **y else {
        return None;
    };
    let k = i32::from(c.cast_signed());
    (k.unsigned_abs() < LONGEST).then_some((x, k))
}

/// 1 and -1.
pub(super) fn is_one(e: &Expr) -> Option<i32> {
    match e {
        Expr::Const(1) => Some(1),
        Expr::Const(u16::MAX) => Some(-1),
        _ => None,
    }
}

impl Code {
    /// Brings an operand that is [`near`] to A or M.
    pub(super) fn operand(&mut self, e: &Expr, sp: i32) -> Operand {
        match e {
            Expr::Const(c) => {
                if *c > 0x7fff {
                    self.at(!c);
                    self.compute(DEST_A, comp::NOT_A);
                } else {
                    self.at(*c);
                }
                Operand::A
            }
            Expr::Neg(x) => {
                let x = self.operand(x, sp);
                self.compute(DEST_A, pick(x, comp::NEG_A, comp::NEG_M));
                Operand::A
            }
            Expr::Not(x) => {
                let x = self.operand(x, sp);
                self.compute(DEST_A, pick(x, comp::NOT_A, comp::NOT_M));
                Operand::A
            }
            Expr::Binary(_, x, y) => {
                let x = self.operand(x, sp);
                self.step(x, is_one(y).unwrap_or(0));
                Operand::A
            }
            place => {
                self.address(place, sp);
                Operand::M
            }
        }
    }

    /// Brings the address of a word into A, without D, however long it takes.
    pub(super) fn address(&mut self, place: &Expr, sp: i32) {
        match place {
            Expr::Cell(cell) => self.at(*cell),
            Expr::Field { base, offset } => {
                self.at(*base);
                self.step(Operand::M, i32::from(*offset));
            }
            Expr::Stacked(height) => {
                self.at(SP);
                self.step(Operand::M, i32::from(*height) - sp);
            }
            Expr::At(address) => {
                let (base, k) = near_base(address).unwrap_or((address, 0));
                let base = self.operand(base, sp);
                self.step(base, k);
            }
            // Never an address.
            _ => {}
        }
    }

    /// A becomes an operand and `k` more.
    fn step(&mut self, from: Operand, k: i32) {
        let (first, more) = match k {
            0 if from == Operand::A => return,
            0 => (comp::M, comp::A),
            1.. => (pick(from, comp::A_PLUS_1, comp::M_PLUS_1), comp::A_PLUS_1),
            _ => (
                pick(from, comp::A_MINUS_1, comp::M_MINUS_1),
                comp::A_MINUS_1,
            ),
        };
        self.compute(DEST_A, first);
        for _ in 1..k.unsigned_abs() {
            self.compute(DEST_A, more);
        }
    }
}

/// The one of two computations that an operand asks for.
pub(super) fn pick(operand: Operand, a: u16, m: u16) -> u16 {
    match operand {
        Operand::A => a,
        Operand::M => m,
    }
}
