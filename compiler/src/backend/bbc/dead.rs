//! Flags that are set where nothing asks for them any more.
//!
//! Where jumps go straight to where a test would have led, what was set for the test
//! may be read nowhere on the way. Lines are walked from the jump on, as control may go
//! (liveness: Aho, Lam, Sethi and Ullman, Compilers, 2nd edition, 9.2.5); what is not
//! certain counts as read.

mod statements;

use super::lines::{Label, Lines};
use rustc_hash::FxHashMap;
use statements::{called, counts, cut, flag, last, leaves, loop_end, written};
use std::collections::BTreeSet;

/// The lines without flags that are set in vain before a jump or at a line's end.
pub fn without(lines: Lines) -> Lines {
    let mut texts: Vec<String> = lines.texts().map(str::to_owned).collect();
    let placed: FxHashMap<Label, usize> = lines.labelled().collect();
    let flow = Flow::of(&texts, &placed);
    let changed: Vec<String> = texts
        .iter()
        .enumerate()
        .map(|(at, text)| flow.without_last(at, text, &placed))
        .collect();
    texts = changed;
    lines.with_texts(texts, &FxHashMap::default())
}

/// A line, or what of it stands behind a statement to which control comes back.
#[derive(Default)]
struct Point {
    /// What may be read before it is written here.
    reads: BTreeSet<String>,
    /// Where it goes on, and what it has written on that way whatever happens.
    next: Vec<Way>,
    /// The procedures that it calls, and where each comes back to.
    calls: Vec<(Way, usize)>,
    /// What it has written on each way on which it ends a procedure.
    ends: Vec<BTreeSet<String>>,
    /// Where it goes on behind a call, if it ends a procedure.
    back: Vec<Way>,
}

/// Where control goes, and what is written before that.
type Way = (usize, BTreeSet<String>);

/// The lines' points, in their order, then those inside lines.
pub struct Flow(Vec<Point>);

/// What is known of a program while its flow is found.
struct Finder<'t> {
    points: Vec<Point>,
    placed: &'t FxHashMap<Label, usize>,
    /// The line of each procedure's DEF.
    defined: FxHashMap<&'t str, usize>,
    /// Where each procedure goes back to.
    back: FxHashMap<&'t str, Vec<usize>>,
    /// Where loops begin anew, and what counts their turns.
    loops: Vec<(&'t str, usize)>,
    /// What ends a loop's turn, if it says which, and what ends a procedure, and what is
    /// written there.
    turns: Vec<(Option<&'t str>, usize, BTreeSet<String>)>,
    ends: Vec<(usize, &'t str, BTreeSet<String>)>,
    /// The procedure that the line stands in, and the line behind it.
    inside: &'t str,
    behind: usize,
}

impl Flow {
    /// The flow of a program's lines.
    pub fn of(texts: &[String], placed: &FxHashMap<Label, usize>) -> Flow {
        let defined = texts.iter().enumerate();
        let defined =
            defined.filter_map(|(at, text)| Some((called(text.strip_prefix("DEF ")?)?, at)));
        let mut finder = Finder {
            points: texts.iter().map(|_| Point::default()).collect(),
            placed,
            defined: defined.collect(),
            back: FxHashMap::default(),
            loops: Vec::new(),
            turns: Vec::new(),
            ends: Vec::new(),
            inside: "",
            behind: 0,
        };
        for (at, text) in texts.iter().enumerate() {
            if let Some(name) = text.strip_prefix("DEF ").and_then(called) {
                finder.inside = name;
            }
            finder.behind = at + 1;
            if !text.starts_with("DEF") {
                finder.point(at, text, &BTreeSet::new());
            } else {
                finder.points[at].next.push((at + 1, BTreeSet::new()));
            }
        }
        for (of, at, writes) in &finder.turns {
            let right = |counts: &str| of.is_none_or(|of| of == counts);
            let all = finder.loops.iter().filter(|(counts, _)| right(counts));
            let all = all.map(|(_, to)| (*to, writes.clone()));
            finder.points[*at].next.extend(all);
        }
        for (at, name, writes) in &finder.ends {
            let all = finder.back.get(name).into_iter().flatten();
            let all = all.map(|to| (*to, writes.clone()));
            finder.points[*at].back.extend(all);
            finder.points[*at].ends.push(writes.clone());
        }
        Flow(finder.points)
    }

    /// Whether a name may be read from a line on, before it is written. A procedure that
    /// is called on the way goes back to where that was, one that the line is in to
    /// wherever it is called.
    pub fn reads(&self, name: &str, from: usize) -> bool {
        let mut seen = vec![[false; 2]; self.0.len()];
        let mut todo = vec![(from, true)];
        while let Some((at, outermost)) = todo.pop() {
            let Some(point) = self.0.get(at) else {
                continue;
            };
            if std::mem::replace(&mut seen[at][usize::from(outermost)], true) {
                continue;
            }
            if point.reads.contains(name) {
                return true;
            }
            let mut go = |ways: &[Way], outermost: bool| {
                let open = ways.iter().filter(|(_, writes)| !writes.contains(name));
                todo.extend(open.map(|(to, _)| (*to, outermost)));
            };
            go(&point.next, outermost);
            if outermost {
                go(&point.back, true);
            }
            for ((to, writes), on) in &point.calls {
                if !writes.contains(name) {
                    todo.push((*to, false));
                    if self.passes(name, *to, &mut Vec::new()) {
                        todo.push((*on, outermost));
                    }
                }
            }
        }
        false
    }

    /// Whether a procedure may be gone through, from a line on, without a name being
    /// written. `inside`: those that call it, as far as is known.
    fn passes(&self, name: &str, from: usize, inside: &mut Vec<usize>) -> bool {
        if inside.contains(&from) {
            return true;
        }
        inside.push(from);
        let passes = self.goes_through(name, from, inside);
        inside.pop();
        passes
    }

    fn goes_through(&self, name: &str, from: usize, inside: &mut Vec<usize>) -> bool {
        let mut seen = vec![false; self.0.len()];
        let mut todo = vec![from];
        while let Some(at) = todo.pop() {
            let Some(point) = self.0.get(at) else {
                continue;
            };
            if std::mem::replace(&mut seen[at], true) {
                continue;
            }
            if point.ends.iter().any(|writes| !writes.contains(name)) {
                return true;
            }
            let open = |(_, writes): &&Way| !writes.contains(name);
            todo.extend(point.next.iter().filter(open).map(|(to, _)| *to));
            for ((to, writes), on) in &point.calls {
                if !writes.contains(name) && self.passes(name, *to, inside) {
                    todo.push(*on);
                }
            }
        }
        false
    }

    /// A line without the flags that it sets last and in vain.
    fn without_last(&self, at: usize, text: &str, placed: &FxHashMap<Label, usize>) -> String {
        let plain = |text: &str| {
            let way = text.contains(" ELSE ") || text.contains("NEXT");
            !way && text.matches("IF ").count() <= 1
        };
        if let Some((before, label)) = Label::last_of(text)
            && let Some(&to) = placed.get(&label)
            && let Some(whole) = before.strip_suffix("GOTO ")
            && let (mut before, end) = loop_end(whole)
            && plain(before)
        {
            while let Some((front, last)) = last(before.strip_suffix(':').unwrap_or(""))
                && flag(last).is_some_and(|name| !self.reads(name, to))
            {
                before = front;
            }
            return match before.ends_with(" THEN ") && end.is_empty() {
                true => format!("{before}{label}"),
                false => format!("{before}{end}GOTO {label}"),
            };
        }
        match flag(text) {
            Some(name) if !self.reads(name, at + 1) => String::new(),
            _ => text.to_owned(),
        }
    }
}

impl<'t> Finder<'t> {
    fn fresh(&mut self) -> usize {
        self.points.push(Point::default());
        self.points.len() - 1
    }

    /// What statements do that begin at a point, where something was written before.
    fn point(&mut self, at: usize, text: &'t str, before: &BTreeSet<String>) {
        let (plain, test) = match text.find("IF ") {
            Some(from) => text.split_at_checked(from).unwrap_or((text, "")),
            None => (text, ""),
        };
        if let Some((head, turn)) = cut(plain) {
            let writes = self.written(at, head, before);
            let rest = text.get(head.len()..).unwrap_or("");
            let rest = rest.strip_prefix(':').unwrap_or(rest);
            let on = match rest {
                "" => self.behind,
                _ => self.fresh(),
            };
            self.turning(at, turn, on, &writes);
            if !rest.is_empty() {
                self.point(on, rest, &BTreeSet::new());
            }
            return;
        }
        let writes = self.written(at, plain, before);
        let Some((asked, ways)) = test.split_once(" THEN ") else {
            // No test, or one in another form than ours.
            let writes = self.written(at, test, &writes);
            return self.way(at, text, &writes);
        };
        let _ = self.written(at, asked, &writes);
        if ways.contains("IF ") {
            // One of many ways: nothing inside is written for sure.
            let _ = self.written(at, ways, &writes);
            for (from, _) in ways.match_indices("PROC") {
                self.turning(at, ways.get(from..).unwrap_or(""), self.behind, &writes);
            }
            if let Some((_, turn)) = ways.split_once("FOR ") {
                self.loops.push((counts(turn), at));
            }
            if ways.contains("NEXT") {
                self.turns.push((None, at, writes.clone()));
            }
            if ways.contains("ENDPROC") {
                self.ends.push((at, self.inside, writes.clone()));
            }
            let to = Label::all_of(ways).filter_map(|label| self.placed.get(&label));
            let to: Vec<usize> = to.copied().chain([self.behind]).collect();
            let next = to.into_iter().map(|to| (to, writes.clone()));
            self.points[at].next.extend(next);
            return;
        }
        let (yes, no) = ways.split_once(" ELSE ").unwrap_or((ways, ""));
        for way in [yes, no] {
            let on = self.fresh();
            self.points[at].next.push((on, writes.clone()));
            self.point(on, way, &BTreeSet::new());
        }
    }

    /// Where control goes from a statement to which it comes back, or from behind which
    /// it may go elsewhere: a call, the head of a loop, its end.
    fn turning(&mut self, at: usize, turn: &'t str, on: usize, writes: &BTreeSet<String>) {
        if let Some(name) = called(turn) {
            self.back.entry(name).or_default().push(on);
            if let Some(to) = self.defined.get(name) {
                self.points[at].calls.push(((*to, writes.clone()), on));
                return;
            }
        } else if let Some(turn) = turn.strip_prefix("FOR ") {
            self.loops.push((counts(turn), on));
        } else {
            let of = turn.strip_prefix("NEXT ");
            // Where a way sets what counts the turns, there is no other one.
            if of.is_none_or(|of| !writes.contains(of)) {
                self.turns.push((of, at, writes.clone()));
            }
        }
        self.points[at].next.push((on, writes.clone()));
    }

    /// The end of a line's way.
    fn way(&mut self, at: usize, text: &'t str, writes: &BTreeSet<String>) {
        let to = Label::all_of(text).filter_map(|label| self.placed.get(&label));
        let mut to: Vec<usize> = to.copied().collect();
        if text.contains("ENDPROC") {
            self.ends.push((at, self.inside, writes.clone()));
        }
        if !leaves(text) {
            to.push(self.behind);
        }
        let next = to.into_iter().map(|to| (to, writes.clone()));
        self.points[at].next.extend(next);
    }

    /// What is written behind some statements; what they read that is not is noted.
    fn written(&mut self, at: usize, text: &str, before: &BTreeSet<String>) -> BTreeSet<String> {
        written(text, before, &mut self.points[at].reads)
    }
}
