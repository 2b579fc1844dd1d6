//! Constant tables: what lookups read.

use super::node::Constant;
use slowlight_routine::{Type, Value};

/// A constant table, indexed by column and row.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Its name in the scene, for the generated source.
    pub name: String,
    /// Columns; at least 1.
    pub width: u32,
    /// Rows; at least 1.
    pub height: u32,
    /// The type of every entry.
    pub ty: Type,
    /// The entries, row by row.
    pub entries: Vec<Constant>,
    /// The ints that the entries are images of, one for each, where they are
    /// known to be; else empty.
    pub seed: Vec<i32>,
}

impl Table {
    /// Where the entry at a column and row stands in `entries`, both clamped.
    pub fn index(&self, column: i32, row: i32) -> usize {
        let clamp = |i: i32, n: u32| i.max(0).min(n as i32 - 1).max(0) as usize;
        clamp(row, self.height) * self.width as usize + clamp(column, self.width)
    }

    /// Where the entries stand that a lookup may give, where its column or its row is known.
    pub fn candidates(
        &self,
        column: Option<Value>,
        row: Option<Value>,
    ) -> impl Iterator<Item = usize> + use<> {
        let only = |of: Option<Value>| match of {
            Some(of) => (of.real(), of.real()),
            None => (f64::NEG_INFINITY, f64::INFINITY),
        };
        self.within(only(column), only(row))
    }

    /// The same where its column and its row are from so many to so many.
    pub fn within(
        &self,
        columns: (f64, f64),
        rows: (f64, f64),
    ) -> impl Iterator<Item = usize> + use<> {
        let (width, height) = (self.width as usize, self.height as usize);
        let all = |(lo, hi): (f64, f64), many: usize| {
            let at = |of: f64| (of.max(0.0) as usize).min(many.saturating_sub(1));
            at(lo)..at(hi) + 1
        };
        let (columns, rows) = (all(columns, width), all(rows, height));
        let entries = self.entries.len();
        let row = move |row| columns.clone().map(move |column| row * width + column);
        rows.flat_map(row).filter(move |at| *at < entries)
    }

    /// The entry at a column and row, both clamped.
    pub fn at(&self, column: i32, row: i32) -> Value {
        self.entries
            .get(self.index(column, row))
            .map_or(Value::Int(0), |e| e.value())
    }
}
