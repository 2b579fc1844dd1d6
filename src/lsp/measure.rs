//! What each line of a scene takes, measured beside the editing.
//!
//! `slowlight explain` itself does it, in a process of its own that is given the text as it is
//! in the editor: so the figures are its figures, and an edit ends it at once.

use crate::format::count;
use lsp_types::Uri;
use serde_json::Value;
use similar::{DiffOp, TextDiff};
use slowlight_compiler::targets::Target;
use std::collections::BTreeMap;
use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex};

/// What a line takes.
#[derive(Clone, Debug, PartialEq)]
pub struct Cost {
    /// The machine's cycles, and what share of all they are.
    pub cycles: u64,
    pub share: f64,
    /// How often the line runs, and what its values depend on.
    pub runs: u64,
    pub rate: String,
}

/// What was measured of a text.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// The text.
    pub text: String,
    /// The machine.
    pub target: &'static str,
    /// What it counts.
    pub unit: String,
    /// By line, from 1.
    pub lines: BTreeMap<usize, Cost>,
}

/// What a process found, of which work.
#[derive(Debug)]
pub struct Done {
    /// The work's number.
    pub work: u64,
    /// The scene.
    pub uri: Uri,
    /// What was measured, or why nothing was.
    pub found: Result<Measured, String>,
}

/// A process that measures.
pub struct Work {
    number: u64,
    uri: Uri,
    child: Arc<Mutex<Child>>,
}

impl Work {
    /// Begins to measure a text; what is found is told where it ends by itself.
    ///
    /// # Errors
    /// Where no process can be made.
    pub fn begin(
        number: u64,
        (uri, text): (&Uri, &str),
        dir: Option<&Path>,
        target: &'static Target,
        tell: impl FnOnce(Done) + Send + 'static,
    ) -> std::io::Result<Work> {
        let mut command = Command::new(std::env::current_exe()?);
        command
            .args(["explain", "-", "--json", "--target", target.name])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        if let Some(dir) = dir.filter(|dir| dir.is_dir()) {
            command.current_dir(dir);
        }
        let mut child = command.spawn()?;
        let pipes = (child.stdin.take(), child.stdout.take(), child.stderr.take());
        let child = Arc::new(Mutex::new(child));
        let (own, text, its) = (Arc::clone(&child), text.to_owned(), uri.clone());
        std::thread::spawn(move || {
            let (input, output, errors) = pipes;
            if let Some(mut input) = input {
                // One that has ended needs no text.
                let _ = input.write_all(text.as_bytes());
            }
            let errors = std::thread::spawn(move || read(errors));
            let said = read(output);
            let errors = errors.join().unwrap_or_default();
            let status = own.lock().ok().and_then(|mut child| child.wait().ok());
            let found = match status.is_some_and(|status| status.success()) {
                true => measured(text, target.name, &said),
                false => Err(errors),
            };
            tell(Done {
                work: number,
                uri: its,
                found,
            });
        });
        Ok(Work {
            number,
            uri: uri.clone(),
            child,
        })
    }

    /// Its number.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// The scene that it measures.
    pub fn uri(&self) -> &Uri {
        &self.uri
    }
}

/// What is no longer wanted ends.
impl Drop for Work {
    fn drop(&mut self) {
        if let Ok(mut child) = self.child.lock() {
            // One that has ended by itself is no matter.
            let _ = child.kill();
        }
    }
}

fn read(pipe: Option<impl Read>) -> String {
    let mut text = String::new();
    // What was read before an error is of use.
    pipe.map(|mut pipe| pipe.read_to_string(&mut text));
    text
}

/// Reads what `explain --json` says of the scene's own text.
fn measured(text: String, target: &'static str, said: &str) -> Result<Measured, String> {
    let said: Value =
        serde_json::from_str(said).map_err(|e| format!("explain said no JSON: {e}"))?;
    let own = |line: &&Value| line["file"] == "standard input";
    let lines = said["lines"].as_array().into_iter().flatten().filter(own);
    let lines = lines.filter_map(|line| {
        let rate = line["rate"].as_array().into_iter().flatten();
        let rate: Vec<&str> = rate.filter_map(Value::as_str).collect();
        let cost = Cost {
            cycles: line["cycles"].as_u64()?,
            share: line["share"].as_f64()?,
            runs: line["executions"].as_u64()?,
            rate: rate.join(", "),
        };
        Some((usize::try_from(line["line"].as_u64()?).ok()?, cost))
    });
    Ok(Measured {
        target,
        unit: said["unit"].as_str().unwrap_or("cycles").to_owned(),
        lines: lines.filter(|(_, cost)| cost.cycles > 0).collect(),
        text,
    })
}

impl Cost {
    /// In a few words behind a line; figures of another text than it is now are marked.
    pub fn label(&self, unit: &str, old: bool) -> String {
        let mark = if old { "old: " } else { "" };
        let share = 100.0 * self.share;
        format!("{mark}{} {unit}, {share:.1}%", count(self.cycles))
    }

    /// In full.
    pub fn tooltip(&self, target: &str, old: bool) -> String {
        let rate = match self.rate.is_empty() {
            true => String::new(),
            false => format!(", changes with: {}", self.rate),
        };
        let old = match old {
            true => "; measured before the last edits",
            false => "",
        };
        format!("on {target}: runs {} times{rate}{old}", count(self.runs))
    }
}

impl Measured {
    /// The costs by the lines of the text as it is now, from 0: lines that were edited have
    /// none.
    pub fn now(&self, text: &str) -> Vec<(usize, &Cost)> {
        if self.text == text {
            return self
                .lines
                .iter()
                .map(|(line, cost)| (line - 1, cost))
                .collect();
        }
        let diff = TextDiff::from_lines(self.text.as_str(), text);
        let mut found = Vec::new();
        for op in diff.ops() {
            if let DiffOp::Equal {
                old_index,
                new_index,
                len,
            } = *op
            {
                let kept = self.lines.range(old_index + 1..old_index + len + 1);
                found.extend(kept.map(|(line, cost)| (line - 1 - old_index + new_index, cost)));
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_go_with_their_lines() {
        let cost = |cycles| Cost {
            cycles,
            share: 0.5,
            runs: 1234,
            rate: "row".to_owned(),
        };
        let found = Measured {
            text: "a\nb\nc\n".to_owned(),
            target: "jack",
            unit: "cycles".to_owned(),
            lines: BTreeMap::from([(1, cost(1)), (2, cost(2)), (3, cost(3))]),
        };
        let now = |text| {
            let lines = found.now(text).into_iter();
            lines
                .map(|(line, cost)| (line, cost.cycles))
                .collect::<Vec<_>>()
        };
        assert_eq!(now("a\nb\nc\n"), [(0, 1), (1, 2), (2, 3)]);
        assert_eq!(now("new\na\nc\n"), [(1, 1), (2, 3)]);
        assert_eq!(now(""), []);
        assert_eq!(
            cost(1_234_567).label("cycles", true),
            "old: 1,234,567 cycles, 50.0%"
        );
        assert!(cost(1).tooltip("jack", false).contains("runs 1,234 times"));
    }
}
