//! One pass a file; each takes a graph and gives a graph or a side table.

pub mod demand;
pub mod fold;
pub mod narrow;
pub mod outline;
mod queue;
pub mod rate;
pub mod rebuild;
pub mod region;
pub mod schedule;
pub mod stable;
