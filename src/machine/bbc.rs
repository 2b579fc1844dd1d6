//! BBC BASIC: text or tokens in, a picture and text out.

use super::{File, Loaded, MachineRun, Program, Sizes, refused};
use crate::failure::{Failure, Outcome};
use slowlight_vm::bbc::{Config, Dialect, Machine, tokenise};
use slowlight_vm::{Fault, Watch};

/// Takes one program: text (`.bas`), or tokens, known by the byte 13 in front.
pub fn load(files: &[File], dialect: Dialect) -> Outcome<Loaded> {
    let [file] = files else {
        let message = "BBC BASIC takes one file: a program as text or tokens".to_owned();
        return Err(Failure::Usage(message));
    };
    let refuse = |fault: Fault| refused("tokeniser", &file.name, &[fault]);
    let mut machine = Machine::new(Config {
        dialect,
        ..Config::default()
    });
    let mut binaries = Vec::new();
    // A line of tokens begins with 13 and its number's high byte; a text with
    // an empty line begins with 13 and 10.
    if file.bytes.first() == Some(&13) && file.bytes.get(1) != Some(&10) {
        machine.load_tokenised(&file.bytes).map_err(refuse)?;
    } else {
        let tokens = tokenise(&file.as_text(), dialect).map_err(refuse)?;
        machine.load_tokenised(&tokens).map_err(refuse)?;
        let stem = file.name.rsplit_once('.').map_or("", |(stem, _)| stem);
        binaries.push(File {
            name: format!("{stem}.bbc"),
            bytes: tokens,
        });
    }
    let sizes = Sizes {
        code: Some(machine.program_bytes() as u64),
        ..Sizes::default()
    };
    Ok(Loaded {
        binaries,
        sizes,
        program: Program::Bbc(machine),
    })
}

/// Runs a program that was loaded.
pub fn run(machine: &Machine, limit: u64, watch: Watch<'_>) -> MachineRun {
    let run = machine.run(limit, watch);
    let drawn = !run.screen.pixels.is_empty();
    MachineRun {
        stop: run.stop,
        cycles: run.cycles,
        plot_cycles: Some(run.plot_cycles),
        os_calls: None,
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
