//! Names, types, specialisation: from trees to a typed program, and from the
//! program to the graph.
//!
//! [`check`] looks at every item and finds every mistake that does not depend
//! on how the scene is used. [`lower`] then evaluates `draw` as far as the
//! scene alone allows: functions are expanded at their calls; vectors, records,
//! optional values, shapes and functions exist only while compiling; what is
//! left are scalars, which become nodes of the [`Graph`](crate::ir::graph::Graph).

mod builtins;
mod check;
pub mod colours;
mod expr;
mod ids;
mod lower;
mod print;
mod program;
mod show;
mod ty;

#[cfg(test)]
mod tests;

pub use builtins::{Builtin, Signature, signatures};
pub use check::{check, check_noting, known, tidy};
pub use lower::{
    Freeze, INSTANCES, Instancing, Millionths, Options, Search, Ways, lower, most_shapes, params,
};
pub use program::*;
pub use ty::Ty;
