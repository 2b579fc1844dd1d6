//! Options that leave passes of the planner out, to see what each is good for.

use clap::Args;
use slowlight_compiler::planner::pass_manager::PassSet;
use slowlight_compiler::planner::pipeline::{PASSES, Pass};
use slowlight_compiler::sema::{Instancing, Ways};

/// The passes that look functions up in tables: those without lines between entries first.
pub const TABLES: [Pass; 2] = [Pass::FunctionTables, Pass::InterpolatedTables];

/// Passes that are left out.
#[derive(Args, Clone, Debug, Default)]
pub struct PassArgs {
    /// Leave a pass of the planner out (`build --emit passes` lists them); may be said again
    #[arg(long, value_name = "PASS", help_heading = "To see what the compiler does (docs/passes.md)", value_parser = pass)]
    without_pass: Vec<Pass>,
    /// Leave all passes out that come after this one: with `--emit plan`, what stands there
    #[arg(long, value_name = "PASS", help_heading = "To see what the compiler does (docs/passes.md)", value_parser = pass)]
    stop_after: Option<Pass>,
}

impl PassArgs {
    /// All that are left out.
    pub fn left_out(&self) -> PassSet {
        let after = self.stop_after.map(PassSet::after).unwrap_or_default();
        let all = self.without_pass.iter();
        all.fold(after, |all, pass| all.with(*pass))
    }

    /// The same without one more.
    #[must_use]
    pub fn without(mut self, pass: Pass) -> PassArgs {
        self.without_pass.push(pass);
        self
    }

    /// Ways, without what passes before the planner's find where those are left out.
    pub fn ways(&self, ways: Ways, as_written: bool, instancing: Instancing) -> Ways {
        Ways {
            unbounded: as_written || self.left_out().has(Pass::Bounds),
            instancing: match as_written || self.left_out().has(Pass::Instances) {
                true => Instancing::Separate,
                false => instancing,
            },
            ..ways
        }
    }
}

/// Reads a pass's name.
fn pass(text: &str) -> Result<Pass, String> {
    let named = |pass: &&Pass| pass.about().0 == text;
    PASSES.iter().find(named).copied().ok_or_else(|| {
        let names: Vec<&str> = PASSES.iter().map(|pass| pass.about().0).collect();
        format!("there is no such pass; the passes are {}", names.join(", "))
    })
}
