//! `fmt`: scenes as they should look.

use crate::failure::{Failure, Outcome};
use crate::output::remark;
use crate::{files, say, scene};
use slowlight_compiler::source::{SourceFile, Sources};
use slowlight_compiler::syntax::format::format;
use std::path::{Path, PathBuf};

/// Options of `fmt`.
#[derive(clap::Args, Debug)]
pub struct Args {
    /// The scenes' files; - formats standard input to standard output
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// Write nothing; list what would change and fail if anything would
    #[arg(long)]
    check: bool,
}

/// A scene as it should look.
struct Formatted<'a> {
    path: &'a Path,
    text: String,
    /// Whether it is another than it was.
    changed: bool,
}

/// Formats in place those that can be read; what is wrong with the others is said, and fails
/// in the end. What standard input has goes to standard output.
pub fn run(args: &Args) -> Outcome<()> {
    let mut good = Vec::new();
    let mut wrong = Vec::new();
    for path in &args.scenes {
        match formatted(path) {
            Ok(formatted) => good.push(formatted),
            Err(failure) => wrong.push((path.display().to_string(), failure)),
        }
    }
    let total = args.scenes.len();
    let done = match args.check {
        true => listed(&good, total),
        false => written(&good),
    };
    let mut status = None;
    for (_, failure) in &wrong {
        crate::diagnostics::report(failure);
        status.get_or_insert(failure.status());
    }
    done?;
    let Some(status) = status else {
        return Ok(());
    };
    if total > 1 {
        let names: Vec<&str> = wrong.iter().map(|(name, _)| name.as_str()).collect();
        let names = names.join(", ");
        remark(&match args.check {
            true => std::format!("error: not looked at: {names}"),
            false => std::format!("error: not formatted: {names}; the others are"),
        });
    }
    Err(Failure::Several(status))
}

fn formatted(path: &Path) -> Outcome<Formatted<'_>> {
    let (name, text) = scene::given(path)?;
    match format(&text, 0) {
        Ok(formatted) => Ok(Formatted {
            path,
            changed: formatted != text,
            text: formatted,
        }),
        Err(said) => {
            let mut sources = Sources::default();
            sources.add(SourceFile {
                name,
                text,
                library: false,
            });
            Err(scene::wrong(sources, said))
        }
    }
}

/// Lists what would change.
fn listed(all: &[Formatted<'_>], total: usize) -> Outcome<()> {
    let changed = all.iter().filter(|f| f.changed);
    let names: Vec<String> = changed
        .map(|f| std::format!("{}\n", f.path.display()))
        .collect();
    if names.is_empty() {
        return Ok(());
    }
    say(&names.concat())?;
    let message = std::format!(
        "not formatted: {} of {total} scenes; `slowlight fmt` does it",
        names.len(),
    );
    Err(Failure::Wrong(message))
}

/// Writes the files that change, and what came from standard input.
fn written(all: &[Formatted<'_>]) -> Outcome<()> {
    let (piped, files): (Vec<_>, Vec<_>) =
        (all.iter()).partition(|f| scene::is_standard_input(f.path));
    let ready: Vec<(&Path, &[u8])> = (files.iter().filter(|f| f.changed))
        .map(|f| (f.path, f.text.as_bytes()))
        .collect();
    files::write_all(&ready)?;
    piped.iter().try_for_each(|f| say(&f.text))
}
