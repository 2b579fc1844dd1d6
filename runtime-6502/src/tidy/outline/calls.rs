//! Calls of subroutines where sequences of instructions were.

use super::{Repeat, Step};
use rustc_hash::FxHashMap;
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
        *count += 1;
        let name = format!("shared{count}");
        bodies.extend(subroutine(&name, &repeat.body, lines));
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

/// A sequence as a subroutine; labels are called by it and by how many instructions stand
/// before them.
fn subroutine<T: Clone>(name: &str, body: &[Step], lines: &[(String, T)]) -> Vec<(String, T)> {
    let label = |k: usize| match k {
        0 => name.to_owned(),
        _ => format!("{name}_{k}"),
    };
    let mut made: Vec<(String, T)> = Vec::new();
    let Some((_, of)) = body.first().and_then(|step| lines.get(step.line)) else {
        return made;
    };
    let mut of = of.clone();
    for k in 0..=body.len() {
        if k == 0 || body.iter().any(|step| step.goes == Some(k)) {
            made.push((format!("{}:", label(k)), of.clone()));
        }
        let step = body.get(k);
        let Some((text, here)) = step.and_then(|step| lines.get(step.line)) else {
            continue;
        };
        of = here.clone();
        let code = text.split(';').next().unwrap_or(text).trim();
        let (branch, _) = code.split_once(' ').unwrap_or((code, ""));
        let said = match step.and_then(|step| step.goes) {
            Some(to) => format!("        {branch} {}", label(to)),
            None => format!("        {code}"),
        };
        made.push((said, of.clone()));
    }
    made.push(("        rts".to_owned(), of));
    made
}
