//! `man`: a manual page for each command.

use crate::failure::{Failure, Outcome, plain};
use crate::{files, say};
use clap::Command;
use clap_mangen::Man;
use std::path::{Path, PathBuf};

/// Options of `man`.
#[derive(clap::Args, Debug)]
pub struct Args {
    /// The directory to write to; it is made where there is none
    dir: PathBuf,
}

/// Writes the pages.
pub fn run(args: &Args) -> Outcome<()> {
    let dir = &args.dir;
    files::may_hold(dir)?;
    let mut command = crate::command_line().disable_help_subcommand(true);
    command.build();
    let shown = command.get_subcommands().filter(|sub| !sub.is_hide_set());
    let pages: Vec<(PathBuf, Vec<u8>)> = std::iter::once(&command)
        .chain(shown)
        .map(|command| page(command, dir))
        .collect::<Outcome<_>>()?;
    let ready: Vec<(&Path, &[u8])> = (pages.iter())
        .map(|(path, text)| (path.as_path(), text.as_slice()))
        .collect();
    files::make(dir)?;
    files::write_all(&ready)?;
    say(&format!(
        "{} pages written to {}\n",
        ready.len(),
        dir.display()
    ))
}

fn page(command: &Command, dir: &Path) -> Outcome<(PathBuf, Vec<u8>)> {
    let mut text = Vec::new();
    Man::new(command.clone())
        .render(&mut text)
        .map_err(|e| Failure::Wrong(format!("no page could be made: {}", plain(&e))))?;
    let name = command.get_display_name().unwrap_or(command.get_name());
    Ok((dir.join(format!("{name}.1")), text))
}
