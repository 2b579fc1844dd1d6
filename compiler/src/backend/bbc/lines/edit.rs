//! Lines changed as a whole: other texts, lines left out, split, joined.

use super::{Item, Label, Later, Lines, note, statements};
use rustc_hash::{FxHashMap, FxHashSet};

impl Lines {
    /// The same lines with other texts, and with labels behind some of them.
    pub fn with_texts(self, texts: Vec<String>, behind: &FxHashMap<usize, Label>) -> Lines {
        self.with_lines(texts.into_iter().map(|text| vec![text]).collect(), behind)
    }

    /// The same where several lines may stand for one.
    pub fn with_lines(self, texts: Vec<Vec<String>>, behind: &FxHashMap<usize, Label>) -> Lines {
        let mut texts = texts.into_iter().enumerate();
        let mut all = Lines::of_weight(self.weight);
        for item in self.items {
            let Item::Line {
                text: before,
                span,
                later,
                open,
                weight,
            } = item
            else {
                all.items.push(item);
                continue;
            };
            let Some((at, own)) = texts.next() else {
                continue;
            };
            let own_line = own.len() == 1;
            let kept = |text: &str| match own_line && statements(text) == statements(&before) {
                true => later.clone(),
                false => Later::new(),
            };
            all.items.extend(own.into_iter().map(|text| Item::Line {
                later: kept(&text),
                text,
                span,
                open,
                weight,
            }));
            all.items.extend(behind.get(&at).copied().map(Item::Label));
        }
        all
    }

    /// Changes every line's text.
    pub fn each_text(&mut self, mut change: impl FnMut(&mut String)) {
        for item in &mut self.items {
            if let Item::Line { text, later, .. } = item {
                let before = statements(text);
                change(text);
                // What was left out or added could be any of them.
                if statements(text) != before {
                    later.clear();
                }
            }
        }
    }

    /// Leaves out lines without text.
    pub fn remove_empty(&mut self) {
        self.items
            .retain(|item| !matches!(item, Item::Line { text, .. } if text.is_empty()));
    }

    /// The lines up to the one that holds some text, and those behind it.
    pub fn split_behind(mut self, holds: &str) -> (Lines, Lines) {
        let found = |item: &Item| matches!(item, Item::Line { text, .. } if text.contains(holds));
        let at = self.items.iter().position(found).map_or(0, |at| at + 1);
        let behind = self.items.split_off(at);
        let weight = self.weight;
        let behind = Lines {
            items: behind,
            weight,
        };
        (self, behind)
    }

    /// These lines and then others, none joined.
    pub fn followed_by(mut self, mut other: Lines) -> Lines {
        self.items.append(&mut other.items);
        self
    }

    /// As few lines as their meaning and a width allow: an `IF` takes the rest
    /// of its line with it, a `DEF` and `DATA` begin one.
    pub fn joined(self, width: usize) -> Lines {
        let ends = |text: &str| {
            ["IF", "REM", "DATA", "*FX"]
                .iter()
                .any(|w| text.contains(w))
        };
        let begins = |text: &str| text.starts_with("DEF") || text.starts_with("DATA");
        let asked: FxHashSet<Label> = self.texts().flat_map(Label::all_of).collect();
        let mut all = Lines::default();
        for item in self.items {
            if matches!(item, Item::Label(label) if !asked.contains(&label)) {
                continue;
            }
            if let Item::Line {
                text, span, later, ..
            } = &item
                && let Some(Item::Line {
                    text: last,
                    later: noted,
                    ..
                }) = all.items.last_mut()
                && !ends(last)
                && !begins(text)
                && last.len() + 1 + text.len() <= width
            {
                note(noted, last, *span, later);
                last.push(':');
                last.push_str(text);
            } else {
                all.items.push(item);
            }
        }
        all
    }
}
