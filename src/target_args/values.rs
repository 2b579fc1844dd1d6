//! What options may be set to, by name.

use crate::failure::{Failure, Outcome};
use clap::ValueEnum;
use serde::{Deserialize, Serialize};

/// What may be done for the plan of one way among many.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Among {
    /// Work to make its program fit, in units of [`slowlight_compiler::fuel::Fuel`].
    pub fit: u64,
    /// Statements that may run to find the widths of values, in formats of several.
    pub modelled: u64,
}

/// An operating system for Jack programs.
#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum Os {
    /// The VM's own: a call counts as one VM instruction
    Native,
    /// Ours, written in Jack
    Jack,
}

/// How many pixels may be wrong, for people.
#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorGoal {
    /// 3% of the pixels
    Fast,
    /// 1%
    Balanced,
    /// 0.1%
    Exact,
}

impl ErrorGoal {
    /// As a share.
    pub fn share(self) -> f64 {
        match self {
            ErrorGoal::Fast => 0.03,
            ErrorGoal::Balanced => 0.01,
            ErrorGoal::Exact => 0.001,
        }
    }
}

/// Whether functions of what changes from pixel to pixel are looked up in tables.
#[derive(
    ValueEnum, Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
)]
#[serde(rename_all = "lowercase")]
pub enum Tables {
    /// Where that is quicker
    Yes,
    /// Each is worked out
    No,
}

impl Tables {
    /// As the option has it.
    pub fn word(self) -> &'static str {
        match self {
            Tables::Yes => "yes",
            Tables::No => "no",
        }
    }
}

/// How a program is written.
#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// To be quick: in BASIC one-letter names, long lines
    Fast,
    /// To be read: in BASIC the scene's names, a remark for each of its items
    Listing,
    /// To be posted to the BBC Micro Bot: on bbc:micro as few characters as it goes
    Toot,
}

/// Rows of a picture as rows of blocks.
pub(super) fn blocks_of((first, last): (u32, u32), high: u32) -> Outcome<(u32, u32)> {
    if first % high == 0 && (last + 1) % high == 0 {
        return Ok((first / high, last / high));
    }
    Err(Failure::Usage(format!(
        "--rows {first}..{last}: blocks are {high} rows high, so rows begin at a multiple of \
         {high} and end before one"
    )))
}
