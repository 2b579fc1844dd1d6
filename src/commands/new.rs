//! `new`: a scene to begin with.

use crate::examples::{self, STARTER};
use crate::failure::{Failure, Outcome};
use crate::given::quoted;
use crate::{files, say};
use clap::builder::PossibleValuesParser;
use std::path::{Path, PathBuf};

/// Options of `new`.
#[derive(clap::Args, Debug)]
pub struct Args {
    /// The new scene's name, with a path if wanted; .scn is added
    name: PathBuf,
    /// Begin with a copy of an example
    #[arg(long, value_name = "EXAMPLE", value_parser = PossibleValuesParser::new(examples::names()))]
    from: Option<String>,
}

/// Writes a scene where there is no file yet, and says what to type next.
pub fn run(args: &Args) -> Outcome<()> {
    let text = match &args.from {
        Some(name) => examples::text(name).ok_or_else(|| {
            Failure::Usage(crate::failure::unknown("example", name, examples::names()))
        })?,
        None => STARTER,
    };
    let path = named(&args.name)?;
    let shown = path.display();
    // A link that leads nowhere is something, too.
    if path.symlink_metadata().is_ok() {
        let message = format!("{shown} is there already, and stays as it is: choose another name");
        return Err(Failure::Wrong(message));
    }
    files::write(&path, text.as_bytes())?;
    let scene = quoted(&shown.to_string());
    let picture = quoted(&path.with_extension("png").display().to_string());
    say(&format!(
        "{shown} is written; next:\n  \
         slowlight render {scene} -o {picture}\n  \
         slowlight run {scene} --target jack\n  \
         slowlight live {scene} --target 6502 --open\n"
    ))
}

/// The scene's file: what was named, with `.scn` behind it if it is not there.
fn named(name: &Path) -> Outcome<PathBuf> {
    let shown = name.to_string_lossy();
    let stem = shown.strip_suffix(".scn").unwrap_or(&shown);
    if stem.is_empty() || stem.ends_with(['/', '.', std::path::MAIN_SEPARATOR]) || stem == "-" {
        let message = format!("`{shown}` names no file: `slowlight new ball` writes ball.scn");
        return Err(Failure::Usage(message));
    }
    let mut path = name.as_os_str().to_owned();
    if name.extension().is_none_or(|e| e != "scn") {
        path.push(".scn");
    }
    Ok(PathBuf::from(path))
}
