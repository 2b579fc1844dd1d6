//! Copy propagation: where a variable is only another's copy, as a negative logarithm's is,
//! or a literal, that is read in its place. Both are assigned at one place each, which comes
//! before whatever reads them.

use super::tree::*;
use std::collections::BTreeMap;

/// Names in a line at most.
const MOST: usize = 256;

/// What is read in a variable's place, and how remarks say it.
struct Copy {
    of: String,
    said: String,
}

/// The variables that are copies.
#[derive(Default)]
pub(super) struct Copies(BTreeMap<String, Copy>);

impl Copies {
    /// Takes the copies out of statements, and what copies itself; `once` says of which variables there may be any.
    pub fn take(&mut self, items: &mut Vec<Item>, once: &impl Fn(&str) -> bool) {
        items.retain_mut(|item| match item {
            Item::Line(line) => match copied(&line.text, once) {
                Some((name, copy)) => {
                    self.0.insert(name, copy);
                    false
                }
                None => assignment(&line.text).is_none_or(|(name, value)| name != value),
            },
            Item::While { body, .. } => {
                self.take(body, once);
                true
            }
            Item::If { yes, no, .. } => {
                self.take(yes, once);
                self.take(no, once);
                !(yes.is_empty() && no.is_empty())
            }
        });
    }

    /// Writes what they are copies of in their places.
    pub fn put(&self, items: &mut [Item]) {
        for item in items {
            match item {
                Item::Line(line) => self.write(&mut line.text),
                Item::While { head, body } => {
                    self.write(&mut head.text);
                    self.put(body);
                }
                Item::If { head, yes, no } => {
                    self.write(&mut head.text);
                    self.put(yes);
                    self.put(no);
                }
            }
        }
    }

    fn write(&self, text: &mut String) {
        // A copy of a copy is one of what the other is of. No two are of each other.
        for _ in 0..MOST {
            let mut names = variables(text).filter(|(_, word, _)| self.0.contains_key(*word));
            let Some((at, name)) = names.next().map(|(at, word, _)| (at, word.to_owned())) else {
                return;
            };
            drop(names);
            let Some(copy) = self.0.get(&name) else {
                return;
            };
            text.replace_range(at..at + name.len(), &copy.of);
            if let Some((code, remark)) = text.split_once(" // ") {
                *text = format!("{code} // {}", renamed(remark, &name, &copy.said));
            }
        }
    }
}

/// A line that only copies.
fn copied(text: &str, once: &impl Fn(&str) -> bool) -> Option<(String, Copy)> {
    let (name, value) = assignment(text)?;
    let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let literal = matches!(value, "true" | "false");
    let other = value.chars().all(is_name) && value != name && once(value);
    let remark = text.split_once(" // ").map(|(_, remark)| remark);
    let said = remark.and_then(|remark| remark.strip_prefix(&format!("{name} = ")));
    (once(name) && (literal || other)).then(|| {
        let said = said.unwrap_or(value).to_owned();
        (
            name.to_owned(),
            Copy {
                of: value.to_owned(),
                said,
            },
        )
    })
}
