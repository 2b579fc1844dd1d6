//! Diagnostics as a terminal shows them, and as JSON.
//!
//! The compiler's places may lie in long texts, even in one line of a
//! megabyte, so only the lines around a place are handed to the renderer, and
//! of a very long line only a piece.

use crate::failure::Failure;
use crate::output::remark;
use annotate_snippets::{Annotation, AnnotationKind, Level, Origin, Renderer, Snippet};
use serde_json::{Value, json};
use slowlight_compiler::source::{Diagnostic, SourceFile, Sources, Span};
use std::fmt::Write;
use std::io::IsTerminal;
use std::ops::Range;
use std::process::ExitCode;

/// How many diagnostics are shown in full.
const SHOWN: usize = 20;
/// Bytes of a line on each side of a place that are handed to the renderer,
/// which shows as many of them as fit.
const SIDE: usize = 2000;
/// Lines between two places that are still shown in one piece.
const NEAR: usize = 200;

/// Prints diagnostics on standard error, errors first, in the order of their places.
pub fn print(sources: &Sources, diagnostics: &[Diagnostic]) {
    let stderr = std::io::stderr();
    let colour = stderr.is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|v| v.is_empty());
    let text = render(sources, diagnostics, colour);
    if let Some(lines) = text.strip_suffix('\n') {
        remark(lines);
    }
}

/// The diagnostics sorted: errors first, the user's files before the library's, by place.
pub fn sorted<'d>(sources: &Sources, diagnostics: &'d [Diagnostic]) -> Vec<&'d Diagnostic> {
    let mut all: Vec<&Diagnostic> = diagnostics.iter().collect();
    let library = |s: Span| sources.files.get(s.file as usize).is_none_or(|f| f.library);
    all.sort_by_key(|d| (!d.is_error(), library(d.span), d.span));
    all.dedup();
    all
}

/// The diagnostics as text.
pub fn render(sources: &Sources, diagnostics: &[Diagnostic], colour: bool) -> String {
    let renderer = if colour {
        Renderer::styled()
    } else {
        Renderer::plain()
    };
    let all = sorted(sources, diagnostics);
    let mut out = String::new();
    for d in all.iter().take(SHOWN) {
        out.push_str(&one(&renderer, sources, d));
        out.push_str("\n\n");
    }
    let errors = all.iter().filter(|d| d.is_error()).count();
    if all.len() > SHOWN {
        let _ = writeln!(out, "and {} more", all.len() - SHOWN);
    }
    if errors > 1 {
        let _ = writeln!(out, "{errors} errors");
    }
    out
}

/// A place cut out of its text.
struct Piece<'t> {
    text: &'t str,
    first_line: usize,
    /// Where the piece begins in the text.
    start: usize,
    /// Whether that is inside a line.
    line_cut: bool,
}

fn one(renderer: &Renderer, sources: &Sources, d: &Diagnostic) -> String {
    let level = if d.is_error() {
        Level::ERROR
    } else {
        Level::WARNING
    };
    let mut group = level
        .primary_title(d.message.as_str())
        .elements(std::iter::empty::<Snippet<'_, Annotation<'_>>>());
    // The places, those that lie close together in one piece.
    let primary = (d.span, AnnotationKind::Primary, d.label.as_str());
    let others = d
        .others
        .iter()
        .map(|o| (o.span, AnnotationKind::Context, o.text.as_str()));
    let mut left: Vec<(Span, AnnotationKind, &str)> =
        std::iter::once(primary).chain(others).collect();
    while let Some(&(first, ..)) = left.first() {
        let Some(file) = sources.files.get(first.file as usize) else {
            left.remove(0);
            continue;
        };
        let near = |s: Span| s.file == first.file && lines_between(file, first, s) <= NEAR;
        let (here, rest): (Vec<_>, Vec<_>) = left.into_iter().partition(|p| near(p.0));
        left = rest;
        let bounds = here.iter().fold(first.range(), |all, p| {
            all.start.min(p.0.range().start)..all.end.max(p.0.range().end)
        });
        let piece = cut(&file.text, bounds);
        let mut snippet = Snippet::source(piece.text).line_start(piece.first_line);
        if piece.line_cut {
            // The renderer would count columns from the cut.
            let (line, column) = sources.line_column(first);
            let origin = Origin::path(file.name.as_str());
            group = group.element(origin.line(line).char_column(column));
        } else {
            snippet = snippet.path(file.name.as_str());
        }
        for (span, kind, label) in here {
            let mut note = kind.span(inside(&piece, span.range()));
            if !label.is_empty() {
                note = note.label(label);
            }
            snippet = snippet.annotation(note);
        }
        group = group.element(snippet);
    }
    if let Some(help) = &d.help {
        group = group.element(Level::HELP.message(help.as_str()));
    }
    renderer.render(&[group])
}

fn lines_between(file: &SourceFile, a: Span, b: Span) -> usize {
    let (lo, hi) = (a.start.min(b.start) as usize, a.start.max(b.start) as usize);
    file.text
        .as_bytes()
        .get(lo..hi.min(file.text.len()))
        .map_or(0, |t| t.iter().filter(|&&c| c == b'\n').count())
}

/// The lines around a range, at most [`SIDE`] bytes of its first and last line
/// on either side.
fn cut(text: &str, range: Range<usize>) -> Piece<'_> {
    let from = floor(text, range.start);
    let to = floor(text, range.end.max(from));
    let before = text[..from].rfind('\n').map_or(0, |k| k + 1);
    let start = floor(text, before.max(from.saturating_sub(SIDE)));
    let line_end = text[to..].find('\n').map_or(text.len(), |k| to + k);
    let end = floor(text, line_end.min(to + SIDE));
    // A span over many bytes shows its beginning.
    let end = floor(text, end.min(start + 8 * SIDE));
    Piece {
        text: &text[start..end],
        first_line: text[..start].matches('\n').count() + 1,
        start,
        line_cut: start != before,
    }
}

/// The greatest boundary of characters that is not behind `at`.
fn floor(text: &str, at: usize) -> usize {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

fn inside(piece: &Piece<'_>, range: Range<usize>) -> Range<usize> {
    let start = floor(piece.text, range.start.saturating_sub(piece.start));
    let end = floor(piece.text, range.end.saturating_sub(piece.start));
    start..end.max(start)
}

/// The diagnostics as JSON: severity, message, file, line and column (from 1), label, help.
pub fn to_json(sources: &Sources, diagnostics: &[Diagnostic]) -> Value {
    let place = |span: Span| {
        let (line, column) = sources.line_column(span);
        let file = sources
            .files
            .get(span.file as usize)
            .map_or("", |f| f.name.as_str());
        (file.to_owned(), line, column)
    };
    let all = sorted(sources, diagnostics).into_iter().map(|d| {
        let (file, line, column) = place(d.span);
        let others: Vec<Value> = d
            .others
            .iter()
            .map(|o| {
                let (file, line, column) = place(o.span);
                json!({"file": file, "line": line, "column": column, "label": o.text})
            })
            .collect();
        json!({
            "severity": if d.is_error() { "error" } else { "warning" },
            "message": d.message,
            "file": file,
            "line": line,
            "column": column,
            "label": d.label,
            "others": others,
            "help": d.help,
        })
    });
    Value::Array(all.collect())
}

/// Says why a command stopped, on standard error; its exit status.
pub fn report(failure: &Failure) -> ExitCode {
    match failure {
        Failure::Scene(said) | Failure::Options(said) => print(&said.sources, &said.diagnostics),
        Failure::Wrong(message) | Failure::Usage(message) => remark(&format!("error: {message}")),
        Failure::TooLarge(large) => remark(&format!("error: {}", large.text)),
        Failure::Differs | Failure::Cases | Failure::Several(_) => {}
        Failure::Interrupted => remark("interrupted"),
    }
    ExitCode::from(failure.status())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(text: &str, at: &str) -> String {
        let mut sources = Sources::default();
        sources.add(SourceFile {
            name: "a.scn".to_owned(),
            text: text.to_owned(),
            library: false,
        });
        let start = text.find(at).unwrap_or(0);
        let span = Span::new(0, start, start + at.len());
        render(&sources, &[Diagnostic::error(span, "wrong")], false)
    }

    #[test]
    fn places_are_right_in_long_texts() {
        assert!(shown("x\ny here\n", "here").contains("a.scn:2:3"));
        let deep = "line\n".repeat(1000) + "here\n" + &"line\n".repeat(1000);
        assert!(shown(&deep, "here").contains("a.scn:1001:1"));
        let wide = "\u{e9}".repeat(100_000) + "here" + &"\u{e9}".repeat(100_000);
        let said = shown(&wide, "here");
        assert!(said.contains("a.scn:1:100001"), "{said}");
        assert!(said.len() < 2000, "{said}");
    }

    #[test]
    fn a_place_outside_its_text_is_no_panic() {
        let mut sources = Sources::default();
        let far = Diagnostic::error(Span::new(7, 10, 20), "nowhere").also(Span::new(0, 9, 9), "");
        assert!(render(&sources, std::slice::from_ref(&far), false).contains("nowhere"));
        sources.add(SourceFile {
            name: "a.scn".to_owned(),
            text: "\u{e9}".to_owned(),
            library: false,
        });
        assert!(render(&sources, &[far], false).contains("nowhere"));
    }
}
