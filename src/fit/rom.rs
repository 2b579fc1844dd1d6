//! Fit for the Hack's processor: code in its ROM, the heap beside the operating system's.

use super::help;
use crate::failure::{Failure, Outcome, TooLarge};
use crate::machine::Machine;
use crate::need::need_beside;
use crate::trial::build_for;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::source::Span;

/// A plan whose program fits the ROM of the Hack's processor as well, and its heap beside
/// the operating system's part of it: short, or with subroutines, where it does not
/// without.
///
/// # Errors
/// By how many words it does not, and what would help.
pub fn fit_rom(
    plan: PlannedScene,
    machine: Machine,
    name: &dyn Fn(Span) -> Option<String>,
) -> Outcome<PlannedScene> {
    // The text is ours: its size is all that the machine's tools can refuse.
    let refused = |plan: &PlannedScene| match build_for(plan, machine) {
        Ok(built) => {
            let need = need_beside(plan, &built.loaded.system);
            Ok((!need.fits()).then(|| need.text()))
        }
        Err(Failure::Wrong(said)) => Ok(Some(said)),
        Err(other) => Err(other),
    };
    let mut said = String::new();
    // A fault of the plan with subroutines would be one of the plan without.
    let outlined = || plan.outlined(name).ok();
    let plans = std::iter::once_with(|| Some(plan.clone())).chain(std::iter::once_with(outlined));
    for mut tried in plans.flatten() {
        // Short, it has the routines of the VM: slower ones.
        for lean in [false, true] {
            tried.lean = lean;
            match refused(&tried)? {
                None => return Ok(tried),
                Some(why) => said = why,
            }
        }
    }
    Err(Failure::TooLarge(Box::new(TooLarge {
        text: format!(
            "{} does not fit the Hack with its operating system: {said}\n{}; run it on the VM, where \
             code and the system take no memory (--os native)",
            plan.name,
            help(&plan)
        ),
        least: said,
    })))
}
