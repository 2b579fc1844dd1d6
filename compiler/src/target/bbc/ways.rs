//! Tests whose outcome is known where a way comes from.
//!
//! A way that has set a flag jumps to lines that ask for it further on, behind what other
//! ways do as well. Where that is little, the way has its own copy of it without the
//! test, as far as the last one that is known (path splitting and jump threading: Aho,
//! Lam, Sethi and Ullman, Compilers, 2nd edition, 8.7.3 and 9.5). What is known of a flag
//! wherever control comes from needs no copy. Where a flag was compared with a test, the
//! flag tells on both ways how that test would come out again. Flags that nobody asks for then need not be
//! set ([`super::dead`]), and one that is asked for at once and never again is the test
//! itself.

use super::asked::{in_place, joined, opposite};
use super::dead::Flow;
use super::lines::{Label, Labels, Lines};
use super::pieces::short_length;
use super::thread::{Known, jump};
use std::collections::{BTreeMap, HashMap};

/// How much may be copied for a way: lines, and bytes of the program.
const LINES: usize = 6;
const LENGTH: usize = 110;

/// How often lines are looked at: what one copy does not need another may do without.
const ROUNDS: usize = 2;

/// The lines with tests left out whose outcome is known. `copies`: there is memory for
/// copies of what stands before them.
pub fn split(lines: Lines, labels: &mut Labels, copies: bool) -> Lines {
    let mut lines = lines;
    for _ in 0..ROUNDS {
        if copies {
            lines = copied(lines, labels);
        }
        lines = decided(lines);
    }
    in_place(lines, labels)
}

/// A line that is one test.
pub struct Test<'t> {
    pub test: &'t str,
    pub yes: &'t str,
    pub no: &'t str,
}

impl<'t> Test<'t> {
    /// The test of a line, if it is one and no more.
    pub fn of(text: &'t str) -> Option<Test<'t>> {
        let (test, ways) = text.strip_prefix("IF ")?.split_once(" THEN ")?;
        let (yes, no) = ways.split_once(" ELSE ").unwrap_or((ways, ""));
        let one = !ways.contains("IF ") && !no.contains(" ELSE ");
        one.then_some(Test { test, yes, no })
    }

    /// Whether it holds, where that is known.
    fn outcome(&self, known: &Known) -> Option<bool> {
        match self.test.strip_prefix("NOT ") {
            Some(name) => known.of(name).map(|holds| !holds),
            None => known.of(self.test),
        }
    }

    /// Where it jumps and does nothing else.
    fn label(&self) -> Option<Label> {
        let (before, label) = Label::last_of(self.yes)?;
        (before.is_empty() && self.no.is_empty()).then_some(label)
    }
}

/// Whether statements are assignments, behind which control goes on.
fn is_plain(text: &str) -> bool {
    text.split(':').all(|statement| {
        let name = statement.split_once('=').map_or("", |(name, _)| name);
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '%';
        !name.is_empty() && name.chars().all(plain)
    }) && !text.contains('"')
}

/// A program's lines, and where control comes to them.
struct Roads<'t> {
    texts: &'t [String],
    placed: HashMap<Label, usize>,
    /// What is known before each line; nothing where control does not come.
    known: Vec<Option<Known>>,
}

impl<'t> Roads<'t> {
    fn of(texts: &'t [String], placed: HashMap<Label, usize>) -> Roads<'t> {
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
    fn ways(&self, at: usize, before: Known) -> Vec<(usize, Known)> {
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
        for (way, holds) in [(test.yes, true), (test.no, false)] {
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
    fn known_at_jump(&self, at: usize) -> Option<(Label, Known)> {
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

/// What is copied for a way.
#[derive(Default)]
struct Copy {
    texts: Vec<(usize, String)>,
    /// The line at which it goes on with the others.
    on: usize,
    /// How many tests are left out.
    saved: usize,
}

impl Roads<'_> {
    /// The lines from one on, without tests that are known there: up to the last of these.
    fn copy(&self, from: usize, known: &Known) -> Copy {
        let mut best = Copy {
            on: from,
            ..Copy::default()
        };
        let (mut at, mut known) = (from, known.clone());
        let (mut texts, mut saved) = (Vec::new(), 0);
        while texts.len() <= LINES {
            let Some(text) = self.texts.get(at) else {
                break;
            };
            if let Some(test) = Test::of(text) {
                // What is known wherever control comes from is left out without a copy.
                let here = self.known.get(at).and_then(Option::as_ref);
                let always = here.is_some_and(|here| test.outcome(here).is_some());
                let Some(holds) = test.outcome(&known).filter(|_| !always) else {
                    let Some(next) = self.undecided(at, &test, &known) else {
                        break;
                    };
                    known.assume(test.test, next.0);
                    texts.push((at, next.1));
                    at = next.2;
                    continue;
                };
                saved += 1;
                let way = if holds { test.yes } else { test.no };
                let (done, label) = match Label::last_of(way) {
                    Some((done, label)) => (done, Some(label)),
                    None => (way, None),
                };
                let done = done.strip_suffix("GOTO ").unwrap_or(done);
                let done = done.strip_suffix(':').unwrap_or(done);
                if !done.is_empty() {
                    if !is_plain(done) {
                        break;
                    }
                    done.split(':').for_each(|s| known.learn(s));
                    texts.push((at, done.to_owned()));
                }
                at = match label {
                    Some(label) => match self.placed.get(&label) {
                        Some(to) => *to,
                        None => break,
                    },
                    None => at + 1,
                };
                best = Copy {
                    texts: texts.clone(),
                    on: at,
                    saved,
                };
            } else if is_plain(text) {
                text.split(':').for_each(|s| known.learn(s));
                texts.push((at, text.clone()));
                at += 1;
            } else if let Some(("GOTO ", label)) = jump(text) {
                match self.placed.get(&label) {
                    Some(to) => at = *to,
                    None => break,
                }
                if texts.len() > LINES || at == from {
                    break;
                }
                texts.push((at, String::new()));
            } else {
                break;
            }
        }
        best.texts.retain(|(_, text)| !text.is_empty());
        best
    }

    /// A test of which nothing is known: which of its ways leads to one that is, as whether
    /// it holds there, the test for the other way, and the line.
    fn undecided(
        &self,
        at: usize,
        test: &Test<'_>,
        known: &Known,
    ) -> Option<(bool, String, usize)> {
        let label = test.label()?;
        let to = *self.placed.get(&label)?;
        if self.leads(at + 1, known) {
            return Some((false, self.texts[at].clone(), at + 1));
        }
        let opposite = opposite(test.test)?;
        // The line behind it must have a name to be jumped to.
        let behind = (self.placed.iter()).filter(|(_, line)| **line == at + 1);
        let behind = behind.map(|(label, _)| *label).min()?;
        self.leads(to, known)
            .then(|| (true, format!("IF {opposite} THEN {behind}"), to))
    }

    /// Whether a line, or one a few assignments further on, is a test that is known.
    fn leads(&self, mut at: usize, known: &Known) -> bool {
        for _ in 0..LINES {
            let Some(text) = self.texts.get(at) else {
                return false;
            };
            match Test::of(text) {
                Some(test) => return test.outcome(known).is_some(),
                None if is_plain(text) => at += 1,
                None => return false,
            }
        }
        false
    }
}

/// The lines with copies for ways of which more is known.
fn copied(lines: Lines, labels: &mut Labels) -> Lines {
    // Lines behind tests get names: a copy may go on there.
    let texts: Vec<String> = lines.texts().map(str::to_owned).collect();
    let tests = texts.iter().enumerate();
    let tests = tests.filter(|(_, text)| Test::of(text).is_some_and(|t| t.label().is_some()));
    let named: HashMap<usize, Label> = tests.map(|(at, _)| (at, labels.next())).collect();
    let lines = lines.with_texts(texts.clone(), &named);
    let roads = Roads::of(&texts, lines.labelled().collect());
    let weights: Vec<u64> = lines.weighted().map(|(_, weight)| weight).collect();
    let spans = lines.spans();
    let mut changed = texts.clone();
    let mut made: BTreeMap<(String, usize), Label> = BTreeMap::new();
    let mut blocks: Vec<(Label, Lines)> = Vec::new();
    let mut ends: HashMap<usize, Label> = HashMap::new();
    for (at, text) in texts.iter().enumerate() {
        let Some((label, known)) = roads.known_at_jump(at) else {
            continue;
        };
        let Some(&from) = roads.placed.get(&label) else {
            continue;
        };
        let copy = roads.copy(from, &known);
        let whole: Vec<&str> = copy.texts.iter().map(|(_, text)| text.as_str()).collect();
        let whole = whole.join(":");
        if copy.saved == 0 || copy.texts.is_empty() || short_length(&whole) > LENGTH {
            continue;
        }
        let own = *made.entry((whole, copy.on)).or_insert_with(|| {
            let own = labels.next();
            let on = *ends.entry(copy.on).or_insert_with(|| labels.next());
            let mut block = Lines::of_weight(1);
            block.place(own);
            for (line, text) in &copy.texts {
                block.weight = weights.get(*line).copied().unwrap_or(1);
                block.line(text.clone(), spans.get(*line).copied().flatten());
            }
            block.line(format!("GOTO {on}"), spans.get(from).copied().flatten());
            blocks.push((label, block));
            own
        });
        if let Some((before, _)) = Label::last_of(text) {
            changed[at] = format!("{before}{own}");
        }
    }
    if blocks.is_empty() {
        return lines;
    }
    // What copies go on at is named before copies stand there.
    let behind: HashMap<usize, Label> = ends.iter().map(|(on, l)| (on - 1, *l)).collect();
    let mut lines = lines.with_texts(changed, &behind);
    for (label, block) in blocks {
        lines = lines.with_before(label, block);
    }
    lines
}

/// The lines without tests that come out the same wherever control comes from, and
/// without lines to which it does not come any more.
fn decided(lines: Lines) -> Lines {
    let texts: Vec<String> = lines.texts().map(str::to_owned).collect();
    let roads = Roads::of(&texts, lines.labelled().collect());
    let flow = Flow::of(&texts, &roads.placed);
    let mut changed = texts.clone();
    for (at, text) in texts.iter().enumerate() {
        let Some(known) = &roads.known[at] else {
            let kept = text.starts_with("DATA") || text.starts_with("REM");
            if !kept {
                changed[at] = String::new();
            }
            continue;
        };
        if let Some(test) = Test::of(text) {
            let name = test.test.strip_prefix("NOT ").unwrap_or(test.test);
            if let Some(holds) = test.outcome(known) {
                let way = if holds { test.yes } else { test.no };
                let lone = Label::last_of(way).is_some_and(|(before, _)| before.is_empty());
                changed[at] = match lone {
                    true => format!("GOTO {way}"),
                    false => way.to_owned(),
                };
            } else if let Some(way) = test.yes.strip_prefix(&format!("{name}=TRUE:"))
                && name == test.test
            {
                changed[at] = text.replacen(test.yes, way, 1);
            } else if let Some(told) = known.told_by(test.test) {
                changed[at] = text.replacen(test.test, &told, 1);
            }
        }
    }
    // What is asked for at once and nowhere else is the test.
    let asked: HashMap<usize, usize> = texts
        .iter()
        .flat_map(|text| Label::all_of(text))
        .filter_map(|label| Some((*roads.placed.get(&label)?, 0)))
        .collect();
    for at in 1..changed.len() {
        if asked.contains_key(&at) {
            continue;
        }
        let found = joined(&changed[at - 1], &changed[at], |name| {
            let mut ways: Vec<usize> = Label::all_of(&changed[at])
                .filter_map(|label| roads.placed.get(&label).copied())
                .collect();
            ways.push(at + 1);
            ways.into_iter().any(|to| flow.reads(name, to))
        });
        if let Some((before, test)) = found {
            changed[at - 1] = before;
            changed[at] = test;
        }
    }
    for at in 0..changed.len() {
        let to = match jump(&changed[at]) {
            Some(("GOTO ", label)) => roads.placed.get(&label).copied(),
            _ => None,
        };
        let between = to.and_then(|to| changed.get(at + 1..to));
        if between.is_some_and(|lines| lines.iter().all(String::is_empty)) {
            changed[at] = String::new();
        }
    }
    let mut lines = lines.with_texts(changed, &HashMap::new());
    lines.remove_empty();
    lines
}

#[cfg(test)]
mod tests;
