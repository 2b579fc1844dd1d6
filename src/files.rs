//! Files in and out: bounded when read, whole or not at all when written.

use crate::failure::{Failure, Outcome};
use std::io::{Read, Write};
use std::path::Path;

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
        return Err(Failure::Wrong(format!("{shown} is a directory")));
    }
    let file = std::fs::File::open(path).map_err(wrong)?;
    let mut bytes = Vec::new();
    file.take(most as u64 + 1)
        .read_to_end(&mut bytes)
        .map_err(wrong)?;
    if bytes.len() > most {
        let limit = most >> 20;
        let message = format!("{shown} is longer than {limit} MB, the most that is read");
        return Err(Failure::Wrong(message));
    }
    Ok(bytes)
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

/// Writes several files; none of them appears before all are written out, and
/// each appears whole. Directories are not made.
///
/// # Errors
/// Where one cannot be written; then none has appeared, unless renaming fails midway.
pub fn write_all(files: &[(&Path, &[u8])]) -> Outcome<()> {
    let mut ready = Vec::new();
    let _writing = crate::interrupt::writing();
    for (path, bytes) in files {
        // Through a link to what it names.
        let path = &std::fs::canonicalize(path).unwrap_or(path.to_path_buf());
        let wrong = |e: std::io::Error| {
            Failure::Wrong(format!("cannot write {}: {}", path.display(), plain(&e)))
        };
        // A pipe or device stays what it is.
        if std::fs::metadata(path).is_ok_and(|m| !m.is_file() && !m.is_dir()) {
            std::fs::write(path, bytes).map_err(wrong)?;
            continue;
        }
        let parent = path.parent().filter(|p| !p.as_os_str().is_empty());
        let mut builder = tempfile::Builder::new();
        builder.prefix(".slowlight-");
        // tempfile makes files for their owner's eyes only; these are for all,
        // as far as the user's mask allows.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let mut file = builder
            .tempfile_in(parent.unwrap_or(Path::new(".")))
            .map_err(wrong)?;
        file.write_all(bytes)
            .and_then(|()| file.flush())
            .map_err(wrong)?;
        ready.push((file, path.clone()));
    }
    crate::interrupt::check()?;
    for (file, path) in ready {
        file.persist(&path).map_err(|e| {
            Failure::Wrong(format!(
                "cannot write {}: {}",
                path.display(),
                plain(&e.error)
            ))
        })?;
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

/// A system error without its number.
fn plain(e: &std::io::Error) -> String {
    let text = e.to_string();
    match text.find(" (os error") {
        Some(at) => text[..at].to_owned(),
        None => text,
    }
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
