//! The command line of `slowlight`.
//!
//! Everything that touches the world is here: files, the terminal, pictures,
//! and the meeting of the compiler with the machines. One file a subcommand
//! in [`commands`]; the compiler and the machines know nothing of each other.

pub mod against;
pub mod ascii;
pub mod auto_format;
pub mod cases;
pub mod colours;
pub mod commands;
pub mod diagnostics;
pub mod digest;
pub mod draw;
pub mod effects;
pub mod estimate;
pub mod examples;
pub mod explain;
pub mod failure;
pub mod files;
pub mod fit;
pub mod forecast;
pub mod format;
pub mod given;
pub mod inks;
pub mod interrupt;
pub mod jobs;
pub mod keys;
pub mod library;
pub mod listing;
pub mod live;
pub mod lsp;
pub mod machine;
pub mod measure;
pub mod need;
pub mod output;
pub mod picture;
pub mod precise;
pub mod program;
pub mod progress;
pub mod scene;
pub mod sheet;
pub mod snapshot;
pub mod survey;
pub mod target_args;
pub mod together;
pub mod trial;
pub mod tune;
pub mod ways;

use clap::error::{ContextKind, ErrorKind};
use clap::{CommandFactory, Parser};
use failure::{Failure, Outcome};
pub use output::{say, say_json};
use std::process::ExitCode;

/// Compiles ray-traced scenes for machines where light is slow, runs the
/// programs on bundled machines, and shows what accuracy costs in time.
#[derive(Parser, Debug)]
#[command(version, propagate_version = true)]
struct Cli {
    #[command(subcommand)]
    command: commands::Command,
}

/// What the command line takes.
pub fn command_line() -> clap::Command {
    Cli::command()
}

/// Runs the command line; answers the exit status.
pub fn main() -> ExitCode {
    let done = match Cli::try_parse() {
        Ok(cli) => {
            interrupt::install();
            draw::set_up_threads();
            draw::deep(|| cli.command.run())
        }
        Err(other) => usage(&other),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => crate::diagnostics::report(&failure),
    }
}

/// What a command line that says nothing to do comes to: help, a version, or what is wrong
/// with it; where a machine is missing, those that there are.
fn usage(found: &clap::Error) -> Outcome<()> {
    if !found.use_stderr() {
        return output::written(found.print());
    }
    // Nothing is left to say it on where standard error cannot be written.
    let _ = found.print();
    let missing = found.get(ContextKind::InvalidArg).map(ToString::to_string);
    if found.kind() == ErrorKind::MissingRequiredArgument
        && missing.is_some_and(|args| args.contains("--target"))
    {
        output::remark(&format!("\n{}", target_args::known_targets()));
    }
    Err(Failure::Several(
        u8::try_from(found.exit_code()).unwrap_or(2),
    ))
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_command_line_is_sound() {
        super::command_line().debug_assert();
    }
}
