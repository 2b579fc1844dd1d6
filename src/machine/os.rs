//! The operating system in Jack, for programs that bring none or a part of one.

use super::{File, refused};
use crate::failure::{Failure, Outcome};
use slowlight_compiler::backend::jack::os;
use slowlight_compiler::backend::jack::os::Wanted;
use slowlight_vm::hack::jack;
use slowlight_vm::hack::vm::{self, Names};

/// Stands for the class that the system calls, wherever that comes from.
const MAIN: (&str, &str) = (
    "Main.jack",
    "class Main { function void main() { return; } }",
);

/// Classes of the system.
#[derive(Default)]
pub struct System {
    /// As sources.
    pub sources: Vec<File>,
    /// As VM code, in the same order.
    pub code: Vec<(String, String)>,
}

/// The classes of the system that a program, given as VM code, calls and lacks.
pub fn complete(program: &[(String, String)]) -> Outcome<System> {
    let names = Names::of(program).map_err(|faults| refused("linker", "the program", &faults))?;
    if names.has.is_empty() {
        let message = "VM code without functions runs on the VM with its own operating system: leave out --cpu and --os";
        return Err(Failure::Usage(message.to_owned()));
    }
    let [has, calls, reached] = [&names.has, &names.calls, &names.reached]
        .map(|names| names.iter().map(String::as_str).collect::<Vec<&str>>());
    let classes = os::classes(Wanted {
        calls: &calls,
        reached: &reached,
        has: &has,
    });
    let mut sources: Vec<(String, String)> = classes
        .into_iter()
        .map(|(name, text)| (format!("{name}.jack"), text))
        .collect();
    let files = sources.iter().map(|(name, text)| File::text(name, text));
    let files = files.collect();
    sources.push((MAIN.0.to_owned(), MAIN.1.to_owned()));
    let mut compiled = jack::compile(&sources)
        .map_err(|faults| refused("Jack compiler", "the operating system", &faults))?;
    compiled.pop();
    let compiled = compiled.into_iter().map(|class| (class.name, class.text));
    Ok(System {
        sources: files,
        code: compiled.collect(),
    })
}

/// Where the system notes an error in a program that has its `Sys`.
#[derive(Clone, Copy, Debug)]
pub struct Noted {
    failed: u16,
    number: u16,
}

impl Noted {
    /// The addresses in a program for which [`complete`] made these files.
    pub fn of(program: &vm::Program, files: &[File]) -> Option<Noted> {
        files.iter().find(|file| file.name == "Sys.jack")?;
        Some(Noted {
            failed: program.static_address("Sys.vm", os::FAILED)?,
            number: program.static_address("Sys.vm", os::NUMBER)?,
        })
    }

    /// The error's number, if there was one.
    pub fn error(self, peek: impl Fn(u16) -> i16) -> Option<i16> {
        (peek(self.failed) != 0).then(|| peek(self.number))
    }
}
