//! Where a program's cycles go, line by line.
//!
//! A line is charged with what it does itself: what a function called from it
//! takes is charged to the function's lines.

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

/// Counts of a run, by the index of the line.
#[derive(Clone, Debug, Default)]
pub(crate) struct Profile {
    pub times: Vec<u64>,
    pub cycles: Vec<u64>,
    /// The line being carried out, and the cycles when that began.
    at: u32,
    since: u64,
}

impl Profile {
    pub fn new(lines: usize) -> Self {
        Self {
            times: vec![0; lines],
            cycles: vec![0; lines],
            ..Self::default()
        }
    }

    /// Goes to a line; answers the one that was left.
    pub fn enter(&mut self, line: u32, now: u64) -> u32 {
        if let Some(cycles) = self.cycles.get_mut(self.at as usize) {
            *cycles += now.saturating_sub(self.since);
        }
        self.since = now;
        std::mem::replace(&mut self.at, line)
    }

    /// Counts the beginning of a line.
    pub fn begin(&mut self, line: u32) {
        if let Some(times) = self.times.get_mut(line as usize) {
            *times += 1;
        }
    }
}
