//! Options that only some machines have.

use super::ScreenArgs;
use crate::failure::{Failure, Outcome};
use crate::target_args::is_6502;
use slowlight_compiler::targets::{Language, System, Target};

impl ScreenArgs {
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
