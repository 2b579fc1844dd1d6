//! slowlight-isa

pub mod opcodes;
pub mod real40;
