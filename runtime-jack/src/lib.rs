//! slowlight-runtime-jack
