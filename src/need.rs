//! What a plan's program takes of the machine's memory.
//!
//! Sizes are those of the machine's own tools: the tokeniser's program and the
//! list entries of its names, the assembler's bytes. What only running would
//! tell is bounded: BASIC's stack, the heap of a Jack program at its start.

mod heap;

use crate::failure::{Failure, Outcome};
use crate::format::count;
use crate::machine::File;
use heap::heap;
use slowlight_compiler::backend::Document;
use slowlight_compiler::backend::mos6502;
use slowlight_compiler::fuel::Fuel;
use slowlight_compiler::ir::tree::{Statement, Tree, walk};
use slowlight_compiler::plan::Plan;
use slowlight_compiler::targets::{Language, System};
use slowlight_vm::bbc::{Config, Dialect, Machine, tokenise};
use slowlight_vm::hack::vm::Heap;
use slowlight_vm::mos6502::extent;

/// What BASIC's stack takes at most: three calls of the runtime's functions
/// inside each other, of 28 bytes and 8 an argument, and as much as a call more
/// for what an expression holds meanwhile.
const BASIC_STACK: u64 = 160;

/// What a procedure without arguments leaves on it while it runs: the
/// processor's stack, and where to return to.
const BASIC_CALL: u64 = 28;

/// Words of the Hack computer's heap that every system has which is built into an emulator,
/// and those that each object has beside its own.
const HEAP: u64 = Heap::BuiltIn.words() as u64;
const HEADER: u64 = 2;

/// Words that every system has: nearly all that the official one leaves as `.vm` files.
const EVERYWHERE: u64 = 11_500;

/// Machine code that is read again as a whole may become shorter by a part of so many: of the
/// examples' programs by 19 in 100 at most, by 2 in the mean.
const TIDIED: u64 = 4;

/// How a program was measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Measured {
    /// As it is.
    Whole,
    /// Machine code as it is first written.
    First,
    /// The same, read again as a whole.
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
            Measured::First => self.total() > most + most / TIDIED,
            _ => self.total() > most,
        }
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

    /// `6,120 of 5,888 bytes, 232 too many (program 5,300, ..)`.
    pub fn text(&self) -> String {
        let parts = self.parts.iter().filter(|(_, size)| *size > 0);
        let parts: Vec<String> = parts.map(|(n, s)| format!("{n} {}", count(*s))).collect();
        let largest = match &self.largest {
            Some((name, size)) => format!("; largest: {name}, {}", count(*size)),
            None => String::new(),
        };
        format!(
            "{} of {} {}, {} too many ({}{largest})",
            count(self.total()),
            count(self.room),
            self.unit,
            count(self.total().saturating_sub(self.room)),
            parts.join(", ")
        )
    }
}

/// What a plan's program takes; `None` where nothing is known of the machine.
///
/// # Errors
/// Where the machine's tools refuse the text, which is a fault of ours.
pub fn need(plan: &Plan) -> Outcome<Option<Need>> {
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
        Some(dialect) => basic_room(plan, &basic_machine(plan, dialect)),
        None if is_assembly(plan) => Some(mos6502::bytes_of_room(plan)),
        None => (plan.target.system == System::Hack).then_some(HEAP),
    }
}

fn basic_machine(plan: &Plan, dialect: Dialect) -> Machine {
    let page = plan.page.unwrap_or(Config::default().page);
    Machine::new(Config { dialect, page })
}

fn basic_room(plan: &Plan, machine: &Machine) -> Option<u64> {
    let mode = plan.mode.name.parse().ok()?;
    machine.memory(mode).map(|room| room as u64)
}

/// The same where it is enough to know whether the machine holds it: of machine code as it is
/// before it is read again as a whole, where that says so already. That makes a program
/// shorter, but by a small part, and takes most of the time.
///
/// It is charged by what the program is made of, not by its text: an edited param has other
/// digits, and must not move the end of a search.
///
/// # Errors
/// As for [`need`].
pub fn about(plan: &Plan, fuel: &Fuel) -> Outcome<Option<Need>> {
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
        of: Measured::First,
        ..assembly(&draft)
    };
    if !need.fits() && need.is_near() {
        fuel.burn(READ_AGAIN * statements);
        draft.tidy();
        need = Need {
            of: Measured::Tidied,
            ..assembly(&draft)
        };
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

fn basic(plan: &Plan, document: &Document, dialect: Dialect) -> Outcome<Option<Need>> {
    let refuse = |fault: slowlight_vm::Fault| {
        Failure::Wrong(format!("the tokeniser refuses {}: {fault}", document.name))
    };
    let tokens = tokenise(&document.text, dialect).map_err(refuse)?;
    let mut machine = basic_machine(plan, dialect);
    machine.load_tokenised(&tokens).map_err(refuse)?;
    let Some(room) = basic_room(plan, &machine) else {
        return Ok(None);
    };
    Ok(Some(Need {
        unit: "bytes",
        parts: vec![
            ("program", machine.program_bytes() as u64),
            ("variables", machine.entry_bytes() as u64),
            ("arrays", arrays(&document.text)),
            ("stack", BASIC_STACK + BASIC_CALL * depth(&plan.tree)),
        ],
        room,
        largest: None,
        system: false,
        of: Measured::Whole,
    }))
}

/// How many subroutines run inside each other at most.
fn depth(tree: &Tree) -> u64 {
    let mut depths: Vec<u64> = vec![0; tree.subroutines.len()];
    // One that is called stands before or behind who calls it; no chain of
    // calls is longer than there are subroutines.
    for _ in 0..depths.len() {
        for (k, subroutine) in tree.subroutines.iter().enumerate() {
            let mut inner = 0;
            walk(&subroutine.body, &mut |statement| {
                if let Statement::Call(id) = statement {
                    inner = inner.max(depths.get(id.0 as usize).copied().unwrap_or(0));
                }
            });
            if let Some(depth) = depths.get_mut(k) {
                *depth = inner + 1;
            }
        }
    }
    depths.into_iter().max().unwrap_or(0)
}

/// Bytes of the arrays that a program makes with constant bounds.
fn arrays(text: &str) -> u64 {
    let mut bytes = 0;
    for (at, _) in text.match_indices("DIM") {
        let mut rest = text.get(at + 3..).unwrap_or_default();
        while let Some((name, behind)) = rest.split_once('(')
            && let Some((bounds, behind)) = behind.split_once(')')
        {
            let bounds: Vec<u64> = bounds.split(',').filter_map(|n| n.parse().ok()).collect();
            let element = if name.ends_with('%') { 4 } else { 5 };
            let elements: u64 = bounds.iter().map(|n| n + 1).product();
            bytes += 1 + 2 * bounds.len() as u64 + element * elements;
            rest = match behind.strip_prefix(',') {
                Some(rest) => rest,
                None => break,
            };
        }
    }
    bytes
}

fn assembly(draft: &mos6502::Draft) -> Need {
    let assembled = || extent(&draft.document().text);
    let counted = draft.extent();
    debug_assert!(counted.is_none_or(|counted| counted == assembled()));
    let (origin, end) = counted.unwrap_or_else(assembled);
    Need {
        unit: "bytes",
        parts: vec![
            ("values and the runtime's tables", draft.room.values),
            ("program", u64::from(end.saturating_sub(origin))),
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
    fn arrays_are_counted_as_the_machine_makes_them() {
        assert_eq!(arrays("10DIM a(7,7):b=1"), 5 + 5 * 64);
        assert_eq!(arrays("10DIMn%(3):DIM error(9,1)"), 3 + 16 + 5 + 100);
        assert_eq!(arrays("10DIMn%(3),error(9,1):a=f(2)"), 3 + 16 + 5 + 100);
        assert_eq!(arrays("10PRINT"), 0);
    }

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
