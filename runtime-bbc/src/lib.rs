//! slowlight-runtime-bbc
