//! The NMOS 6502, with every access to the bus visible.
//!
//! The processor uses the bus in every cycle: where it has nothing to read or
//! write it reads something all the same. Those dummy accesses are real on the
//! pins, and hardware reacts to them, so they are made here too: **one call of
//! [`Bus::read`] or [`Bus::write`] is one cycle**, and the bus may count time by
//! counting calls. The processor itself counts nothing.
//!
//! - `address` finds operands, dummy reads included;
//! - `operate` computes: arithmetic, decimal mode, shifts, the undocumented mixtures;
//! - `decode` joins the two, one line an opcode.
//!
//! Interrupts are taken between instructions by [`Cpu::interrupt`]; the
//! half-instruction delays of the real lines (`cli` and taken branches) are not modelled.
//!
//! Sources: the MOS 6500 data sheet; "64doc" (John West, Marko Mäkelä) for the
//! accesses cycle by cycle; Bruce Clark, "Decimal Mode" (6502.org) for decimal
//! arithmetic with invalid digits; "NMOS 6510 Unintended Opcodes" (groepaz).

mod address;
mod decode;
mod operate;

#[cfg(test)]
mod oracle;
#[cfg(test)]
mod tests;

/// What the processor is connected to. Each call is one cycle.
pub trait Bus {
    /// The byte at an address; may have side effects, as on the machine.
    fn read(&mut self, address: u16) -> u8;
    /// Stores a byte.
    fn write(&mut self, address: u16, value: u8);
}

/// The processor's registers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cpu {
    /// Accumulator.
    pub a: u8,
    /// Index register X.
    pub x: u8,
    /// Index register Y.
    pub y: u8,
    /// Stack pointer, into page 1.
    pub sp: u8,
    /// Address of the next instruction.
    pub pc: u16,
    /// A byte whose bit 7 is the N flag.
    n: u8,
    /// A byte that is 0 where the Z flag is set.
    z: u8,
    c: bool,
    v: bool,
    d: bool,
    i: bool,
}

/// What an instruction was, for the loop around the processor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// An instruction like any other.
    Ran,
    /// `brk`: the processor has gone on through the vector at $FFFE.
    Brk,
    /// An opcode that stops the processor; the program counter stands behind it.
    Jammed,
}

/// The two vectors that an interrupt can take besides reset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interrupt {
    /// Not maskable, through $FFFA.
    Nmi,
    /// Maskable, through $FFFE; ignored while the I flag is set.
    Irq,
}

/// Bits of the status register as `php` pushes it.
pub mod flag {
    /// Carry.
    pub const C: u8 = 0x01;
    /// Zero.
    pub const Z: u8 = 0x02;
    /// Interrupts masked.
    pub const I: u8 = 0x04;
    /// Decimal mode.
    pub const D: u8 = 0x08;
    /// Set where `php` or `brk` pushed, clear where an interrupt did.
    pub const B: u8 = 0x10;
    /// Always set.
    pub const UNUSED: u8 = 0x20;
    /// Overflow.
    pub const V: u8 = 0x40;
    /// Negative.
    pub const N: u8 = 0x80;
}

impl Cpu {
    /// A processor about to run at `pc`, with registers 0, the stack empty,
    /// interrupts masked and decimal mode off.
    pub fn new(pc: u16) -> Self {
        Cpu {
            a: 0,
            x: 0,
            y: 0,
            sp: 0xFF,
            pc,
            n: 0,
            z: 1,
            c: false,
            v: false,
            d: false,
            i: true,
        }
    }

    /// The status register as `php` would push it (bits 4 and 5 set).
    #[inline(always)]
    pub fn status(&self) -> u8 {
        let bit = |set: bool, mask: u8| if set { mask } else { 0 };
        (self.n & flag::N)
            | bit(self.v, flag::V)
            | flag::UNUSED
            | flag::B
            | bit(self.d, flag::D)
            | bit(self.i, flag::I)
            | bit(self.z == 0, flag::Z)
            | bit(self.c, flag::C)
    }

    /// Sets the flags; bits 4 and 5 do not exist in the register and are ignored.
    #[inline(always)]
    pub fn set_status(&mut self, p: u8) {
        self.n = p;
        self.v = p & flag::V != 0;
        self.d = p & flag::D != 0;
        self.i = p & flag::I != 0;
        self.z = !p & flag::Z;
        self.c = p & flag::C != 0;
    }

    /// The seven cycles of an interrupt, where it is not masked; says whether it was taken.
    pub fn interrupt<B: Bus>(&mut self, bus: &mut B, which: Interrupt) -> bool {
        if which == Interrupt::Irq && self.i {
            return false;
        }
        bus.read(self.pc);
        bus.read(self.pc);
        let p = self.status() & !flag::B;
        let vector = if which == Interrupt::Nmi {
            0xFFFA
        } else {
            0xFFFE
        };
        self.enter(bus, p, vector);
        true
    }

    /// Pushes the program counter and `p`, masks interrupts and goes through a vector.
    #[inline(always)]
    fn enter<B: Bus>(&mut self, bus: &mut B, p: u8, vector: u16) {
        let [hi, lo] = self.pc.to_be_bytes();
        self.push(bus, hi);
        self.push(bus, lo);
        self.push(bus, p);
        self.i = true;
        let lo = bus.read(vector);
        let hi = bus.read(vector + 1);
        self.pc = u16::from_le_bytes([lo, hi]);
    }

    /// Reads the byte at the program counter and moves on.
    #[inline(always)]
    fn fetch<B: Bus>(&mut self, bus: &mut B) -> u8 {
        let byte = bus.read(self.pc);
        self.pc = self.pc.wrapping_add(1);
        byte
    }

    #[inline(always)]
    fn push<B: Bus>(&mut self, bus: &mut B, value: u8) {
        bus.write(0x0100 | u16::from(self.sp), value);
        self.sp = self.sp.wrapping_sub(1);
    }

    #[inline(always)]
    fn pull<B: Bus>(&mut self, bus: &mut B) -> u8 {
        self.sp = self.sp.wrapping_add(1);
        bus.read(0x0100 | u16::from(self.sp))
    }

    /// The stack is read once before it is pulled from, while the pointer moves.
    #[inline(always)]
    fn peek_stack<B: Bus>(&mut self, bus: &mut B) {
        bus.read(0x0100 | u16::from(self.sp));
    }
}
