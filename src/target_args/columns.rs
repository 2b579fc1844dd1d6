//! What is asked of targets that draw column scenes only.

use super::{ScreenArgs, TABLES, Tables};
use crate::failure::{Failure, Outcome};
use crate::scene::Scene;
use slowlight_compiler::plan::Plan;
use slowlight_compiler::plan::columns::columns;
use slowlight_compiler::planner::pass_manager::PassSet;
use slowlight_compiler::planner::pipeline::Pass;
use slowlight_compiler::targets::Target;

/// Fails where a plan's picture is not one that its target draws.
///
/// # Errors
/// What of `draw` is otherwise.
pub(super) fn of_columns(scene: &Scene, plan: &Plan) -> Outcome<()> {
    if !plan.target.columns_only {
        return Ok(());
    }
    let found = columns(plan).map(|_| ());
    found.map_err(|refusal| scene.wrong(vec![refusal.diagnostic(plan.target.name)]))
}

impl ScreenArgs {
    /// Fails where something is asked for that only pixels have.
    pub(super) fn check_columns(&self, target: &Target) -> Outcome<()> {
        // A block of one pixel is none: it is what `tune` asks for where nothing is left out.
        let block = self.block.filter(|block| *block != (1, 1));
        let of_pixels = block.is_some() || self.refine.is_some() || self.rows.is_some();
        if !target.columns_only || !of_pixels {
            return Ok(());
        }
        Err(Failure::Usage(format!(
            "--block, --refine and --rows are for pixels; {} draws columns",
            target.name
        )))
    }

    /// The passes that are left out: where pictures are of columns, those that step along rows.
    pub(super) fn left_out(&self, target: &Target) -> PassSet {
        let along_rows = [
            Pass::StripMine,
            Pass::ScanlineRuns,
            Pass::ScanlineSpans,
            Pass::Phases,
        ];
        let mut own = self.passes.left_out();
        // Who asks for a format of many digits wants what these give.
        let exact = self.tables == Some(Tables::No)
            || self.tables.is_none() && self.format.is_some() && target.runtime.real.is_long();
        if exact {
            own = TABLES.into_iter().fold(own, PassSet::with);
        }
        match target.columns_only {
            true => along_rows.into_iter().fold(own, PassSet::with),
            false => own,
        }
    }
}
