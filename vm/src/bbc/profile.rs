//! Where a program's cycles go, line by line.
//!
//! A line is charged with what it does itself, and what a function called from it
//! takes to the function's lines; or, for lines that are routines', to the caller's
//! line ([`crate::Charge`]).

use crate::charge::{Charges, Ledger, Roles};

/// What one line of a program took.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LineCost {
    /// The line's number.
    pub line: u16,
    /// How often it was begun.
    pub times: u64,
    /// Cycles of 2 MHz, without those of the functions that it called.
    pub cycles: u64,
}

/// A statement of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StatementPlace {
    /// Its line's index.
    pub line: u32,
    /// Its number in the line, from 0; colons part statements, ELSE does not.
    pub statement: u32,
    /// Bytes of tokens that it takes, a line's first with the line's head.
    pub bytes: u32,
}

/// Counts of a run, by the index of the statement.
#[derive(Clone, Debug, Default)]
pub(crate) struct Profile {
    ledger: Ledger,
    at: At,
    /// The cycles when that began.
    since: u64,
}

/// What is being carried out.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct At {
    /// The statement.
    pub statement: u32,
    /// How many calls deep.
    pub depth: u32,
    /// Whether the statement begins here.
    pub begins: bool,
}

impl Profile {
    pub fn new(statements: usize, roles: Roles<'_>) -> Self {
        Self {
            ledger: Ledger::new(statements, roles),
            ..Self::default()
        }
    }

    /// Goes on to something else; answers what was left.
    pub fn enter(&mut self, at: At, now: u64) -> At {
        let left = self.at;
        let cycles = now.saturating_sub(self.since);
        self.ledger
            .step(left.statement, left.depth, cycles, left.begins);
        self.since = now;
        std::mem::replace(&mut self.at, at)
    }

    /// The charges, in cycles of 2 MHz.
    pub fn finish(mut self, now: u64) -> Charges {
        self.enter(At::default(), now);
        self.ledger.finish()
    }
}
