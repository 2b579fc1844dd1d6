//! Jump threading: a branch on what the arms before it have just set moves into these, where
//! it is often decided.
//!
//! ```text
//! if (a) { let e = false; }          if (~a) {
//! else { ... let e = x < y; }           ...
//! if (e) { B }                          if (x < y) { B }
//!                                    }
//! ```

use super::tree::*;

/// How many lines more a program may get by one branch that goes, as a block stands in
/// several arms then.
const COPIED: usize = 4;

/// Threads what can be, in all blocks.
pub(super) fn threaded(items: &mut Vec<Item>, counts: &Counts) {
    let mut at = 0;
    while at < items.len() {
        while thread(items, at, counts) {}
        match items.get_mut(at) {
            Some(Item::If { yes, no, .. }) => {
                threaded(yes, counts);
                threaded(no, counts);
            }
            Some(Item::While { body, .. }) => threaded(body, counts),
            _ => {}
        }
        at += 1;
    }
}

/// A branch on a variable: what its arms do, and when.
struct Branch {
    name: String,
    /// The int that it is compared with; of a bool none.
    with: Option<String>,
    head: super::super::Line,
    yes: Vec<Item>,
    no: Vec<Item>,
}

impl Branch {
    fn of(item: &Item) -> Option<Branch> {
        let Item::If { head, yes, no } = item else {
            return None;
        };
        let asked = condition(&head.text);
        let (asked, yes, no) = match denied(asked) {
            Some(other) => (other, no, yes),
            None => (asked, yes, no),
        };
        let (name, with) = match asked.split_once(" = ") {
            Some((name, with)) => (name, Some(with.to_owned())),
            None => (asked, None),
        };
        let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
        (name.chars().all(is_name)).then(|| Branch {
            name: name.to_owned(),
            with,
            head: head.clone(),
            yes: yes.clone(),
            no: no.clone(),
        })
    }

    /// Which way it goes by a value, where that is known.
    fn goes(&self, value: &str) -> Option<bool> {
        let whole = |text: &str| text.trim_matches(['(', ')']).parse::<i32>().ok();
        match (&self.with, value) {
            (None, "true") => Some(true),
            (None, "false") => Some(false),
            (Some(with), _) => Some(whole(with)? == whole(value)?),
            _ => None,
        }
    }

    /// What is left of it behind a value.
    fn behind(&self, value: &str) -> Vec<Item> {
        match (self.goes(value), &self.with) {
            (Some(true), _) => self.yes.clone(),
            (Some(false), _) => self.no.clone(),
            (None, with) => {
                let asked = match with {
                    Some(with) => format!("{} = {with}", term(value)),
                    None => value.to_owned(),
                };
                vec![Item::If {
                    head: if_of(&self.head, &asked),
                    yes: self.yes.clone(),
                    no: self.no.clone(),
                }]
            }
        }
    }
}

/// Threads the branch behind a statement; whether that was possible.
fn thread(items: &mut Vec<Item>, at: usize, counts: &Counts) -> bool {
    let (Some(first @ Item::If { .. }), Some(branch)) =
        (items.get(at), items.get(at + 1).and_then(Branch::of))
    else {
        return false;
    };
    let mut values = Vec::new();
    if !ends(first, &branch.name, &mut values) || counts.get(&branch.name) != [1, values.len()] {
        return false;
    }
    let copies = |way: bool, block: &[Item]| {
        let is = |value: &&String| branch.goes(value) != Some(!way);
        let times = values.iter().filter(is).count();
        length(block) * times.saturating_sub(1)
    };
    if copies(true, &branch.yes) + copies(false, &branch.no) > COPIED {
        return false;
    }
    items.remove(at + 1);
    if let Some(first) = items.get_mut(at) {
        put(first, &branch);
    }
    if matches!(items.get(at), Some(Item::If { yes, no, .. }) if yes.is_empty() && no.is_empty()) {
        items.remove(at);
    }
    true
}

/// Whether every way through a branch ends with the assignment of a variable; of what.
fn ends(item: &Item, name: &str, values: &mut Vec<String>) -> bool {
    match item {
        Item::Line(line) => match assignment(&line.text) {
            Some((to, value)) if to == name => {
                values.push(value.to_owned());
                true
            }
            _ => false,
        },
        Item::If { yes, no, .. } => [yes, no]
            .into_iter()
            .all(|arm| arm.last().is_some_and(|last| ends(last, name, values))),
        Item::While { .. } => false,
    }
}

/// Puts a branch into the places of these assignments.
fn put(item: &mut Item, branch: &Branch) {
    let Item::If { yes, no, .. } = item else {
        return;
    };
    for arm in [yes, no] {
        match arm.pop() {
            Some(Item::Line(line)) => {
                let value = assignment(&line.text).map_or("", |(_, value)| value);
                arm.extend(branch.behind(value));
            }
            Some(mut last) => {
                put(&mut last, branch);
                let idle =
                    matches!(&last, Item::If { yes, no, .. } if yes.is_empty() && no.is_empty());
                arm.extend((!idle).then_some(last));
            }
            None => {}
        }
    }
}
