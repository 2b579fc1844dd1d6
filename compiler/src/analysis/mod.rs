//! Analyses: facts about a graph. Nothing here changes one.
//!
//! How often a value changes ([`rate`]), where it may be computed and what holds there
//! ([`region`]), between which bounds it stays ([`range`]), where its binary point is
//! ([`points`]), which values a pixel needs ([`needed`]), and whether a graph is one ([`verify`]).

pub mod beginnings;
pub(crate) mod carried;
pub mod needed;
pub mod points;
pub mod range;
pub mod rate;
pub mod region;
pub mod verify;
