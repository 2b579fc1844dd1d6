//! The graph of scalar operations, its printer and its verifier.

pub mod build;
pub mod diffusion;
pub mod graph;
pub mod node;
mod notes;
pub mod often;
pub mod print;
pub mod ramp;
pub mod read;
pub mod tree;
pub mod verify;
