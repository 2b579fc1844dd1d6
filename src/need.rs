//! What a plan's program takes of the machine's memory.
//!
//! Sizes are those of the machine's own tools: the tokeniser's program and the
//! list entries of its names, the assembler's bytes. What only running would
//! tell is bounded: BASIC's stack, the heap of a Jack program at its start.

mod basic;
mod heap;

use crate::failure::{Failure, Outcome};
use crate::format::count;
use crate::machine::File;
use crate::vcs;
use basic::{basic, basic_machine, basic_room};
use heap::heap;
use slowlight_compiler::backend::mos6502;
use slowlight_compiler::fuel::Fuel;
use slowlight_compiler::ir::tree::walk;
use slowlight_compiler::plan::Plan;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::targets::{Language, Mode, System};
use slowlight_vm::bbc::Dialect;
use slowlight_vm::hack::vm::Heap;
use slowlight_vm::mos6502::extent;
use std::cell::Cell;

/// Words of the Hack computer's heap that every system has which is built into an emulator,
/// and those that each object has beside its own.
const HEAP: u64 = Heap::BuiltIn.words() as u64;
const HEADER: u64 = 2;

/// Words that every system has: nearly all that the official one leaves as `.vm` files.
const EVERYWHERE: u64 = 11_500;

/// Machine code that is read again as a whole may become shorter by a part of so many: of the
/// examples' programs by 19 in 100 at most, by 2 in the mean.
const TIDIED: u64 = 4;

/// How many times as short machine code may become at most where what it has several times is
/// called: of the examples' programs by a third.
const OUTLINED: u64 = 2;

/// By what part of themselves programs of one scene may differ in what reading them again spares.
const ALIKE: f64 = 0.03;

/// How a program was measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Measured {
    /// As it is.
    Whole,
    /// Machine code as it is first written.
    First,
    /// The same, where what it has several times is to be called.
    Repeats,
    /// The same, too large by what others of its scene became when they were read again.
    Beyond,
    /// Machine code read again as a whole.
    Tidied,
}

/// What a program takes of a machine's memory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Need {
    /// `bytes` or `words`.
    unit: &'static str,
    /// Each part and its size.
    parts: Vec<(&'static str, u64)>,
    /// What the machine has.
    room: u64,
    /// What takes most of a heap, and how much.
    largest: Option<(String, u64)>,
    /// Whether the program brings the operating system that it runs on.
    system: bool,
    /// What was measured.
    of: Measured,
}

/// What the heap of a Jack program takes of its machine.
pub struct HeapNeed<'n> {
    /// Everything with its headers, in words.
    pub words: u64,
    /// Each part that is not nothing.
    pub parts: Vec<(&'n str, u64)>,
    /// What takes most.
    pub largest: &'n str,
    /// Which operating systems have that much.
    pub systems: &'static str,
}

impl Need {
    /// Everything together.
    pub fn total(&self) -> u64 {
        self.parts.iter().map(|(_, size)| size).sum()
    }

    /// Whether the machine holds it.
    pub fn fits(&self) -> bool {
        self.total() <= self.room
    }

    /// Whether it is more than the machine holds by more than one part in so many, however much
    /// shorter it may become when it is read again.
    pub fn exceeds(&self, part: u64) -> bool {
        let most = self.room + self.room / part;
        match self.of {
            Measured::First | Measured::Beyond => self.total() > most + most / TIDIED,
            Measured::Repeats => self.total() > OUTLINED * most,
            _ => self.total() > most,
        }
    }

    /// Whether it is more than the machine holds, whatever of machine code as it was first
    /// written becomes subroutines.
    pub fn is_beyond_calls(&self) -> bool {
        self.total() > OUTLINED * (self.room + self.room / TIDIED)
    }

    /// By how much it is more than the machine holds.
    pub fn excess(&self) -> u64 {
        self.total().saturating_sub(self.room)
    }

    /// This or another, whichever is less.
    pub fn or_less(self, other: Option<Need>) -> Need {
        other
            .filter(|other| other.total() < self.total())
            .unwrap_or(self)
    }

    /// The same where the machine has more or less.
    pub fn in_room(&self, room: u64) -> Need {
        Need {
            room,
            ..self.clone()
        }
    }

    /// Whether it is so near to what the machine holds that another way to write the same
    /// statements may make it fit: of a text, remarks are a good part; of machine code hardly
    /// anything is spared.
    pub fn is_near(&self) -> bool {
        match self.of {
            Measured::Whole => !self.exceeds(2),
            Measured::First => self.total() <= self.room + self.room / TIDIED,
            Measured::Repeats => self.total() <= OUTLINED * self.room,
            Measured::Beyond => false,
            Measured::Tidied => !self.exceeds(16),
        }
    }

    /// Of a program that has a heap: what it takes.
    pub fn heap(&self) -> Option<HeapNeed<'_>> {
        let (largest, _) = self.largest.as_ref()?;
        let words = self.total();
        Some(HeapNeed {
            words,
            parts: self.parts.iter().filter(|(_, n)| *n > 0).copied().collect(),
            largest,
            systems: match words {
                _ if self.system => "runs on its own operating system",
                0..=EVERYWHERE => "runs on every operating system",
                _ => "needs the built-in OS of the VM emulator or the web IDE",
            },
        })
    }

    /// `6,120 of 5,888 bytes, 232 too many`.
    pub fn short(&self) -> String {
        format!(
            "{} of {} {}, {} too many",
            count(self.total()),
            count(self.room),
            self.unit,
            count(self.excess()),
        )
    }

    /// The same with its parts: `.. (program 5,300, ..)`.
    pub fn text(&self) -> String {
        let parts = self.parts.iter().filter(|(_, size)| *size > 0);
        let parts: Vec<String> = parts.map(|(n, s)| format!("{n} {}", count(*s))).collect();
        let largest = match &self.largest {
            Some((name, size)) => format!("; largest: {name}, {}", count(*size)),
            None => String::new(),
        };
        format!("{} ({}{largest})", self.short(), parts.join(", "))
    }
}

/// What a plan's program takes; `None` where nothing is known of the machine.
///
/// # Errors
/// Where the machine's tools refuse the text, which is a fault of ours.
pub fn need(plan: &Plan) -> Outcome<Option<Need>> {
    if vcs::is_cartridge(plan) {
        return cartridge(plan).map(Some);
    }
    if is_assembly(plan) {
        let mut draft = mos6502::Draft::new(plan);
        draft.tidy();
        return Ok(Some(assembly(&draft)));
    }
    let documents = slowlight_compiler::backend::emit(plan);
    match (dialect(plan), documents.first()) {
        (Some(dialect), Some(document)) => basic(plan, document, dialect),
        (None, Some(_)) if plan.target.system == System::Hack => Ok(Some(heap(&documents, &[]))),
        _ => Ok(None),
    }
}

/// What a cartridge has at most.
const CARTRIDGE: u64 = 0x8000;

/// What a cartridge takes.
fn cartridge(plan: &Plan) -> Outcome<Need> {
    let wrong = |why| Failure::Wrong(format!("{}: {why}", plan.target.name));
    let made = mos6502::vcs::cartridge(plan).map_err(wrong)?;
    Ok(Need {
        unit: "bytes",
        parts: vec![("program", u64::from(made.rom))],
        room: CARTRIDGE,
        largest: None,
        system: false,
        of: Measured::Whole,
    })
}

/// Whether a plan is written in assembly.
fn is_assembly(plan: &Plan) -> bool {
    plan.target.system.language() == Language::Assembly
}

/// The BASIC that a plan is written in.
fn dialect(plan: &Plan) -> Option<Dialect> {
    match plan.target.system {
        System::BbcBasic => Some(Dialect::Micro),
        System::Agon => Some(Dialect::Agon),
        System::BasicV => Some(Dialect::BasicV),
        _ => None,
    }
}

/// What a plan's machine has for its program, in its mode; `None` where nothing is known of it.
pub fn room(plan: &Plan) -> Option<u64> {
    match dialect(plan) {
        _ if vcs::is_cartridge(plan) => Some(CARTRIDGE),
        Some(dialect) => basic_room(plan, &basic_machine(plan, dialect)),
        None if is_assembly(plan) => Some(mos6502::bytes_of_room(plan)),
        None => (plan.target.system == System::Hack).then_some(HEAP),
    }
}

/// The same in another mode.
pub fn room_in(plan: &PlannedScene, mode: Mode) -> Option<u64> {
    let mut plan = plan.clone();
    plan.mode = mode;
    room(&plan)
}

/// The same where it is enough to know whether the machine holds it: of machine code as it is
/// before it is read again as a whole, where that says so already. That makes a program
/// shorter, but by a small part, and takes most of the time.
///
/// Where another of its scene's programs was read again, `kept` has what part of it was left:
/// one that is too large by that is not.
///
/// It is charged by what the program is made of, not by its text: an edited param has other
/// digits, and must not move the end of a search.
///
/// # Errors
/// As for [`need`].
pub fn about(plan: &Plan, fuel: &Fuel, kept: &Cell<f64>) -> Outcome<Option<Need>> {
    if vcs::is_cartridge(plan) {
        return need(plan);
    }
    let mut statements = 0;
    for block in plan.tree.blocks() {
        walk(block, &mut |_| statements += 1);
    }
    if !is_assembly(plan) {
        let written = match plan.target.system {
            System::Hack => WRITTEN_IN_JACK,
            _ => WRITTEN_IN_BASIC + statements / PAIRS,
        };
        fuel.burn(written * statements);
        return need(plan);
    }
    fuel.burn(WRITTEN_AS_CODE * statements);
    let mut draft = mos6502::Draft::new(plan);
    let mut need = Need {
        of: match plan.tight {
            true => Measured::Repeats,
            false => Measured::First,
        },
        ..assembly(&draft)
    };
    let first = need.total() as f64;
    if !plan.tight && first * (kept.get() - ALIKE) > need.room as f64 {
        need.of = Measured::Beyond;
    } else if !need.fits() && need.is_near() {
        fuel.burn(READ_AGAIN * statements);
        draft.tidy();
        need = Need {
            of: Measured::Tidied,
            ..assembly(&draft)
        };
        let part = need.total() as f64 / first;
        match kept.get() {
            _ if plan.tight => {}
            0.0 => kept.set(part),
            least => kept.set(part.min(least)),
        }
    }
    Ok(Some(need))
}

/// The same of a program as it is first written, whatever that says.
///
/// # Errors
/// As for [`need`].
pub fn first(plan: &Plan) -> Outcome<Option<Need>> {
    match is_assembly(plan) {
        true => Ok(Some(assembly(&mos6502::Draft::new(plan)))),
        false => need(plan),
    }
}

/// Units of work for each statement of a program: to write it and look how large it is, and
/// to read machine code again as a whole.
const WRITTEN_IN_JACK: u64 = 1_000;
const WRITTEN_IN_BASIC: u64 = 4_000;
const WRITTEN_AS_CODE: u64 = 6_000;
const READ_AGAIN: u64 = 80_000;

/// Of so many pairs of statements one takes a unit more in BASIC, where variables are shared:
/// which are alive at the same time is looked at for each of them.
const PAIRS: u64 = 2;

/// What a plan's program takes of the Hack's heap where this operating system has its
/// part of it.
pub fn need_beside(plan: &Plan, system: &[File]) -> Need {
    heap(&slowlight_compiler::backend::emit(plan), system)
}

fn assembly(draft: &mos6502::Draft) -> Need {
    let assembled = || extent(&draft.document().text);
    let counted = draft.extent();
    debug_assert!(counted.is_none_or(|counted| counted == assembled()));
    let whole = || {
        let (origin, end) = assembled();
        u64::from(end.saturating_sub(origin))
    };
    let bytes = draft.bytes().unwrap_or_else(whole);
    Need {
        unit: "bytes",
        parts: vec![
            ("values and the runtime's tables", draft.room.values),
            ("program", bytes),
        ],
        room: draft.room.bytes,
        largest: None,
        system: false,
        of: Measured::Whole,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_need_says_how_far_it_is_off() {
        let need = Need {
            unit: "bytes",
            parts: vec![("program", 5000), ("arrays", 0), ("variables", 1000)],
            room: 5888,
            largest: None,
            system: false,
            of: Measured::Whole,
        };
        assert!(!need.fits());
        assert_eq!(
            need.text(),
            "6,000 of 5,888 bytes, 112 too many (program 5,000, variables 1,000)"
        );
    }
}
