//! Register allocation: which variable, field or bytes hold each value of a plan.
//!
//! [`liveness`] finds where values are wanted, [`interference`] which of them may share a home
//! and which copies need none, [`single_use`] which values are written where they are read, and
//! [`names`] what homes are called.

pub(crate) mod interference;
#[cfg(test)]
mod interference_tests;
pub(crate) mod liveness;
pub(crate) mod names;
pub(crate) mod single_use;
