//! Worst-case execution time: how many cycles a program takes at most, whatever it is given.
//!
//! The program is interpreted with bytes that are known or not (constant propagation over
//! registers, flags and memory), along all ways that it may go, and where ways meet the longer
//! one counts:
//!
//! - **straight code** is added up; an index that may cross a page counts as crossing it, and a
//!   branch into another page as what it costs;
//! - **a loop whose counter is known** is run turn by turn, until no way leads back;
//! - **any other loop** takes as many turns as it is said to take at most ([`Question::turns`]),
//!   each as long as its longest; where nothing is said there is no answer;
//! - **a call** is what it calls, with what is known where it is called.
//!
//! What has no answer is told with its place: a loop without a bound, one that is entered in
//! its middle and has no block that is said to be come to so often at most, jumps through a
//! pointer, stores that may be into the program itself or the stack, flags that are pulled and
//! were not pushed as such, a stack that is not left as it was found. Interrupts are not
//! counted, nor is what a board makes the processor wait. Believed without proof: what is said
//! of turns, that stores through pointers hit neither the stack nor the program, and, where the
//! stack is in the zero page, that it is empty at $FF where the program or a slice begins.
//!
//! `flow` reads the program's blocks and loops, `state` is what is known, `step` what an
//! instruction makes of it, `walk` follows the ways.

mod flow;
mod state;
mod step;
#[cfg(test)]
mod tests;
mod walk;

use super::Assembly;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::ops::RangeInclusive;

/// Instructions that are interpreted before there is no answer.
const FUEL: u64 = 20_000_000;

/// A program, and what is known of it.
#[derive(Clone, Debug)]
pub struct Question<'a> {
    /// The program.
    pub assembly: &'a Assembly,
    /// Addresses that keep what is stored to them.
    pub ram: RangeInclusive<u16>,
    /// Whether the stack's page is the zero page once more, as on machines with little memory.
    /// Stores to yet other mirrors of it are not looked for.
    pub mirrored: bool,
    /// How many turns loops take at most each time that they are entered, by the addresses at
    /// which their turns begin.
    pub turns: BTreeMap<u16, u32>,
    /// Where a way ends, before what is there is run.
    pub ends: BTreeSet<u16>,
    /// A store to which ends the program.
    pub exit: Option<u16>,
}

/// Why there is no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// A loop of which nobody knows how many turns it takes.
    Loop,
    /// A loop that is entered at more than one place.
    Irregular,
    /// Where it goes on is not known: a jump through a pointer, `brk`, `rti`.
    Jump,
    /// There is no instruction, or one that stops the processor or that is not known to do the
    /// same on all of them.
    Instruction,
    /// A store into the program's instructions.
    Modifies,
    /// The stack is not left as it was found, or another one is taken.
    Stack,
    /// Calls that are too deep.
    Depth,
    /// Decimal arithmetic.
    Decimal,
    /// It would take too long to find out.
    Fuel,
    /// No way comes to an end.
    Endless,
    /// A slice that is not over where its routine returns.
    Returns,
}

/// A place in a program, and why the time from there is not known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unknown {
    /// The instruction.
    pub address: u16,
    /// What is wrong with it.
    pub why: Why,
}

impl fmt::Display for Why {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Why::Loop => "a loop whose turns nobody has bounded begins",
            Why::Irregular => "a loop is entered in its middle",
            Why::Jump => "where it goes on is not known",
            Why::Instruction => "there is no instruction whose effect is known",
            Why::Modifies => "the program's own instructions are changed",
            Why::Stack => "the stack is not left as it was found",
            Why::Depth => "calls are too deep",
            Why::Decimal => "decimal arithmetic begins",
            Why::Fuel => "it takes too long to find out",
            Why::Endless => "no way from there comes to an end",
            Why::Returns => "a slice is not over where its routine returns",
        })
    }
}

impl Question<'_> {
    /// The most cycles from an address to a return to who called it, or to one of the ends.
    ///
    /// # Errors
    /// Where there is no bound, or none is found: why, and where.
    pub fn worst(&self, from: u16) -> Result<u64, Unknown> {
        self.worst_within(from, FUEL)
    }

    /// The same where no more than so many instructions are interpreted for it.
    ///
    /// # Errors
    /// As [`Question::worst`].
    pub fn worst_within(&self, from: u16, fuel: u64) -> Result<u64, Unknown> {
        walk::Walk::new(self, fuel).worst(from)
    }

    /// The most cycles from behind one of the ends, or from `start`, to the next end: how long a
    /// program runs at most that asks at each of them, by an instruction there which leaves
    /// registers and memory as it likes, whether there is time to go on. All of them stand in
    /// the routine that begins at `start`.
    ///
    /// # Errors
    /// Where a slice has no bound: why, and where.
    pub fn slices(&self, start: u16) -> Result<u64, Unknown> {
        let first = self.worst_slice(start)?;
        let behind = self.slices_behind_ends()?;
        Ok(behind.into_values().fold(first, u64::max))
    }

    /// The most cycles from an address to the next of the ends.
    ///
    /// # Errors
    /// As for [`Question::slices`].
    pub fn worst_slice(&self, from: u16) -> Result<u64, Unknown> {
        walk::Walk::new(self, FUEL).slice(from)
    }

    /// The same behind each of the ends, by their addresses.
    ///
    /// # Errors
    /// As for [`Question::slices`].
    pub fn slices_behind_ends(&self) -> Result<BTreeMap<u16, u64>, Unknown> {
        let mut walk = walk::Walk::new(self, FUEL);
        let mut slice = |end: &u16| {
            let begin = flow::Instruction::at(self, *end)?.next;
            Ok((*end, walk.slice(begin)?))
        };
        self.ends.iter().map(&mut slice).collect()
    }

    /// The addresses of labels with bounds written behind them, as in
    /// `next: ; at most 12 turns`, in a program's text.
    pub fn turns_of(assembly: &Assembly, source: &str) -> BTreeMap<u16, u32> {
        let bound = |line: &str| {
            let (code, remark) = line.split_once(';')?;
            let number = remark.trim().strip_prefix("at most ")?;
            let turns = number.strip_suffix(" turns")?.parse().ok()?;
            let label = code.trim().strip_suffix(':')?;
            let address = u16::try_from(*assembly.symbols.get(label)?).ok()?;
            Some((address, turns))
        };
        source.lines().filter_map(bound).collect()
    }
}
