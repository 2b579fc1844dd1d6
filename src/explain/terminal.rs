//! A profile as annotated source, with bars for heat.

use super::Explained;
use crate::draw::Window;
use crate::format::count;
use slowlight_compiler::report::profile::{Part, SourceLine};

/// Characters of a full bar, which is the dearest line's.
const BAR: usize = 8;
/// Parts of a line are told from this share of all cycles on.
const TOLD: f64 = 0.01;
/// So many parts at most.
const PARTS: usize = 4;

/// The whole text.
pub fn text(found: &Explained) -> String {
    let mut out = head(found);
    let most = found.profile.lines.iter().map(|line| line.cycles).max();
    for (file, name, source) in found.files() {
        let mut rows = Vec::new();
        for (number, text) in (1..).zip(source.lines()) {
            let line = found.line(file, number);
            rows.push((cells(found, line, most.unwrap_or(0)), number, text));
        }
        if rows.iter().all(|(cells, ..)| cells.is_none()) {
            continue;
        }
        out.push_str(&format!("\n{name}\n"));
        out.push_str(&annotated(found, file, rows));
    }
    out.push_str(&foot(found));
    out
}

fn head(found: &Explained) -> String {
    let plan = &found.plan;
    let window = Window::of(plan);
    let mode = match plan.mode.name {
        "" => String::new(),
        name => format!(" in mode {name}"),
    };
    format!(
        "{} on {}{mode}, {}: rows {} to {}, {} pixels, {} {}\n",
        found.scene.name,
        plan.target.name,
        plan.runtime.format,
        window.rows.0,
        window.rows.1,
        count(u64::from(window.width()) * u64::from(window.height())),
        count(found.run.cycles),
        found.unit()
    )
}

const COLUMNS: [&str; 7] = ["share", "", "cycles", "runs", "size", "error", "rate"];

/// A line's cells; none where it took nothing.
fn cells(found: &Explained, line: Option<&SourceLine>, most: u64) -> Option<[String; 7]> {
    let line = line?;
    Some([
        percent(found.share(line.cycles)),
        bar(line.cycles, most),
        count(line.cycles),
        count(line.executions),
        count(line.size),
        found
            .error(line)
            .map_or(String::new(), |e| percent(e.share)),
        rate(line),
    ])
}

/// A share in percent.
pub fn percent(share: f64) -> String {
    format!("{:.1}%", 100.0 * share)
}

/// What a line's values depend on, in a word or two.
pub fn rate(line: &SourceLine) -> String {
    let has = |name| line.rate.contains(&name);
    let place = match (has("row"), has("column") || has("pass")) {
        (true, true) => "pixel",
        (true, false) => "row",
        (false, true) if !has("column") => "pass",
        (false, true) => "column",
        (false, false) => "",
    };
    match (has("loop"), place) {
        (true, "") => "loop".to_owned(),
        (true, place) => format!("{place}, loop"),
        (false, "") if has("param") => "picture".to_owned(),
        (false, place) => place.to_owned(),
    }
}

/// A bar of eighths of characters.
fn bar(part: u64, most: u64) -> String {
    let eighths = (8 * BAR as u64 * part).div_ceil(most.max(1)) as usize;
    let full = "█".repeat(eighths / 8);
    let rest = ["", "▏", "▎", "▍", "▌", "▋", "▊", "▉"];
    full + rest.get(eighths % 8).copied().unwrap_or("")
}

type Row<'s> = (Option<[String; 7]>, usize, &'s str);

/// Rows with their columns aligned, each line's parts below it.
fn annotated(found: &Explained, file: u16, rows: Vec<Row<'_>>) -> String {
    let mut widths = COLUMNS.map(|name| name.chars().count());
    widths[1] = BAR;
    for (cells, ..) in &rows {
        for (width, cell) in widths.iter_mut().zip(cells.iter().flatten()) {
            *width = (*width).max(cell.chars().count());
        }
    }
    let padded = |cells: [&str; 7]| {
        let mut out = String::new();
        for (k, (cell, width)) in cells.iter().zip(widths).enumerate() {
            let pad = " ".repeat(width.saturating_sub(cell.chars().count()));
            match k {
                1 | 6 => out.push_str(&format!("{cell}{pad}  ")),
                _ => out.push_str(&format!("{pad}{cell}  ")),
            }
        }
        out
    };
    let digits = rows.len().to_string().len();
    let mut out = padded(COLUMNS).trim_end().to_owned() + "\n";
    let indent = " ".repeat(padded([""; 7]).chars().count() + digits);
    for (cells, number, text) in rows {
        let blank = Default::default();
        let cells = cells
            .as_ref()
            .unwrap_or(&blank)
            .each_ref()
            .map(String::as_str);
        let line = format!("{}{number:>digits$} | {text}", padded(cells));
        out.push_str(line.trim_end());
        out.push('\n');
        if let Some(line) = found.line(file, number) {
            for part in told(found, line) {
                out.push_str(&format!("{indent} :   {part}\n"));
            }
        }
    }
    out
}

/// The parts of a line that are worth telling.
fn told(found: &Explained, line: &SourceLine) -> Vec<String> {
    let text = |part: &Part| {
        let times = match part.times {
            0 => String::new(),
            n => format!(", {} times", count(n)),
        };
        format!("{} {}{times}", percent(found.share(part.cycles)), part.name)
    };
    let some = |parts: &[Part]| -> Vec<String> {
        let dear = parts.iter().filter(|p| found.share(p.cycles) >= TOLD);
        dear.take(PARTS).map(text).collect()
    };
    let mut all = some(&line.parts);
    all.extend(
        some(&line.within)
            .into_iter()
            .map(|text| format!("{text} (library)")),
    );
    all
}

fn foot(found: &Explained) -> String {
    let profile = &found.profile;
    let charged: u64 = profile.lines.iter().map(|line| line.cycles).sum();
    format!(
        "\n{} of {} {} are accounted for by line ({}); {} {} are of routines, tables and set-up\n",
        count(charged),
        count(profile.cycles),
        found.unit(),
        percent(found.share(charged)),
        count(profile.rest_size),
        found.size_unit(),
    ) + &errors(found)
}

/// What errors are of.
fn errors(found: &Explained) -> String {
    let errors = &found.errors;
    format!(
        "the error of {} pixels is {:.2e} in rmse, {} inks are not native's; a line's error is what \
         share of the mean square goes where its values are f64\n",
        count(errors.pixels as u64),
        errors.rmse,
        count(errors.differ as u64)
    )
}
