//! Progress where there is no terminal: nothing is shown, and what was to be said is not.

use std::borrow::Cow;

/// Says a line to nobody.
pub fn say(_: &str) {}

/// How far some work has come.
pub struct Progress;

impl Progress {
    /// Work of `total` units.
    pub fn new(_: impl Into<Cow<'static, str>>, _total: u64) -> Progress {
        Progress
    }

    /// So many units more are done.
    pub fn step(&self, _units: u64) {}

    /// So many units are done in all.
    pub fn reach(&self, _units: u64) {}
}

/// Work of which nobody can say how far it has come.
pub struct Waiting;

impl Waiting {
    /// Waits for `what`.
    pub fn new(_: impl Into<Cow<'static, str>>) -> Waiting {
        Waiting
    }
}
