//! The subcommands, one a file.

mod build;
mod check;
mod compare;
mod completions;
mod doc;
mod effects;
mod explain;
mod fmt;
mod live;
mod lsp;
mod man;
mod new;
mod render;
mod run;
mod snapshot;
mod survey;
mod targets;
mod tune;
mod vm;

use crate::failure::Outcome;
use clap::Subcommand;

/// Where the words and columns of a report are explained.
const WORDS: &str = "What the words and columns mean: docs/words.md";

/// What to do.
#[derive(Subcommand, Debug)]
pub enum Command {
    /// Write a scene to begin with
    New(new::Args),
    /// Draw the native picture: the scene as this computer sees it, in 64-bit floats
    Render(render::Args),
    /// Say what is wrong with a scene, or may surprise
    #[command(after_help = "What the table's columns mean: docs/precision.md")]
    Check(check::Args),
    /// Write sources ready for the real machine
    Build(build::Args),
    /// Build, run on the bundled machine, compare with model and native picture
    #[command(after_help = WORDS)]
    Run(run::Args),
    /// Run scenes on several machines: pictures side by side, one table
    #[command(after_help = WORDS)]
    Compare(compare::Args),
    /// What each line of a scene costs on a machine
    #[command(after_help = "What the columns mean: docs/explain.md")]
    Explain(explain::Args),
    /// What each effect of a scene and of the library costs, and what it adds
    #[command(after_help = "What the columns mean: docs/explain.md")]
    Effects(effects::Args),
    /// Write a scene on a local page, and see its picture grow
    Live(live::Args),
    /// Show what accuracy costs in time: measured cycles against error, to choose from
    #[command(after_help = "What is tried, and what the columns mean: docs/tune.md")]
    Tune(tune::Args),
    /// Tune several scenes on several machines, and write what was found as a document
    #[command(after_help = "What is tried, and what the columns mean: docs/tune.md")]
    Survey(survey::Args),
    /// Keep generated code, digests and cycles beside a scene; fail where they change
    #[command(after_help = "What it is for: docs/commands.md")]
    Snapshot(snapshot::Args),
    /// Format scenes in place
    Fmt(fmt::Args),
    /// Say what the library has: shapes, lights, vectors and so on
    Doc(doc::Args),
    /// Serve an editor: errors as you type, completion, cycles behind lines (docs/editors.md)
    Lsp(lsp::Args),
    /// Run any program on a bundled machine (docs/machines.md)
    Vm(vm::Args),
    /// List the machines, their screens' modes, and the formats that they hold numbers in
    Targets(targets::Args),
    /// Print a shell's script that completes command lines
    Completions(completions::Args),
    /// Write manual pages
    Man(man::Args),
}

impl Command {
    /// Does it.
    ///
    /// # Errors
    /// Whatever goes wrong.
    pub fn run(&self) -> Outcome<()> {
        match self {
            Command::New(args) => new::run(args),
            Command::Render(args) => render::run(args),
            Command::Check(args) => check::run(args),
            Command::Build(args) => build::run(args),
            Command::Run(args) => run::run(args),
            Command::Compare(args) => compare::run(args),
            Command::Explain(args) => explain::run(args),
            Command::Effects(args) => effects::run(args),
            Command::Live(args) => live::run(args),
            Command::Tune(args) => tune::run(args),
            Command::Survey(args) => survey::run(args),
            Command::Snapshot(args) => snapshot::run(args),
            Command::Fmt(args) => fmt::run(args),
            Command::Doc(args) => doc::run(args),
            Command::Lsp(args) => lsp::run(args),
            Command::Vm(args) => vm::run(args),
            Command::Targets(args) => targets::run(args),
            Command::Completions(args) => completions::run(args),
            Command::Man(args) => man::run(args),
        }
    }
}
