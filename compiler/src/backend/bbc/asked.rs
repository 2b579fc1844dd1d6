//! What is asked for where it is computed.
//!
//! A flag that the next line asks for, and nobody else, is the test itself, and an int of
//! which only the lowest bits are asked for stands in the question's place.

use super::dead::Flow;
use super::lines::jump;
use super::lines::{Label, Labels, Lines};
use super::test_line::Test;
use super::test_line::opposite;
use rustc_hash::FxHashMap;

/// The lines with an int that is set only for its lowest bits to be asked for in the
/// question's place. A way that sets it elsewhere, rarely, asks for itself.
pub fn in_place(lines: Lines, labels: &mut Labels) -> Lines {
    let texts: Vec<String> = lines.texts().map(str::to_owned).collect();
    let placed: FxHashMap<Label, usize> = lines.labelled().collect();
    let flow = Flow::of(&texts, &placed);
    let jumps = |to: usize| {
        let leads =
            move |label: &Label, placed: &FxHashMap<Label, usize>| placed.get(label) == Some(&to);
        let count = |text: &String| Label::all_of(text).filter(|l| leads(l, &placed)).count();
        let each = texts.iter().map(count).enumerate();
        each.filter(|(_, count)| *count > 0).collect::<Vec<_>>()
    };
    let mut changed: Vec<Vec<String>> = texts.iter().map(|text| vec![text.clone()]).collect();
    let mut behind = FxHashMap::default();
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
pub fn joined(before: &str, text: &str, reads: impl Fn(&str) -> bool) -> Option<(String, String)> {
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
    let of = value.strip_prefix("NOT ").unwrap_or(&value);
    let other = of != "TRUE" && of != "FALSE" && of.ends_with('%') && of.chars().all(plain);
    if !(compares || other) || reads(name) {
        return None;
    }
    let value = match turned {
        false => value,
        true => opposite(&value).unwrap_or_else(|| format!("NOT ({value})")),
    };
    Some((front, text.replacen(test.test, &value, 1)))
}

/// A flag that is a test where another holds, and its opposite where it does not, as one
/// statement: whether both come out the same.
pub fn same_either_way(text: &str) -> Option<String> {
    let name = Test::of(text)?.yes.split_once('=')?.0;
    Some(format!("{name}={}", either(text, name)?))
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
