//! slowlight-isa

pub mod basic_tokens;
pub mod opcodes;
pub mod real40;
