//! slowlight-routine
