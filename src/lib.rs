//! The command line of `slowlight`.
//!
//! Everything that touches the world is here: files, the terminal, pictures,
//! and the meeting of the compiler with the machines. One file a subcommand
//! in [`commands`]; the compiler and the machines know nothing of each other.

pub mod against;
pub mod ascii;
pub mod cases;
pub mod commands;
pub mod diagnostics;
pub mod digest;
pub mod draw;
pub mod effects;
pub mod estimate;
pub mod explain;
pub mod failure;
pub mod files;
pub mod fit;
pub mod forecast;
pub mod format;
pub mod interrupt;
pub mod jobs;
pub mod keys;
pub mod listing;
pub mod machine;
pub mod measure;
pub mod need;
pub mod picture;
pub mod precise;
pub mod program;
pub mod progress;
pub mod scene;
pub mod sheet;
pub mod snapshot;
pub mod survey;
pub mod target_args;
pub mod trial;
pub mod tune;
pub mod ways;

use clap::Parser;
use std::process::ExitCode;

/// Compiles ray-traced scenes for machines where light is slow, runs the
/// programs on bundled machines, and shows what accuracy costs in time.
#[derive(Parser, Debug)]
#[command(version, propagate_version = true)]
struct Cli {
    #[command(subcommand)]
    command: commands::Command,
}

/// Runs the command line; answers the exit status.
pub fn main() -> ExitCode {
    let cli = Cli::parse();
    interrupt::install();
    draw::set_up_threads();
    match draw::deep(|| cli.command.run()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

/// Prints to standard output, where a reader that has gone away is no error.
pub fn say(text: &str) {
    use std::io::Write;
    let mut out = std::io::stdout().lock();
    let _ = out.write_all(text.as_bytes()).and_then(|()| out.flush());
}

/// Prints a value as JSON, and a line's end.
pub fn say_json(value: &impl serde::Serialize) {
    // Fails only for maps with keys that are no strings, of which there are none.
    if let Ok(text) = serde_json::to_string_pretty(value) {
        say(&(text + "\n"));
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_sound() {
        super::Cli::command().debug_assert();
    }
}
