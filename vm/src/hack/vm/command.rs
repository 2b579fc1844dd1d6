//! Decoded commands and the machine's memory map.
//!
//! The memory is 65,536 words. The lower 32,768 are the RAM of the machine;
//! the upper half holds, at `CONSTANTS + c`, the constant `c`. So every
//! operand of every command, constants included, is *the word at the sum of
//! a base cell and an offset*, and an index of 16 bits never needs a check.
//! No store ever reaches the upper half: where a program's own address is
//! above the keyboard's, the run ends in a fault.

/// All the words that commands can name.
pub(in crate::hack) type Memory = [u16; 0x10000];

/// Addresses of the RAM, as the Hack platform lays it out
/// (*The Elements of Computing Systems*, chapters 7 and 8).
pub(in crate::hack) const SP: u16 = 0;
pub(in crate::hack) const LCL: u16 = 1;
pub(in crate::hack) const ARG: u16 = 2;
pub(in crate::hack) const THIS: u16 = 3;
pub(in crate::hack) const THAT: u16 = 4;
pub(in crate::hack) const TEMP: u16 = 5;
pub(in crate::hack) const STATIC: u16 = 16;
pub(in crate::hack) const STACK: u16 = 256;
pub(in crate::hack) const HEAP: u16 = 2048;
pub(in crate::hack) const SCREEN: u16 = 16384;
pub(in crate::hack) const KEYBOARD: u16 = 24576;

/// How many statics there is room for, over all files.
pub(in crate::hack) const STATICS: u16 = STACK - STATIC;

/// Where the constants lie. The word there, constant 0, is also the base of
/// everything that has a fixed address.
pub(in crate::hack) const CONSTANTS: u16 = 0x8000;

/// Keeps an address that a program computed inside the RAM.
pub(in crate::hack) const RAM_MASK: u16 = 0x7fff;

/// The words that a call saves: the return site, LCL, ARG, THIS and THAT.
pub(in crate::hack) const FRAME: u16 = 5;

/// An operand: the word at `memory[base] + offset`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::hack) struct Place {
    /// The cell that holds the base: LCL, ARG, THIS, THAT, or CONSTANTS for
    /// a fixed address.
    pub base: u16,
    /// Added to the base; the address itself where that is fixed.
    pub offset: u16,
}

impl Place {
    /// The word at a fixed address.
    pub const fn fixed(address: u16) -> Self {
        Place {
            base: CONSTANTS,
            offset: address,
        }
    }

    /// Whether this is reached through THIS or THAT, which a program sets as it likes.
    pub const fn is_field(self) -> bool {
        self.base == THIS || self.base == THAT
    }

    /// The constant, if this is one.
    pub const fn as_constant(self) -> Option<u16> {
        if self.base == CONSTANTS && self.offset >= CONSTANTS {
            Some(self.offset & RAM_MASK)
        } else {
            None
        }
    }
}

/// Commands that take two words and leave one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::hack) enum Binary {
    Add,
    Sub,
    And,
    Or,
    Eq,
    Gt,
    Lt,
}

impl Binary {
    /// The one definition of what each does: 16-bit wraparound, signed
    /// comparison of the whole words, true = -1.
    #[inline(always)]
    pub fn apply(self, x: u16, y: u16) -> u16 {
        match self {
            Binary::Add => x.wrapping_add(y),
            Binary::Sub => x.wrapping_sub(y),
            Binary::And => x & y,
            Binary::Or => x | y,
            Binary::Eq => u16::from(x == y).wrapping_neg(),
            Binary::Gt => u16::from(x.cast_signed() > y.cast_signed()).wrapping_neg(),
            Binary::Lt => u16::from(x.cast_signed() < y.cast_signed()).wrapping_neg(),
        }
    }
}

/// A linked command. Labels are gone: jumps and calls hold indices of commands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::hack) enum Command {
    Push(Place),
    Pop(Place),
    Binary(Binary),
    Neg,
    Not,
    Goto(u32),
    IfGoto(u32),
    /// A call of a function of the program; `site` is its entry in the return sites.
    Call {
        function: u32,
        arguments: u16,
        site: u16,
    },
    /// A call of a function of the machine's own operating system.
    Native(super::os::Native),
    Function {
        locals: u16,
    },
    Return,
    /// Stands after the last command of a function; counts as none.
    FunctionEnd,
}
