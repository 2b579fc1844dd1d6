//! Scheduling: from a graph to statements in order.
//!
//! [`placement`] finds the region in which each value is computed (global code motion: Click,
//! PLDI 1995), [`statements`] puts each region's values in order, [`segment`] and
//! [`constant_runs`] are of runs of columns along a row, [`locality`] and [`outline`] make of
//! statements others that take less memory, [`step`] is what stands behind a picture that moves, and [`analysed`] is a graph with its statements and
//! ranges.

pub(crate) mod analysed;
pub mod constant_runs;
#[cfg(test)]
mod constant_runs_tests;
pub mod locality;
pub mod outline;
pub(crate) mod parallel_copy;
pub mod placement;
pub mod segment;
pub mod statements;
pub mod step;
pub(crate) mod toposort;
