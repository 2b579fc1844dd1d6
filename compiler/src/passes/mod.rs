//! One pass a file; each takes a graph and gives a graph or a side table.

pub mod algebra;
pub mod along;
pub mod apart;
pub mod arcs;
mod arena;
pub mod arms;
pub mod coarse;
pub mod columns;
pub mod demand;
pub mod early;
pub mod either;
pub mod factors;
pub mod fold;
pub mod guard;
pub mod homogeneous;
pub mod identities;
pub mod in_place;
pub mod induction_tables;
pub mod int_roots;
pub mod interlace;
pub mod licm;
pub mod limits;
mod moves;
pub mod narrow;
pub mod near;
pub mod needed;
pub mod outline;
pub mod peel;
mod queue;
pub mod ramps;
pub mod rate;
pub mod rebuild;
pub mod reciprocal_roots;
pub mod reciprocals;
pub mod region;
pub mod schedule;
pub mod segment;
pub mod skip;
pub mod split;
pub mod stable;
pub mod still;
pub mod sums;
pub mod threshold;
pub mod units;
pub mod unroll;
pub mod whole_parts;

#[cfg(test)]
mod apart_tests;
#[cfg(test)]
mod claim_tests;
#[cfg(test)]
mod guard_tests;
#[cfg(test)]
mod int_roots_tests;
#[cfg(test)]
mod peel_tests;
#[cfg(test)]
mod reciprocal_roots_tests;
#[cfg(test)]
mod still_tests;
