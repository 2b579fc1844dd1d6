//! The cost model of tuning: what its steps take, in nanoseconds of one processor, by counts of
//! operations and cycles and what these usually take.

use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::targets::{Language, Target};

/// What any plan takes, a unit of fuel that it burns, and a statement in the routines' models.
const PLANNED: f64 = 3e7;
const BURNT: f64 = 30.0;
const MODELLED: f64 = 200.0;

/// What a plan took to be made: whatever it is, by how much fuel its fit has burnt, and how many
/// statements ran in the models for it.
pub fn of_plan(plan: &PlannedScene) -> f64 {
    PLANNED + BURNT * plan.burnt() as f64 + MODELLED * plan.modelled() as f64
}

/// What a run of so many cycles takes, together with the model's of the same pixels. A command
/// of BASIC takes some thousand cycles, and is carried out as a whole.
pub fn of_cycles(target: &Target, cycles: f64) -> f64 {
    cycles
        * match target.system.language() {
            Language::Jack => 3.0,
            Language::Basic => 0.05,
            Language::Assembly => 1.7,
        }
}
