//! Compiles Jack, the language of *The Elements of Computing Systems*
//! (Nisan and Schocken, chapters 9 to 11), to VM code.
//!
//! text → tokens ([`lexer`]) → tree ([`tree`], built by [`parser`]) → the
//! signatures of every class ([`classes`]) → checks and VM commands, class by
//! class ([`emit`]).
//!
//! The commands are those of the official compiler, in its order and with its
//! labels, so that counts of VM instructions agree with it: `let a[i] = e`
//! keeps `e` in `temp 0` while `pointer 1` is set, `while` negates its
//! condition bitwise (so it wants 0 or -1, which every comparison gives; `if`
//! takes anything but 0), there is no operator precedence, and nothing is
//! folded. One command differs: a constructor of a class without fields
//! allocates one word, as `Memory.alloc(0)` is an error of the OS.
//!
//! What the official compiler rejects is rejected here, except that types are
//! not compared: Jack lets an `int` stand for an address. What it takes and the
//! web IDE rejects is taken with a warning: types of unknown classes, and calls
//! of unknown classes or of functions that the OS does not have, which matter
//! only to a program that comes to them.

mod classes;
mod emit;
mod lexer;
mod parser;
mod statement;
mod symbols;
#[cfg(test)]
mod tests;
mod tree;
mod value;

use crate::Fault;
use classes::Classes;

/// Statics that all classes together may have: RAM words 16 to 255.
pub const STATICS: u32 = 240;

/// The largest constant and the largest index of a segment: what 15 bits hold.
pub const LARGEST: u16 = 32_767;

/// How deep expressions and statements may nest, together.
pub const NESTING: u32 = 256;

/// Faults reported at most; what comes after them is left out.
const FAULTS: usize = 100;

/// One class as VM code.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VmFile {
    /// `Class.vm`.
    pub name: String,
    /// The commands, one a line; every line ends in a line feed.
    pub text: String,
    /// For each of those lines, the line of the class (from 1) that it comes from.
    pub lines: Vec<u32>,
    /// How many statics the class has: indices 0 up to this of its `static` segment.
    pub statics: u32,
}

/// Compiles a program: for each file its name (`Main.jack`, folders before it
/// allowed) and its text. The answers come in the same order.
///
/// The classes of the standard OS are known, except those that the program
/// brings itself, which replace them whole.
///
/// # Errors
/// Everything that is wrong, in the order of the files, at most 100 faults,
/// each with its place.
pub fn compile(files: &[(String, String)]) -> Result<Vec<VmFile>, Vec<Fault>> {
    compile_warning(files, &mut Vec::new())
}

/// The same; adds to `warnings` what is accepted and may be a mistake, at most 100,
/// each with its place.
///
/// # Errors
/// Those of [`compile`].
pub fn compile_warning(
    files: &[(String, String)],
    warnings: &mut Vec<Fault>,
) -> Result<Vec<VmFile>, Vec<Fault>> {
    let mut faults = Faults::default();
    let mut parsed = Vec::with_capacity(files.len());
    for (file, text) in files {
        faults.file = file;
        if let Some(class) = parser::parse(text, &mut faults) {
            parsed.push((file.as_str(), class));
        }
    }
    faults.check()?;
    let classes = Classes::of(&parsed, &mut faults);
    let mut compiled = Vec::with_capacity(parsed.len());
    let mut statics = 0;
    for (file, class) in &parsed {
        faults.file = file;
        compiled.push(emit::class(class, &classes, &mut statics, &mut faults));
    }
    faults.check()?;
    warnings.append(&mut faults.warnings);
    Ok(compiled)
}

/// Where a token begins, from 1; a column is a character.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Place {
    line: u32,
    column: u32,
}

/// The faults so far, and the file at hand.
#[derive(Default)]
struct Faults<'a> {
    file: &'a str,
    list: Vec<Fault>,
    /// What is accepted and may be a mistake.
    warnings: Vec<Fault>,
}

impl Faults<'_> {
    fn add(&mut self, place: Place, message: impl Into<String>) {
        if !self.full() {
            let fault = self.at(place, message.into());
            self.list.push(fault);
        }
    }

    fn warn(&mut self, place: Place, message: impl Into<String>) {
        if self.warnings.len() < FAULTS {
            let fault = self.at(place, message.into());
            self.warnings.push(fault);
        }
    }

    fn at(&self, place: Place, message: String) -> Fault {
        Fault {
            message,
            file: Some(self.file.to_string()),
            line: Some(place.line),
            column: Some(place.column),
        }
    }

    fn full(&self) -> bool {
        self.list.len() >= FAULTS
    }

    fn check(&mut self) -> Result<(), Vec<Fault>> {
        if self.list.is_empty() {
            Ok(())
        } else {
            Err(std::mem::take(&mut self.list))
        }
    }
}
