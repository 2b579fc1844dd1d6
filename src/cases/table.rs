//! The results as a table, and as JSON.

use super::trial::{Row, Rows};
use serde_json::{Value as Json, json};
use std::collections::BTreeMap;
use std::fmt::Write;

/// Passed, of how many, and the worst error over its bound.
#[derive(Clone, Copy, Debug, Default)]
struct Cell {
    passed: usize,
    refused: usize,
    of: usize,
    worst: f64,
}

impl Cell {
    fn add(&mut self, row: &Row) {
        self.of += 1;
        self.passed += usize::from(row.verdict.passed);
        self.refused += usize::from(row.verdict.refused && row.verdict.passed);
        self.worst = self.worst.max(row.verdict.worst);
    }

    fn text(self) -> String {
        if self.of == 0 {
            return "-".to_owned();
        }
        let refused = match self.refused {
            0 => String::new(),
            n => format!(" ({n} refused)"),
        };
        let worst = match self.worst {
            w if w >= 1000.0 => format!("{w:.0e}"),
            w if w >= 10.0 => format!("{w:.0}"),
            w => format!("{w:.2}"),
        };
        format!("{}/{}{refused} {worst}", self.passed, self.of)
    }
}

/// Family by format and machine, as a table in Markdown; and what did not pass.
pub fn text(found: &Rows) -> String {
    let mut columns: Vec<String> = Vec::new();
    let mut families: Vec<&str> = Vec::new();
    let mut cells: BTreeMap<(usize, usize), Cell> = BTreeMap::new();
    for row in &found.rows {
        let name = format!("{} {}", row.way.format(), row.way.place());
        let column = place(&mut columns, name);
        let family = place(&mut families, row.family.as_str());
        cells.entry((family, column)).or_default().add(row);
        cells.entry((usize::MAX, column)).or_default().add(row);
    }
    let mut lines = vec![vec!["family".to_owned()]];
    lines[0].extend(columns.iter().cloned());
    let line = |name: &str, at: usize| {
        let texts = (0..columns.len()).map(|c| cells.get(&(at, c)).copied().unwrap_or_default());
        let mut line = vec![name.to_owned()];
        line.extend(texts.map(Cell::text));
        line
    };
    for (k, name) in families.iter().enumerate() {
        lines.push(line(name, k));
    }
    lines.push(line("all", usize::MAX));
    let mut text = aligned(&lines);
    let failed = found.rows.iter().filter(|r| !r.verdict.passed);
    for row in failed {
        let why = row.failure.clone().unwrap_or_else(|| got_text(row));
        let way = format!("{} {}", row.way.format(), row.way.place());
        let _ = writeln!(text, "{way}: {} does not pass: {why}", row.id);
    }
    text
}

fn place<T: PartialEq>(all: &mut Vec<T>, one: T) -> usize {
    match all.iter().position(|x| *x == one) {
        Some(at) => at,
        None => {
            all.push(one);
            all.len() - 1
        }
    }
}

fn aligned(lines: &[Vec<String>]) -> String {
    let columns = lines.first().map_or(0, Vec::len);
    let wide = |c: usize| lines.iter().filter_map(|l| l.get(c)).map(String::len).max();
    let widths: Vec<usize> = (0..columns).map(|c| wide(c).unwrap_or(0)).collect();
    let mut text = String::new();
    for (k, line) in lines.iter().enumerate() {
        let cells = line.iter().zip(&widths);
        let cells: Vec<String> = cells.map(|(t, w)| format!("{t:w$}")).collect();
        let _ = writeln!(text, "| {} |", cells.join(" | "));
        if k == 0 {
            let rules: Vec<String> = widths.iter().map(|w| "-".repeat(*w)).collect();
            let _ = writeln!(text, "| {} |", rules.join(" | "));
        }
    }
    text
}

fn got_text(row: &Row) -> String {
    let mut text = match row.got.there {
        false => "nothing".to_owned(),
        true => {
            let values: Vec<String> = row.got.values.iter().map(|v| format!("{v:?}")).collect();
            values.join(", ")
        }
    };
    if row.verdict.worst > 0.0 {
        let _ = write!(text, ", {:.3} of the bound", row.verdict.worst);
    }
    if let Some(left) = &row.got.left {
        let _ = write!(text, "; {left}");
    }
    text
}

/// The object of `check --cases --json`.
pub fn to_json(found: &Rows) -> Json {
    let cases: Vec<Json> = found.rows.iter().map(case).collect();
    json!({
        "count": found.rows.len(),
        "passed": found.rows.iter().filter(|r| r.verdict.passed).count(),
        "skipped": found.skipped,
        "cases": cases,
    })
}

fn case(row: &Row) -> Json {
    let got = match (row.got.there, &row.failure) {
        (_, Some(_)) | (false, _) => Json::Null,
        // A list of cells is longer than the list of outputs.
        (true, None) if row.got.values.len() > row.outputs.len() => {
            let name = row.outputs.first().cloned().unwrap_or_default();
            let cells: Vec<&[f64]> = row.got.values.chunks(2).collect();
            json!({ name: cells })
        }
        (true, None) => {
            let pairs = row.outputs.iter().cloned().zip(&row.got.values);
            pairs.map(|(name, value)| (name, json!(value))).collect()
        }
    };
    json!({
        "id": row.id,
        "family": row.family,
        "format": row.way.format(),
        "target": row.way.place(),
        "got": got,
        "bound": row.verdict.bound,
        "error_over_bound": row.verdict.worst,
        "refused": row.verdict.refused.then(|| row.got.left.clone()).flatten(),
        "failure": row.failure,
        "passed": row.verdict.passed,
    })
}
