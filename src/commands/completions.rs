//! `completions`: what a shell needs to know to complete command lines.

use crate::failure::Outcome;
use crate::output::say;
use clap_complete::{Shell, generate};

/// Options of `completions`.
#[derive(clap::Args, Debug)]
pub struct Args {
    /// The shell that is to complete
    shell: Shell,
}

/// Prints a shell's script.
pub fn run(args: &Args) -> Outcome<()> {
    let mut script = Vec::new();
    let mut command = crate::command_line();
    let name = command.get_name().to_owned();
    generate(args.shell, &mut command, name, &mut script);
    say(&String::from_utf8_lossy(&script))
}
