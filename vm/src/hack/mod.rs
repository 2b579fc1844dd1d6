//! The Hack computer of *The Elements of Computing Systems* (nand2tetris):
//! Jack, its language, compiled class by class to VM code; the stack machine
//! that runs it; and the machine below: VM code translated to instructions,
//! the assembler, and the CPU.

pub mod asm;
pub mod cpu;
pub mod jack;
mod keyboard;
mod screen;
pub mod translate;
pub mod vm;
