//! slowlight-compiler
