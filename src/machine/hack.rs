//! The Hack computer: Jack classes, VM code, assembly or an image of the ROM in;
//! a picture and text out.
//!
//! Jack and VM code run on the VM with its native OS or ours in Jack, or are
//! translated and run on the CPU, where what the program does not bring of an OS is
//! ours.

use super::line_map::LineMap;
use super::os::{Noted, System, complete};
use super::{File, Loaded, MachineRun, Program, Sizes, refused};
use crate::failure::{Failure, Outcome};
use slowlight_compiler::report::profile::Line;
use slowlight_vm::hack::asm::{assemble, read_image, write_image};
use slowlight_vm::hack::cpu::Cpu;
use slowlight_vm::hack::translate::{Options, translate};
use slowlight_vm::hack::{jack, vm};
use slowlight_vm::keys::Keyboard;
use slowlight_vm::{Charges, Fault, Progress, Roles, Stop, Watch};
use std::collections::BTreeMap;

/// Words of RAM before the screen, from the first static.
const RAM: std::ops::Range<u16> = 16..16384;

/// How programs run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Config {
    /// On the processor, translated, and not on the VM. The operating system is in
    /// Jack there: there is no other.
    pub cpu: bool,
    /// With the operating system in Jack, as far as the program brings none itself.
    pub os: bool,
    /// The heap that the VM's native system has. Ours in Jack has its own.
    pub heap: vm::Heap,
    /// Whether to count on the VM, too, what runs on the processor.
    pub count: bool,
}

/// A program for the VM.
#[derive(Clone, Debug)]
pub struct OnVm {
    program: vm::Program,
    heap: vm::Heap,
    noted: Option<Noted>,
    pub(super) warnings: Vec<Fault>,
}

/// A program for the processor.
#[derive(Clone, Debug)]
pub struct OnCpu {
    cpu: Cpu,
    noted: Option<Noted>,
    pub(super) warnings: Vec<Fault>,
    /// The same on the VM with its own system.
    counted: Option<vm::Program>,
}

/// Takes Jack classes (`.jack`), VM code (`.vm`), or some of both; or one file of
/// assembly (`.asm`) or of the ROM's words (`.hack`), for the processor. Translated,
/// the binaries are the translation as assembly and as an image.
pub fn load(files: &[File], config: Config) -> Outcome<Loaded> {
    if files.iter().any(is_machine_code) {
        return load_machine_code(files);
    }
    let Compiled {
        mut code,
        lines,
        missing,
        warnings,
    } = compile(files)?;
    let mut found = System::default();
    if config.os || config.cpu {
        let calling = missing.calling();
        found = complete(&[code.as_slice(), calling.as_slice()].concat())?;
    }
    let System {
        sources: system,
        code: system_code,
    } = found;
    code.extend(missing.file());
    let own = code.clone();
    code.extend(system_code);
    let all = code;
    let program = link(&all)?;
    let noted = Noted::of(&program, &system);
    if !config.cpu {
        return Ok(Loaded {
            system,
            binaries: Vec::new(),
            sizes: Sizes::default(),
            map: map(files, &lines, &program),
            program: Program::Hack(Box::new(OnVm {
                program,
                heap: config.heap,
                noted,
                warnings,
            })),
        });
    }
    let translation = translate(&program, Options::default())
        .map_err(|faults| refused("translator", "the program", &faults))?;
    let mut loaded = rom("Main.hack", &translation.words)?;
    let assembly = File::text("Main.asm", &translation.assembly);
    loaded.binaries.push(assembly);
    loaded.system = system;
    if let Program::HackCpu(on) = &mut loaded.program {
        on.noted = noted;
        on.warnings = warnings;
        on.counted = config.count.then(|| link(&own)).transpose()?;
    }
    Ok(loaded)
}

fn is_machine_code(file: &File) -> bool {
    matches!(file.extension().as_str(), "asm" | "hack")
}

fn load_machine_code(files: &[File]) -> Outcome<Loaded> {
    let [file] = files else {
        let message =
            "the Hack CPU takes one file of assembly (.asm) or of its ROM's words (.hack)";
        return Err(Failure::Usage(message.to_owned()));
    };
    if file.extension() == "asm" {
        let assembly = assemble(&file.as_text())
            .map_err(|faults| refused("assembler", &file.name, &faults))?;
        let stem = file.name.rsplit_once('.').map_or("", |(stem, _)| stem);
        return rom(&format!("{stem}.hack"), &assembly.words);
    }
    let words =
        read_image(&file.as_text()).map_err(|faults| refused("machine", &file.name, &faults))?;
    let mut loaded = rom(&file.name, &words)?;
    loaded.binaries.clear();
    Ok(loaded)
}

/// A CPU with these words in its ROM; `name` is that of the image's file.
fn rom(name: &str, words: &[u16]) -> Outcome<Loaded> {
    let cpu = Cpu::new(words).map_err(|fault| refused("machine", name, &[fault]))?;
    Ok(Loaded {
        system: Vec::new(),
        binaries: vec![File::text(name, &write_image(words))],
        sizes: Sizes {
            code: Some(2 * words.len() as u64),
            ..Sizes::default()
        },
        program: Program::HackCpu(Box::new(OnCpu {
            cpu,
            noted: None,
            warnings: Vec::new(),
            counted: None,
        })),
        map: LineMap::Unknown,
    })
}

fn link(files: &[(String, String)]) -> Outcome<vm::Program> {
    vm::Program::link(files).map_err(|faults| refused("linker", "the program", &faults))
}

/// A program as VM code, before an operating system.
struct Compiled {
    code: Vec<(String, String)>,
    lines: CommandLines,
    missing: vm::Missing,
    /// What is accepted and may be a mistake.
    warnings: Vec<Fault>,
}

/// Compiles what is Jack, and adds it to what is VM code.
fn compile(files: &[File]) -> Outcome<Compiled> {
    let mut classes = Vec::new();
    let mut program = Vec::new();
    for file in files {
        let text = (file.name.clone(), file.as_text().into_owned());
        match file.extension().as_str() {
            "jack" => classes.push(text),
            "vm" => program.push(text),
            _ => {
                let message = format!(
                    "{} is neither Jack (.jack) nor VM code (.vm) nor assembly (.asm) nor an image of the ROM (.hack)",
                    file.name
                );
                return Err(Failure::Usage(message));
            }
        }
    }
    let mut warnings = Vec::new();
    let compiled = jack::compile_warning(&classes, &mut warnings)
        .map_err(|faults| refused("Jack compiler", "the program", &faults))?;
    let mut lines = CommandLines::new();
    let sources = files.iter().enumerate();
    let sources = sources.filter(|(_, file)| file.extension() == "jack");
    for ((document, _), class) in sources.zip(compiled) {
        lines.insert(class.name.clone(), (document, class.lines));
        program.push((class.name, class.text));
    }
    let missing =
        vm::Missing::of(&program).map_err(|faults| refused("linker", "the program", &faults))?;
    // The compiler has said what is called in Jack.
    let in_code = |call: &Fault| !call.file.as_ref().is_some_and(|f| lines.contains_key(f));
    warnings.extend(missing.calls.iter().filter(|call| in_code(call)).cloned());
    Ok(Compiled {
        code: program,
        lines,
        missing,
        warnings,
    })
}

/// For each file of VM code that was a class: which of the sources that is, and the
/// line (from 1) behind each of its own.
type CommandLines = BTreeMap<String, (usize, Vec<u32>)>;

/// The line behind each command.
fn map(files: &[File], lines: &CommandLines, program: &vm::Program) -> LineMap {
    let own = |name: &str| files.iter().position(|file| file.name == name);
    let line = |(name, at): (&str, u32)| {
        let at = at.saturating_sub(1) as usize;
        let (document, line) = match lines.get(name) {
            Some((document, lines)) => (*document, lines.get(at)?.saturating_sub(1) as usize),
            None => (own(name)?, at),
        };
        Some(Line {
            document,
            line,
            statement: 0,
        })
    };
    LineMap::Places(program.origins().map(line).collect())
}

/// Runs a program that was loaded. RAM is what it leaves changed of statics,
/// stack and heap, where the native OS's few words count too.
pub fn run(on: &OnVm, limit: u64, watch: Watch<'_>) -> MachineRun {
    let mut machine = vm::Machine::with_heap(&on.program, on.heap);
    let run = machine.run(limit, watch);
    told(on, &machine, run)
}

/// The same with a keyboard.
pub fn play(on: &OnVm, keyboard: &mut Keyboard, limit: u64, watch: Watch<'_>) -> MachineRun {
    let mut machine = vm::Machine::with_heap(&on.program, on.heap);
    machine.plug(keyboard.clone());
    let run = machine.run(limit, watch);
    if let Some(played) = machine.unplug() {
        *keyboard = played;
    }
    told(on, &machine, run)
}

impl OnCpu {
    /// Gives the processor a keyboard.
    pub fn plug(&mut self, keyboard: Keyboard) {
        self.cpu.plug(keyboard);
    }

    /// Takes it away again.
    pub fn unplug(&mut self) -> Option<Keyboard> {
        self.cpu.unplug()
    }
}

/// The same, with what each command took.
pub fn charges(on: &OnVm, limit: u64, roles: Roles<'_>, watch: Watch<'_>) -> (MachineRun, Charges) {
    let mut machine = vm::Machine::with_heap(&on.program, on.heap);
    let (run, charges) = machine.charges(limit, roles, watch);
    (told(on, &machine, run), charges)
}

fn told(on: &OnVm, machine: &vm::Machine<'_>, mut run: vm::Run) -> MachineRun {
    if on.program.is_bare() {
        let words = machine.stack();
        let words = words.iter().map(i16::to_string).collect::<Vec<String>>();
        run.text.push_str(&format!("stack: {}\n", words.join(" ")));
    }
    MachineRun {
        vm_instructions: Some(run.instructions),
        os_calls: Some(run.os_calls),
        output: run.text.into_bytes(),
        sizes: Sizes {
            ram: Some(ram(|at| machine.peek(at))),
            ..Sizes::default()
        },
        ..finished(
            stop(run.stop, on.noted, |at| machine.peek(at)),
            run.instructions,
            run.screen,
        )
    }
}

/// The same for machine code; and before that on the VM, where that is to count.
pub fn run_cpu(on: &mut OnCpu, sizes: Sizes, limit: u64, watch: Watch<'_>) -> MachineRun {
    let quiet = &mut |now: Progress<'_>| watch(Progress { row: None, ..now });
    let counted = on.counted.as_ref();
    let counted = counted.map(|program| vm::Machine::new(program).run(limit, quiet));
    if let Some(Stop::Interrupted) = counted.as_ref().map(|run| &run.stop) {
        return finished(Stop::Interrupted, 0, on.cpu.run(0, watch).screen);
    }
    let run = on.cpu.run(limit, watch);
    let cpu = &on.cpu;
    MachineRun {
        vm_instructions: counted.as_ref().map(|run| run.instructions),
        os_calls: counted.map(|run| run.os_calls),
        rom_words: sizes.code.map(|bytes| bytes / 2),
        sizes: Sizes {
            ram: Some(ram(|at| cpu.peek(at))),
            ..sizes
        },
        ..finished(
            stop(run.stop, on.noted, |at| cpu.peek(at)),
            run.cycles,
            run.screen,
        )
    }
}

/// Why a run ended: that of a program with the system in Jack also because of an
/// error, after which it halts.
fn stop(stop: Stop, noted: Option<Noted>, peek: impl Fn(u16) -> i16) -> Stop {
    match noted.and_then(|noted| noted.error(peek)) {
        Some(number) if stop == Stop::Ended => Stop::Fault(Fault {
            message: match number {
                vm::MISSING => "the program calls a function that it lacks".to_owned(),
                _ => format!("Sys.error({number})"),
            },
            file: None,
            line: None,
            column: None,
        }),
        _ => stop,
    }
}

/// Bytes of RAM that are not zero.
fn ram(peek: impl Fn(u16) -> i16) -> u64 {
    2 * RAM.filter(|at| peek(*at) != 0).count() as u64
}

fn finished(stop: Stop, cycles: u64, screen: slowlight_vm::Screen) -> MachineRun {
    MachineRun {
        stop,
        cycles,
        plot_cycles: None,
        vm_instructions: None,
        os_calls: None,
        rom_words: None,
        screen: Some(screen),
        output: Vec::new(),
        files: BTreeMap::new(),
        sizes: Sizes::default(),
    }
}
