//! A scene from its text: parsed, checked, lowered, with all that is to be said
//! about it.

use crate::ir::graph::Graph;
use crate::prelude::PRELUDE;
use crate::sema::{self, Options, Program, Ty};
use crate::source::{Diagnostic, SourceFile, Sources, Span};
use crate::syntax::tree::{File, ItemKind};
use crate::syntax::{self};
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

/// How many files a scene may have, those that it uses included.
const FILES: usize = 64;

/// A checked scene.
#[derive(Clone, Debug)]
pub struct Scene {
    /// All texts: the scene is number 0, then what it uses, then the library.
    pub sources: Sources,
    /// What it says; to be lowered only if it [`is_right`](Scene::is_right).
    pub program: Program,
    /// Errors and warnings in source order.
    pub diagnostics: Vec<Diagnostic>,
}

impl Scene {
    /// Whether no diagnostic is an error.
    pub fn is_right(&self) -> bool {
        !self.diagnostics.iter().any(Diagnostic::is_error)
    }

    /// The scene's graph. Errors where the scene is wrong, or wrong for these
    /// options.
    pub fn lower(&self, options: &Options) -> Result<Graph, Vec<Diagnostic>> {
        if !self.is_right() {
            return Err(self.diagnostics.clone());
        }
        sema::lower(&self.program, options)
    }
}

/// Reads another file: given who uses it and the path as written, its name and
/// text, or why there is none. Two paths to one file must give one name.
pub type Read<'r> = &'r mut dyn FnMut(&str, &str) -> Result<(String, String), String>;

/// A scene that uses no other files, with the embedded library.
pub fn check(name: &str, text: &str) -> Scene {
    let mut read = |_: &str, path: &str| Err(format!("there is no file `{path}` here"));
    load(name, text, None, &mut read)
}

/// A scene from its text; `prelude` (names and texts) replaces the embedded
/// library. Never fails: what is wrong is in [`Scene::diagnostics`].
pub fn load(name: &str, text: &str, prelude: Option<&[(String, String)]>, read: Read<'_>) -> Scene {
    let (sources, files, said) = read_all(name, text, prelude, read);
    let (program, more) = sema::check(&files);
    let mut scene = joined(sources, program, said, more);
    if scene.is_right()
        && let Err(said) = sema::lower(&scene.program, &moving())
    {
        scene.diagnostics.extend(said);
        sema::tidy(&mut scene.diagnostics);
    }
    scene
}

/// The options of a lowering that comes to all of a scene, what moves too.
fn moving() -> Options {
    Options {
        moves: true,
        ..Options::default()
    }
}

/// A scene with what was found on the way to it.
#[derive(Clone, Debug)]
pub struct Checked {
    /// The scene; mistakes that only the lowering finds are not said.
    pub scene: Scene,
    /// The tree of each of its texts, and whether it is the library's.
    pub trees: Vec<(File, bool)>,
    /// The types of the scene's own expressions, as far as they were found.
    pub types: FxHashMap<Span, Ty>,
}

/// As [`load`] up to the lowering.
pub fn load_checked(name: &str, text: &str, read: Read<'_>) -> Checked {
    let (sources, trees, said) = read_all(name, text, None, read);
    let (program, more, types) = sema::check_noting(&trees);
    Checked {
        scene: joined(sources, program, said, more),
        trees,
        types,
    }
}

/// Reads and parses all texts of a scene.
fn read_all(
    name: &str,
    text: &str,
    prelude: Option<&[(String, String)]>,
    read: Read<'_>,
) -> (Sources, Vec<(File, bool)>, Vec<Diagnostic>) {
    let mut loader = Loader {
        sources: Sources::default(),
        files: Vec::new(),
        diagnostics: Vec::new(),
    };
    loader.add(name.to_owned(), text.to_owned(), false);
    loader.follow(read);
    match prelude {
        Some(texts) => {
            for (name, text) in texts {
                loader.add(name.clone(), text.clone(), true);
            }
        }
        None => loader.add_library(),
    }
    (loader.sources, loader.files, loader.diagnostics)
}

/// A scene of what the parser said and what the checker said.
fn joined(
    sources: Sources,
    program: Program,
    mut diagnostics: Vec<Diagnostic>,
    more: Vec<Diagnostic>,
) -> Scene {
    // Where an item could not be read, what refers to it would be called
    // unknown: the mistakes of the text come first.
    if !diagnostics.iter().any(Diagnostic::is_error) {
        diagnostics.extend(more);
    }
    sema::tidy(&mut diagnostics);
    Scene {
        sources,
        program,
        diagnostics,
    }
}

/// Trees, and what is to be said of them.
type Parsed = Vec<(File, Vec<Diagnostic>)>;

/// The embedded library's trees, where its first file has a number: parsed once, since that
/// takes as long as all else that is done to most scenes.
fn library(first: usize) -> Arc<Parsed> {
    static KNOWN: Mutex<BTreeMap<usize, Arc<Parsed>>> = Mutex::new(BTreeMap::new());
    let known = KNOWN.lock().ok().and_then(|k| k.get(&first).cloned());
    known.unwrap_or_else(|| {
        let number = |k: usize| u16::try_from(first + k).unwrap_or(u16::MAX);
        let texts = PRELUDE.iter().enumerate();
        let parsed = texts.map(|(k, (_, text))| syntax::parse(text, number(k)));
        let parsed = Arc::new(parsed.collect());
        if let Ok(mut known) = KNOWN.lock() {
            known.insert(first, Arc::clone(&parsed));
        }
        parsed
    })
}

struct Loader {
    sources: Sources,
    files: Vec<(File, bool)>,
    diagnostics: Vec<Diagnostic>,
}

impl Loader {
    fn add(&mut self, name: String, text: String, library: bool) {
        let number = u16::try_from(self.sources.files.len()).unwrap_or(u16::MAX);
        let (tree, said) = syntax::parse(&text, number);
        self.sources.add(SourceFile {
            name,
            text,
            library,
        });
        self.files.push((tree, library));
        self.diagnostics.extend(said);
    }

    /// Adds the embedded library.
    fn add_library(&mut self) {
        let parsed = library(self.sources.files.len());
        for ((name, text), (tree, said)) in PRELUDE.iter().zip(parsed.iter()) {
            self.sources.add(SourceFile {
                name: (*name).to_owned(),
                text: (*text).to_owned(),
                library: true,
            });
            self.files.push((tree.clone(), true));
            self.diagnostics.extend(said.iter().cloned());
        }
    }

    /// Reads what `use` names, each file once.
    fn follow(&mut self, read: Read<'_>) {
        let mut at = 0;
        while let Some((file, _)) = self.files.get(at) {
            let mut paths: Vec<(String, Span)> = Vec::new();
            for item in &file.items {
                if let ItemKind::Use { path, path_span } = &item.kind {
                    paths.push((path.clone(), *path_span));
                }
            }
            let from = self
                .sources
                .files
                .get(at)
                .map_or(String::new(), |f| f.name.clone());
            for (path, span) in paths {
                if self.files.len() >= FILES {
                    let message = format!("a scene has at most {FILES} files");
                    self.diagnostics.push(Diagnostic::error(span, message));
                    return;
                }
                match read(&from, &path) {
                    Ok((name, text)) => {
                        if !self.sources.files.iter().any(|f| f.name == name) {
                            self.add(name, text, false);
                        }
                    }
                    Err(why) => {
                        let error = Diagnostic::error(span, why);
                        let help = "name a scene's file, as it lies from the file that uses it: \
                                    `use \"shapes.scn\";`";
                        self.diagnostics.push(error.help(help));
                    }
                }
            }
            at += 1;
        }
    }
}
