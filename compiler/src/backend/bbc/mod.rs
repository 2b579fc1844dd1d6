//! From a plan to BBC BASIC.
//!
//! One program serves BASIC II, the Agon and Brandy. It reads from the top:
//!
//! 1. the parameter block: what may be changed, as decimals, and which rows to draw;
//! 2. the picture: once a frame, a FOR over rows, a FOR over columns;
//! 3. `PROCsetup`: checks the parameters, then constants, tables;
//! 4. the runtime's functions, and DATA.
//!
//! A value lives in a variable, real or integer by its `%`, or is written where it is read
//! once. Decimal constants live in variables too: BASIC II takes three times as long to read
//! one from the text. What is resident (`I% R% X% Y%`) is quick: the pixel's ink, its row's
//! height on the screen, its column and row.
//!
//! What BASIC II asks for and the others bear: a space after a name before a keyword, DATA
//! first on its line, lines under 250 characters, MODE outside procedures, never more than one
//! ELSE on a line, no loops over fractions.
//!
//! - `lines`: lines with labels, numbered at the end; `names`; `expression`: values; `text`:
//!   their text; `guard`: tests in place of functions; `version`: one test
//!   for a run of assignments;
//! - `code`: statements; `frame`: everything around them; `screen`: modes, colours, coordinates;
//! - `poke`: pixels put into the Micro's memory; `passes`: rows drawn every nth column at a time;
//! - `ramp`: ints that are stepped from column to column; `reads`: what a pixel reads;
//! - `spread`: error diffusion; `thread`, `tail`, `dead`: fewer jumps and flags; `short`: short names and lines, for speed and for size;
//! - `toot`: a program in as few characters as it goes, in the form of a post; `strings`: its tables;
//! - `pieces`: statements cut into names and words; `terse`: the same said shorter.

mod asked;
mod code;
mod columns;
mod dead;
#[cfg(test)]
mod dead_tests;
mod expression;
mod frame;
mod guard;
mod lines;
mod names;
mod passes;
mod pieces;
mod poke;
mod procedure;
mod ramp;
mod reads;
mod refine;
mod screen;
mod segment;
mod short;
mod spread;
mod starts;
mod steps;
mod strings;
mod tables;
mod tail;
mod terse;
mod test_line;
#[cfg(test)]
mod tests;
mod text;
mod thread;
mod toot;
mod turns;
mod version;
mod ways;

pub(super) use screen::{colours, first_colour};
pub(super) use starts::starts;
pub(super) use steps::key;
pub use steps::{Held, held};

use super::Document;
use crate::plan::Plan;
use slowlight_routine::{Part, Source};

/// How a program is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Style {
    /// To be read: the scene's names, short lines, a remark for each item.
    Listing,
    /// To be quick: one-letter names, few spaces, long lines.
    Fast,
    /// The same, with function calls in place of tests and two ways to
    /// compute, which take memory, but in loops.
    Lean,
    /// To be small: the same, and constants where they are read.
    Small,
    /// To be posted: as few characters as it goes ([`toot`]).
    Toot,
}

impl Style {
    fn of(plan: &Plan) -> Style {
        match plan {
            Plan { toot: true, .. } => Style::Toot,
            Plan { tight: true, .. } => Style::Small,
            Plan { lean: true, .. } => Style::Lean,
            Plan { listing: true, .. } => Style::Listing,
            _ => Style::Fast,
        }
    }
}

pub(super) fn emit(plan: &Plan) -> Vec<Document> {
    if plan.toot {
        return toot::emit(plan);
    }
    let program = frame::program(plan);
    let later = program.later();
    let (text, lines) = program.finish();
    vec![Document {
        name: format!("{}.bas", plan.name),
        text,
        lines,
        later,
    }]
}

/// Whether a part is carried out before anything else, not called.
fn is_first(part: &Part) -> bool {
    matches!(part.source, Source::Text(text) if !text.starts_with("DEF"))
}
