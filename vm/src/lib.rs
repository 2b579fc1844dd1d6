//! The machines, knowing nothing of the compiler.
//!
//! Every machine is bounded: a run ends when the program ends, when a cycle
//! limit is reached, when the watcher says stop, or with a fault that names
//! its place. No input (source text, tokens, ROM image) makes one panic.

pub mod bbc;
mod charge;
pub mod hack;
pub mod keys;
pub mod mos6502;

pub use charge::{Charge, Charges, Roles};

use std::fmt;

/// What a machine's screen shows when it stops.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Screen {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// One ink index a pixel, row by row from the top left; `width * height` long.
    pub pixels: Vec<u8>,
    /// What each ink looks like, as red, green and blue; indexed by ink.
    pub palette: Vec<[u8; 3]>,
}

/// Where a program went wrong, and how.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct Fault {
    /// What happened and, where known, a way out.
    pub message: String,
    /// The source file, if the machine knows it.
    pub file: Option<String>,
    /// The line (1-based; a BASIC line number for BASIC), if known.
    pub line: Option<u32>,
    /// The column (1-based), if known.
    pub column: Option<u32>,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{file}:")?;
        }
        if let Some(line) = self.line {
            write!(f, "{line}:")?;
            if let Some(column) = self.column {
                write!(f, "{column}:")?;
            }
        }
        if self.file.is_some() || self.line.is_some() {
            write!(f, " ")?;
        }
        f.write_str(&self.message)
    }
}

/// Why a run ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Stop {
    /// The program ended by itself.
    Ended,
    /// The cycle limit was reached first.
    CycleLimit,
    /// The watcher asked for it.
    Interrupted,
    /// The program did something that the machine cannot carry on from.
    Fault(Fault),
}

/// How far a run has come; given to the watcher now and then.
#[derive(Clone, Copy)]
pub struct Progress<'m> {
    /// The machine's own cycles so far (VM instructions on the Hack VM).
    pub cycles: u64,
    /// The row of the last pixel drawn, from the top of the screen; `None` before the first.
    pub row: Option<u32>,
    /// What the screen shows at this moment, made when it is asked for; `None` where the
    /// program has opened none.
    pub screen: &'m dyn Fn() -> Option<Screen>,
}

/// Called about every ten million cycles; answers whether to go on.
pub type Watch<'a> = &'a mut dyn FnMut(Progress<'_>) -> bool;
