//! From a plan to 6502 assembly.
//!
//! The text assembles with the bundled assembler, and with ca65 as
//! `ca65 --feature pc_assignment`, to the same bytes; other assemblers have theirs
//! (see [`syntax`]). It reads from the top:
//!
//! 1. the parameter block: what may be changed, as scaled integers;
//! 2. the ports of the machine, the runtime's zero page, the homes of values;
//! 3. tables that are to begin at pages (`first`);
//! 4. the program: once a picture, once a row, once a pixel;
//! 5. constant tables, and the parts of the runtime that are used.
//!
//! A value lives in memory: in the zero page those that are used most (loops
//! count eightfold), the others before the program or behind it. Routines are
//! written as [`slowlight_runtime_6502::write`] says; a condition that the next
//! statement branches on stays in the carry flag, or in the sign that this would come from.
//!
//! - `memory`: the machines, and what of their memory is left to a program;
//! - `screen`: what is drawn on; `ports`, `blocks`: the plain machine's; `bitmap`: memory;
//!   `bbc`, `c64`: those machines' beginnings and ends;
//! - `homes`: where values live and what they are called; `shapes`: in how many bytes;
//! - `uses`: how often they are met; `columns`: arrays by columns;
//! - `moved`: reals that are kept at a second scale;
//! - `scaled`: reals with points of their own, read where they are wanted;
//! - `code`: statements; `comparisons`: in the carry; `table`: lookups; `comment`: what a
//!   statement means;
//! - `logs`: logarithmic reals; `inline`: products in place;
//! - `draft`: a program before it is read again as a whole, and behind that; `extent`: how
//!   long it is;
//! - `params`: the parameter block's checks; `frame`: everything around the statements;
//!   `rows`: the loops over rows, passes, runs of columns and pixels;
//! - `spread`: error diffusion; `squares`: tables of quarter squares.

mod bbc;
mod bitmap;
mod blocks;
mod c64;
mod code;
mod columns;
mod comment;
mod comparisons;
mod draft;
mod extent;
mod first;
mod frame;
mod homes;
mod in_place;
mod inline;
mod layout;
mod logs;
mod memory;
#[cfg(test)]
mod memory_tests;
mod moved;
mod names;
mod params;
mod ports;
#[cfg(test)]
mod quotient_tests;
mod refine;
mod reports;
mod rows;
mod scaled;
mod screen;
mod shapes;
mod slots;
mod spread;
mod squares;
mod starts;
mod steps;
pub mod syntax;
pub use steps::{Held, held};
mod table;
#[cfg(test)]
mod tests;
mod uses;
pub mod vcs;

use super::Document;
use crate::plan::Plan;
use crate::source::Span;
use crate::targets::System;
pub use draft::Draft;
use memory::Machine;
pub use memory::{DISC_PAGE, LEAST_PAGE, Room, bytes_of_room};
pub use params::ROWS;
pub(super) use starts::starts;
use syntax::Syntax;

/// Writes a plan down as one file of assembly.
pub(super) fn emit(plan: &Plan) -> Vec<Document> {
    if plan.target.system == System::Vcs {
        return vcs::cartridge(plan)
            .map(|made| made.document)
            .into_iter()
            .collect();
    }
    vec![document(plan, syntax::USUAL)]
}

/// A plan as one file of assembly for some assembler.
pub fn document(plan: &Plan, syntax: &Syntax) -> Document {
    let mut draft = Draft::with(plan, syntax);
    draft.tidy();
    draft.document()
}

/// Where the file of a plan's program is loaded, if not where it is assembled for.
pub fn moved_from(plan: &Plan) -> Option<u16> {
    match Machine::of(plan) {
        Machine::Bbc => bbc::moved_from(&homes::Homes::new(plan).places),
        Machine::Plain | Machine::C64 => None,
    }
}

/// Lines of assembly, each with the place in the scene that it comes from.
#[derive(Default)]
struct Text {
    lines: Vec<(String, Option<Span>)>,
    /// The place that lines come from now.
    span: Option<Span>,
    /// Makes labels unique.
    serial: u32,
    /// The symbol of the factor that the pointers into the quarter squares are for, where
    /// that is known: no way comes here from elsewhere, and nothing else set them.
    kept: Option<String>,
}

impl Text {
    /// A line as it stands; several if it has line ends.
    fn line(&mut self, text: impl AsRef<str>) {
        for line in text.as_ref().split('\n') {
            if self.kept.as_deref().is_some_and(|kept| forgets(line, kept)) {
                self.kept = None;
            }
            self.lines.push((line.to_owned(), self.span));
        }
    }

    /// Instructions, separated by `|`.
    fn code(&mut self, instructions: &str) {
        for instruction in instructions.split('|') {
            self.line(format!("        {}", instruction.trim()));
        }
    }

    /// Bytes of a table, sixteen a line.
    fn bytes(&mut self, bytes: impl Iterator<Item = u8>) {
        let bytes: Vec<String> = bytes.map(|byte| byte.to_string()).collect();
        for row in bytes.chunks(16) {
            self.line(format!("        .byte {}", row.join(", ")));
        }
    }

    fn label(&mut self, name: &str) {
        self.kept = None;
        self.line(format!("{name}:"));
    }

    fn next_serial(&mut self) -> u32 {
        self.serial += 1;
        self.serial
    }

    /// What was written elsewhere, as if it had been written here: labels were made there only.
    fn append(&mut self, other: Text) {
        self.lines.extend(other.lines);
        (self.span, self.serial, self.kept) = (other.span, other.serial, other.kept);
    }

    /// A headline over a part of the program.
    fn headline(&mut self, title: &str) {
        self.line("");
        self.line(format!("; ---- {title}"));
    }
}

/// Whether an instruction changes a symbol's value, or may set the pointers into the quarter
/// squares.
fn forgets(line: &str, kept: &str) -> bool {
    let mut words = line.split_whitespace();
    match (words.next(), words.next()) {
        (Some("jsr" | "jmp" | "rts"), _) => true,
        (Some("sta" | "stx" | "sty" | "inc" | "dec" | "asl" | "lsr" | "rol" | "ror"), Some(to)) => {
            to.split('+').next() == Some(kept)
        }
        _ => false,
    }
}
