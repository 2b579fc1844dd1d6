//! Hard cases: exact inputs on which formulas are known to fail, and what a
//! result has to satisfy.
//!
//! A file holds kernels (by their signatures) and vectors; its form is in
//! `docs/hard-cases.md`. Every vector is tried in any of three ways:
//!
//! - natively, in `f64`;
//! - in a number format's model, which is bit for bit what its machine computes;
//! - on the machine: a program whose params are the inputs' bits and which ends
//!   by giving out the bits of its results.
//!
//! Inputs are first rounded to the format ([`format`]), and the result is judged
//! by the vector's own predicate ([`judge`]), in which `u` is the format's
//! roundoff. Nothing depends on a vector's name, nor on the formulas in the file.
//!
//! A format that cannot hold a value saturates. Where the vector allows a
//! refusal, such a result passes only because it is said which operation left
//! the format ([`watch`]), or because what its places lose is enough to make it wrong
//! ([`lose`]).

pub mod exact;
pub mod file;
pub mod format;
pub mod judge;
pub mod kernel;
mod lose;
pub mod machine;
pub mod table;
pub mod trial;
pub mod watch;

pub use file::{CaseFile, parse};
pub use trial::{Row, Rows, Way, knows, run, ways};
