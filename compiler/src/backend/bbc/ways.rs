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

mod region;
mod roads;

use super::asked::{in_place, joined, same_either_way};
use super::dead::Flow;
use super::lines::jump;
use super::lines::{Label, Labels, Lines};
use super::pieces::short_length;
use super::test_line::Test;
use super::thread::threaded;
use crate::plan::Copies;
use region::{Copied, To};
use roads::Roads;
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

/// How far tests are looked for that a way knows, lines, and how much may be copied for
/// each of them, bytes of the program.
const LINES: [usize; 4] = [20, 14, 10, 6];
const LENGTH: usize = 65;
/// Ways that are taken so many times less often than others have copies only where there
/// is memory for all.
const OFTEN: u64 = 64;
const JUMP: usize = 4;

/// How often lines are looked at: what one copy does not need another may do without.
const ROUNDS: usize = 2;

/// The lines with tests left out whose outcome is known. `copies`: there is memory for
/// copies of what stands before them.
pub fn split(lines: Lines, labels: &mut Labels, copies: Copies) -> Lines {
    let mut lines = lines;
    for _ in 0..ROUNDS {
        if copies >= Copies::Tests {
            lines = threaded(copied(lines, labels, copies), labels, false);
        }
        lines = decided(lines);
    }
    in_place(lines, labels)
}

/// The lines with copies for ways of which more is known.
fn copied(lines: Lines, labels: &mut Labels, copies: Copies) -> Lines {
    let texts: Vec<String> = lines.texts().map(str::to_owned).collect();
    let roads = Roads::of(&texts, lines.labelled().collect());
    let weights: Vec<u64> = lines.weighted().map(|(_, weight)| weight).collect();
    let most = weights.iter().copied().max().unwrap_or(0);
    let seldom = |at: usize| weights.get(at).is_some_and(|weight| weight * OFTEN < most);
    let spans = lines.spans();
    let mut changed = texts.clone();
    let mut made: BTreeMap<Vec<Copied>, Label> = BTreeMap::new();
    let mut blocks: Vec<(Label, Lines)> = Vec::new();
    // The lines that copies go on at get names.
    let mut ends: FxHashMap<usize, Label> = FxHashMap::default();
    for (at, text) in texts.iter().enumerate() {
        if copies < Copies::Ends && seldom(at) {
            continue;
        }
        let Some((label, known)) = roads.known_at_jump(at) else {
            continue;
        };
        let Some(&from) = roads.placed.get(&label) else {
            continue;
        };
        let region = |most: &usize| roads.region(from, &known, *most);
        let short = |region: &Vec<Copied>| length(region) <= LENGTH * saved(region);
        let mut regions = LINES.iter().filter_map(region).filter(short);
        let Some(region) = regions.next() else {
            continue;
        };
        let own = *made.entry(region).or_insert_with_key(|region| {
            let own: BTreeMap<usize, Label> =
                region.iter().map(|line| (line.of, labels.next())).collect();
            let mut name = |to: To| match to {
                To::Copy(line) => own[&line],
                To::Line(line) => *ends.entry(line).or_insert_with(|| labels.next()),
            };
            let mut block = Lines::of_weight(1);
            for (k, line) in region.iter().enumerate() {
                let span = spans.get(line.of).copied().flatten();
                block.weight = weights.get(line.of).copied().unwrap_or(1);
                block.place(own[&line.of]);
                let follows = region.get(k + 1).map(|next| To::Copy(next.of));
                let line = &line.turned(follows);
                let to = line.jumps.map(&mut name);
                let text = to.map_or_else(|| line.text.clone(), |to| format!("{}{to}", line.text));
                if !text.is_empty() {
                    block.line(text, span);
                }
                if follows != Some(line.next) {
                    block.line(format!("GOTO {}", name(line.next)), span);
                }
            }
            blocks.push((label, block));
            own[&from]
        });
        if let Some((before, _)) = Label::last_of(text) {
            changed[at] = format!("{before}{own}");
        }
    }
    if blocks.is_empty() {
        return lines;
    }
    // What copies go on at is named before copies stand there.
    let behind: FxHashMap<usize, Label> = ends.iter().map(|(on, l)| (on - 1, *l)).collect();
    let mut lines = lines.with_texts(changed, &behind);
    for (label, block) in blocks {
        lines = lines.with_before(label, block);
    }
    lines
}

/// How many tests copies are without.
fn saved(region: &[Copied]) -> usize {
    region.iter().filter(|line| line.decided).count()
}

/// About how many bytes of the program copies take.
fn length(region: &[Copied]) -> usize {
    let jumps = |line: &Copied| usize::from(line.jumps.is_some()) * JUMP;
    region
        .iter()
        .map(|line| short_length(&line.text) + jumps(line))
        .sum()
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
    let asked: FxHashMap<usize, usize> = texts
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
    for text in &mut changed {
        if let Some(whole) = same_either_way(text) {
            *text = whole;
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
    let mut lines = lines.with_texts(changed, &FxHashMap::default());
    lines.remove_empty();
    lines
}

#[cfg(test)]
mod tests;
