//! The compiler of `slowlight`: from a scene to programs for slow machines.
//!
//! A pure library: no files, no clock, no terminal.

pub mod eval;
pub mod flow;
pub mod fuel;
pub mod passes;
pub mod plan;
pub mod prelude;
pub mod range;
pub mod report;
pub mod scene;
pub mod sema;
pub mod target;

/// Text to tree and back; its own crate because its parser is slow to compile.
pub use slowlight_syntax as syntax;
pub use slowlight_syntax::source;
