//! Programs that are played: a run with a keyboard.

use super::{Loaded, MachineRun, Program, bbc, hack, mos6502};
use crate::failure::{Failure, Outcome};
use crate::interrupt;
use slowlight_vm::keys::Keyboard;
use slowlight_vm::{Progress, Stop};

impl Loaded {
    /// Runs the program as [`Loaded::run`] does, with a keyboard, which it gives back. The
    /// machines around a 6502 have one only where there is a script: without, their programs
    /// have ended where they wait for a key.
    ///
    /// # Errors
    /// An interruption, and a script for a machine that has no keyboard.
    pub fn play(
        &mut self,
        mut keyboard: Keyboard,
        limit: u64,
        progress: &mut dyn FnMut(Progress<'_>),
    ) -> Outcome<(MachineRun, Keyboard)> {
        let mut watch = |now: Progress<'_>| {
            progress(now);
            !interrupt::pressed()
        };
        let run = match &mut self.program {
            Program::Hack(on) => hack::play(on, &mut keyboard, limit, &mut watch),
            Program::HackCpu(on) => {
                on.plug(keyboard.clone());
                let run = hack::run_cpu(on, self.sizes, limit, &mut watch);
                keyboard = on.unplug().unwrap_or(keyboard);
                run
            }
            Program::Bbc(machine) => {
                let (run, played) = bbc::play(machine, keyboard, limit, &mut watch);
                keyboard = played;
                run
            }
            Program::Mos6502(machine) => {
                if keyboard.is_scripted() && !machine.plug(keyboard.clone()) {
                    let message = "--keys: the plain machine has no keyboard".to_owned();
                    return Err(Failure::Usage(message));
                }
                let run = mos6502::run(machine.as_mut(), self.sizes, limit, &mut watch);
                keyboard = machine.unplug().unwrap_or(keyboard);
                run
            }
        };
        if run.stop == Stop::Interrupted {
            return Err(Failure::Interrupted);
        }
        Ok((run, keyboard))
    }
}
