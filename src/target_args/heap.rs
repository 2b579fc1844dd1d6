//! Reads `--heap`: whose heap the Hack VM's native operating system has.

use super::Os;
use crate::failure::{Failure, Outcome};
use crate::machine::Machine;
use clap::ValueEnum;
use slowlight_vm::hack::vm::Heap;

/// Whose heap the Hack VM's native operating system has.
#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeapOf {
    /// Of the systems that are built into VM emulators: 14,334 words
    BuiltIn,
    /// What the official system's `.vm` files leave of it, run beside the program: 11,511 words
    Official,
}

impl HeapOf {
    /// The machine with that heap.
    ///
    /// # Errors
    /// Where there is no native system that could have it.
    pub fn of(given: Option<HeapOf>, os: Option<Os>, machine: Machine) -> Outcome<Machine> {
        let heap = match given {
            None => return Ok(machine),
            Some(HeapOf::BuiltIn) => Heap::BuiltIn,
            Some(HeapOf::Official) => Heap::Official,
        };
        match machine {
            Machine::Hack(config) if !config.cpu && os != Some(Os::Jack) => {
                Ok(machine.with_heap(heap))
            }
            Machine::Hack(_) => Err(Failure::Usage(
                "--heap is the native operating system's; ours in Jack has its own".to_owned(),
            )),
            _ => Err(Failure::Usage(
                "--heap is the Hack VM's: jack, with its native operating system".to_owned(),
            )),
        }
    }
}
