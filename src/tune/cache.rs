//! What was measured before, in the user's cache directory: a second run is instant.
//!
//! A point is a pure function of the program, the scene's texts and the options, so its
//! file is named by their digest. The program is known by its own file: any other build
//! measures anew. Files are written whole or not at all; what cannot be read is measured.

use crate::digest::hexadecimal;
use crate::failure::Outcome;
use crate::files;
use crate::scene::Scene;
use serde::Serialize;
use serde::de::DeserializeOwned;
use sha2::{Digest, Sha256};
use slowlight_compiler::targets::Target;
use std::path::PathBuf;
#[cfg(not(target_family = "wasm"))]
use std::sync::OnceLock;

/// How large a file is read at most: a point has two pictures.
const MOST: usize = 64 << 20;

/// Where points are kept; nowhere if there is no directory.
pub struct Cache {
    /// The directory of this program's points.
    dir: Option<PathBuf>,
}

impl Cache {
    /// No cache.
    pub fn none() -> Cache {
        Cache { dir: None }
    }

    /// The user's; a browser has none.
    #[cfg(target_family = "wasm")]
    pub fn of_user() -> Cache {
        Cache::none()
    }

    /// The user's; none where there is no such directory, or the program cannot read itself.
    #[cfg(not(target_family = "wasm"))]
    pub fn of_user() -> Cache {
        // Once: `live` searches again and again.
        static OWN: OnceLock<Option<String>> = OnceLock::new();
        let own = OWN.get_or_init(|| {
            let program = std::env::current_exe().and_then(std::fs::read);
            Some(crate::digest::bytes(&program.ok()?))
        });
        let (Some(dir), Some(own)) = (dirs::cache_dir(), own) else {
            return Cache::none();
        };
        Cache {
            dir: Some(dir.join("slowlight").join("tune").join(own)),
        }
    }

    /// The file of what some words ask of a scene on a machine.
    fn file(&self, scene: &Scene, target: &Target, words: &[String]) -> Option<PathBuf> {
        let mut digest = Sha256::new();
        let mut add = |bytes: &[u8]| {
            digest.update((bytes.len() as u64).to_le_bytes());
            digest.update(bytes);
        };
        add(target.name.as_bytes());
        add(scene.name.as_bytes());
        for file in &scene.checked.sources.files {
            add(file.text.as_bytes());
        }
        for word in words {
            add(word.as_bytes());
        }
        let name = hexadecimal(&digest.finalize());
        Some(self.dir.as_ref()?.join(format!("{name}.json")))
    }

    /// What is known, or else what the work finds, which is then kept. That it cannot be
    /// kept costs time, later, and no more.
    ///
    /// # Errors
    /// What the work says.
    pub fn known_or<T: Serialize + DeserializeOwned>(
        &self,
        scene: &Scene,
        target: &Target,
        words: &[String],
        work: impl FnOnce() -> Outcome<T>,
    ) -> Outcome<T> {
        let Some(path) = self.file(scene, target, words) else {
            return work();
        };
        let text = files::read_bounded(&path, MOST).ok();
        if let Some(known) = text.and_then(|text| serde_json::from_slice(&text).ok()) {
            return Ok(known);
        }
        let found = work()?;
        self.make_room();
        if let Ok(text) = serde_json::to_vec(&found) {
            let _ = files::write(&path, &text);
        }
        Ok(found)
    }

    /// Makes the directory, and removes those of other programs: what an older build has
    /// kept would never be read again.
    fn make_room(&self) {
        let Some(dir) = self.dir.as_ref().filter(|dir| !dir.exists()) else {
            return;
        };
        let all = dir.parent().map(std::fs::read_dir);
        let others = all.and_then(Result::ok).into_iter().flatten().flatten();
        for other in others {
            if other.path() != *dir {
                let _ = std::fs::remove_dir_all(other.path());
            }
        }
        let _ = std::fs::create_dir_all(dir);
    }
}
