//! The plain engine: an instruction at a time, as the book draws the CPU. What
//! an instruction does is what it does here.

use super::fast::Exit;
use super::{ADDRESS, Cpu, KEYBOARD, Memory};
use crate::hack::asm::instruction::{COMPUTE, DEST_A, DEST_D, DEST_M, JEQ, JGT, JLT, JMP, LARGEST};

impl Cpu {
    /// Runs until `pause` cycles have passed in all.
    pub(super) fn go_plain(&mut self, pause: u64) -> Exit {
        while self.count < pause {
            if let Some(exit) = self.step() {
                return exit;
            }
        }
        Exit::Pause
    }

    /// Executes an instruction, unless the program ends here.
    fn step(&mut self) -> Option<Exit> {
        let Some(&word) = self.rom.get(usize::from(self.registers.at)) else {
            return Some(Exit::Away);
        };
        if halts(&self.rom, self.registers.at) {
            return Some(Exit::Ended);
        }
        self.count += 1;
        if word > LARGEST
            && word & READS != 0
            && usize::from(self.registers.a & ADDRESS) == KEYBOARD
            && let Some(exit) = self.look()
        {
            return Some(exit);
        }
        execute(word, &mut self.registers, &mut self.memory);
        None
    }
}

/// The bit of a computation that reads the word at address A.
const READS: u16 = 1 << 12;

/// What the CPU keeps by itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Registers {
    pub a: u16,
    pub d: u16,
    /// The address of the next instruction, of 15 bits.
    pub at: u16,
}

/// Executes a word.
pub(super) fn execute(word: u16, registers: &mut Registers, memory: &mut Memory) {
    let next = registers.at.wrapping_add(1) & ADDRESS;
    if word <= LARGEST {
        registers.a = word;
        registers.at = next;
        return;
    }
    let address = registers.a & ADDRESS;
    let y = if word & READS == 0 {
        registers.a
    } else {
        memory[usize::from(address)]
    };
    let out = alu(word >> 6, registers.d, y);
    registers.at = if jumps(word, out) { address } else { next };
    if word & DEST_M != 0 {
        memory[usize::from(address)] = out;
    }
    if word & DEST_D != 0 {
        registers.d = out;
    }
    if word & DEST_A != 0 {
        registers.a = out;
    }
}

/// The ALU: six control bits, the highest first for `x` zero, `x` inverted, the
/// same for `y`, sum instead of conjunction, result inverted.
fn alu(control: u16, x: u16, y: u16) -> u16 {
    let bit = |k: u16| control >> k & 1 != 0;
    let prepared = |word: u16, zero: bool, invert: bool| {
        let word = if zero { 0 } else { word };
        if invert { !word } else { word }
    };
    let x = prepared(x, bit(5), bit(4));
    let y = prepared(y, bit(3), bit(2));
    let out = if bit(1) { x.wrapping_add(y) } else { x & y };
    prepared(out, false, bit(0))
}

/// Whether a computation with this result jumps.
fn jumps(word: u16, out: u16) -> bool {
    let condition = match out.cast_signed() {
        ..0 => JLT,
        0 => JEQ,
        1.. => JGT,
    };
    word & condition != 0
}

/// Whether the two instructions at an address jump back to it for ever and do
/// nothing else: `(END) @END 0;JMP`.
pub(super) fn halts(rom: &[u16], at: u16) -> bool {
    let mut words = rom.iter().skip(usize::from(at));
    let (load, jump) = (words.next(), words.next());
    let stays = |word: &u16| {
        word & COMPUTE >= 1 << 15 && word & (DEST_A | DEST_D | DEST_M) == 0 && word & JMP == JMP
    };
    load == Some(&at) && jump.is_some_and(stays)
}
