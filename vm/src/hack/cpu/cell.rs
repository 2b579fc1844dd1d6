//! Instructions decoded in advance.

use super::plain::halts;
use super::{Cells, RAM_WORDS};
use crate::hack::asm::ROM_WORDS;
use crate::hack::asm::instruction::{DEST_A, DEST_D, DEST_M, JMP, LARGEST};

/// Bits of [`Cell::jump`] beside those of the condition.
pub(super) const ENDS: u8 = 8;
pub(super) const AWAY: u8 = 16;

/// `@value`, or a computation, or both one after the other. Masks are 0 or -1.
#[derive(Clone, Copy, Debug)]
#[repr(align(16))]
pub(super) struct Cell {
    /// What A is set to first, where `loads`.
    pub value: u16,
    /// The ALU's controls: `x` kept, `x` inverted, the same for `y`, result inverted.
    pub keep_x: u16,
    pub flip_x: u16,
    pub keep_y: u16,
    pub flip_y: u16,
    pub flip_out: u16,
    /// Whether the ALU adds.
    pub adds: bool,
    /// Whether A is set to `value` first.
    pub loads: bool,
    /// [`FROM_MEMORY`], [`TO_A`], [`TO_D`] and [`TO_NOWHERE`].
    pub route: u8,
    /// The condition of the jump, or why there is nothing to execute.
    pub jump: u8,
}

impl Cell {
    /// Instructions in it, which is also its cycles; 1 or 2.
    #[inline(always)]
    pub fn size(&self) -> u16 {
        u16::from(self.route & PAIR != 0) + 1
    }
}

/// `y` is the word at address A.
pub(super) const FROM_MEMORY: u8 = 1;
/// The result goes to A.
pub(super) const TO_A: u8 = 2;
/// The result goes to D.
pub(super) const TO_D: u8 = 4;
/// The result does not go to the memory.
pub(super) const TO_NOWHERE: u8 = 8;
/// There are two instructions in the cell.
pub(super) const PAIR: u8 = 16;

/// Only sets A.
const LOAD: Cell = Cell {
    value: 0,
    keep_x: 0,
    flip_x: 0,
    keep_y: 0,
    flip_y: 0,
    flip_out: 0,
    adds: false,
    loads: true,
    route: TO_NOWHERE,
    jump: 0,
};

/// A cell for each address.
pub(super) fn decode(rom: &[u16]) -> Box<Cells> {
    let away = Cell { jump: AWAY, ..LOAD };
    let mut cells: Box<Cells> = Box::new([away; ROM_WORDS]);
    for ((at, cell), word) in (0..).zip(cells.iter_mut()).zip(rom) {
        let next = rom.get(usize::from(at) + 1).filter(|next| **next > LARGEST);
        *cell = match (word, next) {
            _ if halts(rom, at) => Cell { jump: ENDS, ..LOAD },
            (value, None) if *value <= LARGEST => Cell {
                value: *value,
                ..LOAD
            },
            (value, Some(next)) if *value <= LARGEST => {
                let computation = computation(*next);
                Cell {
                    value: *value,
                    loads: true,
                    route: computation.route | PAIR,
                    ..computation
                }
            }
            (word, _) => computation(*word),
        };
    }
    cells
}

fn computation(word: u16) -> Cell {
    let bit = |k: u16| word >> (6 + k) & 1 != 0;
    let mask = |on: bool| u16::from(on).wrapping_neg();
    let mut route = 0;
    for (set, flag) in [
        (bit(6), FROM_MEMORY),
        (word & DEST_A != 0, TO_A),
        (word & DEST_D != 0, TO_D),
        (word & DEST_M == 0, TO_NOWHERE),
    ] {
        if set {
            route |= flag;
        }
    }
    Cell {
        value: 0,
        keep_x: mask(!bit(5)),
        flip_x: mask(bit(4)),
        keep_y: mask(!bit(3)),
        flip_y: mask(bit(2)),
        flip_out: mask(bit(0)),
        adds: bit(1),
        loads: false,
        route,
        jump: (word & JMP) as u8,
    }
}

/// Where a result goes that is not stored: the half of the memory that nobody reads.
pub(super) const NOWHERE: usize = RAM_WORDS;
