//! The machines around a 6502: assembly or binary in, a picture out.

use super::binary::{self, Binary};
use super::board::Config;
use super::line_map::LineMap;
use super::{File, Loaded, MachineRun, Program, Sizes, refused};
use crate::failure::{Failure, Outcome};
use slowlight_compiler::report::profile::Line;
use slowlight_vm::mos6502::plain::port;
use slowlight_vm::mos6502::{Assembly, Machine, Parsed, Run};
use slowlight_vm::{Charges, Roles, Watch};
use std::collections::BTreeMap;

/// Takes one file: assembly source, which is any text, or a binary (see [`binary`]).
pub fn load(files: &[File], config: Config) -> Outcome<Loaded> {
    let [file] = files else {
        let message = "the 6502 takes one file: an assembly source or a binary".to_owned();
        return Err(Failure::Usage(message));
    };
    match binary::is_text(file) {
        true => load_source(file, config),
        false => load_binary(file, config),
    }
}

fn load_binary(file: &File, config: Config) -> Outcome<Loaded> {
    let Binary { at, start, bytes } = binary::read(file, config)?;
    let mut machine = config.board.machine();
    let loaded = machine.load_at(at, &bytes, start);
    loaded.map_err(|fault| refused("machine", &file.name, &[fault]))?;
    Ok(Loaded {
        system: Vec::new(),
        binaries: Vec::new(),
        sizes: Sizes {
            code: Some(bytes.len() as u64),
            ..Sizes::default()
        },
        program: Program::Mos6502(machine),
        map: LineMap::Unknown,
    })
}

fn load_source(file: &File, config: Config) -> Outcome<Loaded> {
    if config.at.is_some() {
        let message = format!(
            "{} is a text, which is assembled and says itself where it lies; --at is for binaries",
            file.name
        );
        return Err(Failure::Usage(message));
    }
    Source::of(file, config).load(&[])
}

/// A program's text, read: it can be loaded with other numbers than it has.
pub struct Source {
    name: String,
    parsed: Parsed,
    config: Config,
}

impl Source {
    /// Of a file of assembly; what is wrong with it is said where it is loaded.
    pub fn of(file: &File, config: Config) -> Source {
        Source {
            name: file.name.clone(),
            parsed: Parsed::of(&file.as_text(), config.dialect),
            config,
        }
    }

    /// Assembles it with these numbers for symbols that it assigns others, and loads it.
    ///
    /// # Errors
    /// What the assembler says of it, and what the machine does.
    pub fn load(&self, numbers: &[(&str, i64)]) -> Outcome<Loaded> {
        let assembly = self.parsed.assemble(numbers).map_err(|faults| {
            let failure = refused("assembler", &self.name, &faults);
            match failure {
                Failure::Wrong(said) => Failure::Wrong(format!("{said}\n{}", ANY_ASSEMBLER)),
                other => other,
            }
        })?;
        loaded(&assembly, &self.name, self.config)
    }
}

fn loaded(assembly: &Assembly, name: &str, config: Config) -> Outcome<Loaded> {
    let Config { board, start, .. } = config;
    let image = assembly.image();
    let mut machine = board.machine();
    let loaded = match board.loaded(&image).as_slice() {
        [lo, hi, bytes @ ..] => machine.load_at(u16::from_le_bytes([*lo, *hi]), bytes, start),
        _ => Ok(()),
    };
    loaded.map_err(|fault| refused("machine", name, &[fault]))?;
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    Ok(Loaded {
        system: Vec::new(),
        binaries: board.files(stem, image),
        sizes: sizes(assembly),
        program: Program::Mos6502(machine),
        map: map(assembly),
    })
}

/// What to do with a program for another assembler.
const ANY_ASSEMBLER: &str = "\
The bundled assembler is there for what `build` writes: docs/6502.md, \"What our assembler reads\". \
A program for another one runs from its binary: assemble it there, then \
`slowlight vm 6502 FILE --at ADDR --start ADDR`, or FILE.prg as it is.";

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

/// Runs a program that was loaded. RAM is what it leaves changed, where that is known:
/// memory is 0 at first.
pub fn run(machine: &mut dyn Machine, sizes: Sizes, limit: u64, watch: Watch<'_>) -> MachineRun {
    watched(machine, sizes, |machine| (machine.run(limit, watch), ())).0
}

/// The same, with what each address took.
pub fn charges(
    machine: &mut dyn Machine,
    sizes: Sizes,
    limit: u64,
    roles: Roles<'_>,
    watch: Watch<'_>,
) -> (MachineRun, Charges) {
    watched(machine, sizes, |machine| {
        machine.charges(limit, roles, watch)
    })
}

fn watched<T>(
    machine: &mut dyn Machine,
    sizes: Sizes,
    run: impl FnOnce(&mut dyn Machine) -> (Run, T),
) -> (MachineRun, T) {
    // Where the screen is memory like any other, and programs move, that tells nothing.
    let counted = if machine.draws_apart() {
        port::WIDTH
    } else {
        0
    };
    let before: Vec<u8> = (0..counted).map(|at| machine.peek(at)).collect();
    let (run, more) = run(machine);
    let changed = before
        .iter()
        .zip(0..)
        .filter(|(was, at)| machine.peek(*at) != **was);
    let ram = (counted > 0).then_some(changed.count() as u64);
    let run = MachineRun {
        stop: run.stop,
        cycles: run.cycles,
        plot_cycles: None,
        vm_instructions: None,
        os_calls: None,
        rom_words: None,
        screen: run.screen,
        output: run.output,
        files: BTreeMap::new(),
        sizes: Sizes { ram, ..sizes },
    };
    (run, more)
}
