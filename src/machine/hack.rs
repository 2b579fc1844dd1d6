//! The Hack computer's VM with its native OS: Jack classes or VM code in, a
//! picture and text out.

use super::{File, Loaded, MachineRun, Program, Sizes, refused};
use crate::failure::{Failure, Outcome};
use slowlight_vm::Watch;
use slowlight_vm::hack::{jack, vm};
use std::collections::BTreeMap;

/// Words of RAM before the screen, from the first static.
const RAM: std::ops::Range<u16> = 16..16384;

/// Takes Jack classes (`.jack`), VM code (`.vm`), or some of both.
pub fn load(files: &[File]) -> Outcome<Loaded> {
    let mut classes = Vec::new();
    let mut program = Vec::new();
    for file in files {
        let text = (file.name.clone(), file.as_text().into_owned());
        match file.extension().as_str() {
            "jack" => classes.push(text),
            "vm" => program.push(text),
            _ => {
                let message = format!("{} is neither Jack (.jack) nor VM code (.vm)", file.name);
                return Err(Failure::Usage(message));
            }
        }
    }
    let compiled = jack::compile(&classes)
        .map_err(|faults| refused("Jack compiler", "the program", &faults))?;
    program.extend(compiled.into_iter().map(|class| (class.name, class.text)));
    let linked =
        vm::Program::link(&program).map_err(|faults| refused("linker", "the program", &faults))?;
    Ok(Loaded {
        binaries: Vec::new(),
        sizes: Sizes::default(),
        program: Program::Hack(Box::new(linked)),
    })
}

/// Runs a program that was loaded. RAM is what it leaves changed of statics,
/// stack and heap, where the native OS's few words count too.
pub fn run(program: &vm::Program, limit: u64, watch: Watch<'_>) -> MachineRun {
    let mut machine = vm::Machine::new(program);
    let run = machine.run(limit, watch);
    let words = RAM.filter(|&at| machine.peek(at) != 0).count();
    MachineRun {
        stop: run.stop,
        cycles: run.instructions,
        plot_cycles: None,
        os_calls: Some(run.os_calls),
        screen: Some(run.screen),
        output: run.text.into_bytes(),
        files: BTreeMap::new(),
        sizes: Sizes {
            ram: Some(2 * words as u64),
            ..Sizes::default()
        },
    }
}
