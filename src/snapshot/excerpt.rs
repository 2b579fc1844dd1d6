//! Generated sources as a snapshot keeps them: whole, or as a digest and what a reader
//! looks at first.

use crate::digest;
use slowlight_compiler::plan::{ParamPlan, Plan};
use std::ops::Range;

/// Lines from the top of the scene's own source.
const TOP: usize = 40;

/// A source with all of its lines.
pub fn whole(name: &str, text: &str) -> String {
    let end = if text.ends_with('\n') || text.is_empty() {
        ""
    } else {
        "\n"
    };
    format!("==> {name} <==\n{text}{end}")
}

/// Size and digest of a source; of the scene's own also its first lines and the parameter
/// block. What a runtime brings is not the scene's.
pub fn excerpt(name: &str, text: &str, plan: &Plan) -> String {
    let lines: Vec<&str> = text.lines().collect();
    let count = lines.len();
    let sha = digest::bytes(text.as_bytes());
    let mut out = format!(
        "==> {name} <==\nsha256: {sha}\nlines: {count}, bytes: {}\n",
        text.len()
    );
    if !is_scenes(name, plan) {
        return out;
    }
    let mut shown = 0;
    for part in [Some(0..TOP.min(count)), block(&lines, &plan.params)]
        .into_iter()
        .flatten()
    {
        let part = part.start.max(shown)..part.end.max(shown);
        out += &left_out(part.start - shown);
        for line in lines.get(part.clone()).unwrap_or_default() {
            out += line;
            out.push('\n');
        }
        shown = part.end;
    }
    out + &left_out(count - shown)
}

/// Whether a source is named after the scene, as that is named in generated text.
fn is_scenes(name: &str, plan: &Plan) -> bool {
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let plain = |text: &str| {
        let kept = text.chars().filter(char::is_ascii_alphanumeric);
        kept.collect::<String>().to_ascii_lowercase()
    };
    plain(stem) == plain(&plan.name)
}

/// The lines that give the params their values.
fn block(lines: &[&str], params: &[ParamPlan]) -> Option<Range<usize>> {
    let plain = |line: &str| {
        let kept = line.chars().filter(|c| !c.is_whitespace());
        kept.collect::<String>().to_ascii_lowercase()
    };
    let wanted: Vec<String> = (params.iter())
        .map(|p| format!("{}={}", p.label.to_ascii_lowercase(), p.text))
        .collect();
    let found = lines.iter().enumerate().filter(|(_, line)| {
        let line = plain(line);
        wanted.iter().any(|w| line.contains(w.as_str()))
    });
    let found: Vec<usize> = found.map(|(k, _)| k).take(params.len()).collect();
    Some(*found.first()?..found.last()? + 1)
}

fn left_out(lines: usize) -> String {
    match lines {
        0 => String::new(),
        1 => "[1 line more]\n".to_owned(),
        n => format!("[{n} lines more]\n"),
    }
}
