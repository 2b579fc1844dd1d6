//! The planner: from a graph to the plan that is cheapest on a machine.
//!
//! [`pipeline`] lists the passes, [`search`] asks each family of them for candidates and keeps
//! what the cost model finds cheaper, [`context`] holds what was made so far, [`made`] runs all of
//! it, [`assemble`] selects routines, and [`replan`] and [`outlined`] plan the same scene again
//! for less memory.

pub(crate) mod assemble;
pub(crate) mod context;
#[cfg(test)]
mod context_tests;
pub(crate) mod made;
pub(crate) mod observed;
pub(crate) mod outlined;
pub mod pass_manager;
pub mod pipeline;
pub(crate) mod planned;
pub(crate) mod replan;
pub(crate) mod search;

use crate::cost::size_budget::SizeBudget;
pub use made::{Candidate, plan, plan_among, plan_as_written, plan_with_every_shade, plan_within};
pub use planned::PlannedScene;

/// How much work a search for a plan may do, in units of [`crate::fuel::Fuel`]: some seconds'
/// worth, a few times what the dearest of the examples takes.
pub const SEARCH: u64 = 400_000_000;

/// In how many steps plans may spend less and less memory on speed.
pub const THRIFTS: usize = SizeBudget::COUNT;
