//! A scene's tree with the library's, which is parsed once.

use slowlight_compiler::prelude::PRELUDE;
use slowlight_compiler::syntax;
use slowlight_compiler::syntax::tree::File;
use std::cell::RefCell;

thread_local! {
    /// The scene's tree, then the library's.
    static FILES: RefCell<Vec<(File, bool)>> = RefCell::new(library());
}

fn library() -> Vec<(File, bool)> {
    let mut files = vec![(File::default(), false)];
    for (k, (_, text)) in PRELUDE.iter().enumerate() {
        files.push((syntax::parse(text, k as u16 + 1).0, true));
    }
    files
}

/// Does something with a scene and the library.
pub fn with_library(scene: File, done: impl FnOnce(&[(File, bool)])) {
    FILES.with_borrow_mut(|files| {
        files[0].0 = scene;
        done(files);
    });
}
