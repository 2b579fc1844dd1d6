//! Divisions whose divisor may be 0, and ints that may leave a machine's, as the scene writes
//! them.

use crate::analysis::range::{Slack, ranges};
use crate::ir::graph::*;
use crate::schedule::statements::schedule;
use crate::source::{Diagnostic, Label, Sources, Span};
use crate::targets::Target;
use slowlight_routine::{Format, Op, Range};
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

/// A warning where sums and products of ints, as the scene writes them, may leave the ints of
/// a target that has fewer bits than the language; none where it has as many. What follows
/// from a value that has left them, or that no range was found of, is passed over.
pub fn int_warning(graph: &Graph, sources: &Sources, target: &Target) -> Option<Diagnostic> {
    let Format::Int { bits: bits @ ..32 } = target.runtime.int else {
        return None;
    };
    let slack = Slack::exact_with_ints_of(target.runtime);
    let (lo, hi) = (
        -f64::from(1u32 << (bits - 1)),
        f64::from((1u32 << (bits - 1)) - 1),
    );
    let found = ranges(graph, &schedule(graph), &slack);
    let leaves = |range: &Range| range.lo < lo || range.hi > hi;
    let mut said: Option<Diagnostic> = None;
    for id in graph.ids() {
        let Node::Apply(Op::IntAdd | Op::IntSub | Op::IntMul, _) = graph.node(id) else {
            continue;
        };
        let at = id.0 as usize;
        let (Some(exact), Some(args)) = (found.exact.get(at), found.args.get(at)) else {
            continue;
        };
        let known = |range: &Range| range.lo > lo && range.hi < hi;
        let span = graph.span(id);
        if !is_own(span, sources) || !leaves(exact) || !args.iter().all(known) {
            continue;
        }
        said = Some(match said {
            Some(said) if said.span == span => said,
            Some(said) => said.also(span, "and here"),
            None => {
                let message = format!(
                    "`{}` {}, and an int of {} has {bits} bits: it stops at {lo} and {hi}",
                    sources.text(span),
                    lies(exact.lo, exact.hi),
                    target.name
                );
                let help = "count in reals: `x * 1.0` in the place of an int `x`";
                Diagnostic::warning(span, message).help(help)
            }
        });
    }
    said
}

/// Warnings for tables that are smaller than the picture and have its columns or rows for
/// indices as they are: all beyond their end is their last entry.
pub fn clamped(graph: &Graph, sources: &Sources) -> Vec<Diagnostic> {
    let mut said: Vec<Diagnostic> = Vec::new();
    let axis = |id: NodeId| match graph.node(id) {
        Node::Axis(Axis::X) => Some(("x", graph.image.width)),
        Node::Axis(Axis::Y) => Some(("y", graph.image.height)),
        _ => None,
    };
    for id in graph.ids() {
        let Node::Lookup { table, column, row } = graph.node(id) else {
            continue;
        };
        let span = graph.span(id);
        let Some(table) = graph
            .tables
            .get(table.0 as usize)
            .filter(|_| is_own(span, sources))
        else {
            continue;
        };
        let sides = [
            (column, table.width, "columns"),
            (row, table.height, "rows"),
        ];
        let short = sides.into_iter().find_map(|(index, side, what)| {
            let (name, most) = axis(index)?;
            (most > side && side > 1).then_some((name, most, side, what))
        });
        if let Some((name, most, side, what)) = short
            && said.iter().all(|d| d.span != span)
        {
            let message = format!(
                "this table has {side} {what}, and {name} goes up to {}: all beyond them look \
                 like the last",
                most - 1
            );
            let help = format!("let it begin again: `{name} mod {side}`");
            said.push(Diagnostic::warning(span, message).help(help));
        }
    }
    said
}

/// Whether the scene's author wrote what stands there, not the library's.
fn is_own(span: Span, sources: &Sources) -> bool {
    let file = sources.files.get(usize::from(span.file));
    file.is_some_and(|file| !file.library) && span.called().is_none()
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
