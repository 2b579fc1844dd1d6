//! The Hack computer: Jack classes, VM code, assembly or an image of the ROM in;
//! a picture and text out.
//!
//! Jack and VM code run on the VM with its native OS, or are translated and run
//! on the CPU, where the OS has to come with the program.

use super::{File, Loaded, MachineRun, Program, Sizes, refused};
use crate::failure::{Failure, Outcome};
use slowlight_vm::hack::asm::{assemble, read_image, write_image};
use slowlight_vm::hack::cpu::Cpu;
use slowlight_vm::hack::translate::{Options, translate};
use slowlight_vm::hack::{jack, vm};
use slowlight_vm::{Stop, Watch};
use std::collections::BTreeMap;

/// Words of RAM before the screen, from the first static.
const RAM: std::ops::Range<u16> = 16..16384;

/// Takes Jack classes (`.jack`), VM code (`.vm`), or some of both, for the VM; or
/// one file of assembly (`.asm`) or of the ROM's words (`.hack`), for the CPU.
pub fn load(files: &[File]) -> Outcome<Loaded> {
    if files.iter().any(is_machine_code) {
        return load_machine_code(files);
    }
    let program = link(files)?;
    Ok(Loaded {
        binaries: Vec::new(),
        sizes: Sizes::default(),
        program: Program::Hack(Box::new(program)),
    })
}

/// Takes the same, all for the CPU. The binaries are the translation, as
/// assembly and as an image.
pub fn load_for_cpu(files: &[File]) -> Outcome<Loaded> {
    if files.iter().any(is_machine_code) {
        return load_machine_code(files);
    }
    let program = link(files)?;
    let translation = translate(&program, Options::default())
        .map_err(|faults| refused("translator", "the program", &faults))?;
    let mut loaded = rom("Main.hack", &translation.words)?;
    let assembly = File::text("Main.asm", &translation.assembly);
    loaded.binaries.push(assembly);
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
    let loaded = rom(&file.name, &words)?;
    Ok(Loaded {
        binaries: Vec::new(),
        ..loaded
    })
}

/// A CPU with these words in its ROM; `name` is that of the image's file.
fn rom(name: &str, words: &[u16]) -> Outcome<Loaded> {
    let cpu = Cpu::new(words).map_err(|fault| refused("machine", name, &[fault]))?;
    Ok(Loaded {
        binaries: vec![File::text(name, &write_image(words))],
        sizes: Sizes {
            code: Some(2 * words.len() as u64),
            ..Sizes::default()
        },
        program: Program::HackCpu(Box::new(cpu)),
    })
}

/// Compiles what is Jack, and links it with what is VM code.
fn link(files: &[File]) -> Outcome<vm::Program> {
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
    let compiled = jack::compile(&classes)
        .map_err(|faults| refused("Jack compiler", "the program", &faults))?;
    program.extend(compiled.into_iter().map(|class| (class.name, class.text)));
    vm::Program::link(&program).map_err(|faults| refused("linker", "the program", &faults))
}

/// Runs a program that was loaded. RAM is what it leaves changed of statics,
/// stack and heap, where the native OS's few words count too.
pub fn run(program: &vm::Program, limit: u64, watch: Watch<'_>) -> MachineRun {
    let mut machine = vm::Machine::new(program);
    let run = machine.run(limit, watch);
    MachineRun {
        os_calls: Some(run.os_calls),
        output: run.text.into_bytes(),
        sizes: Sizes {
            ram: Some(ram(|at| machine.peek(at))),
            ..Sizes::default()
        },
        ..finished(run.stop, run.instructions, run.screen)
    }
}

/// The same for machine code.
pub fn run_cpu(cpu: &mut Cpu, sizes: Sizes, limit: u64, watch: Watch<'_>) -> MachineRun {
    let run = cpu.run(limit, watch);
    let ram = Some(ram(|at| cpu.peek(at)));
    MachineRun {
        sizes: Sizes { ram, ..sizes },
        ..finished(run.stop, run.cycles, run.screen)
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
        os_calls: None,
        screen: Some(screen),
        output: Vec::new(),
        files: BTreeMap::new(),
        sizes: Sizes::default(),
    }
}
