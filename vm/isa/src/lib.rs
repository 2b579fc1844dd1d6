//! slowlight-isa
