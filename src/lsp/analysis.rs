//! What is known of a scene as it is in the editor: checked, with its names and types.
//!
//! Made anew for each edit; what only some requests ask for is found when it is first asked
//! for.

use super::facts::Facts;
use super::names::Names;
use super::shelf;
use super::text::{full, path_of, range_of, uri_of};
use super::types::Types;
use crate::scene;
use lsp_types::{Location, Uri};
use slowlight_compiler::ir::graph::Graph;
use slowlight_compiler::report::domain;
use slowlight_compiler::scene::{Checked, load_checked};
use slowlight_compiler::sema::{self, Options};
use slowlight_compiler::source::{Diagnostic, SourceFile, Span};
use slowlight_compiler::syntax::tree::ItemKind;
use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The texts that an editor has open, with its addresses for them, by their files' full names.
pub type Open = BTreeMap<PathBuf, (Uri, String)>;

/// A scene and what is known of it.
#[derive(Debug)]
pub struct Analysis {
    /// The scene and its trees.
    pub whole: Checked,
    /// Where its first text is.
    uri: Uri,
    /// The editor's addresses for texts that are open.
    open: BTreeMap<PathBuf, Uri>,
    lowered: OnceCell<Lowered>,
    types: OnceCell<Types>,
    names: OnceCell<Names>,
    facts: OnceCell<Facts>,
}

/// The name of a scene's first text for the compiler: its file's full name, else its address.
pub fn name_of(uri: &Uri) -> String {
    match path_of(uri) {
        Some(path) => full(&path).display().to_string(),
        None => uri.as_str().to_owned(),
    }
}

/// A file that a scene uses, from the editor or else the disk.
fn used(open: &Open, from: &str, path: &str) -> Result<(String, String), String> {
    let from = Path::new(from);
    if !from.is_absolute() {
        return Err(format!(
            "there is no file `{path}` beside a scene that has none"
        ));
    }
    let path = full(&from.parent().unwrap_or(from).join(path));
    if let Some((_, text)) = open.get(&path) {
        return Ok((path.display().to_string(), text.clone()));
    }
    scene::text(&path).map_err(|failure| failure.reason())
}

/// What only the lowering finds.
#[derive(Debug, Default)]
struct Lowered {
    graph: Option<Graph>,
    said: Vec<Diagnostic>,
}

impl Analysis {
    /// Of a text at an address.
    pub fn new(uri: &Uri, text: &str, open: &Open) -> Analysis {
        let name = name_of(uri);
        let mut read = |from: &str, path: &str| used(open, from, path);
        let mut whole = load_checked(&name, text, &mut read);
        if !is_scene(&whole) {
            // A file for others to use needs neither.
            let whole_file = |d: &Diagnostic| d.span == Span::new(0, 0, 0);
            let lacks = |d: &Diagnostic| d.message.starts_with("the scene has no `");
            let diagnostics = &mut whole.scene.diagnostics;
            diagnostics.retain(|d| !(whole_file(d) && lacks(d)));
        }
        Analysis {
            whole,
            uri: uri.clone(),
            open: (open.iter())
                .map(|(path, (uri, _))| (path.clone(), uri.clone()))
                .collect(),
            lowered: OnceCell::new(),
            types: OnceCell::new(),
            names: OnceCell::new(),
            facts: OnceCell::new(),
        }
    }

    /// What the lowering finds, of a scene that the checker found right: that takes longest.
    fn lowered(&self) -> &Lowered {
        self.lowered.get_or_init(|| {
            let scene = &self.whole.scene;
            if !self.is_checked() || !self.is_scene() {
                return Lowered::default();
            }
            match sema::lower(&scene.program, &Options::default()) {
                Ok(graph) => {
                    let mut said = domain::warnings(&graph, &scene.sources);
                    said.extend(domain::clamped(&graph, &scene.sources));
                    Lowered {
                        graph: Some(graph),
                        said,
                    }
                }
                Err(said) => Lowered { graph: None, said },
            }
        })
    }

    /// All that is to be said of it.
    pub fn said(&self) -> impl Iterator<Item = &Diagnostic> {
        let checked = self.whole.scene.diagnostics.iter();
        checked.chain(&self.lowered().said)
    }

    /// Whether the checker found no mistake: all names and types are known.
    pub fn is_checked(&self) -> bool {
        self.whole.scene.is_right()
    }

    /// Whether nothing is wrong with it.
    pub fn is_right(&self) -> bool {
        self.is_checked() && (self.graph().is_some() || !self.is_scene())
    }

    /// Its graph, where it has one.
    pub fn graph(&self) -> Option<&Graph> {
        self.lowered().graph.as_ref()
    }

    /// Where its first text is.
    pub fn root_uri(&self) -> &Uri {
        &self.uri
    }

    /// Whether it draws something, rather than being there for others to use.
    pub fn is_scene(&self) -> bool {
        is_scene(&self.whole)
    }

    /// Types by place.
    pub fn types(&self) -> &Types {
        self.types
            .get_or_init(|| Types::new(&self.whole.scene.program, &self.whole.types))
    }

    /// Names; the library's uses only where its own text is open.
    pub fn names(&self) -> &Names {
        let all = shelf::holds(&self.uri);
        let names = || Names::new(&self.whole.trees, self.types(), all);
        self.names.get_or_init(names)
    }

    /// Rates and ranges, where there is a graph.
    pub fn facts(&self) -> Option<&Facts> {
        let graph = self.graph()?;
        Some(self.facts.get_or_init(|| Facts::new(graph)))
    }

    /// All texts.
    pub fn files(&self) -> &[SourceFile] {
        &self.whole.scene.sources.files
    }

    /// The text under a span.
    pub fn text(&self, span: Span) -> &str {
        self.whole.scene.sources.text(span)
    }

    /// A text on one line.
    pub fn line(&self, span: Span) -> String {
        let words: Vec<&str> = self.text(span).split_whitespace().collect();
        words.join(" ")
    }

    /// The number of the text at an address, and the text.
    pub fn file(&self, uri: &Uri) -> Option<(u16, &str)> {
        let library = shelf::file_name(uri);
        let own = name_of(uri);
        let wanted = |f: &SourceFile| match &library {
            Some(name) => f.library && f.name == *name,
            None => !f.library && f.name == own,
        };
        let number = self.files().iter().position(wanted)?;
        let text = self.files().get(number)?.text.as_str();
        Some((u16::try_from(number).ok()?, text))
    }

    /// The address of a text.
    pub fn uri(&self, file: u16) -> Option<Uri> {
        let found = self.files().get(usize::from(file))?;
        match (file, found.library) {
            (_, true) => shelf::uri(&found.name),
            (0, false) => Some(self.uri.clone()),
            _ => {
                let path = Path::new(&found.name);
                self.open.get(path).cloned().or_else(|| uri_of(path))
            }
        }
    }

    /// A place for the editor.
    pub fn location(&self, span: Span) -> Option<Location> {
        let text = &self.files().get(usize::from(span.file))?.text;
        Some(Location::new(self.uri(span.file)?, range_of(text, span)))
    }
}

fn is_scene(whole: &Checked) -> bool {
    let draws = |kind: &ItemKind| matches!(kind, ItemKind::Image(_) | ItemKind::Draw { .. });
    let own = whole.trees.iter().filter(|(_, library)| !library);
    own.flat_map(|(file, _)| &file.items)
        .any(|item| draws(&item.kind))
}
