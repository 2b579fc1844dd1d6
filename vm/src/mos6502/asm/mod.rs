//! A two-pass assembler for the part of the language that most 6502 assemblers share.
//!
//! ```text
//! * = $0800            ; where the program lies; before its first byte
//! width = 320          ; a symbol; may mention later ones
//! start: lda #<(width) ; a label (with its colon) and an instruction
//!        sta count     ; zero page where the value is known here and below 256
//!        asl           ; on the accumulator; `asl a` is the same
//!        jmp (vector)
//! data:  .byte 1, $02, %11, 'c', "text"
//!        .word start, data + 2
//!        .res 16       ; so many bytes, zero unless `.res 16, 255`
//! ```
//!
//! It is there for the programs that `slowlight build` writes: no macros, scopes, local
//! labels, conditions, segments or files. A line that has such a thing is refused by its
//! name. ca65 with `--feature pc_assignment` makes the same bytes of what this one
//! accepts (undocumented opcodes there need `--cpu 6502X`). Where assemblers read
//! an expression differently, it is an error here: see `expr`.
//!
//! beebasm's way of writing is read where it is asked for: see [`Dialect`].
//!
//! - Whether an operand is in the zero page is decided where it stands: a symbol
//!   that is defined later counts as absolute, so define zero-page symbols first.
//!   All sizes are therefore known after the first pass, and two passes are enough.
//! - The origin cannot move once there are bytes: pad with `.res`.
//! - Numbers are of 32 bits, signed or not; instructions and symbols in any case,
//!   symbols distinguishing it. Symbols are ASCII letters, digits and `_`.

mod emit;
mod expr;
mod layout;
mod lexer;
mod listing;
mod parse;
mod symbols;
#[cfg(test)]
mod tests;
mod unread;

use std::collections::BTreeMap;

use crate::Fault;
pub use listing::Taken;
use symbols::Symbols;

/// How a program is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Dialect {
    /// As most assemblers have it: see [`self`].
    #[default]
    Common,
    /// As beebasm has it, and what of it has one meaning. Against the other:
    ///
    /// ```text
    /// ORG &0800             \ hexadecimal; two kinds of comments
    /// .start LDA #LO(width) ; a label has its dot in front, and bytes are LO(x), HI(x)
    /// ASL A : STA count     \ several statements a line; the accumulator is written
    /// EQUB 1, "text"        \ also EQUS; EQUW; SKIP 16
    /// SAVE "NAME", start, * \ is checked, and has no effect
    /// ```
    ///
    /// `&` is no operator then, nor are `|`, `^` and `/`, which are others in beebasm.
    Beebasm,
}

/// At most so many faults are reported.
const FAULTS: usize = 100;

/// Some bytes of the program and the line of source that they come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LineSpan {
    /// Address of the first byte.
    pub address: u16,
    /// How many bytes.
    pub length: u32,
    /// Line of the source, from 1.
    pub line: u32,
    /// Whether they are an instruction (else data).
    pub code: bool,
}

/// A program, assembled.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Assembly {
    /// Address of the first byte, which is also where the program is entered.
    pub origin: u16,
    /// The program.
    pub bytes: Vec<u8>,
    /// Every symbol's value; labels are addresses.
    pub symbols: BTreeMap<String, i64>,
    /// Which line made which bytes, by rising address, without gaps.
    pub lines: Vec<LineSpan>,
}

impl Assembly {
    /// The program as a file for [`super::Plain::load`]: two bytes of origin, low
    /// byte first, then the bytes.
    pub fn image(&self) -> Vec<u8> {
        let mut image = self.origin.to_le_bytes().to_vec();
        image.extend(&self.bytes);
        image
    }

    /// The line that made the byte at an address.
    pub fn line_at(&self, address: u16) -> Option<u32> {
        let behind = self.lines.partition_point(|span| span.address <= address);
        let span = self.lines.get(behind.checked_sub(1)?)?;
        (u32::from(address - span.address) < span.length).then_some(span.line)
    }
}

/// Where things go wrong, collected up to a limit.
#[derive(Clone, Default)]
struct Faults(Vec<Fault>);

impl Faults {
    fn add(&mut self, line: u32, column: u32, message: impl Into<String>) {
        if self.0.len() < FAULTS {
            self.0.push(Fault {
                message: message.into(),
                file: None,
                line: Some(line),
                column: Some(column),
            });
        }
    }
}

/// The addresses of a program's first byte and behind its last one, which is
/// beyond 64K where the program is too long. Nothing is said of what is wrong.
pub fn extent(source: &str) -> (u32, u32) {
    let Parsed {
        statements,
        mut symbols,
        mut faults,
    } = Parsed::of(source, Dialect::Common);
    let placed = layout::layout(&statements, &[], &mut symbols, &mut faults);
    (placed.origin, placed.end)
}

/// A program's text, parsed: it can be assembled more than once, each time with other numbers
/// for what it names.
pub struct Parsed {
    statements: Vec<parse::Statement>,
    symbols: Symbols,
    faults: Faults,
}

impl Parsed {
    /// Reads a text. What is wrong with it is said where it is assembled.
    pub fn of(source: &str, dialect: Dialect) -> Parsed {
        let mut faults = Faults::default();
        let mut symbols = Symbols::default();
        let statements = statements(source, dialect, &mut symbols, &mut faults);
        Parsed {
            statements,
            symbols,
            faults,
        }
    }

    /// Assembles it, as if each of these symbols were assigned that number where the text
    /// assigns it another; one that the text does not assign changes nothing.
    ///
    /// # Errors
    /// As for [`assemble`].
    pub fn assemble(&self, others: &[(&str, i64)]) -> Result<Assembly, Vec<Fault>> {
        let (mut symbols, mut faults) = (self.symbols.clone(), self.faults.clone());
        let other = |(name, value): &(&str, i64)| Some((symbols.find(name)?, *value));
        let others: Vec<(usize, i64)> = others.iter().filter_map(other).collect();
        let placed = layout::layout(&self.statements, &others, &mut symbols, &mut faults);
        if placed.end > layout::END {
            return Err(faults.0);
        }
        let assembly = emit::emit(&placed, &symbols, &mut faults);
        if faults.0.is_empty() {
            Ok(assembly)
        } else {
            Err(faults.0)
        }
    }
}

/// Reads a program's statements.
fn statements(
    source: &str,
    dialect: Dialect,
    symbols: &mut Symbols,
    faults: &mut Faults,
) -> Vec<parse::Statement> {
    let mut all = Vec::new();
    for (line, text) in (1u32..).zip(source.lines()) {
        let end = text.chars().count() as u32 + 1;
        let parsed = lexer::tokens(text, dialect)
            .and_then(|tokens| parse::line(&tokens, line, end, dialect, symbols, &mut all));
        if let Err(wrong) = parsed {
            let message = unread::construct(text, dialect).unwrap_or(wrong.message);
            faults.add(line, wrong.column, message);
        }
    }
    all
}

/// Assembles a program, or says all that is wrong with it.
///
/// # Errors
/// One fault a line at most, in the order of the lines within a pass, 100 in all.
pub fn assemble(source: &str) -> Result<Assembly, Vec<Fault>> {
    assemble_as(source, Dialect::Common)
}

/// The same for a program in some dialect.
///
/// # Errors
/// As for [`assemble`].
pub fn assemble_as(source: &str, dialect: Dialect) -> Result<Assembly, Vec<Fault>> {
    Parsed::of(source, dialect).assemble(&[])
}
