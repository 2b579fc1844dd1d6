//! The cost model: what a plan takes a pixel, by the routines' cycles and how often each
//! statement runs.
//!
//! [`price`] runs a scheduled graph at the pixels of [`pixels`], a sample with probabilities
//! proportional to size; [`profile`] says how often each value is computed and by that what a
//! rewrite gains; [`statement`] says what one statement takes; [`size_budget`] is how dear
//! memory is.

pub(crate) mod branch_probability;
pub(crate) mod magnitudes;
pub(crate) mod meter;
pub(crate) mod pixels;
pub(crate) mod price;
#[cfg(test)]
mod price_tests;
pub(crate) mod profile;
pub(crate) mod size_budget;
pub mod statement;
