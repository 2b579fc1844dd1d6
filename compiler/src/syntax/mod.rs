//! Text to tree: lexer (logos), parser (chumsky), tree, and the way back.

pub mod tree;
