//! What a plan's program takes of the machine's memory.
//!
//! Sizes are those of the machine's own tools: the tokeniser's program and the
//! list entries of its names, the assembler's bytes. What only running would
//! tell is bounded: BASIC's stack, the heap of a Jack program at its start.

use crate::failure::{Failure, Outcome};
use crate::format::count;
use crate::machine::File;
use crate::target_args::is_6502;
use slowlight_compiler::flow::tree::{Statement, Tree, walk};
use slowlight_compiler::fuel::Fuel;
use slowlight_compiler::plan::Plan;
use slowlight_compiler::target::Document;
use slowlight_compiler::target::mos6502;
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

/// Words of a string beside its characters, in the web IDE, which has most: the two lengths,
/// where the characters are, and the header of these.
const STRING: u64 = 3 + HEADER;

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

    /// Whether it is so near to what the machine holds that another way to write the same
    /// statements may make it fit.
    pub fn is_near(&self) -> bool {
        self.total() <= self.room + self.room / 2
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
    if is_6502(plan.target) {
        let mut draft = mos6502::Draft::new(plan);
        draft.tidy();
        return Ok(Some(assembly(&draft)));
    }
    let documents = (plan.target.emit)(plan);
    let dialect = match plan.target.name {
        "bbc:micro" => Dialect::Micro,
        "bbc:agon" => Dialect::Agon,
        "bbc:basicv" => Dialect::BasicV,
        "jack" => return Ok(Some(heap(&documents, &[]))),
        _ => return Ok(None),
    };
    match documents.first() {
        Some(document) => basic(plan, document, dialect),
        None => Ok(None),
    }
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
    if !is_6502(plan.target) {
        let written = match plan.target.name {
            "jack" => WRITTEN_IN_JACK,
            _ => WRITTEN_IN_BASIC + statements / PAIRS,
        };
        fuel.burn(written * statements);
        return need(plan);
    }
    fuel.burn(WRITTEN_AS_CODE * statements);
    let mut draft = mos6502::Draft::new(plan);
    let mut need = assembly(&draft);
    if !need.fits() && need.is_near() {
        fuel.burn(READ_AGAIN * statements);
        draft.tidy();
        need = assembly(&draft);
    }
    Ok(Some(need))
}

/// The same of a program as it is first written, whatever that says.
///
/// # Errors
/// As for [`need`].
pub fn first(plan: &Plan) -> Outcome<Option<Need>> {
    match is_6502(plan.target) {
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
    heap(&(plan.target.emit)(plan), system)
}

fn basic(plan: &Plan, document: &Document, dialect: Dialect) -> Outcome<Option<Need>> {
    let refuse = |fault: slowlight_vm::Fault| {
        Failure::Wrong(format!("the tokeniser refuses {}: {fault}", document.name))
    };
    let tokens = tokenise(&document.text, dialect).map_err(refuse)?;
    let mut machine = Machine::new(Config {
        dialect,
        page: plan.page.unwrap_or(Config::default().page),
    });
    machine.load_tokenised(&tokens).map_err(refuse)?;
    let mode = plan.mode.name.parse().ok();
    let Some(room) = mode.and_then(|mode| machine.memory(mode)) else {
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
        room: room as u64,
        largest: None,
        system: false,
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
    }
}

/// The heap of a Jack program before it draws: one object of fields, Floats and
/// arrays, the tables of its classes and of the system's, and the longest message. Rows
/// of errors are filled in a loop, of Floats with one an element.
fn heap(documents: &[Document], system: &[File]) -> Need {
    let (mut fields, mut floats, mut arrays, mut rows, mut message) = (0, 0, 0, 0, 0);
    let texts = documents.iter().map(|d| d.text.clone());
    let texts = texts.chain(system.iter().map(|file| file.as_text().into_owned()));
    let mut largest = texts
        .flat_map(|text| largest_array(&text))
        .max_by_key(|(_, size)| *size);
    // Behind `Main` comes the scene's class.
    let scene = documents.get(1).map_or("", |d| d.text.as_str());
    let of_floats = scene.contains("] = Float.new()");
    let lines = scene.lines().map(str::trim_start);
    let befores = std::iter::once("").chain(lines.clone());
    for (line, before) in lines.zip(befores) {
        if let Some(declared) = line.strip_prefix("field ") {
            let names = declared.split(';').next().unwrap_or_default();
            fields += names.split(',').count() as u64;
        } else if let Some(size) = array(line) {
            arrays += size + HEADER;
            if of_floats && line.starts_with("let errors") || line.ends_with("// of Floats") {
                rows += size;
            }
        } else if line.contains("= Float.constant(") {
            floats += 1;
        } else if line.contains("= Float.new(") {
            // Elements of rows are counted as these are made.
            floats += u64::from(!line.contains("] = ") && !replaces(line, before));
        } else if let Some((_, said)) = line.split_once("Output.printString(\"") {
            let length = said.split('"').next().unwrap_or_default().len() as u64;
            message = message.max(length + STRING + HEADER);
        }
    }
    let float = 3 + HEADER;
    let classes = documents.iter().skip(2).flat_map(|d| d.text.lines());
    let arithmetic = classes.filter_map(|line| match line.contains("= Float.new(") {
        true => Some(float),
        false => array(line).map(|size| size + HEADER),
    });
    let beside: u64 = (system.iter())
        .map(|file| {
            file.as_text()
                .lines()
                .filter_map(array)
                .map(|size| size + HEADER)
                .sum::<u64>()
        })
        .sum();
    let groups = [
        ("the fields", fields + HEADER),
        ("the numbers", floats * float),
        ("the rows of errors", rows * float),
    ];
    for (name, size) in groups {
        if largest.as_ref().is_none_or(|(_, most)| size > *most) {
            largest = Some((name.to_owned(), size));
        }
    }
    Need {
        unit: "words of heap",
        largest,
        system: !system.is_empty(),
        parts: vec![
            ("fields", fields + HEADER),
            ("numbers", floats * float),
            ("tables", arrays),
            ("errors", rows * float),
            ("arithmetic", arithmetic.sum()),
            ("messages", message),
            ("operating system", beside),
        ],
        room: HEAP,
    }
}

/// Whether a line makes the variable anew that the line before put into an array.
fn replaces(line: &str, before: &str) -> bool {
    let made = line.strip_prefix("let ").and_then(|l| l.split_once(" = "));
    let put = before
        .split_once("] = ")
        .and_then(|(_, p)| p.strip_suffix(';'));
    made.is_some_and(|(name, _)| put == Some(name))
}

/// The longest array that a class makes, and its words.
fn largest_array(class: &str) -> Option<(String, u64)> {
    let name = |line: &str| {
        let (name, _) = line.trim_start().strip_prefix("let ")?.split_once(" = ")?;
        Some((format!("the array {name}"), array(line)? + HEADER))
    };
    class.lines().filter_map(name).max_by_key(|(_, size)| *size)
}

/// The length of the array that a line makes.
fn array(line: &str) -> Option<u64> {
    let (_, size) = line.split_once("= Array.new(")?;
    size.split(')').next()?.parse().ok()
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
        };
        assert!(!need.fits());
        assert_eq!(
            need.text(),
            "6,000 of 5,888 bytes, 112 too many (program 5,000, variables 1,000)"
        );
    }
}
