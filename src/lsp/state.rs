//! The texts that an editor has open, what is known of them, and what it was told.

use super::analysis::{Analysis, Open};
use super::diagnostics;
use super::look::At;
use super::shelf;
use super::text::{Lines, edit, full, path_of};
use lsp_types::{
    Diagnostic, Position, PublishDiagnosticsParams, TextDocumentContentChangeEvent, TextEdit, Uri,
};
use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

/// Diagnostics by the addresses of their texts.
type Said = BTreeMap<String, (Uri, Vec<Diagnostic>)>;

/// An open text.
#[derive(Debug)]
pub struct Document {
    /// Its address.
    pub uri: Uri,
    /// The text.
    pub text: String,
    /// The editor's number for it.
    pub version: i32,
}

/// All that is open; texts by their addresses.
#[derive(Default)]
pub struct State {
    /// The texts.
    pub documents: BTreeMap<String, Document>,
    known: BTreeMap<String, Analysis>,
    said: BTreeMap<String, Said>,
    /// What is to be looked at again.
    dirty: BTreeSet<String>,
    /// What was looked at and not closely.
    unsaid: BTreeSet<String>,
    /// What the editor shows.
    shown: Said,
}

impl State {
    /// Takes a text in.
    pub fn open(&mut self, uri: Uri, text: String, version: i32) {
        let key = uri.as_str().to_owned();
        let document = Document { uri, text, version };
        self.documents.insert(key.clone(), document);
        self.touch(&key);
    }

    /// Changes a text; nothing where it is not open.
    pub fn change(
        &mut self,
        uri: &Uri,
        version: i32,
        changes: Vec<TextDocumentContentChangeEvent>,
    ) {
        let Some(document) = self.documents.get_mut(uri.as_str()) else {
            return;
        };
        document.version = version;
        for change in changes {
            edit(&mut document.text, change);
        }
        self.touch(uri.as_str());
    }

    /// Lets a text go.
    pub fn close(&mut self, uri: &Uri) {
        self.touch(uri.as_str());
        self.documents.remove(uri.as_str());
        self.known.remove(uri.as_str());
        self.said.remove(uri.as_str());
        self.dirty.remove(uri.as_str());
        self.unsaid.remove(uri.as_str());
    }

    /// The other open texts that use a text.
    pub fn users(&self, uri: &Uri) -> Vec<Uri> {
        let known = self.known.values().filter(|known| known.root_uri() != uri);
        let users = known.filter(|known| known.file(uri).is_some());
        users.map(|known| known.root_uri().clone()).collect()
    }

    /// Another open scene that uses a text which is to be edited, and that speaks in another of its
    /// texts of what is renamed, or of the new name: what the edits would make of it is not known.
    pub fn other_user(
        &self,
        of: &Analysis,
        edits: &[(Uri, Vec<TextEdit>)],
        new: &str,
    ) -> Option<Uri> {
        let old = edits.iter().find_map(|(uri, list)| {
            let (_, text) = of.file(uri)?;
            let range = list.first()?.range;
            let lines = Lines::new(text);
            text.get(lines.byte(text, range.start)..lines.byte(text, range.end))
        })?;
        let is_edited = |uri: &Uri| edits.iter().any(|(edited, _)| edited == uri);
        let speaks = |known: &Analysis| {
            (0u16..).zip(known.files()).any(|(number, file)| {
                let other = known.uri(number).is_some_and(|uri| !is_edited(&uri));
                let mut words = (file.text).split(|c: char| !c.is_alphanumeric() && c != '_');
                other && !file.library && words.any(|word| word == old || word == new)
            })
        };
        let mut users = edits.iter().flat_map(|(uri, _)| self.users(uri));
        users.find(|user| user != of.root_uri() && self.known(user).is_some_and(speaks))
    }

    /// What a text is used by, and itself, is to be looked at again.
    pub fn touch(&mut self, key: &str) {
        let uri: Option<Uri> = key.parse().ok();
        if let Some(uri) = uri {
            let uses = self
                .known
                .iter()
                .filter(|(_, known)| known.file(&uri).is_some());
            let uses: Vec<String> = uses.map(|(key, _)| key.clone()).collect();
            self.dirty.extend(uses);
        }
        if self.documents.contains_key(key) {
            self.dirty.insert(key.to_owned());
        }
    }

    /// A file was changed outside of the editor. A file that could not be found may have
    /// come, so whatever is wrong is looked at again.
    pub fn changed_on_disk(&mut self, uri: &Uri) {
        if !self.documents.contains_key(uri.as_str()) {
            self.touch(uri.as_str());
            let wrong = self.known.iter().filter(|(_, known)| !known.is_right());
            self.dirty.extend(wrong.map(|(key, _)| key.clone()));
        }
    }

    /// Whether something is to be looked at.
    pub fn is_dirty(&self) -> bool {
        !self.dirty.is_empty()
    }

    fn overlay(&self) -> Open {
        let open = self.documents.values();
        let own =
            open.filter_map(|d| Some((full(&path_of(&d.uri)?), (d.uri.clone(), d.text.clone()))));
        own.collect()
    }

    /// Whether something that was looked at is not said yet.
    pub fn is_unsaid(&self) -> bool {
        !self.unsaid.is_empty()
    }

    /// Looks at what is to be looked at; answers what the editor is to show otherwise. Of
    /// what the checker finds no mistake in nothing is said yet.
    pub fn refresh(&mut self) -> Vec<PublishDiagnosticsParams> {
        let dirty = std::mem::take(&mut self.dirty);
        let overlay = self.overlay();
        for key in dirty {
            let Some(document) = self.documents.get(&key) else {
                continue;
            };
            // The library's texts are what they are.
            let text = match shelf::holds(&document.uri) {
                true => "",
                false => &document.text,
            };
            let known = Analysis::new(&document.uri, text, &overlay);
            match known.is_checked() {
                true => self.unsaid.insert(key.clone()),
                false => {
                    self.said.insert(key.clone(), diagnostics::of(&known));
                    self.unsaid.remove(&key)
                }
            };
            self.known.insert(key, known);
        }
        self.publish()
    }

    /// Looks closer at what is not said yet; answers as [`State::refresh`].
    pub fn finish(&mut self) -> Vec<PublishDiagnosticsParams> {
        for key in std::mem::take(&mut self.unsaid) {
            if let Some(known) = self.known.get(&key) {
                self.said.insert(key, diagnostics::of(known));
            }
        }
        self.publish()
    }

    /// What is shown of a text.
    pub fn shown(&self, uri: &Uri) -> Vec<Diagnostic> {
        let shown = self.shown.get(uri.as_str());
        shown.map_or(Vec::new(), |(_, list)| list.clone())
    }

    /// What is shown otherwise than before.
    fn publish(&mut self) -> Vec<PublishDiagnosticsParams> {
        let mut all = Said::new();
        for (key, said) in &self.said {
            let Some(document) = self.documents.get(key) else {
                continue;
            };
            // What a scene uses is looked at as a part of it.
            if self.root(&document.uri) != Some(key) || shelf::holds(&document.uri) {
                continue;
            }
            for (key, (uri, list)) in said {
                let (_, known) = all
                    .entry(key.clone())
                    .or_insert_with(|| (uri.clone(), Vec::new()));
                let new: Vec<Diagnostic> = list
                    .iter()
                    .filter(|d| !known.contains(d))
                    .cloned()
                    .collect();
                known.extend(new);
            }
        }
        let gone = self
            .shown
            .iter()
            .filter(|(key, (_, list))| !all.contains_key(*key) && !list.is_empty());
        let gone = gone.map(|(_, (uri, _))| (uri.clone(), Vec::new()));
        let new = all
            .iter()
            .filter(|(key, said)| self.shown.get(*key) != Some(said));
        let new = new.map(|(_, (uri, list))| (uri.clone(), list.clone()));
        let out = gone.chain(new).map(|(uri, list)| {
            let version = self.documents.get(uri.as_str()).map(|d| d.version);
            PublishDiagnosticsParams::new(uri, list, version)
        });
        let out = out.collect();
        self.shown = all;
        out
    }

    /// The open scene that a text belongs to: itself, or the first that uses it.
    fn root(&self, uri: &Uri) -> Option<&String> {
        let (own, known) = self.known.get_key_value(uri.as_str())?;
        if known.is_scene() || shelf::holds(uri) {
            return Some(own);
        }
        let users = self.known.iter();
        let mut users = users.filter(|(_, known)| known.is_scene() && known.file(uri).is_some());
        Some(users.next().map_or(own, |(key, _)| key))
    }

    /// What is known of the scene that a text belongs to.
    pub fn known(&self, uri: &Uri) -> Option<&Analysis> {
        self.known.get(self.root(uri)?)
    }

    /// A place of an editor in what is known.
    pub fn at(&self, uri: &Uri, position: Position) -> Option<At<'_>> {
        let of = self.known(uri)?;
        let (file, text) = of.file(uri)?;
        Some(At {
            of,
            file,
            text,
            byte: Lines::new(text).byte(text, position),
        })
    }

    /// What would be known of a scene with other texts in the place of some of its own.
    pub fn remake(&self, of: &Analysis, texts: &[(u16, String)]) -> Analysis {
        let mut overlay = self.overlay();
        let mut root = of.files().first().map_or("", |f| f.text.as_str());
        for (number, text) in texts {
            match (number, of.files().get(usize::from(*number))) {
                (0, _) => root = text,
                (_, Some(file)) => {
                    let path = PathBuf::from(&file.name);
                    let uri = of.uri(*number).unwrap_or_else(|| of.root_uri().clone());
                    overlay.insert(path, (uri, text.clone()));
                }
                _ => {}
            }
        }
        Analysis::new(of.root_uri(), root, &overlay)
    }
}
