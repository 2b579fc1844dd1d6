//! The search: candidates of each family of passes, kept where the plan becomes cheaper.

pub(crate) mod branches;
pub(crate) mod columns;
pub(crate) mod forms;
pub(crate) mod licm;
#[cfg(test)]
mod licm_tests;
pub(crate) mod stepped;
pub(crate) mod sums;
pub(crate) mod whole_forms;
