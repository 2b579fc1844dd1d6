//! Options that only some machines have.

use super::ScreenArgs;
use crate::estimate;
use crate::failure::{Failure, Outcome};
use crate::scene::Scene;
use crate::target_args::is_6502;
use slowlight_compiler::backend::mos6502::LEAST_PAGE;
use slowlight_compiler::planner::PlannedScene;
use slowlight_compiler::targets::{Language, System, Target};

/// What part of its time a program takes at most that begins where the disc system has its
/// memory, for that to be worth it.
const WORTH: f64 = 0.97;

impl ScreenArgs {
    /// Plans a scene for a target and the best mode in which its program fits
    /// the machine, `set` being values read from edited source. Where nothing is said of where
    /// BASIC begins, what needs the disc system's memory has it.
    ///
    /// # Errors
    /// Where the scene does not compile for it, the options do not fit, or the
    /// program does not.
    pub fn plan(
        &self,
        scene: &Scene,
        target: &'static Target,
        set: &[(String, Vec<f64>)],
    ) -> Outcome<PlannedScene> {
        let plan = self.plan_as_asked(scene, target, set);
        let open = target.system == System::BbcBasic && self.page.is_none() && !self.is_toot();
        let is_small = match &plan {
            Ok(plan) => plan.is_made_small(),
            Err(failure) => matches!(failure, Failure::TooLarge(_)),
        };
        if !open || !is_small {
            return plan;
        }
        let low = ScreenArgs {
            page: Some(LEAST_PAGE),
            ..self.clone()
        };
        // What is called takes longer than is estimated.
        let calls = |plan: &PlannedScene| plan.tight || plan.calls_at_pixels();
        let worth = |high: &PlannedScene, low: &PlannedScene| {
            calls(high) && !calls(low) || estimate::cycles(low) <= WORTH * estimate::cycles(high)
        };
        match (&plan, low.plan_as_asked(scene, target, set)) {
            (Ok(high), Ok(low)) if !worth(high, &low) => plan,
            (_, Ok(mut low)) => {
                low.moved = true;
                Ok(low)
            }
            _ => plan,
        }
    }

    /// # Errors
    /// Where an option is another machine's.
    pub(super) fn check_machine(&self, target: &Target) -> Outcome<()> {
        if self.os.is_some() && target.system != System::Hack {
            let message = format!("--os is Jack's, and {} has its own", target.name);
            return Err(Failure::Usage(message));
        }
        let basic = target.system.language() == Language::Basic;
        if self.style.is_some() && !basic && !is_6502(target) {
            let message = format!(
                "--style is BASIC's and the 6502's; {} has one way to write",
                target.name
            );
            return Err(Failure::Usage(message));
        }
        if self.undocumented && !is_6502(target) {
            let message = format!("--undocumented is the 6502's; {} is none", target.name);
            return Err(Failure::Usage(message));
        }
        if self.page.is_some() && !matches!(target.system, System::BbcBasic | System::BbcCode) {
            let message = format!("--page is the BBC Micro's; {} has none", target.name);
            return Err(Failure::Usage(message));
        }
        Ok(())
    }
}
