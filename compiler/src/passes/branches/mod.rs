//! Passes on comparisons and selects: what is asked, where, and what each arm makes of it.

pub mod cross_multiply;
pub mod early_exit;
pub mod invert_monotone;
pub mod prune_minima;
pub mod push_into_select;
pub mod shannon;
pub mod specialise_factors;
pub mod square_comparisons;
pub mod unswitch;
