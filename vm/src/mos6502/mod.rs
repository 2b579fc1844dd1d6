//! The 6502: a processor, an assembler, and machines around them.

pub mod asm;
pub mod cpu;
pub mod plain;

pub use asm::{Assembly, Dialect, LineSpan, assemble, assemble_as, extent};
pub use plain::{Plain, Run};
