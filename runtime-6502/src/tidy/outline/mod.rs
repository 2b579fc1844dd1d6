//! A machine outliner (procedural abstraction): sequences of instructions that a program has
//! several times become subroutines.
//!
//! After Fraser, Myers and Wendt, "Analyzing and compressing assembly code" (1984), as LLVM's
//! MachineOutliner does it: repeats are neighbours in the sorted suffixes of the program; the
//! one that saves most bytes is taken first. Each call takes twelve cycles, so no more is taken
//! than what a program is too large by.
//!
//! A branch is compared by how many instructions it goes over: what stands behind a label is
//! alike whatever that is called. What goes elsewhere than within its sequence or to its end is
//! in none, nor is what uses the stack.

mod calls;
mod repeats;

use super::code::Names;
use calls::replace;
pub use calls::{CALLED, WITHIN};
use repeats::Program;
use std::ops::Range;

/// What subroutines have alike is looked for again, so often.
const ROUNDS: usize = 4;

/// Makes a program so many bytes shorter, or as much shorter as can be. `symbols` are the lines
/// that name the bytes that it alone uses, `own` those that may change, behind which the
/// subroutines are put.
pub fn outline<T: Clone>(
    lines: &mut Vec<(String, T)>,
    symbols: &Range<usize>,
    own: &Range<usize>,
    excess: u32,
) {
    let (mut own, mut excess) = (own.clone(), i64::from(excess));
    let mut count = 0;
    for _ in 0..ROUNDS {
        if excess <= 0 {
            return;
        }
        let found = {
            let texts: Vec<&str> = lines.iter().map(|(text, _)| text.as_str()).collect();
            let names = Names::new(&texts, symbols.clone());
            Program::new(&texts, &names, &own).repeats(excess)
        };
        if found.is_empty() {
            return;
        }
        excess -= found.iter().map(|repeat| repeat.saved).sum::<i64>();
        let before = lines.len();
        replace(lines, &own, &found, &mut count);
        own.end = own.end + lines.len() - before;
    }
}

/// A sequence that is met several times.
struct Repeat {
    /// The lines of each.
    places: Vec<Range<usize>>,
    body: Vec<Step>,
    saved: i64,
}

/// An instruction of a sequence.
struct Step {
    line: usize,
    /// Before which of them a branch goes on, or behind the last.
    goes: Option<usize>,
}

#[cfg(test)]
mod tests;
