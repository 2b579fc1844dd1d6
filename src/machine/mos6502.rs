//! The plain 6502 machine: assembly or binary in, a picture out.

use super::charge::LineMap;
use super::{File, Loaded, MachineRun, Program, Sizes, refused};
use crate::failure::{Failure, Outcome};
use slowlight_compiler::report::profile::Line;
use slowlight_vm::mos6502::plain::{self, port};
use slowlight_vm::mos6502::{Assembly, Dialect, Plain, assemble_as};
use slowlight_vm::{Charge, Fault, Watch};
use std::collections::BTreeMap;

/// Takes one assembly source (`.asm`, `.s`, `.a65`), or one binary that begins
/// with its load address.
pub fn load(files: &[File], dialect: Dialect) -> Outcome<Loaded> {
    let [file] = files else {
        let message = "the 6502 takes one file: an assembly source or a binary".to_owned();
        return Err(Failure::Usage(message));
    };
    let mut machine = Plain::new();
    let refuse = |fault: Fault| refused("machine", &file.name, &[fault]);
    if !matches!(file.extension().as_str(), "asm" | "s" | "a65" | "inc") {
        machine.load(&file.bytes).map_err(refuse)?;
        let code = file.bytes.len().saturating_sub(2) as u64;
        return Ok(Loaded {
            system: Vec::new(),
            binaries: Vec::new(),
            sizes: Sizes {
                code: Some(code),
                ..Sizes::default()
            },
            program: Program::Mos6502(Box::new(machine)),
            map: LineMap::Unknown,
        });
    }
    let assembly = assemble_as(&file.as_text(), dialect)
        .map_err(|faults| refused("assembler", &file.name, &faults))?;
    let image = assembly.image();
    machine.load(&image).map_err(refuse)?;
    let stem = file.name.rsplit_once('.').map_or("", |(stem, _)| stem);
    Ok(Loaded {
        system: Vec::new(),
        binaries: vec![File {
            name: format!("{stem}.bin"),
            bytes: image,
        }],
        sizes: sizes(&assembly),
        program: Program::Mos6502(Box::new(machine)),
        map: map(&assembly),
    })
}

/// Instructions are code, and what `.byte` and `.word` make is tables.
fn sizes(assembly: &Assembly) -> Sizes {
    let bytes = |code: bool| {
        let spans = assembly.lines.iter().filter(|l| l.code == code);
        Some(spans.map(|l| u64::from(l.length)).sum())
    };
    Sizes {
        code: bytes(true),
        tables: bytes(false),
        ram: None,
    }
}

/// The line behind each address.
fn map(assembly: &Assembly) -> LineMap {
    let mut places = vec![None; 0x1_0000];
    for span in &assembly.lines {
        let line = Line {
            document: 0,
            line: span.line.saturating_sub(1) as usize,
            statement: 0,
        };
        let bytes = places.iter_mut().skip(usize::from(span.address));
        bytes
            .take(span.length as usize)
            .for_each(|place| *place = Some(line));
    }
    LineMap::Places(places)
}

/// Runs a program that was loaded. RAM is what it leaves changed: memory is 0 at first.
pub fn run(machine: &mut Plain, sizes: Sizes, limit: u64, watch: Watch<'_>) -> MachineRun {
    watched(machine, sizes, |machine| (machine.run(limit, watch), ())).0
}

/// The same, with what each address took.
pub fn charges(
    machine: &mut Plain,
    sizes: Sizes,
    limit: u64,
    routine: &dyn Fn(u32) -> bool,
    watch: Watch<'_>,
) -> (MachineRun, Vec<Charge>) {
    watched(machine, sizes, |machine| {
        machine.charges(limit, routine, watch)
    })
}

fn watched<T>(
    machine: &mut Plain,
    sizes: Sizes,
    run: impl FnOnce(&mut Plain) -> (plain::Run, T),
) -> (MachineRun, T) {
    let before: Vec<u8> = (0..port::WIDTH).map(|at| machine.peek(at)).collect();
    let (run, more) = run(machine);
    let changed = before
        .iter()
        .zip(0..)
        .filter(|(was, at)| machine.peek(*at) != **was);
    let ram = Some(changed.count() as u64);
    let run = MachineRun {
        stop: run.stop,
        cycles: run.cycles,
        plot_cycles: None,
        vm_instructions: None,
        os_calls: None,
        rom_words: None,
        screen: run.screen,
        output: Vec::new(),
        files: BTreeMap::new(),
        sizes: Sizes { ram, ..sizes },
    };
    (run, more)
}
