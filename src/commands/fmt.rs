//! `fmt`: scenes as they should look.

use crate::failure::{Failure, Outcome};
use crate::{files, say, scene};
use slowlight_compiler::source::{SourceFile, Sources};
use slowlight_compiler::syntax::format::format;
use std::path::PathBuf;

/// Options of `fmt`.
#[derive(clap::Args, Debug)]
pub struct Args {
    /// The scenes' files
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// Write nothing; list what would change and fail if anything would
    #[arg(long)]
    check: bool,
}

/// Formats them in place: all of them, or none where one cannot be read.
pub fn run(args: &Args) -> Outcome<()> {
    let mut changed: Vec<(&PathBuf, String)> = Vec::new();
    for path in &args.scenes {
        let (name, text) = scene::text(path)?;
        match format(&text, 0) {
            Ok(formatted) if formatted == text => {}
            Ok(formatted) => changed.push((path, formatted)),
            Err(said) => {
                let mut sources = Sources::default();
                sources.add(SourceFile {
                    name,
                    text,
                    library: false,
                });
                return Err(scene::wrong(sources, said));
            }
        }
    }
    if args.check {
        if changed.is_empty() {
            return Ok(());
        }
        for (path, _) in &changed {
            say(&std::format!("{}\n", path.display()));
        }
        let message = std::format!(
            "not formatted: {} of {} scenes; `slowlight fmt` does it",
            changed.len(),
            args.scenes.len()
        );
        return Err(Failure::Wrong(message));
    }
    let ready: Vec<_> = changed
        .iter()
        .map(|(path, text)| (path.as_path(), text.as_bytes()))
        .collect();
    files::write_all(&ready)
}
