//! The scene's file: read, and written whole or not at all.

use crate::failure::{Failure, Outcome};
use crate::{files, interrupt, scene};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard};
use std::time::SystemTime;

/// A scene's file.
pub struct SceneFile {
    /// As the user named it.
    named: PathBuf,
    /// Through links to what it names.
    path: PathBuf,
    /// What is known to be in it.
    known: Mutex<Known>,
    /// The files that the text which was read last uses, and when they were written.
    used: Mutex<BTreeMap<PathBuf, Option<SystemTime>>>,
}

struct Known {
    /// With lines that end in a line feed alone, as the page has them.
    text: String,
    /// Whether they end in two characters in the file.
    two: bool,
}

impl Known {
    fn of(text: String) -> Known {
        let two = text.contains("\r\n");
        Known {
            text: if two {
                text.replace("\r\n", "\n")
            } else {
                text
            },
            two,
        }
    }
}

/// What became of saving.
#[derive(Debug, PartialEq, Eq)]
pub enum Saved {
    /// It is written.
    Yes,
    /// Somebody else wrote another text to the file; nothing is written.
    Elsewhere,
}

impl SceneFile {
    /// Reads a scene's file.
    ///
    /// # Errors
    /// Where it cannot be read.
    pub fn open(named: &Path) -> Outcome<SceneFile> {
        let (_, text) = scene::text(named)?;
        let wrong = |e: std::io::Error| Failure::Wrong(format!("{}: {e}", named.display()));
        Ok(SceneFile {
            named: named.to_path_buf(),
            path: std::fs::canonicalize(named).map_err(wrong)?,
            known: Mutex::new(Known::of(text)),
            used: Mutex::default(),
        })
    }

    fn known(&self) -> MutexGuard<'_, Known> {
        self.known.lock().unwrap_or_else(|e| e.into_inner())
    }

    /// As the user named it.
    pub fn name(&self) -> String {
        self.named.display().to_string()
    }

    /// The path as the user named it.
    pub fn named(&self) -> &Path {
        &self.named
    }

    /// The directory that nothing outside of is read or written.
    pub fn directory(&self) -> &Path {
        self.path.parent().unwrap_or(Path::new("."))
    }

    /// The text that is known to be in it.
    pub fn text(&self) -> String {
        self.known().text.clone()
    }

    /// Whether it holds a text.
    pub fn holds(&self, text: &str) -> bool {
        self.known().text == text
    }

    /// Writes a text to it; not over one that is not known, unless that is `forced`.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub fn save(&self, text: &str, forced: bool) -> Outcome<Saved> {
        let mut known = self.known();
        self.stays()?;
        let is_known = || match scene::text(&self.path) {
            Ok((_, now)) => Known::of(now).text == known.text,
            // What is there and cannot be read is somebody's, too.
            Err(_) => !self.path.exists(),
        };
        if !forced && !is_known() {
            return Ok(Saved::Elsewhere);
        }
        let _writing = interrupt::writing();
        let written = match known.two {
            true => text.replace('\n', "\r\n"),
            false => text.to_owned(),
        };
        files::write(&self.path, written.as_bytes())?;
        text.clone_into(&mut known.text);
        Ok(Saved::Yes)
    }

    /// Fails where the file was made a link to one outside of its directory since it was opened.
    fn stays(&self) -> Outcome<()> {
        if !files::is_elsewhere(&self.path, self.directory()) {
            return Ok(());
        }
        Err(Failure::Wrong(format!(
            "{} has become a link to a file outside of its directory: begin again with that",
            self.named.display()
        )))
    }

    /// Waits until what is being saved is saved.
    pub fn finish(&self) {
        drop(self.known());
    }

    /// Reads it again; answers its new text, and the one before, where that was another.
    ///
    /// # Errors
    /// Where it cannot be read.
    pub fn again(&self) -> Outcome<Option<(String, String)>> {
        let mut known = self.known();
        self.stays()?;
        let now = Known::of(scene::text(&self.path)?.1);
        if now.text == known.text {
            return Ok(None);
        }
        let before = std::mem::replace(&mut *known, now);
        Ok(Some((known.text.clone(), before.text)))
    }

    /// Whether a path is its own.
    pub fn is(&self, path: &Path) -> bool {
        path == self.path
    }

    /// Whether a path is of a file that the text uses, and was written since that was read.
    pub fn is_stale(&self, path: &Path) -> bool {
        let used = self.used.lock().unwrap_or_else(|e| e.into_inner());
        used.get(path).is_some_and(|then| *then != written(path))
    }

    /// Whether any file that the text uses was written since.
    pub fn is_any_stale(&self) -> bool {
        let used = self.used.lock().unwrap_or_else(|e| e.into_inner());
        used.iter().any(|(path, then)| *then != written(path))
    }

    /// A text is about to be read that may use other files.
    pub fn begin(&self) {
        self.used.lock().unwrap_or_else(|e| e.into_inner()).clear();
    }

    /// A file that a scene uses: only one in the scene's directory.
    ///
    /// # Errors
    /// Why it is not read.
    pub fn used(&self, from: &str, path: &str) -> Result<(String, String), String> {
        let beside = Path::new(from).parent().unwrap_or(Path::new(""));
        let full = std::fs::canonicalize(beside.join(path));
        if let Ok(full) = &full {
            let mut used = self.used.lock().unwrap_or_else(|e| e.into_inner());
            used.insert(full.clone(), written(full));
        }
        match full {
            Ok(full) if !full.starts_with(self.directory()) => Err(format!(
                "`{path}` is outside of the scene's directory, and this page reads nothing there"
            )),
            _ => scene::used(from, path),
        }
    }
}

/// When a file was written, if that can be told.
fn written(path: &Path) -> Option<SystemTime> {
    std::fs::metadata(path)
        .and_then(|meta| meta.modified())
        .ok()
}
