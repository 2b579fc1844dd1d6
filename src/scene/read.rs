//! The texts of scenes: from files, from standard input, and from what a scene uses.

use super::wrong;
use crate::failure::{Failure, Outcome};
use crate::files;
use slowlight_compiler::source::{SourceFile, Sources};
use slowlight_compiler::syntax;
use std::path::Path;

/// What stands for standard input where a scene's file is named.
pub const STANDARD_INPUT: &str = "-";

/// Whether a scene is read from standard input.
pub fn is_standard_input(path: &Path) -> bool {
    path.as_os_str() == STANDARD_INPUT
}

/// The name and text of a scene as the command line names it: a file's, or what standard
/// input has.
///
/// # Errors
/// As for [`text`].
pub fn given(path: &Path) -> Outcome<(String, String)> {
    match is_standard_input(path) {
        true => decoded("standard input".to_owned(), files::standard_input()?),
        false => text(path),
    }
}

/// Reads a scene's name and text; bytes that are no text are a diagnostic.
///
/// # Errors
/// Where it cannot be read, or is no text.
pub fn text(path: &Path) -> Outcome<(String, String)> {
    decoded(path.display().to_string(), &files::read(path)?)
}

fn decoded(name: String, bytes: &[u8]) -> Outcome<(String, String)> {
    let (text, said) = syntax::decode(bytes, 0);
    if said.is_empty() {
        return Ok((name, text));
    }
    let mut sources = Sources::default();
    sources.add(SourceFile {
        name,
        text,
        library: false,
    });
    Err(wrong(sources, said))
}

/// A file that a scene uses, beside the file that uses it: its name and text.
///
/// # Errors
/// Why it cannot be read.
pub fn used(from: &str, path: &str) -> Result<(String, String), String> {
    let beside = Path::new(from).parent().unwrap_or(Path::new(""));
    // Without `.` and `..`, one file has one name.
    let path = beside.join(path);
    let path = std::fs::canonicalize(&path)
        .ok()
        .and_then(|full| {
            let here = std::env::current_dir().ok()?;
            let near = full.strip_prefix(here).ok();
            // The directory itself has no name there.
            let near = near.filter(|near| !near.as_os_str().is_empty());
            Some(near.map_or(full.clone(), Path::to_owned))
        })
        .unwrap_or(path);
    text(&path).map_err(|failure| match failure {
        Failure::Wrong(why) => why,
        _ => format!("{} is not UTF-8", path.display()),
    })
}

/// The library in a directory: names and texts.
///
/// # Errors
/// Where it cannot be read.
pub(super) fn prelude(dir: &Path) -> Outcome<Vec<(String, String)>> {
    let paths = files::list(dir, "scn")?;
    paths.iter().map(|path| text(path)).collect()
}
