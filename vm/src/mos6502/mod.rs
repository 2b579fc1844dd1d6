//! The 6502: a processor, an assembler, and machines around them.
//!
//! `plain` has ports that draw; `bbc` and `c64` are as much of a BBC Micro and of a
//! Commodore 64 as a program needs that draws into the screen's memory. Their own
//! programs, the operating systems and BASIC, are not bundled: what they would do for
//! such a program is done here, and what else is called or read ends the run with a
//! fault that says so. `vcs` is an Atari VCS, which has no program of its own.

pub mod asm;
pub mod bbc;
pub mod c64;
mod computer;
pub mod cpu;
pub mod plain;
pub mod vcs;
pub mod worst;

pub use asm::{Assembly, Dialect, LineSpan, Parsed, Taken, assemble, assemble_as, extent};
pub use bbc::Bbc;
pub use c64::C64;
pub use computer::{Board, Computer, Machine, Run};
pub use plain::Plain;
pub use vcs::Vcs;
