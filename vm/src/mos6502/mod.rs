//! The 6502: a processor, an assembler, and machines around them.

pub mod cpu;
