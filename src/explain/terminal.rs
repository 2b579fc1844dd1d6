//! A profile as annotated source, with bars for heat.

use super::Explained;
use crate::draw::Window;
use crate::format::count;
use crate::sheet::{self, Line};
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
    for (name, lines, _) in annotated_files(found, BAR) {
        out.push_str(&format!("\n{name}\n"));
        for line in lines {
            out.push_str(&line.text);
            out.push('\n');
        }
    }
    out.push_str(&foot(found));
    out.push_str(LEGEND);
    out.push_str(&why(found));
    out
}

/// What the columns mean.
const LEGEND: &str = "share: of all cycles; runs: how often the line's code was begun; size: of its code \
                      alone; error: its part of how far the shades are off;\nrate: how often its values \
                      change (docs/explain.md)\n";

/// What lines' plans could not do, the dearest line first, if that was asked.
fn why(found: &Explained) -> String {
    let Some(all) = &found.why else {
        return String::new();
    };
    if all.is_empty() {
        return "\nno line would be cheaper by a range, a bound or a constant that was tried\n"
            .to_owned();
    }
    let told = super::told::told(found).into_iter().map(|told| {
        let (places, share) = (
            places(found, &told.lines),
            percent(found.share(told.cycles)),
        );
        let spared = spared(found, told.saves, told.cycles);
        format!("{places} ({share}): {} {spared}\n", told.head)
    });
    "\nwhat lines could not do, the dearest first\n".to_owned() + &told.collect::<String>()
}

/// The end of a sentence: how many of some lines' cycles, and of all, something spares.
pub fn spared(found: &Explained, saves: u64, cycles: u64) -> String {
    format!(
        "would spare {} of these {} {} ({} of all)",
        count(saves),
        count(cycles),
        found.unit(),
        percent(found.share(saves)),
    )
}

/// `line 12` or `lines 7, 9 and 12`, with their files where the scene has several.
pub fn places(found: &Explained, lines: &[&SourceLine]) -> String {
    let of_file = |lines: &[&SourceLine]| match lines {
        [] => String::new(),
        [line] => place(found, line),
        [before @ .., last] => {
            let numbers: Vec<String> = before.iter().map(|l| l.line.to_string()).collect();
            let end = place(found, last);
            let file = end.strip_suffix(&format!("line {}", last.line));
            let file = file.unwrap_or_default();
            format!("{file}lines {} and {}", numbers.join(", "), last.line)
        }
    };
    let files = lines.chunk_by(|a, b| a.file == b.file).map(of_file);
    files.collect::<Vec<String>>().join("; ")
}

/// `line 12`, with its file where the scene has several.
pub fn place(found: &Explained, line: &SourceLine) -> String {
    let file = found.files().find(|(k, ..)| *k == line.file);
    match file.filter(|_| found.files().count() > 1) {
        Some((_, name, _)) => format!("{name}, line {}", line.line),
        None => format!("line {}", line.line),
    }
}

/// The same as a picture, whose bars stand behind the source's lines.
pub fn svg(found: &Explained) -> String {
    let files = annotated_files(found, 0);
    let head = head(found);
    let mut lines = vec![Line::plain(&head)];
    let mut from = 0;
    for (name, of_file, source) in files {
        lines.extend([Line::plain(""), Line::plain(name)]);
        lines.extend(of_file);
        from = source.max(from);
    }
    lines.extend(foot(found).lines().map(Line::plain));
    sheet::svg(head.trim_end(), &lines, from)
}

/// Each file that takes anything: its name, its lines, and the column at which its source
/// begins. Bars of characters are so long at most.
fn annotated_files(found: &Explained, bar: usize) -> Vec<(&str, Vec<Line>, usize)> {
    let most = found.profile.lines.iter().map(|line| line.cycles).max();
    let most = most.unwrap_or(0);
    let mut files = Vec::new();
    for (file, name, source) in found.files() {
        let mut rows = Vec::new();
        for (number, text) in (1..).zip(source.lines()) {
            let line = found.line(file, number);
            rows.push((cells(found, line, most, bar), number, text));
        }
        if rows.iter().any(|(cells, ..)| cells.is_some()) {
            let (lines, from) = annotated(found, file, rows, (bar, most));
            files.push((name, lines, from));
        }
    }
    files
}

fn head(found: &Explained) -> String {
    let plan = &found.plan;
    let window = Window::on_screen(plan);
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
fn cells(
    found: &Explained,
    line: Option<&SourceLine>,
    most: u64,
    wide: usize,
) -> Option<[String; 7]> {
    let line = line?;
    Some([
        percent(found.share(line.cycles)),
        bar(line.cycles, most, wide),
        count(line.cycles),
        count(line.executions),
        count(line.size),
        found.error(line).map_or(String::new(), |e| error(e.share)),
        rate(line),
    ])
}

/// A share in percent.
pub fn percent(share: f64) -> String {
    format!("{:.1}%", 100.0 * share)
}

/// A line's share of the error, in percent; a word where the error is no smaller without it,
/// as errors cancel.
pub fn error(share: f64) -> String {
    match share < -0.0005 {
        true => "cancels".to_owned(),
        false => percent(share.max(0.0)),
    }
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

/// A bar of eighths of characters, so many characters at most.
fn bar(part: u64, most: u64, wide: usize) -> String {
    let eighths = (8 * wide as u64 * part).div_ceil(most.max(1)) as usize;
    let full = "█".repeat(eighths / 8);
    let rest = ["", "▏", "▎", "▍", "▌", "▋", "▊", "▉"];
    full + rest.get(eighths % 8).copied().unwrap_or("")
}

type Row<'s> = (Option<[String; 7]>, usize, &'s str);

/// Rows with their columns aligned, each line's parts below it, and the column at which the
/// source begins.
fn annotated(
    found: &Explained,
    file: u16,
    rows: Vec<Row<'_>>,
    (bar, most): (usize, u64),
) -> (Vec<Line>, usize) {
    let mut widths = COLUMNS.map(|name| name.chars().count());
    widths[1] = bar;
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
    let mut out = vec![Line::plain(padded(COLUMNS).trim_end())];
    let indent = " ".repeat(padded([""; 7]).chars().count() + digits);
    for (cells, number, text) in rows {
        let blank = Default::default();
        let cells = cells
            .as_ref()
            .unwrap_or(&blank)
            .each_ref()
            .map(String::as_str);
        let line = format!("{}{number:>digits$} | {text}", padded(cells));
        let known = found.line(file, number);
        out.push(Line {
            text: line.trim_end().to_owned(),
            bar: known.map(|line| line.cycles as f64 / most.max(1) as f64),
        });
        for part in known.iter().flat_map(|line| told(found, line)) {
            out.push(Line::plain(&format!("{indent} :   {part}")));
        }
    }
    (out, indent.len() + 3)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_share_of_an_error_is_below_nothing() {
        let told = [0.25, 0.0, -0.000_01, -1.097].map(error);
        assert_eq!(told, ["25.0%", "0.0%", "0.0%", "cancels"]);
    }
}
