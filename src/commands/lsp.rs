//! `lsp`: the language server, for editors.

use crate::failure::Outcome;
use crate::lsp;

/// Options of `lsp`.
#[derive(clap::Args, Debug)]
pub struct Args {
    /// Talk on standard input and output, as is done in any case
    #[arg(long)]
    stdio: bool,
}

/// Serves until the editor ends.
pub fn run(_: &Args) -> Outcome<()> {
    lsp::serve()
}
