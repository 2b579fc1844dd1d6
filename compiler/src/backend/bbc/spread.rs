//! Error diffusion: what pixels send to later ones waits in an array.
//!
//! The array's second index is a row of the ring ([`ErrorRows`]); which row of
//! the picture each is for is kept in variables, which change places after
//! each row.

use super::code::Code;
use crate::plan::{ErrorRows, Plan};

/// The names of what the errors need.
pub struct Spread {
    rows: ErrorRows,
    array: String,
    received: String,
    /// Where in the array a row of the picture is: the one being drawn, the
    /// one below, and so on.
    ring: Vec<String>,
    /// For the exchange.
    done: String,
}

impl Spread {
    /// Where the plan spreads errors.
    pub fn new(plan: &Plan, code: &mut Code<'_>) -> Option<Spread> {
        let rows = plan.error_rows()?;
        let names = &mut code.values.names;
        let array = names.unique("error", "(").trim_end_matches('(').to_owned();
        let received = names.unique("received", "");
        let ring = (0..rows.rows).map(|k| names.unique(&format!("row{k}"), "%"));
        let ring = ring.collect();
        let done = names.unique("done", "%");
        code.values.received.clone_from(&received);
        Some(Spread {
            rows,
            array,
            received,
            ring,
            done,
        })
    }

    /// The element for a column `dx` to the right, `dy` rows down.
    fn element(&self, dx: i64, dy: usize) -> String {
        let right = i64::from(self.rows.left) + dx;
        let column = match right {
            0 => "X%".to_owned(),
            1.. => format!("X%+{right}"),
            _ => format!("X%{right}"),
        };
        let row = self.ring.get(dy).map_or("0", String::as_str);
        format!("{}({column},{row})", self.array)
    }

    /// Makes the array, all 0.
    pub fn start(&self, code: &mut Code<'_>) {
        let (last, rows) = (self.rows.length() - 1, self.rows.rows - 1);
        code.statement(format!("DIM {}({last},{rows})", self.array));
        for (k, name) in self.ring.iter().enumerate() {
            code.statement(format!("{name}={k}"));
        }
    }

    /// Takes what a pixel has received, and leaves 0.
    pub fn receive(&self, code: &mut Code<'_>) {
        let here = self.element(0, 0);
        code.statement(format!("{}={here}", self.received));
        code.statement(format!("{here}=0"));
    }

    /// Sends a pixel's shares.
    pub fn send(&self, code: &mut Code<'_>) {
        for share in &self.rows.shares {
            let down = usize::try_from(share.dy).unwrap_or(0);
            let there = self.element(i64::from(share.dx), down);
            let sum = code.values.gather(&there, share.node);
            code.statement(format!("{there}={sum}"));
        }
    }

    /// The row that is done becomes the furthest one.
    pub fn turn(&self, code: &mut Code<'_>) {
        let [first, .., last] = self.ring.as_slice() else {
            return;
        };
        code.statement(format!("{}={first}", self.done));
        for pair in self.ring.windows(2) {
            if let [to, from] = pair {
                code.statement(format!("{to}={from}"));
            }
        }
        code.statement(format!("{last}={}", self.done));
    }
}
