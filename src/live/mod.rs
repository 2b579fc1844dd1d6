//! A scene on a local page: its text, its native picture after each edit, and the machine's
//! own picture as the bundled machine computes it.
//!
//! What is wanted and what is shown stand on one [`desk`]. Two workers look at it, one that
//! draws native pictures and one that runs machines, so neither threads nor memory grow with
//! edits: what is wanted newly stops what was begun for older wishes. A [`run`] is a machine
//! with the options that a program is planned with; one or two stand beside each other, each
//! with what accuracy costs there ([`frontier`]). The page ([`page`]) is
//! served on the loopback alone ([`http`]), behind a token in its address ([`guard`]).

#[cfg(not(target_family = "wasm"))]
mod serve;

mod alone;
mod board;
mod choices;
mod frontier;
mod machine;
mod native;
mod run;
mod said;
mod shown;

pub use alone::{Alone, Tell};
pub use choices::about;
#[cfg(not(target_family = "wasm"))]
pub use serve::{Build, Start, serve};
