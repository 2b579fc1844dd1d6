//! What each line of a program's sources takes on its machine.
//!
//! Machines count by places of their own ([`slowlight_vm::Charge`]); here those
//! become lines of the files that were given.

use super::line_map::LineMap;
use super::{Loaded, MachineRun, Program, bbc, hack, mos6502};
use crate::failure::{Failure, Outcome};
use crate::interrupt;
use slowlight_compiler::report::profile::{Cost, Line};
use slowlight_vm::{Charge, Progress, Roles, Stop};
use std::collections::BTreeMap;

/// What lines are to who counts, as [`Roles`] says it of places.
#[derive(Clone, Copy)]
pub struct LineRoles<'r> {
    /// Whether a line is a routine's.
    pub routine: &'r dyn Fn(Line) -> bool,
    /// The group whose stretches a line's cycles are part of, if any.
    pub group: &'r dyn Fn(Line) -> Option<u16>,
    /// Whether stretches end where a line begins.
    pub cuts: &'r dyn Fn(Line) -> bool,
}

/// What was counted.
pub struct Lines {
    /// By line.
    pub costs: Vec<Cost>,
    /// By group: the cycles of each stretch between two cuts in which there were any.
    pub stretches: BTreeMap<u16, Vec<u64>>,
    /// How many stretches there were at most.
    pub cuts: u64,
}

impl Loaded {
    /// Runs the program as [`Loaded::run`] does, and counts what each line takes: routines'
    /// lines, and what is no line of any file, are charged to the lines that call them. All
    /// costs together are the run's cycles.
    ///
    /// # Errors
    /// An interruption, and a machine that cannot tell.
    pub fn charges(
        &mut self,
        limit: u64,
        roles: LineRoles<'_>,
        progress: &mut dyn FnMut(Progress<'_>),
    ) -> Outcome<(MachineRun, Lines)> {
        let mut watch = |now: Progress<'_>| {
            progress(now);
            !interrupt::pressed()
        };
        let map = &self.map;
        let called = |place| map.line(place).is_none_or(roles.routine);
        let roles = Roles {
            routine: &called,
            group: &|place| map.line(place).and_then(roles.group),
            cuts: &|place| map.line(place).is_some_and(roles.cuts),
        };
        let (run, charges) = match &mut self.program {
            Program::Hack(program) => hack::charges(program, limit, roles, &mut watch),
            Program::Bbc(machine) => bbc::charges(machine, limit, roles, &mut watch),
            Program::Mos6502(machine) => {
                mos6502::charges(machine.as_mut(), self.sizes, limit, roles, &mut watch)
            }
            Program::HackCpu(_) => {
                let message = "the lines of a program in the Hack's ROM are not counted: leave --os jack out, which counts the commands of the VM";
                return Err(Failure::Usage(message.to_owned()));
            }
        };
        if run.stop == Stop::Interrupted {
            return Err(Failure::Interrupted);
        }
        let lines = Lines {
            costs: by_line(&charges.places, &self.map),
            stretches: charges.stretches,
            cuts: charges.cuts,
        };
        Ok((run, lines))
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
