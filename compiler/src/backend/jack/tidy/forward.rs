//! Forward substitution: what is assigned once and read once is written where it is read,
//! which saves the commands that put it into its variable and fetch it from there.
//!
//! An expression moves past statements that assign nothing it reads, into an arm too, but
//! never into a loop, nor past a method. What sets a static of the runtime's stays.

use super::tree::*;
use std::collections::BTreeSet;

/// Characters of an expression that is still written where it is read, and of a line.
const WIDE: usize = 56;
const LINE: usize = 96;
/// Subroutines beside which `Log.plus()` has a meaning.
const SIGNED: [&str; 8] = [
    "Log.plus(",
    "Log.add(",
    "Log.mod(",
    "Log.sin(",
    "Log.quarterSine(",
    "Log.tan(",
    "Log.log(",
    "Log.pow(",
];

/// A value on its way to who reads it.
struct Moved {
    name: String,
    value: String,
    /// How it is said in remarks.
    said: String,
    reads: BTreeSet<String>,
}

/// What came of a search.
enum Search {
    Found,
    Blocked,
    Going,
}

/// Substitutes what `may` go, in all blocks; who went is told.
pub(super) fn substituted(
    items: &mut Vec<Item>,
    may: &impl Fn(&str) -> bool,
    gone: &mut BTreeSet<String>,
) {
    let mut at = 0;
    while at < items.len() {
        let moved = match items.get_mut(at) {
            Some(Item::Line(line)) => moved(&line.text).filter(|moved| may(&moved.name)),
            Some(Item::If { yes, no, .. }) => {
                substituted(yes, may, gone);
                substituted(no, may, gone);
                None
            }
            Some(Item::While { body, .. }) => {
                substituted(body, may, gone);
                None
            }
            None => None,
        };
        if let (Some(moved), Some(rest)) = (moved, items.get_mut(at + 1..))
            && matches!(search(rest, &moved), Search::Found)
        {
            gone.insert(moved.name);
            items.remove(at);
        } else {
            at += 1;
        }
    }
}

/// The assignment of a value that may be computed later as well.
fn moved(text: &str) -> Option<Moved> {
    let (name, value) = assignment(text)?;
    let calls = value.split('(').filter_map(|before| {
        let call = before
            .rsplit(|c: char| !c.is_ascii_alphanumeric() && c != '.')
            .next();
        call.filter(|call| call.contains('.'))
    });
    let pure = |call: &str| {
        let class = call.split('.').next().unwrap_or_default();
        matches!(class, "Log" | "Int" | "Fixed" | "Float" | "Math")
            && !SIGNED
                .iter()
                .any(|signed| signed.trim_end_matches('(') == call)
    };
    if value.len() > WIDE || value.contains('"') || !calls.into_iter().all(pure) {
        return None;
    }
    let remark = text.split_once(" // ").map(|(_, remark)| remark);
    let said = remark.and_then(|remark| remark.strip_prefix(&format!("{name} = ")));
    Some(Moved {
        name: name.to_owned(),
        value: value.to_owned(),
        said: said.unwrap_or(value).to_owned(),
        reads: variables(value)
            .map(|(_, word, _)| word.to_owned())
            .collect(),
    })
}

impl Moved {
    /// Whether a line changes what the value is made of.
    fn is_disturbed(&self, text: &str) -> bool {
        let own = text.starts_with("do ") && !text.starts_with("do Screen.");
        own || variables(text).any(|(_, word, assigned)| assigned && self.reads.contains(word))
    }

    /// Writes the value where it is read.
    fn put(&self, text: &mut String) -> Search {
        let code = code(text);
        let here = |(_, word, assigned): &(usize, &str, bool)| *word == self.name && !assigned;
        let Some(at) = variables(text).find(here).map(|(at, ..)| at) else {
            return Search::Blocked;
        };
        let (before, after) = (&code[..at], &code[at + self.name.len()..]);
        let opens = before.ends_with(['(', '[']) || before.ends_with(", ");
        let alone = opens && after.starts_with([',', ')', ']']);
        let assigned = before.starts_with("let ") && before.matches(" = ").count() == 1;
        let whole = assigned && before.ends_with(" = ") && after == ";";
        let value = match alone || whole {
            true => self.value.clone(),
            false => term(&self.value),
        };
        let line = format!("{before}{value}{after}");
        if line.len() > LINE {
            return Search::Blocked;
        }
        *text = format!("{line}{}", self.remark(&text[code.len()..]));
        Search::Found
    }

    /// A remark that names the value, if there is one.
    fn remark(&self, remark: &str) -> String {
        let Some(said) = remark.strip_prefix(" // ") else {
            return String::new();
        };
        format!(" // {}", renamed(said, &self.name, &self.said))
    }
}

/// Looks for who reads a value, and writes it there.
fn search(items: &mut [Item], moved: &Moved) -> Search {
    let reads_it = |text: &str| reads(text, &moved.name);
    let disturbs = |text: &str| moved.is_disturbed(text);
    for item in items {
        match item {
            Item::Line(line) if reads_it(&line.text) => return moved.put(&mut line.text),
            Item::Line(line) if disturbs(&line.text) => return Search::Blocked,
            Item::Line(_) => {}
            Item::While { head, body } => {
                let stops = |text: &str| reads_it(text) || disturbs(text);
                if stops(&head.text) || any(body, &stops) {
                    return Search::Blocked;
                }
            }
            Item::If { head, .. } if reads_it(&head.text) => return moved.put(&mut head.text),
            Item::If { yes, no, .. } => {
                for arm in [&mut *yes, &mut *no] {
                    if any(arm, &reads_it) {
                        return search(arm, moved);
                    }
                }
                if any(yes, &disturbs) || any(no, &disturbs) {
                    return Search::Blocked;
                }
            }
        }
    }
    Search::Going
}
