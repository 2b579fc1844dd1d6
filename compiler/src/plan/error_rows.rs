//! Error diffusion buffers: rings of rows, with margins, as a program keeps them.
//!
//! What a pixel sends waits in a row of errors until the pixel that it goes to
//! is drawn. A share reaches some rows down, so that many rows and the one
//! being drawn are kept, and the row that is done becomes the furthest one: a
//! pixel takes what it received and leaves 0 behind. Shares that leave the
//! picture to the left or right fall into margins that nothing reads; those
//! that leave it below wait for rows that are never drawn. So no share needs a
//! test.

use super::Plan;
use crate::ir::graph::Share;

/// The rows of errors that a program keeps.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ErrorRows {
    /// What each pixel sends, in the order in which it is added.
    pub shares: Vec<Share>,
    /// Rows kept: the one being drawn and those that a share reaches; at least 1.
    pub rows: u32,
    /// Columns left of the picture that a share may reach.
    pub left: u32,
    /// Columns right of the picture that a share may reach.
    pub right: u32,
    /// Columns of the picture.
    pub width: u32,
}

impl ErrorRows {
    /// Errors in a row, margins included.
    pub fn length(&self) -> u32 {
        self.left + self.width + self.right
    }
}

impl Plan {
    /// The rows of errors, where the graph spreads its error.
    pub fn error_rows(&self) -> Option<ErrorRows> {
        let diffusion = self.graph.diffusion.as_ref()?;
        let furthest = |side: fn(&Share) -> i32| {
            let all = diffusion.shares.iter().map(side);
            u32::try_from(all.max().unwrap_or(0)).unwrap_or(0)
        };
        Some(ErrorRows {
            shares: diffusion.shares.clone(),
            rows: diffusion.reach() as u32 + 1,
            left: furthest(|s| -s.dx),
            right: furthest(|s| s.dx),
            width: self.graph.image.width,
        })
    }
}
