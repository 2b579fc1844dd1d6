//! Names of the rows of errors, where a plan spreads errors.

use super::names::Names;
use crate::plan::{ErrorRows, Plan};

/// The names of what the errors need.
#[derive(Clone)]
pub(super) struct Spread {
    pub rows: ErrorRows,
    /// What the pixel has received.
    pub received: String,
    /// What a share is added to.
    pub sum: String,
    /// The row being drawn, the one below, and so on; then one for the exchange.
    pub ring: Vec<String>,
}

impl Spread {
    /// Where the plan spreads errors.
    pub fn new(plan: &Plan, names: &mut Names) -> Option<Spread> {
        let rows = plan.error_rows()?;
        let ring = (0..=rows.rows).map(|k| match k < rows.rows {
            true => names.fresh(&format!("errors_{k}")),
            false => names.fresh("errors_done"),
        });
        let ring = ring.collect();
        Some(Spread {
            received: names.fresh("received"),
            sum: names.fresh("error_sum"),
            ring,
            rows,
        })
    }
}
