//! Files in and out: bounded when read, whole or not at all when written.

use crate::failure::{Failure, Outcome, plain};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use tempfile::NamedTempFile;

/// The largest source that is read, in bytes.
pub const MAX_BYTES: usize = slowlight_compiler::syntax::MAX_BYTES;

/// Reads a file of at most [`MAX_BYTES`].
///
/// # Errors
/// Where it cannot be read, is a directory, or is longer.
pub fn read(path: &Path) -> Outcome<Vec<u8>> {
    read_bounded(path, MAX_BYTES)
}

/// Reads a file of at most `most` bytes, a few megabytes.
///
/// # Errors
/// Where it cannot be read, is a directory, or is longer.
pub fn read_bounded(path: &Path, most: usize) -> Outcome<Vec<u8>> {
    let shown = path.display();
    let wrong = |e: std::io::Error| Failure::Wrong(format!("cannot read {shown}: {}", plain(&e)));
    let meta = std::fs::metadata(path).map_err(wrong)?;
    if meta.is_dir() {
        return Err(Failure::Wrong(format!(
            "{shown} is a directory, not a file"
        )));
    }
    let file = std::fs::File::open(path).map_err(wrong)?;
    bounded(file, &shown.to_string(), most).map_err(Failure::Wrong)
}

/// What standard input has, at most [`MAX_BYTES`]: read once, for all who ask.
///
/// # Errors
/// Where it cannot be read, or is longer.
pub fn standard_input() -> Outcome<&'static [u8]> {
    static READ: OnceLock<Result<Vec<u8>, String>> = OnceLock::new();
    let read = READ.get_or_init(|| bounded(std::io::stdin(), "standard input", MAX_BYTES));
    match read {
        Ok(bytes) => Ok(bytes),
        Err(why) => Err(Failure::Wrong(why.clone())),
    }
}

/// All bytes of a source, if they are at most so many; else what is wrong with it.
fn bounded(source: impl Read, shown: &str, most: usize) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    source
        .take(most as u64 + 1)
        .read_to_end(&mut bytes)
        .map_err(|e| format!("cannot read {shown}: {}", plain(&e)))?;
    match bytes.len() > most {
        true => Err(format!(
            "{shown} is longer than {} MB, the most that is read",
            most >> 20
        )),
        false => Ok(bytes),
    }
}

/// Reads a text, which must be UTF-8.
///
/// # Errors
/// As [`read`], and where it is not UTF-8.
pub fn read_text(path: &Path) -> Outcome<String> {
    String::from_utf8(read(path)?).map_err(|e| {
        let at = e.utf8_error().valid_up_to();
        Failure::Wrong(format!("{} is not UTF-8 at byte {at}", path.display()))
    })
}

/// Whether a file may be written, as far as can be told beforehand: work of minutes should
/// not be lost by a directory that is not there. Nothing is left behind.
///
/// # Errors
/// Why [`write_all`] would fail.
pub fn may_write(path: &Path) -> Outcome<()> {
    if path.is_dir() {
        let shown = path.display();
        return Err(Failure::Wrong(format!(
            "{shown} is a directory; name a file in it"
        )));
    }
    beginning(path).map(drop)
}

/// The same of several files that may not be wanted.
///
/// # Errors
/// As for [`may_write`].
pub fn may_write_each<'p>(paths: impl IntoIterator<Item = Option<&'p PathBuf>>) -> Outcome<()> {
    paths
        .into_iter()
        .flatten()
        .try_for_each(|path| may_write(path))
}

/// Whether a directory can take files, or be made for them. A name like a file's is taken
/// for a directory's only where there is one.
///
/// # Errors
/// Where a part of its way is no directory or takes no files, and where it is named like
/// a file.
pub fn may_hold(directory: &Path) -> Outcome<()> {
    let shown = directory.display();
    let here = directory.as_os_str().is_empty();
    let mut parts = directory
        .ancestors()
        .filter(|part| !part.as_os_str().is_empty());
    let there = parts.find(|part| part.exists()).unwrap_or(Path::new("."));
    if !there.is_dir() {
        return Err(Failure::Wrong(format!(
            "{} is no directory; name another to write to",
            there.display()
        )));
    }
    if !here && !directory.exists() && directory.extension().is_some() {
        return Err(Failure::Usage(format!(
            "{shown} is named like a file, and several are written: name a directory for them \
             (or make one that is called {shown} first)"
        )));
    }
    match temporary(there) {
        Ok(_) => Ok(()),
        Err(e) => Err(unwritten(directory, &e)),
    }
}

/// Makes a directory and those around it.
///
/// # Errors
/// Where it cannot be made.
pub fn make(directory: &Path) -> Outcome<()> {
    std::fs::create_dir_all(directory).map_err(|e| {
        Failure::Wrong(format!(
            "cannot make {}: {}",
            directory.display(),
            plain(&e)
        ))
    })
}

/// Where a file's bytes go until all are there, beside the file itself; none for what is no
/// plain file, a pipe or device, which stays what it is.
fn beginning(path: &Path) -> Outcome<(PathBuf, Option<NamedTempFile>)> {
    // Through a link to what it names.
    let path = std::fs::canonicalize(path).unwrap_or(path.to_path_buf());
    if std::fs::metadata(&path).is_ok_and(|m| !m.is_file() && !m.is_dir()) {
        return Ok((path, None));
    }
    let parent = path.parent().filter(|p| !p.as_os_str().is_empty());
    let file = temporary(parent.unwrap_or(Path::new("."))).map_err(|e| unwritten(&path, &e))?;
    Ok((path, Some(file)))
}

/// A file in a directory that is gone when it is dropped, unless it is given a name.
fn temporary(directory: &Path) -> std::io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".slowlight-");
    // tempfile makes files for their owner's eyes only; these are for all,
    // as far as the user's mask allows.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(directory)
}

fn unwritten(path: &Path, e: &std::io::Error) -> Failure {
    Failure::Wrong(format!("cannot write {}: {}", path.display(), plain(e)))
}

/// Whether a file is there and is, by a link, another directory's. `directory` is without links.
pub fn is_elsewhere(path: &Path, directory: &Path) -> bool {
    std::fs::canonicalize(path).is_ok_and(|full| !full.starts_with(directory))
}

/// Writes several files; none of them appears before all are written out, and
/// each appears whole. Directories are not made.
///
/// # Errors
/// Where one cannot be written; then none has appeared, unless renaming fails midway.
pub fn write_all(files: &[(&Path, &[u8])]) -> Outcome<()> {
    let mut ready = Vec::new();
    let _writing = crate::interrupt::writing();
    for (path, bytes) in files {
        let (path, temporary) = beginning(path)?;
        let wrong = |e: std::io::Error| unwritten(&path, &e);
        let Some(mut file) = temporary else {
            std::fs::write(&path, bytes).map_err(wrong)?;
            continue;
        };
        file.write_all(bytes)
            .and_then(|()| file.flush())
            .map_err(wrong)?;
        ready.push((file, path));
    }
    crate::interrupt::check()?;
    for (file, path) in ready {
        file.persist(&path)
            .map_err(|e| unwritten(&path, &e.error))?;
    }
    Ok(())
}

/// Writes one file, whole or not at all.
///
/// # Errors
/// Where it cannot be written.
pub fn write(path: &Path, bytes: &[u8]) -> Outcome<()> {
    write_all(&[(path, bytes)])
}

/// The files of a directory with an extension, by name.
///
/// # Errors
/// Where the directory cannot be read.
pub fn list(dir: &Path, extension: &str) -> Outcome<Vec<std::path::PathBuf>> {
    let wrong =
        |e: std::io::Error| Failure::Wrong(format!("cannot read {}: {}", dir.display(), plain(&e)));
    let mut found = Vec::new();
    for entry in std::fs::read_dir(dir).map_err(wrong)? {
        let path = entry.map_err(wrong)?.path();
        if path.extension().is_some_and(|e| e == extension) {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}
