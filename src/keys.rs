//! `vm --keys`: a script for the keyboard, standard input behind it, and what came of it.

use crate::failure::{Failure, Outcome};
use crate::files;
use crate::machine::{Machine, MachineRun, complaint};
use crate::picture::{FileFormat, Picture};
use slowlight_vm::Stop;
use slowlight_vm::keys::{Keyboard, Script, Unit};
use std::io::{BufRead, IsTerminal, Read};
use std::path::Path;

/// The longest line of standard input that is read at once; what is left is the next.
const LINE: u64 = 1 << 16;

/// Options of the keyboard.
#[derive(clap::Args, Debug)]
pub struct KeyArgs {
    /// The keys that are pressed, as a script: `right*20 wait 50 space "text" shot one.png`,
    /// or @FILE, a file of it (docs/machines.md)
    #[arg(long, value_name = "SCRIPT", conflicts_with = "profile")]
    keys: Option<String>,
}

impl KeyArgs {
    /// The keyboard for a machine: of the script, or one that nobody touches. Files of
    /// pictures have names of pictures.
    ///
    /// # Errors
    /// What is wrong with the script, and where.
    pub fn keyboard(&self, machine: Machine) -> Outcome<Keyboard> {
        let unit = match machine {
            Machine::Hack(_) => Unit::Calls,
            _ => Unit::Frames,
        };
        Ok(Keyboard::new(self.script()?, unit, line))
    }

    /// The script; empty where none is given.
    ///
    /// # Errors
    /// What is wrong with it, and where.
    pub fn script(&self) -> Outcome<Script> {
        let text = match self.keys.as_deref() {
            None => String::new(),
            Some(given) => match given.strip_prefix('@') {
                Some(path) => files::read_text(Path::new(path))?,
                None => given.to_owned(),
            },
        };
        let script: Script = text
            .parse()
            .map_err(|fault| Failure::Usage(format!("--keys: {fault}")))?;
        for name in script.pictures() {
            FileFormat::of(Path::new(name))?;
        }
        Ok(script)
    }
}

/// A line of standard input; a terminal is shown the line that the program has begun.
fn line(shown: &str) -> Option<Vec<u8>> {
    let mut input = std::io::stdin().lock();
    if std::io::stdin().is_terminal() {
        eprint!("{shown}");
    }
    let mut line = Vec::new();
    let read = input.by_ref().take(LINE).read_until(b'\n', &mut line);
    read.ok().filter(|bytes| *bytes > 0).map(|_| line)
}

/// Writes the pictures of the shots.
///
/// # Errors
/// What cannot be written, and what was never to be seen.
pub fn write_shots(keyboard: &Keyboard) -> Outcome<()> {
    for (name, screen) in keyboard.shots() {
        let path = Path::new(name);
        let Some(screen) = screen else {
            let message = format!("{name}: the program showed no picture then");
            return Err(Failure::Wrong(message));
        };
        let picture = Picture::from(screen);
        files::write(path, &picture.encode(FileFormat::of(path)?)?)?;
        eprintln!("{name}: {}", picture.sha256());
    }
    let missed: Vec<&str> = keyboard.missed().collect();
    match missed.as_slice() {
        [] => Ok(()),
        names => Err(Failure::Wrong(format!(
            "the program stopped before it came to {}",
            names.join(", ")
        ))),
    }
}

/// What is wrong with a run, as [`complaint`] says it, and whether it waits for a key.
pub fn waits(run: &MachineRun, limit: u64, keyboard: &Keyboard) -> Option<String> {
    let message = complaint(run, limit)?;
    Some(match (&run.stop, keyboard.late()) {
        (Stop::CycleLimit, 1..) => {
            format!("{message}; it waits for a key, and none is left: give keys with --keys")
        }
        (Stop::Fault(_), _) if message.contains("waits for a key") => {
            format!("{message}; give keys with --keys")
        }
        _ => message,
    })
}
