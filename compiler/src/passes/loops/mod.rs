//! Passes on loops, of the scene and over the picture's rows and columns.

pub mod bypass;
pub mod collect;
#[cfg(test)]
pub(in crate::passes) mod drawn;
pub mod guard;
#[cfg(test)]
mod guard_tests;
pub mod induction_tables;
pub mod licm;
pub mod peel;
#[cfg(test)]
mod peel_tests;
pub mod polynomials;
pub mod scalar_expansion;
pub mod strength_reduction;
pub mod strip_mine;
pub mod trip_counts;
pub mod unroll;
