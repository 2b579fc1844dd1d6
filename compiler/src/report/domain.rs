//! Divisions whose divisor may be 0, as the scene writes them.

use crate::analysis::range::{Slack, ranges};
use crate::ir::graph::*;
use crate::schedule::statements::schedule;
use crate::source::{Diagnostic, Label, Sources};
use slowlight_routine::Op;
use std::collections::BTreeSet;

/// Warnings for what a scene divides by although its range, refined by the
/// conditions around, holds 0. What the library divides by is its own affair:
/// it says what it makes of 0.
pub fn warnings(graph: &Graph, sources: &Sources) -> Vec<Diagnostic> {
    let found = ranges(graph, &schedule(graph), &Slack::exact());
    let mut places = BTreeSet::new();
    let mut said: Vec<(NodeId, Diagnostic)> = Vec::new();
    for id in graph.ids() {
        let Node::Apply(Op::Div | Op::IntDiv, [_, by]) = graph.node(id) else {
            continue;
        };
        let Some(&[_, range]) = found.args.get(id.0 as usize) else {
            continue;
        };
        // What no statement computes has every range, and nobody needs it.
        let bounded = range.lo.is_finite() && range.hi.is_finite();
        if !range.contains(0.0) || !bounded || graph.constant(by).is_some() {
            continue;
        }
        let span = graph.span(id);
        let file = sources.files.get(usize::from(span.file));
        let text = file.filter(|f| !f.library);
        let text = text.and_then(|f| f.text.get(span.start as usize..span.end as usize));
        if let Some(text) = text
            && let Some(divisor) = divisor(text)
            && places.insert(span)
        {
            // The same divisor again is the same trouble.
            if let Some((_, known)) = said.iter_mut().find(|(d, _)| *d == by) {
                known.others.push(Label {
                    span,
                    text: "and here".to_owned(),
                });
                continue;
            }
            let message = format!(
                "`{text}` may divide by zero: `{divisor}` {}",
                lies(range.lo, range.hi)
            );
            let help = format!(
                "guard it, `if {divisor} == 0 then .. else ..`, or give what it is made of a \
                 range without 0"
            );
            said.push((by, Diagnostic::warning(span, message).help(help)));
        }
    }
    said.into_iter().map(|(_, warning)| warning).collect()
}

/// Where a value lies, as far as that says anything.
fn lies(lo: f64, hi: f64) -> String {
    match lo.abs().max(hi.abs()) {
        far if far > 1e300 => "may be any number".to_owned(),
        _ => format!("lies in [{}, {}]", short(lo), short(hi)),
    }
}

/// A number to four digits, but whole ones that are not long in full.
fn short(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e6 {
        return format!("{value}");
    }
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    match rounded.abs() {
        size if (1e-3..1e6).contains(&size) => format!("{rounded}"),
        _ => format!("{rounded:e}"),
    }
}

/// What stands after the last `/` or `div` outside of brackets, if there is one.
fn divisor(text: &str) -> Option<&str> {
    let mut depth = 0;
    let mut from = None;
    for (at, c) in text.char_indices() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            '/' if depth == 0 => from = Some(at + 1),
            ' ' if depth == 0 && text[at..].starts_with(" div ") => from = Some(at + 5),
            _ => {}
        }
    }
    from.and_then(|at| text.get(at..)).map(str::trim)
}
