//! The passes: one a file, each from a graph to another of the same picture. Their order, and
//! which are kept, is [`crate::planner`]'s affair.

pub mod accuracy;
pub mod algebra;
pub mod branches;
pub mod loops;
pub mod pixel_blocks;
pub mod refine;
pub mod rematerialise;
pub mod rewrite;
pub mod simplify;

#[cfg(test)]
mod claim_tests;
#[cfg(test)]
mod rematerialise_tests;
