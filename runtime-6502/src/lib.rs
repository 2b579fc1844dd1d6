//! slowlight-runtime-6502
