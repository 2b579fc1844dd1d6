//! The Hack virtual machine: runs the VM language of *The Elements of
//! Computing Systems* (chapters 7 and 8), with a native operating system.
//!
//! [`Program::link`] reads `.vm` texts, [`Machine::run`] runs the result:
//!
//! ```
//! use slowlight_vm::hack::vm::{Machine, Program};
//! let main = "function Main.main 0
//!             push constant 6
//!             push constant 7
//!             call Math.multiply 2
//!             call Output.printInt 1
//!             return";
//! let program = Program::link(&[("Main.vm".to_owned(), main.to_owned())])?;
//! let run = Machine::new(&program).run(1_000, &mut |_| true);
//! assert_eq!(run.text, "42");
//! assert_eq!(run.instructions, 6);
//! # Ok::<(), Vec<slowlight_vm::Fault>>(())
//! ```
//!
//! # What is exact
//!
//! The RAM is the real machine's: pointers in 0 to 4, temp in 5 to 12, statics
//! from 16, call frames on the stack from 256, heap from 2048, screen from
//! 16384. A program may read and write all of it through THIS, THAT and
//! `Memory`. Commands are counted as the official emulator steps them: every
//! command but labels counts one, `function` included; a call of a native
//! function is one command in all.
//!
//! Two things are this machine's own, as on every implementation: what the
//! words above the stack pointer hold, and the return addresses in frames
//! (here, numbers of call sites).
//!
//! # How it is fast
//!
//! There are two engines over one state. The plain one steps command by
//! command, checks everything, and defines what each command does. The fused
//! engine runs commands joined several at a time, on programs whose stack
//! heights the linker could prove; it checks the limit only at jumps, calls
//! and returns, and hands over to the plain one wherever its assumptions end:
//! near the limit, near the end of the stack, at stores to the pointers or
//! the stack itself, at every fault. So only the plain engine ever faults or
//! meets the limit, and it does so at the exact command.

mod access;
pub(in crate::hack) mod command;
mod fast;
mod fuse;
mod glue;
pub(in crate::hack) mod heights;
mod join;
pub(in crate::hack) mod link;
mod machine;
mod missing;
mod names;
pub(in crate::hack) mod os;
mod parse;
mod plain;
#[cfg(test)]
pub(in crate::hack) mod tests;

pub use link::Program;
pub use machine::{Machine, Run};
pub use missing::{ERROR as MISSING, Missing};
pub use names::Names;
pub use os::Heap;
