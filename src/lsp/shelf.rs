//! The library's texts as files that an editor can open: written once into the user's cache
//! directory, read-only, by the version of their texts.

use super::text::{full, path_of, uri_of};
use crate::digest;
use crate::files;
use lsp_types::Uri;
use slowlight_compiler::prelude::PRELUDE;
use std::path::PathBuf;
use std::sync::OnceLock;

/// The directory of this library's texts; none where the user has no cache.
fn dir() -> Option<&'static PathBuf> {
    static DIR: OnceLock<Option<PathBuf>> = OnceLock::new();
    let found = DIR.get_or_init(|| {
        let all: Vec<u8> = PRELUDE
            .iter()
            .flat_map(|(name, text)| [*name, *text])
            .flat_map(str::bytes)
            .collect();
        let own = digest::bytes(&all);
        let cache = full(&dirs::cache_dir()?);
        Some(cache.join("slowlight").join("library").join(own.get(..16)?))
    });
    found.as_ref()
}

/// The address of a text of the library, which is written where it is not yet; none where
/// it cannot be.
pub fn uri(name: &str) -> Option<Uri> {
    let (_, text) = PRELUDE.iter().find(|(known, _)| *known == name)?;
    let path = dir()?.join(name);
    if !std::fs::read(&path).is_ok_and(|kept| kept == text.as_bytes()) {
        std::fs::create_dir_all(dir()?).ok()?;
        files::write(&path, text.as_bytes()).ok()?;
        if let Ok(about) = std::fs::metadata(&path) {
            let mut may = about.permissions();
            may.set_readonly(true);
            // An editor that may write to it is no harm: the text is looked at each time.
            let _ = std::fs::set_permissions(&path, may);
        }
    }
    uri_of(&path)
}

/// The library's text that an address names.
pub fn file_name(uri: &Uri) -> Option<String> {
    let path = full(&path_of(uri)?);
    let name = path.strip_prefix(dir()?).ok()?.to_str()?;
    PRELUDE
        .iter()
        .any(|(known, _)| *known == name)
        .then(|| name.to_owned())
}

/// Whether an address names a text of the library.
pub fn holds(uri: &Uri) -> bool {
    file_name(uri).is_some()
}
