//! slowlight-isa

pub mod opcodes;
