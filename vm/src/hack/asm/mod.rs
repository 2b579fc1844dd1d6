//! The Hack assembler (*The Elements of Computing Systems*, chapter 6), and
//! images of the ROM as texts.
//!
//! ```text
//! // draws a word
//!     @SCREEN     // A = 16384
//!     M=-1        // sixteen black pixels
//! (END)           // a label: the address of the next instruction
//!     @END
//!     0;JMP
//! ```
//!
//! Symbols are letters, digits, `_`, `.`, `$` and `:`; only digits are a number. `SP LCL ARG THIS THAT`, `R0` to `R15`, `SCREEN` and `KBD` are known;
//! what is neither known nor a label is a variable, from 16 upwards in the order
//! of first use. Blanks mean nothing. Destinations stand in any order (`MD`,
//! `DM`), and so do the operands of `+`, `&` and `|`.

mod image;
pub mod instruction;
mod parse;
#[cfg(test)]
mod tests;

pub use image::{read_image, write_image};

use crate::Fault;
use instruction::{LARGEST, written};
use parse::{Statement, Value, statement};
use std::collections::HashMap;

/// Words that the ROM holds.
pub const ROM_WORDS: usize = 32_768;

/// The address of the first variable.
const VARIABLES: u16 = 16;
/// The first address that no variable can have: the screen's.
const SCREEN: u16 = 16_384;
const KEYBOARD: u16 = 24_576;

/// No more than this many faults are reported.
const FAULTS: usize = 100;

/// A program, assembled.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Assembly {
    /// The instructions.
    pub words: Vec<u16>,
    /// For each instruction its line in the source, from 1.
    pub lines: Vec<u32>,
}

/// Where things go wrong, collected up to a limit.
#[derive(Default)]
struct Faults(Vec<Fault>);

impl Faults {
    fn add(&mut self, line: u32, message: String) {
        if self.0.len() < FAULTS {
            self.0.push(Fault {
                message,
                file: None,
                line: Some(line),
                column: None,
            });
        }
    }
}

/// What a program of too many words is refused with.
pub fn overflow(words: usize) -> Option<String> {
    let over = words.checked_sub(ROM_WORDS).filter(|over| *over > 0)?;
    Some(format!(
        "the program has {words} instructions, {over} more than the ROM's {ROM_WORDS} words"
    ))
}

/// Assembles a program.
///
/// # Errors
/// What is wrong with it, by line; at most a hundred faults.
pub fn assemble(source: &str) -> Result<Assembly, Vec<Fault>> {
    let mut faults = Faults::default();
    let mut symbols = Symbols::new();
    let mut code = Vec::new();
    for (line, text) in (1..).zip(source.lines()) {
        match statement(text) {
            Ok(None) => {}
            Ok(Some(Statement::Label(name))) => {
                if let Err(message) = symbols.label(name, code.len(), line) {
                    faults.add(line, message);
                }
            }
            Ok(Some(Statement::Instruction(value))) => code.push((line, value)),
            Err(message) => faults.add(line, message),
        }
    }
    let mut words = Vec::with_capacity(code.len());
    for (line, value) in &code {
        let word = match value {
            Value::Word(word) => Ok(*word),
            Value::Symbol(name) => symbols.value(name),
        };
        match word {
            Ok(word) => words.push(word),
            Err(message) => faults.add(*line, message),
        }
    }
    if let (Some(message), Some((line, _))) = (overflow(code.len()), code.get(ROM_WORDS)) {
        faults.add(*line, message);
    }
    if faults.0.is_empty() {
        let lines = code.iter().map(|(line, _)| *line).collect();
        Ok(Assembly { words, lines })
    } else {
        Err(faults.0)
    }
}

/// The instructions of a program, one a line, without symbols. A word that is
/// no known computation stands in a comment.
pub fn disassemble(words: &[u16]) -> String {
    let mut text = String::new();
    for word in words {
        match written(*word) {
            Some(instruction) => text.push_str(&instruction),
            None => text.push_str(&format!("// {word:016b}")),
        }
        text.push('\n');
    }
    text
}

/// Whether a name has a value in every program.
pub fn is_predefined(name: &str) -> bool {
    Symbols::new().known.contains_key(name)
}

/// What a symbol stands for.
#[derive(Clone, Copy)]
struct Symbol {
    value: usize,
    /// The line of a label.
    line: Option<u32>,
}

struct Symbols {
    known: HashMap<String, Symbol>,
    next: u16,
}

impl Symbols {
    fn new() -> Self {
        let named = [("SP", 0), ("LCL", 1), ("ARG", 2), ("THIS", 3), ("THAT", 4)];
        let devices = [
            ("SCREEN", usize::from(SCREEN)),
            ("KBD", usize::from(KEYBOARD)),
        ];
        let fixed = named.iter().chain(&devices);
        let registers = (0..16).map(|k| (format!("R{k}"), k));
        let all = fixed.map(|(name, value)| ((*name).to_owned(), *value));
        let symbol = |(name, value)| (name, Symbol { value, line: None });
        Symbols {
            known: all.chain(registers).map(symbol).collect(),
            next: VARIABLES,
        }
    }

    /// A label for the instruction at `value`.
    fn label(&mut self, name: &str, value: usize, line: u32) -> Result<(), String> {
        match self.known.get(name) {
            Some(Symbol {
                line: Some(first), ..
            }) => Err(format!(
                "a second label {name}: the first is in line {first}"
            )),
            Some(_) => Err(format!("{name} cannot be a label: it is predefined")),
            None => {
                let line = Some(line);
                self.known.insert(name.to_owned(), Symbol { value, line });
                Ok(())
            }
        }
    }

    /// The value of a symbol: that of a new variable where it is not known.
    fn value(&mut self, name: &str) -> Result<u16, String> {
        if let Some(symbol) = self.known.get(name) {
            // Only a label of a program that is too long, which is said elsewhere.
            return Ok((symbol.value as u16).min(LARGEST));
        }
        let value = self.next;
        if value >= SCREEN {
            return Err(format!(
                "no memory is left for the variable {name}: they lie from {VARIABLES} to {}",
                SCREEN - 1
            ));
        }
        self.next += 1;
        let symbol = Symbol {
            value: usize::from(value),
            line: None,
        };
        self.known.insert(name.to_owned(), symbol);
        Ok(value)
    }
}
