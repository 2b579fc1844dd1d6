//! What a program has more than once, or at greater length, for speed: tail duplication and
//! inlining, as far as there is memory.

/// What stands behind several ways and may be written on each of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Copies {
    /// Nothing.
    #[default]
    None,
    /// What leads to a test whose outcome a way knows.
    Tests,
    /// That, and the end of a pixel, with the way's ink.
    Ends,
    /// That, and what routines of loops look up in tables (6502).
    Loops,
    /// That, and both bytes of all of these tables' entries.
    Tables,
}
