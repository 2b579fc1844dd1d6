//! What rewriting passes share: graphs made anew node by node.

pub(crate) mod arena;
pub mod dither;
pub mod rebuild;
