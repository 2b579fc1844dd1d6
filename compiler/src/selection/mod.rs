//! Instruction selection: a routine of the machine's runtime for each operation.

pub mod in_place;
pub mod integer_roots;
#[cfg(test)]
mod integer_roots_tests;
pub mod reciprocal_roots;
#[cfg(test)]
mod reciprocal_roots_tests;
pub(crate) mod routines;
pub(crate) mod underflow;
