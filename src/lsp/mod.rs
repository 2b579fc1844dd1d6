//! A language server for the scene language (Language Server Protocol 3.17).
//!
//! Everything that it says is said by the compiler, or by what the other subcommands use:
//! diagnostics, types, ranges, the library's comments, the formatter, `explain`'s figures.

mod analysis;
mod complete;
mod describe;
mod diagnostics;
mod facts;
mod inlay;
mod look;
mod measure;
mod names;
mod outline;
mod rename;
mod requests;
mod scan;
mod server;
mod settings;
mod shelf;
mod signature;
mod state;
mod text;
mod types;
mod wire;

pub use complete::TYPES;
pub use server::serve;
