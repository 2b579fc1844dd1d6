//! The tables that stand first in a program, from a page's beginning, so that an index into
//! them crosses into no other page than it has to, which would take a cycle more: the quarter
//! squares, and what sums of logarithms are looked up in. The latter begin one byte later each
//! than the one before, which hardly any index meets.
//!
//! Nothing is left empty for that on the plain machine, where the first instruction, a jump
//! over the tables, ends the page before. A Commodore 64 has its line of BASIC there: its page
//! is filled up where there is memory for speed.

use super::Text;
use super::memory::{JUMP, Machine};
use super::squares::Squares;
use crate::plan::{Copies, Plan};
use slowlight_routine::{Part, Source};

/// The parts of the runtime that are such tables, beside the quarter squares.
const TABLES: [&str; 2] = ["log_sums", "log_lost"];

/// Bytes of a Commodore 64's line of BASIC and of the jump to what begins behind the tables, in
/// a page that begins with the byte before.
const BEFORE: u16 = 1 + 12 + JUMP;

pub(super) struct First {
    machine: Machine,
    squares: Squares,
    tables: Vec<&'static Part>,
}

impl First {
    pub fn of(plan: &Plan, parts: &[&'static Part]) -> First {
        let machine = Machine::of(plan);
        let may = match machine {
            Machine::Plain => true,
            Machine::C64 => plan.copies >= Copies::Tables,
            Machine::Bbc => false,
        };
        let is = |part: &&&Part| may && TABLES.contains(&part.name);
        First {
            machine,
            squares: Squares::of(machine, parts),
            tables: parts.iter().filter(is).copied().collect(),
        }
    }

    /// Whether a part's text does not stand among the others.
    pub fn has(&self, part: &Part) -> bool {
        self.squares.replace(part) || self.tables.iter().any(|table| table.name == part.name)
    }

    fn is_empty(&self) -> bool {
        self.squares != Squares::Stored && self.tables.is_empty()
    }

    /// Where a program begins that would otherwise begin at a page.
    pub fn origin(&self, page: u16) -> u16 {
        match self.machine {
            Machine::Plain if !self.is_empty() => page.saturating_sub(JUMP),
            _ => page,
        }
    }

    /// Behind what a program begins with, in which its first instruction is not: the tables,
    /// and the label of that.
    pub fn write(&self, text: &mut Text) {
        if !self.is_empty() {
            text.code("jmp begin");
            if self.machine == Machine::C64 {
                text.bytes(std::iter::repeat_n(0, usize::from(0x100 - BEFORE)));
            }
            self.squares.tables(text);
            for part in &self.tables {
                text.headline(&format!("runtime: {}", part.name));
                if let Source::Table(make) = part.source {
                    text.label(part.name);
                    text.bytes(make().into_iter().map(|b| (b & 0xFF) as u8));
                }
            }
            text.headline("once a picture");
        }
        if !self.is_empty() || self.machine == Machine::C64 {
            text.label("begin");
        }
    }
}
