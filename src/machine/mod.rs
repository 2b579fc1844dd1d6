//! The bundled machines as the command line uses them: sources in; files for
//! the real machine, counts and a screen out.
//!
//! The machines know nothing of scenes, and the compiler nothing of machines.
//! This is where a target's name chooses its machine.

mod bbc;
mod binary;
mod board;
mod boot;
mod charge;
mod dfs;
mod hack;
mod keys;
mod line_map;
mod mos6502;
mod os;

pub use binary::address;
pub use board::{Board, Config as Mos6502Config};
pub use charge::{LineRoles, Lines};
pub use hack::Config as HackConfig;
pub use mos6502::Source as Mos6502Source;

use crate::failure::{Failure, Outcome};
use crate::interrupt;
use crate::picture::Picture;
use slowlight_compiler::targets::{System, Target};
use slowlight_vm::bbc::{Config, Dialect, LineCost};
use slowlight_vm::hack::vm::Heap;
use slowlight_vm::{Progress, Screen, Stop};
use std::collections::BTreeMap;

/// A machine that is bundled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Machine {
    /// The Hack computer: Jack and VM code on its VM or, translated, on its CPU;
    /// machine code on its CPU.
    Hack(HackConfig),
    /// BBC BASIC and its screen.
    Bbc(Config),
    /// A machine around a 6502, and how its assembly is written.
    Mos6502(Mos6502Config),
}

/// A source text or binary by its file name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// Its name, without directories.
    pub name: String,
    /// What is in it.
    pub bytes: Vec<u8>,
}

impl File {
    /// A text.
    pub fn text(name: &str, text: &str) -> File {
        File {
            name: name.to_owned(),
            bytes: text.as_bytes().to_vec(),
        }
    }

    /// The text, with what is not UTF-8 replaced.
    pub fn as_text(&self) -> std::borrow::Cow<'_, str> {
        String::from_utf8_lossy(&self.bytes)
    }

    fn extension(&self) -> String {
        let end = self.name.rsplit_once('.').map_or("", |(_, e)| e);
        end.to_ascii_lowercase()
    }
}

/// How large a program is, in bytes; what is not known is absent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sizes {
    /// Code.
    pub code: Option<u64>,
    /// Tables: in the program, or in memory where the program makes them.
    pub tables: Option<u64>,
    /// Memory beside the program: variables, arrays, stack.
    pub ram: Option<u64>,
}

/// A program that a machine's own tools have accepted.
pub struct Loaded {
    /// The sources of what the program was completed with: an operating system.
    pub system: Vec<File>,
    /// What the real machine loads, beside the sources; may be empty.
    pub binaries: Vec<File>,
    /// Sizes as far as they are known before it runs.
    pub sizes: Sizes,
    program: Program,
    map: line_map::LineMap,
}

enum Program {
    Hack(Box<hack::OnVm>),
    HackCpu(Box<hack::OnCpu>),
    Bbc(slowlight_vm::bbc::Machine),
    Mos6502(Box<dyn slowlight_vm::mos6502::Machine>),
}

/// How a run on a machine went.
#[derive(Clone, Debug)]
pub struct MachineRun {
    /// Why it ended.
    pub stop: Stop,
    /// The machine's own cycles (VM instructions on the Hack VM).
    pub cycles: u64,
    /// Of those, what drawing took, where the machine can tell.
    pub plot_cycles: Option<u64>,
    /// VM instructions with a native operating system (Jack), where they were counted.
    pub vm_instructions: Option<u64>,
    /// Words of the ROM that the program takes, where it is in one.
    pub rom_words: Option<u64>,
    /// Calls of the native operating system's functions (Jack).
    pub os_calls: Option<u64>,
    /// The screen; none where the program showed nothing.
    pub screen: Option<Screen>,
    /// What the program printed, if it prints beside the screen.
    pub output: Vec<u8>,
    /// The files that it wrote, by name.
    pub files: BTreeMap<String, Vec<u8>>,
    /// Sizes as far as they are known now.
    pub sizes: Sizes,
}

impl Machine {
    /// The machine of a target.
    pub fn of(target: &Target) -> Machine {
        let bbc = |dialect| {
            Machine::Bbc(Config {
                dialect,
                ..Config::default()
            })
        };
        let mos6502 = |board| {
            Machine::Mos6502(Mos6502Config {
                board,
                ..Mos6502Config::default()
            })
        };
        match target.system {
            System::Hack => Machine::Hack(HackConfig::default()),
            System::BbcBasic => bbc(Dialect::Micro),
            System::Agon => bbc(Dialect::Agon),
            System::BasicV => bbc(Dialect::BasicV),
            System::Plain6502 => mos6502(Board::Plain),
            System::BbcCode => mos6502(Board::Bbc),
            System::C64 => mos6502(Board::C64),
            System::Vcs => mos6502(Board::Vcs),
        }
    }

    /// The same with programs beginning elsewhere, where the machine knows that.
    pub fn at_page(self, page: Option<u16>) -> Machine {
        match (self, page) {
            (Machine::Bbc(config), Some(page)) => Machine::Bbc(Config { page, ..config }),
            (machine, _) => machine,
        }
    }

    /// The same for a scene's program on the Hack computer's processor, with an
    /// operating system in Jack; other machines stay what they are.
    pub fn on_processor(self) -> Machine {
        match self {
            Machine::Hack(config) => Machine::Hack(HackConfig {
                cpu: true,
                os: true,
                count: true,
                ..config
            }),
            machine => machine,
        }
    }

    /// The same with another heap of the Hack VM's native system; other machines stay what
    /// they are.
    pub fn with_heap(self, heap: Heap) -> Machine {
        match self {
            Machine::Hack(config) => Machine::Hack(HackConfig { heap, ..config }),
            machine => machine,
        }
    }

    /// The extension of its source files.
    pub fn extension(self) -> &'static str {
        match self {
            Machine::Hack(_) => "jack",
            Machine::Bbc(_) => "bas",
            Machine::Mos6502(_) => "asm",
        }
    }

    /// Whether a program is several sources together.
    pub fn many_sources(self) -> bool {
        matches!(self, Machine::Hack(_))
    }

    /// Compiles, tokenises or assembles files for the machine.
    ///
    /// # Errors
    /// Whatever the machine's tools say of the files.
    pub fn load(self, files: &[File]) -> Outcome<Loaded> {
        match self {
            Machine::Hack(config) => hack::load(files, config),
            Machine::Bbc(config) => bbc::load(files, config),
            Machine::Mos6502(config) => mos6502::load(files, config),
        }
    }
}

impl Loaded {
    /// Runs the program until it ends, faults, has used `limit` cycles, or is interrupted.
    ///
    /// # Errors
    /// Only an interruption: how a program ended is in the answer.
    pub fn run(
        &mut self,
        limit: u64,
        progress: &mut dyn FnMut(Progress<'_>),
    ) -> Outcome<MachineRun> {
        let mut watch = |now: Progress<'_>| {
            progress(now);
            !interrupt::pressed()
        };
        let run = match &mut self.program {
            Program::Hack(program) => hack::run(program, limit, &mut watch),
            Program::HackCpu(on) => hack::run_cpu(on, self.sizes, limit, &mut watch),
            Program::Bbc(machine) => bbc::run(machine, limit, &mut watch),
            Program::Mos6502(machine) => {
                mos6502::run(machine.as_mut(), self.sizes, limit, &mut watch)
            }
        };
        if run.stop == Stop::Interrupted {
            return Err(Failure::Interrupted);
        }
        Ok(run)
    }

    /// What is accepted of the program and may be a mistake.
    pub fn warnings(&self) -> &[slowlight_vm::Fault] {
        match &self.program {
            Program::Hack(on) => &on.warnings,
            Program::HackCpu(on) => &on.warnings,
            _ => &[],
        }
    }

    /// Runs a BASIC program, and counts what each of its lines takes.
    ///
    /// # Errors
    /// An interruption, and a machine that has no lines to count.
    pub fn profile(&mut self, limit: u64) -> Outcome<(MachineRun, Vec<LineCost>)> {
        let Program::Bbc(machine) = &self.program else {
            let message = "--profile counts lines of BASIC; this machine has none".to_owned();
            return Err(Failure::Usage(message));
        };
        let (run, lines) = bbc::profile(machine, limit, &mut |_| !interrupt::pressed());
        if run.stop == Stop::Interrupted {
            return Err(Failure::Interrupted);
        }
        Ok((run, lines))
    }
}

impl MachineRun {
    /// The screen as a picture.
    pub fn picture(&self) -> Option<Picture> {
        self.screen.as_ref().map(Picture::from)
    }
}

/// Why a run ended, in a word for JSON.
pub fn stop_word(stop: &Stop) -> &'static str {
    match stop {
        Stop::Ended => "ended",
        Stop::CycleLimit => "limit",
        Stop::Interrupted => "interrupted",
        Stop::Fault(_) => "fault",
    }
}

/// What is wrong with a run that did not end by itself; `None` where it did.
pub fn complaint(run: &MachineRun, limit: u64) -> Option<String> {
    match &run.stop {
        Stop::Ended => None,
        Stop::CycleLimit => Some(format!(
            "the program did not end within {limit} cycles; give more with --limit"
        )),
        Stop::Interrupted => Some("interrupted".to_owned()),
        Stop::Fault(fault) => Some(fault.to_string()),
    }
}

/// Several faults as one failure.
fn refused(what: &str, name: &str, faults: &[slowlight_vm::Fault]) -> Failure {
    let mut message = format!("the {what} refuses {name}:");
    for fault in faults.iter().take(10) {
        message.push_str(&format!("\n  {fault}"));
    }
    if faults.len() > 10 {
        message.push_str(&format!("\n  and {} more", faults.len() - 10));
    }
    Failure::Wrong(message)
}
