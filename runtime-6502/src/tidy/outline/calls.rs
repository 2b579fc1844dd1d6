//! Calls of subroutines where sequences of instructions were.

use super::{Repeat, Step};
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;
use std::ops::Range;

/// Puts calls where the sequences were, and these once behind the program's own lines. Remarks
/// stay where the calls are, and so do labels before and behind.
pub(super) fn replace<T: Clone>(
    lines: &mut Vec<(String, T)>,
    own: &Range<usize>,
    found: &[Repeat],
    count: &mut usize,
) {
    let behind = lines.split_off(own.end);
    let mut calls = FxHashMap::default();
    let mut bodies = Vec::new();
    for repeat in found {
        let name = fresh(CALLED, count);
        bodies.extend(subroutine(&name, &repeat.body, lines, count));
        calls.extend((repeat.places.iter()).map(|of| (of.start, (of.end, name.clone()))));
    }
    let all = std::mem::take(lines);
    let mut within = 0..0;
    for (k, (text, of)) in all.into_iter().enumerate() {
        if let Some((end, name)) = calls.get(&k) {
            within = k..*end;
            lines.push((format!("        jsr {name}"), of.clone()));
        }
        if !within.contains(&k) || is_silent(&text) {
            lines.push((text, of));
        }
    }
    lines.extend(bodies);
    lines.extend(behind);
}

/// Whether a line is a remark, or says what a name stands for.
fn is_silent(text: &str) -> bool {
    let code = text.split(';').next().unwrap_or(text).trim_end();
    code.is_empty() || code.contains(" = ")
}

/// The words of subroutines' labels, and of those within them.
pub const CALLED: &str = "shared";
pub const WITHIN: &str = "within";

/// A label as all that are numbered: a word and a number, which no value is called by.
fn fresh(word: &str, count: &mut usize) -> String {
    *count += 1;
    format!("{word}{count}")
}

/// A sequence as a subroutine.
fn subroutine<T: Clone>(
    name: &str,
    body: &[Step],
    lines: &[(String, T)],
    count: &mut usize,
) -> Vec<(String, T)> {
    let mut labels: BTreeMap<usize, String> = (body.iter())
        .filter_map(|step| step.goes.filter(|to| *to > 0))
        .map(|to| (to, String::new()))
        .collect();
    for label in labels.values_mut() {
        *label = fresh(WITHIN, count);
    }
    labels.insert(0, name.to_owned());
    let mut made: Vec<(String, T)> = Vec::new();
    let Some((_, of)) = body.first().and_then(|step| lines.get(step.line)) else {
        return made;
    };
    let mut of = of.clone();
    for k in 0..=body.len() {
        if let Some(label) = labels.get(&k) {
            made.push((format!("{label}:"), of.clone()));
        }
        let step = body.get(k);
        let Some((text, here)) = step.and_then(|step| lines.get(step.line)) else {
            continue;
        };
        of = here.clone();
        let code = text.split(';').next().unwrap_or(text).trim();
        let (branch, _) = code.split_once(' ').unwrap_or((code, ""));
        let said = match step.and_then(|step| labels.get(&step.goes?)) {
            Some(label) => format!("        {branch} {label}"),
            None => format!("        {code}"),
        };
        made.push((said, of.clone()));
    }
    made.push(("        rts".to_owned(), of));
    made
}
