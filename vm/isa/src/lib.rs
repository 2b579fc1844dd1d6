//! slowlight-isa

pub mod basic_tokens;
pub mod c64;
pub mod opcodes;
pub mod real40;
