//! A program's lines, and what is known where control comes to them.

use super::super::lines::Label;
use super::super::lines::jump;
use super::super::test_line::Test;
use super::super::thread::Known;
use rustc_hash::FxHashMap;

impl Test<'_> {
    /// Whether it holds, where that is known.
    pub fn outcome(&self, known: &Known) -> Option<bool> {
        match self.test.strip_prefix("NOT ") {
            Some(name) => known.of(name).map(|holds| !holds),
            None => known.of(self.test),
        }
    }
}

/// Whether statements are assignments, behind which control goes on.
pub(super) fn is_plain(text: &str) -> bool {
    text.split(':').all(|statement| {
        let name = statement.split_once('=').map_or("", |(name, _)| name);
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '%';
        !name.is_empty() && name.chars().all(plain)
    }) && !text.contains('"')
}

/// A program's lines, and where control comes to them.
pub(super) struct Roads<'t> {
    pub texts: &'t [String],
    pub placed: FxHashMap<Label, usize>,
    /// What is known before each line; nothing where control does not come.
    pub known: Vec<Option<Known>>,
}

impl<'t> Roads<'t> {
    pub fn of(texts: &'t [String], placed: FxHashMap<Label, usize>) -> Roads<'t> {
        let mut roads = Roads {
            texts,
            placed,
            known: vec![None; texts.len()],
        };
        let defined = (0..texts.len()).filter(|at| texts[*at].starts_with("DEF"));
        let mut todo: Vec<usize> = defined.chain([0]).collect();
        for at in &todo {
            roads.known[*at] = Some(Known::default());
        }
        while let Some(at) = todo.pop() {
            let Some(before) = roads.known[at].clone() else {
                continue;
            };
            for (to, known) in roads.ways(at, before) {
                let Some(there) = roads.known.get_mut(to) else {
                    continue;
                };
                let met = match there.as_ref() {
                    Some(other) => known.met(other),
                    None => known,
                };
                if there.as_ref() != Some(&met) {
                    *there = Some(met);
                    todo.push(to);
                }
            }
        }
        roads
    }

    /// Where control goes from a line, and what is known there.
    pub fn ways(&self, at: usize, before: Known) -> Vec<(usize, Known)> {
        let text = self.texts[at].as_str();
        let Some(test) = Test::of(text) else {
            // What is no assignment, or a test in a test, leaves nothing known.
            let mut known = before;
            match text.contains("IF ") {
                true => known = Known::default(),
                false => text.split(':').for_each(|s| known.learn(s)),
            }
            let jumps = Label::all_of(text).filter_map(|l| self.placed.get(&l));
            let jumps: Vec<usize> = jumps.copied().collect();
            let goes = match jump(text) {
                Some((way, _)) => text.contains("IF ") || !way.ends_with("GOTO "),
                None => !["END", "ENDPROC"].contains(&text),
            };
            return (jumps.into_iter().chain(goes.then_some(at + 1)))
                .map(|to| (to, known.clone()))
                .collect();
        };
        let mut all = Vec::new();
        let outcome = test.outcome(&before);
        for (way, holds) in [(test.yes, true), (test.no, false)] {
            if outcome.is_some_and(|outcome| outcome != holds) {
                continue;
            }
            let mut known = before.clone();
            known.assume(test.test, holds);
            let label = Label::last_of(way).filter(|(b, _)| b.is_empty() || b.ends_with("GOTO "));
            let done = label.map_or(way, |(before, _)| before);
            let done = done.strip_suffix("GOTO ").unwrap_or(done);
            let done = done.strip_suffix(':').unwrap_or(done);
            let statements = done.split(':').filter(|s| !s.is_empty());
            statements.for_each(|s| known.learn(s));
            match label {
                Some((_, label)) => all.extend(self.placed.get(&label).map(|to| (*to, known))),
                None => all.push((at + 1, known)),
            }
        }
        all
    }

    /// What is known where a line jumps at its end.
    pub fn known_at_jump(&self, at: usize) -> Option<(Label, Known)> {
        let mut known = self.known.get(at)?.clone()?;
        let text = self.texts.get(at)?;
        let (before, label) = jump(text)?;
        let statements = match Test::of(text) {
            Some(test) if test.no.is_empty() => {
                known.assume(test.test, true);
                before.split_once(" THEN ").map_or("", |(_, way)| way)
            }
            Some(_) => return None,
            None if text.contains("IF ") => return None,
            None => before,
        };
        let statements = statements.strip_suffix("GOTO ").unwrap_or(statements);
        let statements = statements.split(':').filter(|s| !s.is_empty());
        statements.for_each(|s| known.learn(s));
        Some((label, known))
    }
}
