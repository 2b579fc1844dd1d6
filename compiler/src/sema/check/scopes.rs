//! The local names in sight: innermost first, found without a search.

use crate::sema::program::LocalId;
use rustc_hash::FxHashMap;

/// Names in the order of their declaration; a later one hides an earlier one.
#[derive(Default)]
pub(super) struct Scopes {
    names: Vec<String>,
    /// What each name has stood for, the innermost last.
    known: FxHashMap<String, Vec<LocalId>>,
}

impl Scopes {
    pub(super) fn len(&self) -> usize {
        self.names.len()
    }

    pub(super) fn push(&mut self, name: &str, id: LocalId) {
        self.names.push(name.to_owned());
        self.known.entry(name.to_owned()).or_default().push(id);
    }

    /// Forgets all names but the first `len`.
    pub(super) fn truncate(&mut self, len: usize) {
        while self.names.len() > len {
            if let Some(list) = self.names.pop().and_then(|n| self.known.get_mut(&n)) {
                list.pop();
            }
        }
    }

    pub(super) fn find(&self, name: &str) -> Option<LocalId> {
        self.known.get(name)?.last().copied()
    }

    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.names.iter().map(String::as_str)
    }
}
