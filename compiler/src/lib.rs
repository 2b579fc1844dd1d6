//! The compiler of `slowlight`: from a scene to programs for slow machines.
//!
//! A pure library: no files, no clock, no terminal.

pub mod analysis;
pub mod backend;
pub mod cost;
pub mod eval;
pub mod fuel;
pub mod homes;
pub mod ir;
pub mod passes;
pub mod plan;
pub mod planner;
pub mod prelude;
pub mod report;
pub mod scene;
pub mod schedule;
pub mod selection;
pub mod sema;
pub mod targets;
pub mod wordlength;

/// Text to tree and back; its own crate because its parser is slow to compile.
pub use slowlight_syntax as syntax;
pub use slowlight_syntax::source;
