//! One pass a file; each takes a graph and gives a graph or a side table.

pub mod demand;
pub mod rate;
pub mod region;
pub mod schedule;
