//! The quarter squares that products are read from, where a program uses them: in the
//! program itself, or made in memory at the start.

use super::Text;
use super::memory::Machine;
use slowlight_routine::Part;
use slowlight_runtime_6502::squares::{PAGES, TABLES};

/// The part of the runtime that they are.
const PART: &str = "squares";

/// Where a program has the quarter squares from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Squares {
    Unused,
    /// It makes them, as files are short of room.
    Made,
    Stored,
}

impl Squares {
    pub fn of(machine: Machine, parts: &[&'static Part]) -> Squares {
        match (parts.iter().any(|part| part.name == PART), machine) {
            (false, _) => Squares::Unused,
            (true, Machine::Plain) => Squares::Stored,
            (true, Machine::Bbc | Machine::C64) => Squares::Made,
        }
    }

    /// Whether a part's text is not the program's.
    pub fn replace(self, part: &Part) -> bool {
        self == Squares::Stored && part.name == PART
    }

    /// The tables that are in a program.
    pub fn tables(self, text: &mut Text) {
        if self != Squares::Stored {
            return;
        }
        text.headline("quarter squares");
        text.line("; f(n) = floor(n n / 4), in four tables that begin at pages.");
        text.line(
            "; a b = f(a + b) - f(a - b), exactly: a + b and a - b are both even or both odd.",
        );
        for table in TABLES {
            text.label(table.label);
            text.bytes(table.bytes());
        }
    }

    /// Makes the tables, and the pointers' upper bytes.
    pub fn set(self, text: &mut Text) {
        match self {
            Squares::Unused => {}
            Squares::Made => text.code("jsr make_squares"),
            Squares::Stored => text.line(PAGES.trim_end()),
        }
    }
}
