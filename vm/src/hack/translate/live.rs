//! Which of temps, pointers and locals are read later, at each command.
//!
//! Jack compilers pass a word through `temp 0` and through `pointer 1` for every
//! element of an array. Where nobody reads them afterwards, they need not be
//! written.

use crate::hack::vm::command::{CONSTANTS, Command, LCL, Place, STATIC, TEMP, THAT, THIS};
use crate::hack::vm::heights::{Heights, UNREACHED};
use crate::hack::vm::link::{Function, Program};
use crate::hack::vm::os::Native;

/// A set: bits 0 to 7 temps, then THIS, THAT, and the first 54 locals.
pub(super) type Set = u64;

const TEMPS: Set = 0xff;
const THIS_BIT: Set = 1 << 8;
const THAT_BIT: Set = 1 << 9;
/// The pointers.
pub(super) const POINTERS: Set = THIS_BIT | THAT_BIT;
const FIRST_LOCAL: u16 = 10;

/// What is read later.
pub(super) struct Live {
    /// After each command of the program.
    after: Vec<Set>,
    /// At the start of each function that is reached.
    entry: Vec<Set>,
}

impl Live {
    pub fn new(program: &Program, heights: &Heights, order: &[usize]) -> Live {
        // First as if nothing went from one function to another; that shows whether
        // something does. A call leaves the pointers as they were.
        let alone = Live::with(program, heights, order, 0);
        let mut passed = 0;
        for function in order {
            passed |= alone.entry.get(*function).copied().unwrap_or(0) & (TEMPS | POINTERS);
            let Some(function) = program.functions.get(*function) else {
                continue;
            };
            let commands = program.commands.get(function.range()).unwrap_or(&[]);
            let after = alone.after.get(function.range()).unwrap_or(&[]);
            for (command, after) in commands.iter().zip(after) {
                if matches!(command, Command::Call { .. }) {
                    passed |= after & TEMPS;
                }
            }
        }
        if passed == 0 {
            alone
        } else {
            Live::with(program, heights, order, passed)
        }
    }

    /// Where those of `passed` count as read by every function that is called, and
    /// its temps by every caller.
    fn with(program: &Program, heights: &Heights, order: &[usize], passed: Set) -> Live {
        let mut live = Live {
            after: vec![0; program.commands.len()],
            entry: vec![0; program.functions.len()],
        };
        for index in order {
            if let Some(function) = program.functions.get(*index) {
                let entry = live.walk(program, heights, function, passed);
                if let Some(slot) = live.entry.get_mut(*index) {
                    *slot = entry;
                }
            }
        }
        live
    }

    /// Whether the word at a fixed address may be read after a command.
    pub fn is_read(&self, at: u32, address: u16) -> bool {
        let bit = bit(Place::fixed(address));
        bit == 0 || self.after.get(at as usize).is_none_or(|set| set & bit != 0)
    }

    /// The pointers that a function reads as its caller left them.
    pub fn pointers(&self, function: usize) -> Set {
        self.entry.get(function).copied().unwrap_or(0) & POINTERS
    }

    /// Whether a local may be read before the function has written it.
    pub fn reads_first(&self, function: usize, local: u16) -> bool {
        let set = self.entry.get(function).copied().unwrap_or(0);
        let bit = local_bit(local);
        bit == 0 || set & bit != 0
    }

    /// Goes backwards through a function until nothing changes; answers what is
    /// read of what is there at its start.
    fn walk(
        &mut self,
        program: &Program,
        heights: &Heights,
        function: &Function,
        passed: Set,
    ) -> Set {
        let first = function.start + 1;
        let mut jumpers: std::collections::HashMap<u32, Vec<u32>> = Default::default();
        let reached = |at: u32| heights.at.get(at as usize) != Some(&UNREACHED);
        let mut work = Vec::new();
        for at in (first..=function.end).filter(|at| reached(*at)) {
            if let Some(Command::Goto(to) | Command::IfGoto(to)) = program.commands.get(at as usize)
            {
                jumpers.entry(*to).or_default().push(at);
            }
            work.push(at);
        }
        let mut before = vec![0; (function.end - function.start + 1) as usize];
        let mut visited = vec![false; before.len()];
        while let Some(at) = work.pop() {
            let Some(command) = program.commands.get(at as usize) else {
                continue;
            };
            let slot = |at: u32| at.wrapping_sub(function.start) as usize;
            let read = |at: u32| before.get(slot(at)).copied().unwrap_or(0);
            let after = match command {
                Command::Return | Command::FunctionEnd => passed & TEMPS,
                Command::Native(Native::Halt) => 0,
                Command::Goto(to) => read(*to),
                Command::IfGoto(to) => read(*to) | read(at + 1),
                _ => read(at + 1),
            };
            if let Some(known) = self.after.get_mut(at as usize) {
                *known = after;
            }
            let now = transfer(*command, after, passed);
            let (Some(known), Some(seen)) = (before.get_mut(slot(at)), visited.get_mut(slot(at)))
            else {
                continue;
            };
            if *known != now || !*seen {
                *known = now;
                *seen = true;
                work.extend(jumpers.get(&at).into_iter().flatten());
                if at > first && reached(at - 1) {
                    work.push(at - 1);
                }
            }
        }
        before.get(1).copied().unwrap_or(0)
    }
}

/// What is read at a command, if `after` is what is read after it.
fn transfer(command: Command, after: Set, passed: Set) -> Set {
    match command {
        Command::Push(place) => after | bit(place) | base_bit(place),
        Command::Pop(place) => after & !bit(place) | base_bit(place),
        Command::Call { .. } => after & !TEMPS | passed,
        _ => after,
    }
}

fn bit(place: Place) -> Set {
    match (place.base, place.offset) {
        (CONSTANTS, THIS) => THIS_BIT,
        (CONSTANTS, THAT) => THAT_BIT,
        (CONSTANTS, temp @ TEMP..STATIC) => 1 << (temp - TEMP).min(63) & TEMPS,
        (LCL, local) => local_bit(local),
        _ => 0,
    }
}

fn local_bit(local: u16) -> Set {
    if local < 64 - FIRST_LOCAL {
        1 << (local + FIRST_LOCAL)
    } else {
        0
    }
}

/// The pointer that a place is reached through.
fn base_bit(place: Place) -> Set {
    match place.base {
        THIS => THIS_BIT,
        THAT => THAT_BIT,
        _ => 0,
    }
}
