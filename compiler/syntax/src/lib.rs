//! Text to tree: lexer (logos), parser (chumsky), tree, and the way back.
//!
//! [`parse`] is total: any text gives a tree and diagnostics, in time linear in
//! its length and with bounded depth. [`decode`] comes before it where a scene
//! is read as bytes; [`format::format`] and [`print`] are the ways back.

mod check;
mod cut;
pub mod format;
mod lexer;
mod parser;
pub mod print;
pub mod source;
mod token;
pub mod tree;
pub mod walk;

pub use cut::MAX_DEPTH;
pub use lexer::{MAX_BYTES, decode};
pub use parser::parse;
pub use token::{ITEMS, PLACED, WORDS, is_name};

#[cfg(test)]
mod tests;
