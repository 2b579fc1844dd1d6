//! Snapshots of a scene on a target: what was generated, what it drew and what
//! that cost, in one text beside the scene that a person can review.
//!
//! The text begins with one `name: value` a line between two lines of `---`;
//! the generated sources, as digests and excerpts or whole, and a small picture of
//! characters follow. The options among those lines are what the snapshot is made with
//! again. All of it is
//! a pure function of scene, options and compiler, except for the digest of the
//! scene's text: that only tells whether a change comes from the scene, and a
//! changed comment changes no snapshot.

mod excerpt;

use crate::ascii;
use crate::failure::Outcome;
use crate::files;
use crate::machine::File;
use crate::picture::Picture;
use crate::scene::Scene;
use crate::trial::Trial;
use sha2::{Digest, Sha256};
use similar::TextDiff;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The longest snapshot that is read, in bytes.
const MAX_BYTES: usize = 16 << 20;

/// The line that is not compared.
const SCENE_DIGEST: &str = "scene_sha256: ";

/// Columns of the picture of characters.
const COLUMNS: u32 = 64;

/// How long the shortest difference is searched for; then a longer one serves.
const PATIENCE: Duration = Duration::from_secs(5);

/// Where the snapshot of a scene on a target is kept: `snapshots/NAME.TARGET.snap`
/// beside the scene, `:` written as `-`.
pub fn path(scene: &Path, target: &str) -> PathBuf {
    let stem = scene.file_stem().unwrap_or_default().to_string_lossy();
    let name = format!("{stem}.{}.snap", target.replace(':', "-"));
    scene.with_file_name("snapshots").join(name)
}

/// The options that a snapshot is made with.
pub struct Made<'o> {
    /// As on the command line.
    pub text: &'o str,
    /// Whether all that was generated is kept.
    pub full: bool,
}

/// The snapshot of a trial.
pub fn text(
    file: &Path,
    scene: &Scene,
    options: &Made<'_>,
    sources: &[File],
    trial: &Trial,
) -> String {
    let plan = &trial.plan;
    let window = trial.native.window;
    let size = |bytes: Option<u64>| bytes.map(|b| b.to_string());
    let differs = |found: &Option<Vec<_>>| found.as_ref().map(|f| f.len().to_string());
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    let head = [
        ("scene", Some(name.into_owned())),
        ("scene_sha256", Some(digest(scene))),
        ("target", Some(plan.target.name.to_owned())),
        ("mode", Some(plan.mode.name.to_owned())),
        ("options", Some(options.text.to_owned())),
        ("format", Some(plan.runtime.format.to_owned())),
        ("inks", Some(plan.graph.image.palette.len().to_string())),
        (
            "rows",
            Some(format!("{}..{}", window.rows.0, window.rows.1)),
        ),
        ("pixels", Some(trial.pixels().to_string())),
        ("inks_sha256", trial.picture.as_ref().map(Picture::sha256)),
        ("cycles", Some(trial.run.cycles.to_string())),
        ("code_bytes", size(trial.run.sizes.code)),
        ("table_bytes", size(trial.run.sizes.tables)),
        ("ram_bytes", size(trial.run.sizes.ram)),
        ("differs_from_model", differs(&trial.from_model)),
        ("differs_from_native", differs(&trial.from_native)),
    ];
    let mut out = "---\n".to_owned();
    for (name, value) in head {
        if let Some(value) = value.filter(|v| !v.is_empty()) {
            out.push_str(&format!("{name}: {value}\n"));
        }
    }
    out.push_str("---\n");
    for source in sources {
        let text = source.as_text();
        out.push_str(&match options.full {
            true => excerpt::whole(&source.name, &text),
            false => excerpt::excerpt(&source.name, &text, plan),
        });
    }
    if let Some(picture) = &trial.picture {
        out.push_str("==> picture <==\n");
        out.push_str(&ascii::text(picture, COLUMNS));
    }
    out
}

/// SHA-256 over the scene's own texts, the files that it uses included.
fn digest(scene: &Scene) -> String {
    let mut hash = Sha256::new();
    for file in scene.checked.sources.files.iter().filter(|f| !f.library) {
        hash.update(file.text.len().to_le_bytes());
        hash.update(&file.text);
    }
    let hex = |byte: &u8| format!("{byte:02x}");
    hash.finalize().iter().map(hex).collect()
}

/// The options that a kept snapshot was made with, as on the command line; nothing where
/// none is kept.
///
/// # Errors
/// Where there is a file that cannot be read.
pub fn kept_options(path: &Path) -> Outcome<Option<String>> {
    let Some(text) = kept(path)? else {
        return Ok(None);
    };
    let head = text.lines().skip(1).take_while(|line| *line != "---");
    let found = head
        .filter_map(|line| line.strip_prefix("options: "))
        .next();
    Ok(Some(found.unwrap_or_default().to_owned()))
}

/// The text of a kept snapshot, if there is one.
fn kept(path: &Path) -> Outcome<Option<String>> {
    if matches!(path.try_exists(), Ok(false)) {
        return Ok(None);
    }
    let text = files::read_bounded(path, MAX_BYTES)?;
    // A checkout may have changed the lines' ends.
    Ok(Some(String::from_utf8_lossy(&text).replace("\r\n", "\n")))
}

/// How a snapshot compares with the one that is kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum State {
    /// Nothing is kept.
    Missing,
    /// Equal; the scene's text may have been edited without effect.
    Unchanged {
        /// Whether it was.
        edited: bool,
    },
    /// Not equal.
    Changed {
        /// What changed, as a unified difference from old to new.
        difference: String,
        /// Whether the scene's text is another than it was.
        edited: bool,
    },
}

/// Holds a new snapshot against the kept one.
///
/// # Errors
/// Where there is a file that cannot be read.
pub fn compare(path: &Path, new: &str) -> Outcome<State> {
    let Some(old) = kept(path)? else {
        return Ok(State::Missing);
    };
    let (old, old_digest) = without_digest(&old);
    let (new, new_digest) = without_digest(new);
    let edited = old_digest != new_digest;
    if old == new {
        return Ok(State::Unchanged { edited });
    }
    let difference = TextDiff::configure()
        .timeout(PATIENCE)
        .diff_lines(&old, &new)
        .unified_diff()
        .header(&path.display().to_string(), "now")
        .to_string();
    Ok(State::Changed { difference, edited })
}

/// A snapshot without the scene's digest, and the digest. The first line of
/// that form is in the head, before any generated text.
fn without_digest(text: &str) -> (String, &str) {
    let mut digest = "";
    let mut rest = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        match line.strip_prefix(SCENE_DIGEST) {
            Some(found) if digest.is_empty() => digest = found,
            _ => rest.push_str(line),
        }
    }
    (rest, digest)
}

/// A unified difference in a terminal's colours.
pub fn coloured(difference: &str) -> String {
    let mut out = String::with_capacity(difference.len() * 2);
    for line in difference.lines() {
        let colour = match line.bytes().next() {
            Some(b'+') => "\x1b[32m",
            Some(b'-') => "\x1b[31m",
            Some(b'@') => "\x1b[36m",
            _ => "",
        };
        let end = if colour.is_empty() { "" } else { "\x1b[0m" };
        out.push_str(&format!("{colour}{line}{end}\n"));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn snapshots_stand_beside_their_scenes() {
        let at = |scene: &str| path(Path::new(scene), "bbc:micro").display().to_string();
        assert_eq!(at("a/two.scn"), "a/snapshots/two.bbc-micro.snap");
        assert_eq!(at("two.scn"), "snapshots/two.bbc-micro.snap");
    }

    #[test]
    fn the_scenes_digest_is_left_out_of_the_comparison() {
        let dir = tempfile::tempdir().expect("a directory");
        let kept = dir.path().join("a.jack.snap");
        assert_eq!(compare(&kept, "x").expect("read"), State::Missing);
        std::fs::write(&kept, "---\r\nscene_sha256: 1\r\ncycles: 5\r\n").expect("written");
        let against = |new: &str| compare(&kept, new).expect("read");
        let same = State::Unchanged { edited: false };
        assert_eq!(against("---\nscene_sha256: 1\ncycles: 5\n"), same);
        let edited = State::Unchanged { edited: true };
        assert_eq!(against("---\nscene_sha256: 2\ncycles: 5\n"), edited);
        match against("---\nscene_sha256: 1\ncycles: 6\n") {
            State::Changed { difference, edited } => {
                assert!(difference.contains("\n-cycles: 5\n+cycles: 6\n"));
                assert!(!edited);
            }
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn colours_follow_the_sign() {
        assert_eq!(coloured("-a\n b\n"), "\x1b[31m-a\x1b[0m\n b\n");
    }
}
