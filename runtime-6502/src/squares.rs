//! The quarter squares, f(n) = floor(n n / 4), that products are read from.
//!
//! a b = f(a + b) - f(a - b). A machine short of room in its files makes them in memory
//! at the start (the part `squares`); one that is not has them in the program, each table
//! from a page's beginning, and only sets the pointers' pages.

/// Instructions that set the upper bytes of the pointers into the tables.
pub const PAGES: &str = include_str!("../asm/squares_pages.asm");

/// A table of the quarter squares.
#[derive(Clone, Copy, Debug)]
pub struct Table {
    /// What its first byte is called.
    pub label: &'static str,
    /// The number that its first byte is for.
    from: i32,
    /// Which byte of the square it has.
    byte: u32,
}

/// All of them, in the order in which they stand in memory.
pub const TABLES: [Table; 4] = [
    Table::new("sqr_lo", 0, 0),
    Table::new("sqr_hi", 0, 1),
    Table::new("sqd_lo", -255, 0),
    Table::new("sqd_hi", -255, 1),
];

impl Table {
    const fn new(label: &'static str, from: i32, byte: u32) -> Table {
        Table { label, from, byte }
    }

    /// Its bytes: two pages. The last of those from f(-255) on is read by nobody.
    pub fn bytes(&self) -> impl Iterator<Item = u8> {
        let Table { from, byte, .. } = *self;
        (from..from + 512).map(move |n| (n * n / 4).to_le_bytes()[byte as usize])
    }
}
