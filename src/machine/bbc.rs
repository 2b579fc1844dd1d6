//! BBC BASIC: text or tokens in, a picture and text out.

use super::line_map::LineMap;
use super::{File, Loaded, MachineRun, Program, Sizes, refused};
use super::{boot, dfs};
use crate::failure::{Failure, Outcome};
use slowlight_compiler::report::profile::Line;
use slowlight_vm::bbc::{Config, Dialect, LineCost, Machine, StatementPlace, tokenise};
use slowlight_vm::keys::Keyboard;
use slowlight_vm::{Charges, Fault, Roles, Watch};

/// Takes one program: text (`.bas`), or tokens, known by the byte 13 in front, or a disc (`.ssd`)
/// that starts one.
pub fn load(files: &[File], config: Config) -> Outcome<Loaded> {
    let [file] = files else {
        let message = "BBC BASIC takes one file: a program as text or tokens".to_owned();
        return Err(Failure::Usage(message));
    };
    if file.extension() == "ssd" {
        return load_disc(file, config);
    }
    let refuse = |fault: Fault| refused("tokeniser", &file.name, &[fault]);
    let Config { dialect, page } = config;
    let mut machine = Machine::new(config);
    let mut binaries = Vec::new();
    // A line of tokens begins with 13 and its number's high byte; a text with
    // an empty line begins with 13 and 10.
    if file.bytes.first() == Some(&13) && file.bytes.get(1) != Some(&10) {
        machine.load_tokenised(&file.bytes).map_err(refuse)?;
    } else {
        let tokens = tokenise(&file.as_text(), dialect).map_err(refuse)?;
        machine.load_tokenised(&tokens).map_err(refuse)?;
        let stem = file.name.strip_suffix(".toot.txt");
        let stem = stem.or_else(|| Some(file.name.rsplit_once('.')?.0));
        let stem = stem.unwrap_or_default();
        let disc = match dialect {
            Dialect::Micro => dfs::bootable(stem, &tokens, page),
            _ => None,
        };
        let named = |extension: &str, bytes| File {
            name: format!("{stem}.{extension}"),
            bytes,
        };
        binaries.push(named("bbc", tokens));
        binaries.extend(disc.map(|bytes| named("ssd", bytes)));
    }
    Ok(loaded(machine, binaries))
}

fn loaded(machine: Machine, binaries: Vec<File>) -> Loaded {
    let sizes = Sizes {
        code: Some(machine.program_bytes() as u64),
        ..Sizes::default()
    };
    Loaded {
        system: Vec::new(),
        binaries,
        sizes,
        map: map(&machine),
        program: Program::Bbc(machine),
    }
}

/// The program that a disc starts, with all its files at hand; where `!BOOT` sets PAGE, that holds.
fn load_disc(file: &File, config: Config) -> Outcome<Loaded> {
    let wrong = |what: String| Failure::Wrong(format!("{}: {what}", file.name));
    if config.dialect != Dialect::Micro {
        return Err(wrong("discs are the Micro's".to_owned()));
    }
    let booted = boot::program(&file.bytes).map_err(wrong)?;
    let page = booted.page.unwrap_or(config.page);
    let mut machine = Machine::new(Config { page, ..config });
    for file in booted.files {
        machine.add_file(&file.name, file.bytes);
    }
    let program = booted.program;
    machine
        .load_tokenised(&program.bytes)
        .map_err(|fault| wrong(format!("{} is no program: {fault}", program.name)))?;
    Ok(loaded(machine, Vec::new()))
}

/// The line and statement behind each statement.
fn map(machine: &Machine) -> LineMap {
    let statements = machine.statements().into_iter();
    let line = |place: StatementPlace| Line {
        document: 0,
        line: place.line as usize,
        statement: place.statement as usize,
    };
    LineMap::Places(statements.map(|place| Some(line(place))).collect())
}

/// Runs a program that was loaded.
pub fn run(machine: &Machine, limit: u64, watch: Watch<'_>) -> MachineRun {
    finished(machine.run(limit, watch))
}

/// The same with a keyboard, which it gives back.
pub fn play(
    machine: &Machine,
    keyboard: Keyboard,
    limit: u64,
    watch: Watch<'_>,
) -> (MachineRun, Keyboard) {
    let (run, keyboard) = machine.play(keyboard, limit, watch);
    (finished(run), keyboard)
}

/// The same, with what each line took.
pub fn profile(machine: &Machine, limit: u64, watch: Watch<'_>) -> (MachineRun, Vec<LineCost>) {
    let (run, lines) = machine.profile(limit, watch);
    (finished(run), lines)
}

/// The same, with what each place took.
pub fn charges(
    machine: &Machine,
    limit: u64,
    roles: Roles<'_>,
    watch: Watch<'_>,
) -> (MachineRun, Charges) {
    let (run, charges) = machine.charges(limit, roles, watch);
    (finished(run), charges)
}

fn finished(run: slowlight_vm::bbc::Run) -> MachineRun {
    let drawn = !run.screen.pixels.is_empty();
    MachineRun {
        stop: run.stop,
        cycles: run.cycles,
        plot_cycles: Some(run.plot_cycles),
        vm_instructions: None,
        os_calls: None,
        rom_words: None,
        screen: drawn.then_some(run.screen),
        output: run.text.into_bytes(),
        files: run.files,
        sizes: Sizes {
            code: Some(run.program_bytes as u64),
            tables: None,
            ram: Some(run.ram_bytes as u64),
        },
    }
}
