//! The 256 opcodes of the NMOS 6502 as data: what each does, how it finds its
//! operand, how far it can be trusted, and how long it takes.
//!
//! The assembler looks an opcode up by mnemonic and mode; the processor's
//! tests and the cost tables look one up by its byte. Cycle counts are those
//! of the MOS data sheet; what they leave to the moment is told apart by
//! [`Opcode::page_cycle`] (one cycle more where an index crosses a page) and by
//! the mode [`Mode::Relative`] (one more when taken, two into another page).
//!
//! Names of the undocumented opcodes are those of "NMOS 6510 Unintended
//! Opcodes: no more secrets" (groepaz), which most assemblers follow.

use std::collections::{HashMap, HashSet};
use std::sync::LazyLock;

/// How an instruction finds its operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Mode {
    /// `rts`
    Implied,
    /// `asl`, on the accumulator
    Accumulator,
    /// `lda #1`
    Immediate,
    /// `lda $12`
    ZeroPage,
    /// `lda $12,x`, wrapping within the zero page
    ZeroPageX,
    /// `ldx $12,y`, wrapping within the zero page
    ZeroPageY,
    /// `lda $1234`
    Absolute,
    /// `lda $1234,x`
    AbsoluteX,
    /// `lda $1234,y`
    AbsoluteY,
    /// `jmp ($1234)`; the pointer's high byte is read within the same page
    Indirect,
    /// `lda ($12,x)`
    IndirectX,
    /// `lda ($12),y`
    IndirectY,
    /// a branch: one signed byte from the next instruction
    Relative,
}

impl Mode {
    /// Bytes of an instruction in this mode, the opcode included.
    pub const fn bytes(self) -> u16 {
        match self {
            Mode::Implied | Mode::Accumulator => 1,
            Mode::Absolute | Mode::AbsoluteX | Mode::AbsoluteY | Mode::Indirect => 3,
            _ => 2,
        }
    }
}

/// How far an opcode can be trusted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trust {
    /// In the data sheet.
    Documented,
    /// Not in it, but alike on every NMOS 6502.
    Stable,
    /// Not in it, and varies with the chip, its temperature or what else is on the bus.
    Unstable,
    /// Stops the processor until reset.
    Jam,
}

/// One opcode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Opcode {
    /// Three lower-case letters.
    pub mnemonic: &'static str,
    /// Where the operand is.
    pub mode: Mode,
    /// Documented or not.
    pub trust: Trust,
    /// Cycles where no page is crossed and no branch is taken; 0 for a jam.
    pub cycles: u8,
}

impl Opcode {
    /// Whether crossing a page by the index costs a cycle: it does where the
    /// operand is only read. Stores and read-modify-writes always pay.
    pub fn page_cycle(&self) -> bool {
        matches!(
            (self.mode, self.cycles),
            (Mode::AbsoluteX | Mode::AbsoluteY, 4) | (Mode::IndirectY, 5)
        )
    }
}

/// The documented opcode for a mnemonic and mode, else a stable one, else an
/// unstable one; where several are alike, the lowest. The mnemonic is in lower case.
pub fn find(mnemonic: &str, mode: Mode) -> Option<u8> {
    let letters: [u8; 3] = mnemonic.as_bytes().try_into().ok()?;
    BY_NAME.get(&(letters, mode)).copied()
}

/// What [`find`] finds, by a mnemonic's letters and the mode: programs are assembled by the
/// dozen to find out which of them fits.
static BY_NAME: LazyLock<HashMap<([u8; 3], Mode), u8>> = LazyLock::new(|| {
    let rank = |o: &Opcode| match o.trust {
        Trust::Documented => 0,
        Trust::Stable => 1,
        Trust::Unstable => 2,
        Trust::Jam => 3,
    };
    let mut all: Vec<(u8, &Opcode)> = (0..=255).zip(OPCODES.iter()).collect();
    all.retain(|(_, o)| o.trust != Trust::Jam);
    // What is put last stays.
    all.sort_by_key(|(byte, o)| std::cmp::Reverse((rank(o), *byte)));
    let named = |(byte, o): (u8, &Opcode)| {
        let letters = o.mnemonic.as_bytes().try_into().ok()?;
        Some(((letters, o.mode), byte))
    };
    all.into_iter().filter_map(named).collect()
});

/// Names that some assemblers have for undocumented opcodes, and the ones here.
const OTHER_NAMES: [(&str, &str); 8] = [
    ("axs", "sbx"),
    ("aax", "sax"),
    ("dcm", "dcp"),
    ("isb", "isc"),
    ("ins", "isc"),
    ("aso", "slo"),
    ("lse", "sre"),
    ("asr", "alr"),
];

/// The name here of an opcode that an assembler may call otherwise (lower case).
pub fn usual_name(name: &str) -> &str {
    let other = OTHER_NAMES.iter().find(|(other, _)| *other == name);
    other.map_or(name, |(_, usual)| usual)
}

/// Whether some opcode has this mnemonic (lower case). A jam has none that can be written.
pub fn is_mnemonic(name: &str) -> bool {
    let letters: Result<[u8; 3], _> = name.as_bytes().try_into();
    letters.is_ok_and(|letters| MNEMONICS.contains(&letters))
}

/// All that are [mnemonics](is_mnemonic): every word of a program that is assembled is looked up.
static MNEMONICS: LazyLock<HashSet<[u8; 3]>> =
    LazyLock::new(|| BY_NAME.keys().map(|(letters, _)| *letters).collect());

use Mode::*;

const fn doc(mnemonic: &'static str, mode: Mode, cycles: u8) -> Opcode {
    Opcode {
        mnemonic,
        mode,
        trust: Trust::Documented,
        cycles,
    }
}

const fn und(mnemonic: &'static str, mode: Mode, cycles: u8) -> Opcode {
    Opcode {
        mnemonic,
        mode,
        trust: Trust::Stable,
        cycles,
    }
}

const fn uns(mnemonic: &'static str, mode: Mode, cycles: u8) -> Opcode {
    Opcode {
        mnemonic,
        mode,
        trust: Trust::Unstable,
        cycles,
    }
}

const JAM: Opcode = Opcode {
    mnemonic: "jam",
    mode: Implied,
    trust: Trust::Jam,
    cycles: 0,
};

/// All opcodes, by their byte.
#[rustfmt::skip]
pub static OPCODES: [Opcode; 256] = [
    // $00
    doc("brk", Implied, 7), doc("ora", IndirectX, 6), JAM, und("slo", IndirectX, 8),
    und("nop", ZeroPage, 3), doc("ora", ZeroPage, 3), doc("asl", ZeroPage, 5), und("slo", ZeroPage, 5),
    doc("php", Implied, 3), doc("ora", Immediate, 2), doc("asl", Accumulator, 2), und("anc", Immediate, 2),
    und("nop", Absolute, 4), doc("ora", Absolute, 4), doc("asl", Absolute, 6), und("slo", Absolute, 6),
    // $10
    doc("bpl", Relative, 2), doc("ora", IndirectY, 5), JAM, und("slo", IndirectY, 8),
    und("nop", ZeroPageX, 4), doc("ora", ZeroPageX, 4), doc("asl", ZeroPageX, 6), und("slo", ZeroPageX, 6),
    doc("clc", Implied, 2), doc("ora", AbsoluteY, 4), und("nop", Implied, 2), und("slo", AbsoluteY, 7),
    und("nop", AbsoluteX, 4), doc("ora", AbsoluteX, 4), doc("asl", AbsoluteX, 7), und("slo", AbsoluteX, 7),
    // $20
    doc("jsr", Absolute, 6), doc("and", IndirectX, 6), JAM, und("rla", IndirectX, 8),
    doc("bit", ZeroPage, 3), doc("and", ZeroPage, 3), doc("rol", ZeroPage, 5), und("rla", ZeroPage, 5),
    doc("plp", Implied, 4), doc("and", Immediate, 2), doc("rol", Accumulator, 2), und("anc", Immediate, 2),
    doc("bit", Absolute, 4), doc("and", Absolute, 4), doc("rol", Absolute, 6), und("rla", Absolute, 6),
    // $30
    doc("bmi", Relative, 2), doc("and", IndirectY, 5), JAM, und("rla", IndirectY, 8),
    und("nop", ZeroPageX, 4), doc("and", ZeroPageX, 4), doc("rol", ZeroPageX, 6), und("rla", ZeroPageX, 6),
    doc("sec", Implied, 2), doc("and", AbsoluteY, 4), und("nop", Implied, 2), und("rla", AbsoluteY, 7),
    und("nop", AbsoluteX, 4), doc("and", AbsoluteX, 4), doc("rol", AbsoluteX, 7), und("rla", AbsoluteX, 7),
    // $40
    doc("rti", Implied, 6), doc("eor", IndirectX, 6), JAM, und("sre", IndirectX, 8),
    und("nop", ZeroPage, 3), doc("eor", ZeroPage, 3), doc("lsr", ZeroPage, 5), und("sre", ZeroPage, 5),
    doc("pha", Implied, 3), doc("eor", Immediate, 2), doc("lsr", Accumulator, 2), und("alr", Immediate, 2),
    doc("jmp", Absolute, 3), doc("eor", Absolute, 4), doc("lsr", Absolute, 6), und("sre", Absolute, 6),
    // $50
    doc("bvc", Relative, 2), doc("eor", IndirectY, 5), JAM, und("sre", IndirectY, 8),
    und("nop", ZeroPageX, 4), doc("eor", ZeroPageX, 4), doc("lsr", ZeroPageX, 6), und("sre", ZeroPageX, 6),
    doc("cli", Implied, 2), doc("eor", AbsoluteY, 4), und("nop", Implied, 2), und("sre", AbsoluteY, 7),
    und("nop", AbsoluteX, 4), doc("eor", AbsoluteX, 4), doc("lsr", AbsoluteX, 7), und("sre", AbsoluteX, 7),
    // $60
    doc("rts", Implied, 6), doc("adc", IndirectX, 6), JAM, und("rra", IndirectX, 8),
    und("nop", ZeroPage, 3), doc("adc", ZeroPage, 3), doc("ror", ZeroPage, 5), und("rra", ZeroPage, 5),
    doc("pla", Implied, 4), doc("adc", Immediate, 2), doc("ror", Accumulator, 2), uns("arr", Immediate, 2),
    doc("jmp", Indirect, 5), doc("adc", Absolute, 4), doc("ror", Absolute, 6), und("rra", Absolute, 6),
    // $70
    doc("bvs", Relative, 2), doc("adc", IndirectY, 5), JAM, und("rra", IndirectY, 8),
    und("nop", ZeroPageX, 4), doc("adc", ZeroPageX, 4), doc("ror", ZeroPageX, 6), und("rra", ZeroPageX, 6),
    doc("sei", Implied, 2), doc("adc", AbsoluteY, 4), und("nop", Implied, 2), und("rra", AbsoluteY, 7),
    und("nop", AbsoluteX, 4), doc("adc", AbsoluteX, 4), doc("ror", AbsoluteX, 7), und("rra", AbsoluteX, 7),
    // $80
    und("nop", Immediate, 2), doc("sta", IndirectX, 6), und("nop", Immediate, 2), und("sax", IndirectX, 6),
    doc("sty", ZeroPage, 3), doc("sta", ZeroPage, 3), doc("stx", ZeroPage, 3), und("sax", ZeroPage, 3),
    doc("dey", Implied, 2), und("nop", Immediate, 2), doc("txa", Implied, 2), uns("ane", Immediate, 2),
    doc("sty", Absolute, 4), doc("sta", Absolute, 4), doc("stx", Absolute, 4), und("sax", Absolute, 4),
    // $90
    doc("bcc", Relative, 2), doc("sta", IndirectY, 6), JAM, uns("sha", IndirectY, 6),
    doc("sty", ZeroPageX, 4), doc("sta", ZeroPageX, 4), doc("stx", ZeroPageY, 4), und("sax", ZeroPageY, 4),
    doc("tya", Implied, 2), doc("sta", AbsoluteY, 5), doc("txs", Implied, 2), uns("tas", AbsoluteY, 5),
    uns("shy", AbsoluteX, 5), doc("sta", AbsoluteX, 5), uns("shx", AbsoluteY, 5), uns("sha", AbsoluteY, 5),
    // $A0
    doc("ldy", Immediate, 2), doc("lda", IndirectX, 6), doc("ldx", Immediate, 2), und("lax", IndirectX, 6),
    doc("ldy", ZeroPage, 3), doc("lda", ZeroPage, 3), doc("ldx", ZeroPage, 3), und("lax", ZeroPage, 3),
    doc("tay", Implied, 2), doc("lda", Immediate, 2), doc("tax", Implied, 2), uns("lxa", Immediate, 2),
    doc("ldy", Absolute, 4), doc("lda", Absolute, 4), doc("ldx", Absolute, 4), und("lax", Absolute, 4),
    // $B0
    doc("bcs", Relative, 2), doc("lda", IndirectY, 5), JAM, und("lax", IndirectY, 5),
    doc("ldy", ZeroPageX, 4), doc("lda", ZeroPageX, 4), doc("ldx", ZeroPageY, 4), und("lax", ZeroPageY, 4),
    doc("clv", Implied, 2), doc("lda", AbsoluteY, 4), doc("tsx", Implied, 2), uns("las", AbsoluteY, 4),
    doc("ldy", AbsoluteX, 4), doc("lda", AbsoluteX, 4), doc("ldx", AbsoluteY, 4), und("lax", AbsoluteY, 4),
    // $C0
    doc("cpy", Immediate, 2), doc("cmp", IndirectX, 6), und("nop", Immediate, 2), und("dcp", IndirectX, 8),
    doc("cpy", ZeroPage, 3), doc("cmp", ZeroPage, 3), doc("dec", ZeroPage, 5), und("dcp", ZeroPage, 5),
    doc("iny", Implied, 2), doc("cmp", Immediate, 2), doc("dex", Implied, 2), und("sbx", Immediate, 2),
    doc("cpy", Absolute, 4), doc("cmp", Absolute, 4), doc("dec", Absolute, 6), und("dcp", Absolute, 6),
    // $D0
    doc("bne", Relative, 2), doc("cmp", IndirectY, 5), JAM, und("dcp", IndirectY, 8),
    und("nop", ZeroPageX, 4), doc("cmp", ZeroPageX, 4), doc("dec", ZeroPageX, 6), und("dcp", ZeroPageX, 6),
    doc("cld", Implied, 2), doc("cmp", AbsoluteY, 4), und("nop", Implied, 2), und("dcp", AbsoluteY, 7),
    und("nop", AbsoluteX, 4), doc("cmp", AbsoluteX, 4), doc("dec", AbsoluteX, 7), und("dcp", AbsoluteX, 7),
    // $E0
    doc("cpx", Immediate, 2), doc("sbc", IndirectX, 6), und("nop", Immediate, 2), und("isc", IndirectX, 8),
    doc("cpx", ZeroPage, 3), doc("sbc", ZeroPage, 3), doc("inc", ZeroPage, 5), und("isc", ZeroPage, 5),
    doc("inx", Implied, 2), doc("sbc", Immediate, 2), doc("nop", Implied, 2), und("sbc", Immediate, 2),
    doc("cpx", Absolute, 4), doc("sbc", Absolute, 4), doc("inc", Absolute, 6), und("isc", Absolute, 6),
    // $F0
    doc("beq", Relative, 2), doc("sbc", IndirectY, 5), JAM, und("isc", IndirectY, 8),
    und("nop", ZeroPageX, 4), doc("sbc", ZeroPageX, 4), doc("inc", ZeroPageX, 6), und("isc", ZeroPageX, 6),
    doc("sed", Implied, 2), doc("sbc", AbsoluteY, 4), und("nop", Implied, 2), und("isc", AbsoluteY, 7),
    und("nop", AbsoluteX, 4), doc("sbc", AbsoluteX, 4), doc("inc", AbsoluteX, 7), und("isc", AbsoluteX, 7),
];

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn counts_are_those_of_the_data_sheet() {
        let count = |t| OPCODES.iter().filter(|o| o.trust == t).count();
        assert_eq!(count(Trust::Documented), 151);
        assert_eq!(count(Trust::Stable), 84);
        assert_eq!(count(Trust::Unstable), 9);
        assert_eq!(count(Trust::Jam), 12);
    }

    #[test]
    fn every_documented_opcode_is_found_by_its_name_and_mode() {
        for (byte, o) in (0..=255u8).zip(OPCODES.iter()) {
            if o.trust == Trust::Documented {
                assert_eq!(find(o.mnemonic, o.mode), Some(byte), "{o:?}");
            }
        }
        assert_eq!(find("lax", Mode::ZeroPage), Some(0xA7));
        assert_eq!(find("anc", Mode::Immediate), Some(0x0B));
        assert_eq!(find("nop", Mode::Absolute), Some(0x0C));
        assert_eq!(find("jam", Mode::Implied), None);
        assert_eq!(find("sta", Mode::Immediate), None);
        for (other, usual) in OTHER_NAMES {
            assert!(is_mnemonic(usual) && !is_mnemonic(other) && usual_name(other) == usual);
        }
        assert!(is_mnemonic("lda") && !is_mnemonic("jam") && !is_mnemonic("LDA"));
    }
}
