//! How far work has come: shown on a terminal, and nowhere else.

#[cfg(target_family = "wasm")]
mod quiet;
#[cfg(not(target_family = "wasm"))]
mod terminal;

#[cfg(target_family = "wasm")]
pub use quiet::{Progress, Waiting, say};
#[cfg(not(target_family = "wasm"))]
pub use terminal::{Progress, Waiting, say};
