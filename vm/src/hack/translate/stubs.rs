//! Calls made shorter where the ROM is too small.
//!
//! A call in a method often passes words of its object, and one beyond the first
//! few takes seven instructions: `@n D=A @this A=D+M D=M @argument M=D`. Passing
//! n itself takes four. So such a call goes to a stub of the function, which
//! reads the words that the numbers stand for, for all calls that pass words of
//! an object known by the same cell in the same places. Each costs eight cycles
//! more, and the call two.

use super::code::{Code, Label};
use super::expr::Expr;
use super::frames::Cells;
use crate::hack::asm::instruction::{DEST_A, DEST_D, DEST_M, comp};
use std::collections::BTreeMap;

/// The offset from which a number is shorter than the word.
const FAR: u16 = 3;

/// The stubs of a program.
#[derive(Default)]
pub(super) struct Stubs {
    /// By function, cell of the pointer, and cells of the arguments to be read.
    known: BTreeMap<(usize, u16, Vec<u16>), Label>,
}

/// The offset of an argument that is a word of the object at `this`.
pub(super) fn far_offset(e: &Expr, this: u16) -> Option<u16> {
    match e {
        Expr::Field { base, offset } if *base == this && *offset > FAR => Some(*offset),
        _ => None,
    }
}

impl Stubs {
    /// The stub for a call.
    pub fn of(&mut self, function: usize, this: u16, cells: Vec<u16>, code: &mut Code) -> Label {
        let known = self.known.entry((function, this, cells));
        *known.or_insert_with(|| code.label())
    }

    /// Makes the stubs. `frame` is where a function keeps its words, and where it
    /// goes on when it has kept its return address.
    pub fn make<'f>(&self, code: &mut Code, frame: impl Fn(usize) -> Option<(&'f Cells, Label)>) {
        for ((function, this, arguments), label) in &self.known {
            let Some((cells, body)) = frame(*function) else {
                continue;
            };
            code.mark(*label);
            code.at(cells.back);
            code.compute(DEST_M, comp::D);
            for argument in arguments {
                code.at(*argument);
                code.compute(DEST_D, comp::M);
                code.at(*this);
                code.compute(DEST_A, comp::D_PLUS_M);
                code.compute(DEST_D, comp::M);
                code.at(*argument);
                code.compute(DEST_M, comp::D);
            }
            code.go(body);
        }
    }
}
