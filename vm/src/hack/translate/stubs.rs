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

/// A function, the cell of a pointer, and the cells of the arguments to be read.
type Key = (usize, u16, Vec<u16>);

/// The stubs of a program.
#[derive(Default)]
pub(super) struct Stubs {
    known: BTreeMap<Key, Label>,
    /// How many calls would be shorter by each.
    calls: BTreeMap<Key, usize>,
    /// How many calls were counted before, if they were.
    counted: Option<BTreeMap<Key, usize>>,
}

/// The offset of an argument that is a word of the object at `this`.
pub(super) fn far_offset(e: &Expr, this: u16) -> Option<u16> {
    match e {
        Expr::Field { base, offset } if *base == this && *offset > FAR => Some(*offset),
        _ => None,
    }
}

impl Stubs {
    /// Those that are worth their words, when these have counted the calls.
    pub fn counted(self) -> Stubs {
        Stubs {
            counted: Some(self.calls),
            ..Stubs::default()
        }
    }

    /// The stub for a call, if there is to be one.
    pub fn of(
        &mut self,
        function: usize,
        this: u16,
        cells: Vec<u16>,
        code: &mut Code,
    ) -> Option<Label> {
        if cells.is_empty() {
            return None;
        }
        let saved = 3 * cells.len();
        let own = 4 + 7 * cells.len();
        let key = (function, this, cells);
        let Some(counted) = &self.counted else {
            *self.calls.entry(key).or_default() += 1;
            return None;
        };
        let calls = counted.get(&key).copied().unwrap_or(0);
        if calls * saved <= own {
            return None;
        }
        Some(*self.known.entry(key).or_insert_with(|| code.label()))
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
