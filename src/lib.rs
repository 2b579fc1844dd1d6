//! The command line of `slowlight`.
//!
//! Everything that touches the world is here: files, the terminal, pictures,
//! and the meeting of the compiler with the machines. One file a subcommand
//! in [`commands`]; the compiler and the machines know nothing of each other.

pub mod against;
pub mod ascii;
pub mod auto_format;
pub mod cases;
#[cfg(not(target_family = "wasm"))]
mod cli;
pub mod colours;
#[cfg(not(target_family = "wasm"))]
pub mod commands;
pub mod diagnostics;
pub mod digest;
pub mod draw;
pub mod effects;
pub mod estimate;
pub mod examples;
pub mod explain;
pub mod failure;
pub mod files;
pub mod fit;
pub mod forecast;
pub mod format;
pub mod given;
#[cfg(not(target_family = "wasm"))]
pub mod grow;
pub mod inks;
pub mod interrupt;
pub mod jobs;
pub mod keys;
#[cfg(not(target_family = "wasm"))]
pub mod labels;
pub mod library;
pub mod listing;
pub mod live;
#[cfg(not(target_family = "wasm"))]
pub mod lsp;
pub mod machine;
pub mod measure;
pub mod moving;
pub mod need;
pub mod output;
pub mod picture;
pub mod precise;
pub mod program;
pub mod progress;
pub mod scene;
pub mod sheet;
#[cfg(not(target_family = "wasm"))]
pub mod show;
#[cfg(not(target_family = "wasm"))]
pub mod snapshot;
#[cfg(not(target_family = "wasm"))]
pub mod survey;
pub mod tables;
pub mod target_args;
pub mod together;
pub mod toot;
pub mod trial;
pub mod tune;
pub mod unlike;
pub mod vcs;
#[cfg(not(target_family = "wasm"))]
pub mod watch;
pub mod ways;
pub mod worst;

#[cfg(not(target_family = "wasm"))]
pub use cli::{command_line, main};
pub use output::{say, say_json};
