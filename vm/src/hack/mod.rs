//! The Hack computer of *The Elements of Computing Systems* (nand2tetris):
//! Jack, its language, compiled class by class to VM code, and the stack
//! machine that runs it.

pub mod jack;
pub mod vm;
