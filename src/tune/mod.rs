//! Tuning: what accuracy costs in time, by trying.
//!
//! A *setting* is what is left out of the picture: blocks instead of pixels, fewer turns of
//! loops. A *choice* is a setting in a number format, with params that stay changeable or
//! are folded. All of it are options of `run` and `build`, so whoever likes a point of the
//! frontier gets its program and its figures by the options that stand beside it.
//!
//! Trying goes from cheap to dear, and at each step only what may still reach the frontier
//! goes on ([`explore`]):
//! 1. every setting is drawn in `f64`, which says what is lost by the setting alone, and
//!    counts operations;
//! 2. the whole picture is planned in each format, and then what is left of settings in
//!    formats, as far as these let one expect that nothing clearly beats it ([`prune`]); what
//!    takes long is run on some rows of the picture first ([`rows`]);
//! 3. those that nothing clearly beats there are run whole, and held against the native
//!    picture.
//!
//! At each step as much is done as a budget of counted work allows, what is worth most first
//! ([`effort`]).
//!
//! Cycles and errors of the frontier are those of whole runs; nothing is estimated.

pub mod bands;
pub mod cache;
pub mod choice;
pub mod choices;
pub mod effort;
pub mod explore;
pub mod goal;
pub mod looked;
pub mod marks;
pub mod page;
pub mod planned;
pub mod plot;
pub mod point;
pub mod prune;
pub mod rows;
pub mod search;
pub mod settings;
pub mod spent;
pub mod tell;
pub mod work;
