//! The intermediate representation: the graph of scalar operations, its text form, and the
//! statement tree.

pub mod build;
pub mod diffusion;
pub mod enclosure;
pub mod extent;
pub mod graph;
pub(crate) mod interval;
pub mod node;
mod notes;
pub mod often;
pub mod print;
pub mod ramp;
pub mod read;
pub mod refinement;
pub mod table;
pub mod tree;
