//! What a frontier is of: its points are worth choosing while just that is wanted, and again
//! once it is.

use crate::live::board::Wish;
use crate::live::shown::Param;
use std::collections::BTreeMap;
use std::sync::Arc;

/// All that the points of a search hang on.
#[derive(Clone, Debug, PartialEq)]
pub struct Searched {
    text: Arc<str>,
    set: BTreeMap<String, Vec<f64>>,
    files: u64,
    target: &'static str,
    mode: Option<String>,
}

impl Searched {
    /// Of what is wanted now for a machine, where it is there; `files` is how often other files
    /// that the scene uses were others.
    pub fn of(wish: &Wish, params: &[Param], files: u64, panel: usize) -> Option<Searched> {
        let run = wish.runs.get(panel)?;
        // A value that is the text's own is none that was set.
        let own = |name: &String, values: &[f64]| {
            let param = params.iter().find(|param| param.name == *name);
            param.is_some_and(|p| p.parts.iter().map(|part| part.value).eq(values.to_vec()))
        };
        let mut set = wish.set.clone();
        set.retain(|name, values| !own(name, values));
        Some(Searched {
            text: wish.text.clone(),
            set,
            files,
            target: run.target.name,
            mode: run.mode.clone(),
        })
    }
}
