//! Lines of assembly as instructions.

use rustc_hash::{FxHashMap, FxHashSet};
use slowlight_isa::opcodes;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::LazyLock;

/// Bytes of a value, at most: what has more is an array, whose bytes are not told apart.
const MOST: u16 = 16;

/// All mnemonics: each line is looked up in them.
static MNEMONICS: LazyLock<FxHashSet<&str>> = LazyLock::new(|| {
    let all = opcodes::OPCODES.iter().map(|opcode| opcode.mnemonic);
    all.filter(|name| opcodes::is_mnemonic(name)).collect()
});

/// What an instruction works on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Operand {
    /// Nothing, or the accumulator.
    None,
    /// A number, or bytes of a symbol.
    Immediate(String, Option<u8>),
    /// A byte that has a name.
    Cell(u16, String),
    /// A byte of those from one name to the next: an index says which.
    Region(Range<u16>, String),
    /// What two cells of the zero page point to: where it is, and how that is written.
    Pointed(u16, String),
    /// A table, which nobody writes to, by its label and an index.
    Table(String),
    /// Where a branch, a jump or a call goes.
    Label(String),
    /// Anything else: a port, the screen, what only the assembler can work out.
    Other(String),
}

/// One instruction.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Instruction {
    pub name: String,
    pub operand: Operand,
}

/// What a line is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Line {
    /// A remark, an empty line, the definition of a symbol.
    Silent,
    Label(String),
    Code(Instruction),
    /// Bytes, or something that is not understood: nothing goes on behind it.
    Data,
}

/// The names of a program, and what they stand for.
pub(super) struct Names {
    /// Addresses of the bytes that are told apart.
    cells: FxHashMap<String, u16>,
    /// Where each of them ends: at the next.
    ends: BTreeMap<u16, u16>,
    labels: FxHashMap<String, usize>,
}

fn number(text: &str) -> Option<u32> {
    match text.strip_prefix('$') {
        Some(hex) => u32::from_str_radix(hex, 16).ok(),
        None => text.parse().ok(),
    }
}

fn is_name(text: &str) -> bool {
    let mut letters = text.chars();
    let first = |c: char| c.is_ascii_alphabetic() || c == '_';
    letters.next().is_some_and(first) && letters.all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// A name and what is added to it.
fn sum(text: &str) -> Option<(&str, i32)> {
    let at = text.find(['+', '-']).unwrap_or(text.len());
    let (name, rest) = text.split_at(at);
    let by = match rest.split_at_checked(1) {
        Some(("+", by)) => number(by)? as i32,
        Some(("-", by)) => -(number(by)? as i32),
        _ => 0,
    };
    is_name(name).then_some((name, by))
}

/// A line without its comment and the spaces behind it.
fn body(line: &str) -> &str {
    line.split(';').next().unwrap_or(line).trim_end()
}

/// The symbol that a line gives an address, and the address.
pub(super) fn defined(line: &str) -> Option<(&str, u16)> {
    let (name, value) = body(line).split_once(" = ")?;
    let value = value.trim().strip_prefix('$')?;
    let address = u16::from_str_radix(value, 16).ok()?;
    is_name(name).then_some((name, address))
}

impl Names {
    /// Of a program; `symbols` are the lines that name its bytes. Bytes whose address is
    /// written anywhere are not told apart.
    pub fn new(lines: &[&str], symbols: Range<usize>) -> Names {
        let named = lines.get(symbols).unwrap_or_default();
        let mut cells: FxHashMap<String, u16> = (named.iter())
            .filter_map(|line| defined(line))
            .map(|(name, at)| (name.to_owned(), at))
            .collect();
        let labels: FxHashMap<String, usize> = (lines.iter().enumerate())
            .filter_map(|(k, line)| Some((label(line)?.to_owned(), k)))
            .collect();
        for line in lines {
            for (at, _) in line.match_indices(['<', '>']) {
                let inner = line.get(at + 1..).unwrap_or_default();
                let inner = inner.trim_start_matches(['(', ' ']);
                let end = inner.find(|c: char| !c.is_ascii_alphanumeric() && c != '_');
                cells.remove(inner.get(..end.unwrap_or(inner.len())).unwrap_or_default());
            }
        }
        let mut starts: Vec<u16> = (lines.iter())
            .filter_map(|line| Some(defined(line)?.1))
            .collect();
        starts.sort_unstable();
        starts.dedup();
        let ends: BTreeMap<u16, u16> = (starts.windows(2))
            .filter_map(|pair| Some((*pair.first()?, *pair.last()?)))
            .filter(|(start, end)| end - start <= MOST)
            .collect();
        Names {
            cells,
            ends,
            labels,
        }
    }

    /// The line of a label.
    pub fn line_of(&self, label: &str) -> Option<usize> {
        self.labels.get(label).copied()
    }

    fn region(&self, name: &str) -> Option<Range<u16>> {
        let start = *self.cells.get(name)?;
        Some(start..*self.ends.get(&start)?)
    }

    /// A byte by its name, if it is one that is told apart and lies in what has that name.
    fn cell(&self, text: &str) -> Option<u16> {
        let (name, by) = sum(text)?;
        let region = self.region(name)?;
        let at = u16::try_from(i32::from(region.start) + by).ok()?;
        region.contains(&at).then_some(at)
    }

    fn operand(&self, name: &str, text: &str) -> Operand {
        let other = || Operand::Other(text.to_owned());
        if text.is_empty() {
            return Operand::None;
        }
        if let Some(value) = text.strip_prefix('#') {
            let known = number(value).and_then(|n| u8::try_from(n).ok());
            return Operand::Immediate(text.to_owned(), known);
        }
        if matches!(name, "jmp" | "jsr") || is_branch(name) {
            return match self.labels.contains_key(text) {
                true => Operand::Label(text.to_owned()),
                false => other(),
            };
        }
        if let Some(inner) = text.strip_prefix('(') {
            let pointer = inner.strip_suffix("),y").and_then(|p| self.cell(p));
            return pointer.map_or_else(other, |at| Operand::Pointed(at, text.to_owned()));
        }
        if let Some(base) = text.strip_suffix(",x").or_else(|| text.strip_suffix(",y")) {
            let Some((name, _)) = sum(base) else {
                return other();
            };
            return match self.region(name) {
                Some(region) => Operand::Region(region, text.to_owned()),
                None if self.labels.contains_key(name) => Operand::Table(text.to_owned()),
                None => other(),
            };
        }
        match self.cell(text) {
            Some(at) => Operand::Cell(at, text.to_owned()),
            None => other(),
        }
    }

    pub fn read(&self, line: &str) -> Line {
        let code = body(line);
        let text = code.trim_start();
        if text.is_empty() || (text.len() == code.len() && code.contains(" = ")) {
            return Line::Silent;
        }
        if let Some(name) = label(line) {
            return Line::Label(name.to_owned());
        }
        let (name, rest) = text.split_once(' ').unwrap_or((text, ""));
        if text.len() == code.len() || !MNEMONICS.contains(name) {
            return Line::Data;
        }
        Line::Code(Instruction {
            name: name.to_owned(),
            operand: self.operand(name, rest.trim()),
        })
    }
}

/// The label that a line is.
fn label(line: &str) -> Option<&str> {
    let name = body(line).strip_suffix(':')?;
    is_name(name).then_some(name)
}

/// Whether an instruction may go elsewhere or on.
pub(super) fn is_branch(name: &str) -> bool {
    matches!(
        name,
        "bcc" | "bcs" | "beq" | "bne" | "bmi" | "bpl" | "bvc" | "bvs"
    )
}

impl Operand {
    /// As it is written.
    pub fn text(&self) -> &str {
        match self {
            Operand::None => "",
            Operand::Immediate(text, _)
            | Operand::Cell(_, text)
            | Operand::Region(_, text)
            | Operand::Pointed(_, text)
            | Operand::Table(text)
            | Operand::Label(text)
            | Operand::Other(text) => text,
        }
    }
}
