//! Lines as a post: joined, with numbers only where these make it shorter.

use super::super::lines::{Lines, MARK};
use super::encode::{Letters, encoded, token};
use crate::source::Span;
use std::collections::{BTreeMap, BTreeSet};

/// The longest text of a line.
const LONGEST: usize = 251;

/// A line of the post.
struct Row {
    text: String,
    span: Option<Span>,
    /// The labels before it that are asked for.
    labels: Vec<String>,
    /// Whether nothing may be joined behind it.
    ends: bool,
}

/// The text of a post, and where its lines come from.
pub fn posted(lines: &Lines, strings: &[Option<Vec<u8>>]) -> (String, Vec<Option<Span>>) {
    let rows = joined(lines, strings);
    let numbered = |numbers: bool| {
        let number = |at: usize| match numbers {
            true => at.to_string(),
            false => (10 * (at + 1)).to_string(),
        };
        let mut labels: BTreeMap<&str, String> = BTreeMap::new();
        for (at, row) in rows.iter().enumerate() {
            labels.extend(row.labels.iter().map(|label| (label.as_str(), number(at))));
        }
        let texts = rows.iter().enumerate().map(|(at, row)| {
            let first = if numbers { number(at) } else { String::new() };
            let parts = row.text.split(MARK).enumerate();
            let put = parts.map(|(k, part)| match k % 2 {
                0 => part,
                _ => labels.get(part).map_or("0", String::as_str),
            });
            first + &put.collect::<String>()
        });
        texts.collect::<Vec<String>>().join("\n")
    };
    let text = [numbered(false), numbered(true)]
        .into_iter()
        .min_by_key(|text| text.chars().count());
    (
        text.unwrap_or_default(),
        rows.iter().map(|row| row.span).collect(),
    )
}

/// As few lines as their meaning allows.
fn joined(lines: &Lines, strings: &[Option<Vec<u8>>]) -> Vec<Row> {
    let letters = Letters::of(lines.texts());
    let asked: BTreeSet<String> = (lines.texts())
        .flat_map(|text| text.split(MARK).skip(1).step_by(2))
        .map(str::to_owned)
        .collect();
    let mut labels: BTreeMap<usize, Vec<String>> = BTreeMap::new();
    for (label, at) in lines.labelled() {
        let name = label.to_string().trim_matches(MARK).to_owned();
        if asked.contains(&name) {
            labels.entry(at).or_default().push(name);
        }
    }
    let of = |name| token(name).unwrap_or_default();
    let (test, data, def, rem) = (of("IF"), of("DATA"), of("DEF"), of("REM"));
    let mut rows: Vec<Row> = Vec::new();
    let texts = lines.texts().zip(lines.spans()).enumerate();
    for (at, (text, span)) in texts {
        let text = encoded(text, &letters, strings);
        let labels = labels.remove(&at).unwrap_or_default();
        let begins = text.starts_with([data, def]);
        if let Some(last) = rows.last_mut()
            && labels.is_empty()
            && !last.ends
            && !begins
            && last.text.chars().count() + 1 + text.chars().count() <= LONGEST
        {
            join(&mut last.text, &text);
            last.ends = text.contains([test, data, rem]);
            continue;
        }
        rows.push(Row {
            ends: text.contains([test, data, rem]),
            text,
            span,
            labels,
        });
    }
    // What a label stands behind all lines for.
    if let Some(labels) = labels.remove(&lines.texts().count()) {
        rows.push(Row {
            text: of("END").to_string(),
            span: None,
            labels,
            ends: false,
        });
    }
    without_end(&mut rows, of("END"));
    rows
}

/// Leaves out an END that nothing but DATA stands behind.
fn without_end(rows: &mut [Row], end: char) {
    let data = token("DATA").unwrap_or_default();
    let last = rows
        .iter_mut()
        .rev()
        .find(|row| !row.text.starts_with(data));
    if let Some(row) = last
        && let Some(text) = row.text.strip_suffix(end)
        && let Some(text) = text.strip_suffix(':')
    {
        row.text = text.to_owned();
    }
}

/// Joins a line's statements to another's. Loops that end at the same place share a NEXT, and
/// what is sent to the screen a VDU.
fn join(line: &mut String, more: &str) {
    let of = |name| token(name).unwrap_or_default();
    let (next, vdu) = (of("NEXT"), of("VDU"));
    let last = line.rsplit(':').next().unwrap_or_default();
    if let Some(rest) = more.strip_prefix(next)
        && last
            .strip_prefix(next)
            .is_some_and(|of| of.chars().all(|c| c.is_ascii_alphanumeric() || c == ','))
    {
        line.push(',');
        line.push_str(rest);
        return;
    }
    if let Some(rest) = more.strip_prefix(vdu)
        && last.starts_with(vdu)
        && last.ends_with(';')
    {
        line.push_str(rest);
        return;
    }
    line.push(':');
    line.push_str(more);
}
