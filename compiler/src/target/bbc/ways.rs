//! Tests whose outcome is known where a way comes from.
//!
//! A way that has set a flag jumps to lines that ask for it further on, behind what other
//! ways do as well. Where that is little, the way has its own copy of it without the
//! test, as far as the last one that is known (path splitting and jump threading: Aho,
//! Lam, Sethi and Ullman, Compilers, 2nd edition, 8.7.3 and 9.5). What is known of a flag
//! wherever control comes from needs no copy. Flags that nobody asks for then need not be
//! set ([`super::dead`]), and one that is asked for at once and never again is the test
//! itself.

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
struct Test<'t> {
    test: &'t str,
    yes: &'t str,
    no: &'t str,
}

impl<'t> Test<'t> {
    fn of(text: &'t str) -> Option<Test<'t>> {
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

/// The test that holds where another does not.
fn opposite(test: &str) -> Option<String> {
    if let Some(name) = test.strip_prefix("NOT ") {
        return (!name.contains([' ', '(', '<', '>', '='])).then(|| name.to_owned());
    }
    let sign = |c: char| "<>=".contains(c);
    let from = test.find(sign)?;
    let length = test.get(from..)?.find(|c| !sign(c))?;
    let (left, rest) = test.split_at_checked(from)?;
    let (sign_is, right) = rest.split_at_checked(length)?;
    let alone = |text: &str| !text.contains(sign) && !text.contains("AND") && !text.contains("OR");
    let turned = match sign_is {
        "<" => ">=",
        "<=" => ">",
        ">" => "<=",
        ">=" => "<",
        "=" => "<>",
        "<>" => "=",
        _ => return None,
    };
    (alone(left) && alone(right)).then(|| format!("{left}{turned}{right}"))
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

/// The lines with an int that is set only for its lowest bits to be asked for in the
/// question's place. A way that sets it elsewhere, rarely, asks for itself.
fn in_place(lines: Lines, labels: &mut Labels) -> Lines {
    let texts: Vec<String> = lines.texts().map(str::to_owned).collect();
    let placed: HashMap<Label, usize> = lines.labelled().collect();
    let flow = Flow::of(&texts, &placed);
    let jumps = |to: usize| {
        let leads =
            move |label: &Label, placed: &HashMap<Label, usize>| placed.get(label) == Some(&to);
        let count = |text: &String| Label::all_of(text).filter(|l| leads(l, &placed)).count();
        let each = texts.iter().map(count).enumerate();
        each.filter(|(_, count)| *count > 0).collect::<Vec<_>>()
    };
    let mut changed: Vec<Vec<String>> = texts.iter().map(|text| vec![text.clone()]).collect();
    let mut behind = HashMap::new();
    for at in 1..texts.len() {
        let Some(name) = bits_asked(&texts[at]) else {
            continue;
        };
        let ways = Label::all_of(&texts[at]).filter_map(|label| placed.get(&label).copied());
        let read = ways.chain([at + 1]).any(|to| flow.reads(name, to));
        let Some((front, value)) = set_last(&texts[at - 1], name).filter(|_| !read) else {
            continue;
        };
        let others: Option<Vec<_>> = (jumps(at).into_iter())
            .map(|(from, count)| {
                let (way, _) = jump(&texts[from]).filter(|_| count == 1)?;
                if let Some(way) = way.strip_suffix(":GOTO ") {
                    let (front, value) = set_last(way, name)?;
                    return Some((from, front, value, from));
                }
                // A jump by itself, to which only the line before it leads.
                let before = from.checked_sub(1).filter(|_| way == "GOTO ")?;
                let (front, value) = set_last(texts.get(before)?, name)?;
                jumps(from)
                    .is_empty()
                    .then_some((before, front, value, from))
            })
            .collect();
        let Some(others) = others.filter(|all| all.len() <= 1) else {
            continue;
        };
        let asks = |value: &str| texts[at].replacen(name, value, 1);
        for (set, front, value, from) in others {
            let on = *behind.entry(at).or_insert_with(|| labels.next());
            changed[from] = vec![asks(value), format!("GOTO {on}")];
            match set == from {
                true => changed[from].insert(0, front.to_owned()),
                false => changed[set] = vec![front.to_owned()],
            }
        }
        changed[at - 1] = vec![front.to_owned()];
        changed[at] = vec![asks(value)];
    }
    let mut lines = lines.with_lines(changed, &behind);
    lines.remove_empty();
    lines
}

/// The int of which a test asks for some bits, and which it names once.
fn bits_asked(text: &str) -> Option<&str> {
    let test = Test::of(text)?;
    let (name, bits) = test.test.split_once(" AND ")?;
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '%';
    let lone = name.ends_with('%') && name.chars().all(plain);
    let number = !bits.is_empty() && bits.chars().all(|c| c.is_ascii_digit());
    (lone && number && text.matches(name).count() == 1).then_some(name)
}

/// What stands before the last of some statements, and the value that it gives an int;
/// a sum, since what binds less than AND would need brackets.
fn set_last<'t>(text: &'t str, name: &str) -> Option<(&'t str, &'t str)> {
    let (front, last) = text.rsplit_once(':').unwrap_or(("", text));
    let value = last.strip_prefix(name)?.strip_prefix('=')?;
    let binds = value.contains(['<', '>', '=']) || value.contains("AND") || value.contains("OR");
    (!binds && !text.contains("IF ")).then_some((front, value))
}

/// Two lines of which the first sets a flag last that the second asks for, where nobody
/// reads it behind that.
fn joined(before: &str, text: &str, reads: impl Fn(&str) -> bool) -> Option<(String, String)> {
    let test = Test::of(text)?;
    let (name, turned) = match test.test.strip_prefix("NOT ") {
        Some(name) => (name, true),
        None => (test.test, false),
    };
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '%';
    let flag = name.ends_with('%') && name.chars().all(plain);
    if !flag || [test.yes, test.no].iter().any(|way| way.contains(name)) {
        return None;
    }
    let (front, value) = match either(before, name) {
        Some(value) => (String::new(), value),
        None if before.contains("IF ") => return None,
        None => {
            let (front, last) = before.rsplit_once(':').unwrap_or(("", before));
            let value = last.strip_prefix(name)?.strip_prefix('=')?;
            (front.to_owned(), value.to_owned())
        }
    };
    // A number would be cut in bits by NOT.
    let compares = value.contains(['<', '>', '=']);
    if !compares || reads(name) {
        return None;
    }
    let value = match turned {
        false => value,
        true => opposite(&value).unwrap_or_else(|| format!("NOT ({value})")),
    };
    Some((front, text.replacen(test.test, &value, 1)))
}

/// The value of a flag that is a test where a condition holds, and its opposite where it
/// does not: whether both come out the same.
fn either(text: &str, name: &str) -> Option<String> {
    let test = Test::of(text)?;
    let value = |way: &str| Some(way.strip_prefix(name)?.strip_prefix('=')?.to_owned());
    let (yes, no) = (value(test.yes)?, value(test.no)?);
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '%';
    let flag = test.test.ends_with('%') && test.test.chars().all(plain);
    let alone = !yes.contains([':', ' ']) && opposite(&yes)? == no;
    (flag && alone).then(|| format!("{}=({yes})", test.test))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The lines `texts`, where `@n;` goes to the line number n, without tests that are known.
    fn written(texts: &[&str], copies: bool) -> String {
        let mut labels = Labels::default();
        let all: Vec<Label> = texts.iter().map(|_| labels.next()).collect();
        let mut lines = Lines::default();
        for (text, label) in texts.iter().zip(&all) {
            lines.place(*label);
            let mut text = (*text).to_owned();
            for (k, label) in all.iter().enumerate() {
                text = text.replace(&format!("@{k};"), &label.to_string());
            }
            lines.line(text, None);
        }
        let lines = super::super::dead::without(split(lines, &mut labels, copies));
        let mut lines = split(lines, &mut labels, false);
        lines.remove_empty();
        lines.finish().0
    }

    const FLAG: [&str; 10] = [
        "FOR x%=1 TO 9",
        "IF f% THEN a%=x>=0 ELSE a%=x<0",
        "IF a% THEN @5;",
        "y=x*2",
        "a%=FALSE",
        "z=x*x",
        "IF z<1 THEN @8;",
        "IF NOT a% THEN z=y",
        "PRINT z",
        "NEXT",
    ];

    #[test]
    fn a_way_has_a_copy_of_what_stands_before_a_known_test() {
        // The way where a% holds goes past the test; the other way needs no flag.
        let expected = "10FOR x%=1 TO 9\n20IF f%=(x>=0) THEN 50\n30y=x*2\n40GOTO 80\n\
            50z=x*x\n60IF z<1 THEN 110\n70GOTO 110\n80z=x*x\n90IF z<1 THEN 110\n\
            100z=y\n110PRINT z\n120NEXT\n";
        assert_eq!(written(&FLAG, true), expected);
    }

    #[test]
    fn without_memory_nothing_is_copied() {
        let text = written(&FLAG, false);
        assert!(text.contains("IF NOT a% THEN z=y"), "{text}");
        assert_eq!(text.matches("z=x*x").count(), 1, "{text}");
    }

    #[test]
    fn what_is_known_wherever_control_comes_from_is_not_asked() {
        let source = [
            "IF x<0 THEN a%=TRUE:GOTO @3;",
            "a%=y<1",
            "IF NOT a% THEN @6;",
            "IF a% THEN z=1",
            "PRINT z",
            "END",
            "z=2",
            "END",
        ];
        let expected = "10IF x<0 THEN 30\n20IF y>=1 THEN 60\n30z=1\n40PRINT z\n50END\n\
            60z=2\n70END\n";
        assert_eq!(written(&source, true), expected);
    }

    #[test]
    fn a_flag_that_is_read_later_is_kept() {
        let source = [
            "a%=x<1",
            "IF a% THEN @3;",
            "z=2",
            "PRINT z",
            "IF a% THEN z=1",
            "END",
        ];
        let text = written(&source, false);
        assert!(text.starts_with("10a%=x<1\n20IF a% THEN 40\n"), "{text}");
    }

    #[test]
    fn lowest_bits_are_asked_for_in_place() {
        let source = [
            "IF y<1 THEN @7;",
            "n%=INT(x)+INT(y)",
            "IF n% AND 1 THEN @5;",
            "z=2",
            "END",
            "z=1",
            "END",
            "n%=FNfloor(x)",
            "GOTO @2;",
        ];
        let expected = "10IF y<1 THEN 70\n20IF INT(x)+INT(y) AND 1 THEN 50\n30z=2\n40END\n\
            50z=1\n60END\n70IF FNfloor(x) AND 1 THEN 50\n80GOTO 30\n";
        assert_eq!(written(&source, false), expected);
        let mut read = source;
        read[3] = "z=n%";
        assert!(written(&read, false).contains("n%=INT(x)+INT(y)\n"));
    }

    #[test]
    fn opposites() {
        assert_eq!(opposite("a<b+1").as_deref(), Some("a>=b+1"));
        assert_eq!(opposite("NOT a%").as_deref(), Some("a%"));
        assert_eq!(opposite("a<>b").as_deref(), Some("a=b"));
        assert_eq!(opposite("a<b AND c"), None);
        assert_eq!(opposite("a%=(b<c)"), None);
    }
}
