//! What each line of a program's sources takes on its machine.
//!
//! Machines count by places of their own ([`slowlight_vm::Charge`]); here those
//! become lines of the files that were given.

use super::{Loaded, MachineRun, Program, bbc, hack, mos6502};
use crate::failure::{Failure, Outcome};
use crate::interrupt;
use slowlight_compiler::report::profile::{Cost, Line};
use slowlight_vm::{Charge, Progress, Stop};
use std::collections::BTreeMap;

/// From a machine's places to lines.
#[derive(Clone, Debug, Default)]
pub(super) enum LineMap {
    /// Not known.
    #[default]
    Unknown,
    /// The line of each place; none for what no file has.
    Places(Vec<Option<Line>>),
}

impl LineMap {
    fn line(&self, place: u32) -> Option<Line> {
        match self {
            LineMap::Unknown => None,
            LineMap::Places(lines) => lines.get(place as usize).copied().flatten(),
        }
    }
}

impl Loaded {
    /// Runs the program as [`Loaded::run`] does, and counts what each line takes: lines
    /// that `routine` knows, and what is no line of any file, are charged to the lines
    /// that call them. All costs together are the run's cycles.
    ///
    /// # Errors
    /// An interruption, and a machine that cannot tell.
    pub fn charges(
        &mut self,
        limit: u64,
        routine: &dyn Fn(Line) -> bool,
        progress: &mut dyn FnMut(Progress),
    ) -> Outcome<(MachineRun, Vec<Cost>)> {
        let mut watch = |now: Progress| {
            progress(now);
            !interrupt::pressed()
        };
        let map = &self.map;
        let called = |place| map.line(place).is_none_or(routine);
        let (run, charges) = match &mut self.program {
            Program::Hack(program) => hack::charges(program, limit, &called, &mut watch),
            Program::Bbc(machine) => bbc::charges(machine, limit, &called, &mut watch),
            Program::Mos6502(machine) => {
                mos6502::charges(machine, self.sizes, limit, &called, &mut watch)
            }
            Program::HackCpu(_) => {
                let message = "the lines of a program in the Hack's ROM are not counted: leave --os jack out, which counts the commands of the VM";
                return Err(Failure::Usage(message.to_owned()));
            }
        };
        if run.stop == Stop::Interrupted {
            return Err(Failure::Interrupted);
        }
        Ok((run, by_line(&charges, &self.map)))
    }

    /// What each line takes in memory: bytes, or commands of the Hack VM.
    pub fn line_sizes(&self) -> Vec<(Line, u64)> {
        let sizes: Vec<u64> = match (&self.program, &self.map) {
            (Program::Bbc(machine), _) => {
                let statements = machine.statements().into_iter();
                statements
                    .map(|statement| u64::from(statement.bytes))
                    .collect()
            }
            (_, LineMap::Places(places)) => vec![1; places.len()],
            _ => Vec::new(),
        };
        let mut found: BTreeMap<Line, u64> = BTreeMap::new();
        for (place, size) in (0..).zip(sizes) {
            if let Some(line) = self.map.line(place) {
                *found.entry(line).or_default() += size;
            }
        }
        found.into_iter().collect()
    }
}

/// Charges of the same line together; a line is begun as often as the place in it
/// that is begun most.
fn by_line(charges: &[Charge], map: &LineMap) -> Vec<Cost> {
    let mut costs: BTreeMap<(Option<Line>, Option<Option<Line>>), Cost> = BTreeMap::new();
    for charge in charges {
        let line = map.line(charge.place);
        let routine = charge.routine.map(|entry| map.line(entry));
        let cost = costs.entry((line, routine)).or_insert(Cost {
            line,
            called: routine,
            times: 0,
            cycles: 0,
        });
        cost.cycles += charge.cycles;
        cost.times = match routine {
            None => cost.times.max(charge.times),
            Some(_) => cost.times + charge.times,
        };
    }
    costs.into_values().collect()
}
