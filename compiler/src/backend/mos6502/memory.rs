//! The machines that programs are written for, and what memory each leaves to them.
//!
//! | | plain | BBC Micro | Commodore 64 |
//! |---|---|---|---|
//! | zero page | all | &00-&8F, &A8-&CF: the language's and what the disc uses | all but $00 and $01: kept, and put back at the end |
//! | quarter squares | the program's first 2K | &400 (the language's), &900-&CFF (cassette, keys, letters) | $D000, under the circuits |
//! | values, errors | from $0200 | from PAGE | below $CB00 |
//! | program | behind those | behind those, up to the screen | from $0801 up to those |
//! | screen | ports | as much as the picture takes, up to &8000 | $E000, its colours at $CC00 |

use super::layout::Layout;
use crate::plan::ErrorRows;
use crate::plan::Plan;
use crate::targets::System;
use slowlight_runtime_6502::write;
use slowlight_runtime_6502::{FREE_MEMORY, free_zero_page};
use std::ops::Range;

/// Where the disc system of a BBC Micro leaves memory to programs.
pub const DISC_PAGE: u16 = 0x1900;
/// Where programs may begin once the disc is not needed any more.
pub const LEAST_PAGE: u16 = 0x0E00;
/// Where the text screen begins that is there while a file is loaded.
const TEXT_SCREEN: u16 = 0x7C00;
/// Where a BASIC program of the Commodore 64 begins.
pub(super) const C64_ORIGIN: u16 = 0x0801;
/// What its program and values may take ends here, below what is kept of the ROMs'.
const C64_END: u16 = 0xCB00;

/// A machine that programs are written for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Machine {
    Plain,
    Bbc,
    C64,
}

/// Where a program's parts go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Places {
    /// The first value that is not in the zero page.
    pub values: u16,
    /// Rows of errors.
    pub errors: u16,
    /// The program's first byte; on the plain machine the first behind the jump that begins
    /// it, where there is one.
    pub origin: u16,
}

/// What a program may take of its machine's memory, and what of that its values do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Room {
    /// Bytes for values and program together.
    pub bytes: u64,
    /// Bytes of the values, rows of errors among them, and of what is made at the start
    /// where that takes of the same memory.
    pub values: u64,
    /// So many bytes more may what is done once take, which stands last.
    pub once: u64,
}

impl Machine {
    pub fn of(plan: &Plan) -> Machine {
        match plan.target.system {
            System::BbcCode => Machine::Bbc,
            System::C64 => Machine::C64,
            _ => Machine::Plain,
        }
    }

    /// What it is called in a program's head.
    pub fn about(self) -> &'static str {
        match self {
            Machine::Plain => "a plain 6502",
            Machine::Bbc => "a BBC Micro",
            Machine::C64 => "a Commodore 64",
        }
    }

    /// By how much the runtime's zero page stands higher than usual.
    fn page_shift(self) -> u16 {
        match self {
            // The processor's port is in the first two bytes.
            Machine::C64 => 2,
            _ => 0,
        }
    }

    /// What of the zero page is left to values.
    pub fn zero_page(self, plan: &Plan) -> Vec<Range<u16>> {
        let first = u16::from(free_zero_page(plan.runtime)) + self.page_shift();
        match self {
            Machine::Bbc => vec![first..0x90, 0xA8..0xD0],
            Machine::Plain | Machine::C64 => vec![first..0x100; 1],
        }
    }

    /// Where everything goes, given the bytes of the values that are not in the zero page
    /// and those of the rows of errors.
    pub fn places(self, plan: &Plan, values: u16, errors: u16) -> Places {
        match self {
            Machine::Plain => {
                let page_from = |at: u16| at.saturating_add(0xFF) & 0xFF00;
                let values_end = FREE_MEMORY.saturating_add(values);
                let errors_at = page_from(values_end);
                let end = match errors {
                    0 => values_end,
                    _ => errors_at.saturating_add(errors),
                };
                // A page of its own keeps the program's addresses easy to read, and tables
                // of squares quick; the jump over these is before it.
                Places {
                    values: FREE_MEMORY,
                    errors: errors_at,
                    origin: page_from(end.saturating_add(JUMP)),
                }
            }
            Machine::Bbc => {
                let page = plan.page.unwrap_or(LEAST_PAGE);
                let behind = page.saturating_add(values);
                Places {
                    values: page,
                    errors: behind,
                    origin: behind.saturating_add(errors),
                }
            }
            Machine::C64 => {
                let errors_at = C64_END.saturating_sub(errors);
                Places {
                    values: errors_at.saturating_sub(values),
                    errors: errors_at,
                    origin: C64_ORIGIN,
                }
            }
        }
    }

    /// Where it has memory for a plan's program and values, from an address and to another.
    pub fn free(self, plan: &Plan) -> (u16, u16) {
        match self {
            Machine::Plain => (0, 0xFF00),
            Machine::Bbc => {
                let screen = Layout::of(plan).map_or(TEXT_SCREEN, |layout| layout.lowest(plan));
                (plan.page.unwrap_or(LEAST_PAGE), screen.min(TEXT_SCREEN))
            }
            Machine::C64 => (C64_ORIGIN, C64_END),
        }
    }

    /// What a program with these places may take.
    pub fn room(self, plan: &Plan, places: &Places) -> Room {
        let (from, end) = self.free(plan);
        let values = match self {
            Machine::Plain => places.origin,
            Machine::Bbc => places.origin.saturating_sub(places.values),
            Machine::C64 => C64_END.saturating_sub(places.values),
        };
        // What is done once may be where the screen will be, but not beyond that of text; and a
        // file that moves itself down is loaded higher.
        let last = match self {
            Machine::Bbc if places.origin < DISC_PAGE => {
                (places.origin + (TEXT_SCREEN - DISC_PAGE)).min(TEXT_SCREEN)
            }
            Machine::Bbc => TEXT_SCREEN,
            _ => end,
        };
        let end = end.min(last);
        Room {
            bytes: u64::from(end.saturating_sub(from)),
            values: u64::from(values),
            once: u64::from(last - end),
        }
    }

    /// The text of a part of the runtime, its addresses where they are on this machine.
    pub fn placed(self, lines: &str) -> String {
        let squares: [(&str, u16); 4] = match self {
            Machine::Plain => return lines.to_owned(),
            // Whole zeros stand where BREAK looks for a key's text (&B00): its high bytes.
            Machine::Bbc => [
                ("sqr_lo", 0x400),
                ("sqd_lo", 0x600),
                ("sqd_hi", 0x900),
                ("sqr_hi", 0xB00),
            ],
            Machine::C64 => [
                ("sqr_lo", 0xD000),
                ("sqr_hi", 0xD200),
                ("sqd_lo", 0xD400),
                ("sqd_hi", 0xD600),
            ],
        };
        let placed = lines.lines().map(|line| {
            let Some((name, rest)) = line.split_once(" = $") else {
                return line.to_owned();
            };
            let end = rest.find(' ').unwrap_or(rest.len());
            let (digits, behind) = rest.split_at(end);
            let table = squares.iter().find(|(n, _)| *n == name);
            match (table, u16::from_str_radix(digits, 16)) {
                (Some((_, at)), _) => format!("{name} = ${at:04x}{behind}"),
                // What is in the zero page is written with two digits.
                (None, Ok(at)) if digits.len() == 2 => {
                    format!("{name} = ${:02x}{behind}", at + self.page_shift())
                }
                _ => line.to_owned(),
            }
        });
        placed.collect::<Vec<_>>().join("\n")
    }
}

/// What a plan's machine has for its program and values, in bytes.
pub fn bytes_of_room(plan: &Plan) -> u64 {
    let (from, end) = Machine::of(plan).free(plan);
    u64::from(end.saturating_sub(from))
}

/// Bytes of a plan's rows of errors, or of what its pixels leave.
pub(super) fn error_bytes(plan: &Plan) -> Option<u16> {
    let errors = plan.error_rows().map(|rows| row_bytes(plan, &rows));
    let bytes = errors.or(plan.kept_rows().map(|rows| rows.bytes()))?;
    Some(u16::try_from(bytes).unwrap_or(0xFF00))
}

/// Bytes of the jump over the tables.
pub(super) const JUMP: u16 = 3;

/// Bytes of all rows.
pub(super) fn row_bytes(plan: &Plan, rows: &ErrorRows) -> u32 {
    rows.rows * rows.length() * error_size(plan)
}

/// Bytes of an error.
pub(super) fn error_size(plan: &Plan) -> u32 {
    u32::from(write::size(plan.runtime.real))
}
