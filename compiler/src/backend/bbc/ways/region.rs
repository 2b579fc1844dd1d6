//! What is copied for a way of which more is known.

use super::super::lines::Label;
use super::super::lines::jump;
use super::super::test_line::Test;
use super::super::test_line::opposite;
use super::super::thread::Known;
use super::roads::{Roads, is_plain};
use std::collections::{BTreeMap, BTreeSet};

/// Where a copied line goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum To {
    /// At the copy of a line.
    Copy(usize),
    /// At a line of the program.
    Line(usize),
}

/// A copied line.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Copied {
    /// Which line it is of.
    pub of: usize,
    /// Its statements, without a jump.
    pub text: String,
    /// Where the text jumps at its end, if it does.
    pub jumps: Option<To>,
    /// Where control goes on behind it.
    pub next: To,
    /// Whether it was a test whose outcome is known.
    pub decided: bool,
}

impl Copied {
    /// The same line before another, to which it goes on rather than jumps.
    pub fn turned(&self, follows: Option<To>) -> Copied {
        let mut turned = self.clone();
        if let Some(jumps) = self.jumps.filter(|to| Some(*to) == follows)
            && let Some(test) = Test::of(&self.text).filter(|test| test.yes.is_empty())
            && let Some(opposite) = opposite(test.test)
        {
            turned.text = format!("IF {opposite} THEN ");
            (turned.jumps, turned.next) = (Some(self.next), jumps);
        }
        turned
    }
}

impl Roads<'_> {
    /// The lines from one on that lead to tests of which a way knows more than all ways
    /// to them do, and these without the tests; `most` are looked at. Nothing where there
    /// is no such test.
    pub fn region(&self, from: usize, known: &Known, most: usize) -> Option<Vec<Copied>> {
        let inside = self.inside(from, known, most);
        let decided = |at: &usize| {
            let test = Test::of(self.texts.get(*at)?)?;
            let always = self.known.get(*at).and_then(Option::as_ref);
            let always = always.and_then(|known| test.outcome(known));
            test.outcome(inside.get(at)?).filter(|_| always.is_none())
        };
        let mut useful: BTreeSet<usize> = inside
            .keys()
            .copied()
            .filter(|at| decided(at).is_some())
            .collect();
        loop {
            let leads = |at: &usize| {
                let ways = self.ways(*at, inside[at].clone());
                ways.iter().any(|(to, _)| useful.contains(to))
            };
            let more = inside.keys().copied().filter(|at| !useful.contains(at));
            let more: Vec<usize> = more.filter(leads).collect();
            if more.is_empty() {
                break;
            }
            useful.extend(more);
        }
        if !useful.contains(&from) {
            return None;
        }
        let to = |line: usize| match useful.contains(&line) {
            true => To::Copy(line),
            false => To::Line(line),
        };
        let copied = |at: usize| self.copied(at, &inside[&at], &to);
        // In the program's order, behind where it begins, as long as control goes on so.
        let (before, behind): (Vec<usize>, Vec<usize>) = useful.iter().partition(|at| **at < from);
        behind.into_iter().chain(before).map(copied).collect()
    }

    /// What is known on the way at each of the lines that it may come to; as far as these
    /// may be copied.
    fn inside(&self, from: usize, known: &Known, most: usize) -> BTreeMap<usize, Known> {
        let mut inside = BTreeMap::from([(from, known.clone())]);
        let mut todo = vec![from];
        while let Some(at) = todo.pop() {
            if !self.may_be_copied(at) {
                inside.remove(&at);
                continue;
            }
            let Some(before) = inside.get(&at).cloned() else {
                continue;
            };
            for (to, known) in self.ways(at, before) {
                let met = match inside.get(&to) {
                    Some(other) => known.met(other),
                    None if inside.len() == most => continue,
                    None => known,
                };
                if inside.get(&to) != Some(&met) {
                    inside.insert(to, met);
                    todo.push(to);
                }
            }
        }
        inside
    }

    /// Whether a line is assignments, a jump, or a test of which one way goes on behind it.
    fn may_be_copied(&self, at: usize) -> bool {
        let Some(text) = self.texts.get(at) else {
            return false;
        };
        match Test::of(text) {
            Some(test) => {
                let plain = |way: &str| way.is_empty() || is_plain(way);
                match Label::last_of(test.yes) {
                    Some((before, _)) => {
                        // A loop that ends has no other turn.
                        let way = statements(before);
                        let ends = way.rsplit_once(":NEXT ").map_or(way, |(before, _)| before);
                        test.no.is_empty() && plain(ends)
                    }
                    None => plain(test.yes) && plain(test.no),
                }
            }
            None => is_plain(text) || jump(text).is_some_and(|(way, _)| way == "GOTO "),
        }
    }

    /// A line as it is on a way, where `to` says what becomes of others.
    fn copied(&self, at: usize, known: &Known, to: &dyn Fn(usize) -> To) -> Option<Copied> {
        let text = self.texts.get(at)?.as_str();
        let behind = to(at + 1);
        let whole = |text: &str, next| Copied {
            of: at,
            text: text.to_owned(),
            jumps: None,
            next,
            decided: false,
        };
        let Some(test) = Test::of(text) else {
            return Some(match jump(text) {
                Some((_, label)) => whole("", to(*self.placed.get(&label)?)),
                None => whole(text, behind),
            });
        };
        if let Some(holds) = test.outcome(known) {
            let way = if holds { test.yes } else { test.no };
            let line = match Label::last_of(way) {
                Some((before, label)) => whole(statements(before), to(*self.placed.get(&label)?)),
                None => whole(way, behind),
            };
            return Some(Copied {
                decided: true,
                ..line
            });
        }
        Some(match Label::last_of(text) {
            Some((before, label)) => Copied {
                jumps: Some(to(*self.placed.get(&label)?)),
                ..whole(before, behind)
            },
            None => whole(text, behind),
        })
    }
}

/// What stands before a jump.
fn statements(before: &str) -> &str {
    let before = before.strip_suffix("GOTO ").unwrap_or(before);
    before.strip_suffix(':').unwrap_or(before)
}
