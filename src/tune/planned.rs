//! A plan, and beside it the plan of its shades: to make either may take many seconds, so
//! bands of rows and the whole picture share both.

use crate::draw::{Drawn, model_with};
use crate::estimate;
use crate::failure::Outcome;
use slowlight_compiler::planner::PlannedScene;
use std::sync::OnceLock;

/// A plan and its shades'.
pub struct Planned {
    /// What the machine's program is made of.
    pub plan: PlannedScene,
    /// What computes every pixel's shade, where the program does without; made when it is
    /// first asked for.
    shaded: OnceLock<Option<PlannedScene>>,
    /// The cycles that the planner's figures predict.
    cycles: OnceLock<f64>,
}

impl Planned {
    /// Of a plan of the whole picture.
    pub fn new(plan: PlannedScene) -> Planned {
        Planned {
            plan,
            shaded: OnceLock::new(),
            cycles: OnceLock::new(),
        }
    }

    /// The cycles that the planner's figures predict of the whole picture.
    pub fn cycles(&self) -> f64 {
        *self.cycles.get_or_init(|| estimate::cycles(&self.plan))
    }

    /// The plan of the shades, where it is another.
    pub fn shaded(&self) -> Option<&PlannedScene> {
        self.shaded.get_or_init(|| self.plan.shaded()).as_ref()
    }

    /// The program for some rows.
    pub fn band(&self, rows: (u32, u32)) -> PlannedScene {
        in_rows(&self.plan, rows)
    }

    /// What the model makes of some rows; with the shades only where they are wanted.
    ///
    /// # Errors
    /// Only an interruption.
    pub fn modelled(&self, rows: (u32, u32), shades: bool) -> Outcome<Drawn> {
        let shaded = shades.then(|| self.shaded()).flatten();
        let shaded = shaded.map(|plan| in_rows(plan, rows));
        model_with(&self.band(rows), shaded.as_deref())
    }
}

fn in_rows(plan: &PlannedScene, rows: (u32, u32)) -> PlannedScene {
    let mut band = plan.clone();
    band.rows = rows;
    band
}
