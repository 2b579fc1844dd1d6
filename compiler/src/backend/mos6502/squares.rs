//! The quarter squares that products are read from, where a program uses them: in the
//! program itself, or made in memory at the start.
//!
//! In the program they stand first, from a page's beginning, so that nothing has to be left
//! empty for that. The first instruction, a jump over them, ends the page before.

use super::Text;
use super::memory::{JUMP, Machine};
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

    /// Where a program begins that would otherwise begin at a page.
    pub fn origin(self, page: u16) -> u16 {
        match self {
            Squares::Stored => page.saturating_sub(JUMP),
            Squares::Unused | Squares::Made => page,
        }
    }

    /// Behind the program's first label: the tables that are in it.
    pub fn tables(self, text: &mut Text) {
        if self != Squares::Stored {
            return;
        }
        text.code("jmp begin");
        text.headline("quarter squares");
        text.line("; f(n) = floor(n n / 4), in four tables that begin at pages.");
        text.line(
            "; a b = f(a + b) - f(a - b), exactly: a + b and a - b are both even or both odd.",
        );
        for table in TABLES {
            text.label(table.label);
            text.bytes(table.bytes());
        }
        text.headline("once a picture");
        text.label("begin");
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
