//! bbc
