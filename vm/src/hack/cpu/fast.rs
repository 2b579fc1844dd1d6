//! The fast engine: a cell at a time.

use super::cell::{AWAY, ENDS, FROM_MEMORY, NOWHERE, TO_A, TO_D, TO_NOWHERE};
use super::{ADDRESS, Cpu};
use crate::hack::asm::instruction::{JEQ, JGT, JLT};

/// Why an engine comes back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Exit {
    /// As many cycles as asked for have passed.
    Pause,
    /// The program has come to its end.
    Ended,
    /// There is no instruction.
    Away,
}

/// The most instructions of a cell.
const LONGEST: u64 = 2;

impl Cpu {
    /// Runs until `pause` cycles have passed in all.
    pub(super) fn go_fast(&mut self, pause: u64) -> Exit {
        let enough = pause.saturating_sub(LONGEST - 1);
        let Cpu { cells, memory, .. } = self;
        let (mut a, mut d, mut at) = (self.a, self.d, self.at);
        let mut count = self.count;
        let mut exit = Exit::Pause;
        while count < enough {
            let cell = &cells[usize::from(at & ADDRESS)];
            let size = cell.size();
            let address = if cell.loads { cell.value } else { a };
            let index = usize::from(address & ADDRESS);
            let word = memory[index];
            let y = if cell.route & FROM_MEMORY != 0 {
                word
            } else {
                address
            };
            let x = (d & cell.keep_x) ^ cell.flip_x;
            let y = (y & cell.keep_y) ^ cell.flip_y;
            let sum = x.wrapping_add(y);
            let out = if cell.adds { sum } else { x & y } ^ cell.flip_out;
            if cell.jump != 0 {
                if cell.jump & (ENDS | AWAY) != 0 {
                    exit = if cell.jump & ENDS != 0 {
                        Exit::Ended
                    } else {
                        Exit::Away
                    };
                    break;
                }
                let condition = match out.cast_signed() {
                    ..0 => JLT,
                    0 => JEQ,
                    1.. => JGT,
                };
                at = if u16::from(cell.jump) & condition != 0 {
                    address
                } else {
                    at.wrapping_add(size)
                };
            } else {
                at = at.wrapping_add(size);
            }
            count += u64::from(size);
            let kept = usize::from(cell.route & TO_NOWHERE != 0) * NOWHERE;
            memory[index | kept] = out;
            d = if cell.route & TO_D != 0 { out } else { d };
            a = if cell.route & TO_A != 0 { out } else { address };
        }
        (self.a, self.d, self.at) = (a, d, at & ADDRESS);
        self.count = count;
        match exit {
            Exit::Pause => self.go_plain(pause),
            exit => exit,
        }
    }
}
