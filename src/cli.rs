//! The command line itself: what is asked for is parsed, done, and its status answered.

use crate::failure::{Failure, Outcome};
use crate::{commands, draw, interrupt, output, target_args};
use clap::error::{ContextKind, ErrorKind};
use clap::{CommandFactory, Parser};
use std::process::ExitCode;

/// Compiles ray-traced scenes for machines where light is slow, runs the
/// programs on bundled machines, and shows what accuracy costs in time.
#[derive(Parser, Debug)]
#[command(version, propagate_version = true, after_help = BEGIN)]
struct Cli {
    #[command(subcommand)]
    command: commands::Command,
}

/// Where to begin.
const BEGIN: &str = "To begin: `slowlight new hill`, then `slowlight live hill.scn --target 6502 --open` \
                     (docs/start.md).\nWhat is meant by native, model, ink, format and so on: \
                     docs/words.md";

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
