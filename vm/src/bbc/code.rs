//! A program being run: its code, its watcher and its limit.

use std::cell::RefCell;
use std::ops::Deref;

use super::program::Program;
use crate::Watch;

pub(crate) struct Code<'a> {
    pub program: &'a Program,
    pub watch: RefCell<Watch<'a>>,
    /// Cycles after which the run stops.
    pub limit: u64,
}

impl Deref for Code<'_> {
    type Target = Program;
    fn deref(&self) -> &Program {
        self.program
    }
}
