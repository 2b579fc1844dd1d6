//! Edited programs: the parameter block of a generated source, read back.
//!
//! Every target writes each scalar of a live param on a line of its own, as
//! `name = number`, perhaps with a line number or `let` before it and `;`, `:`
//! or a comment behind it. Whoever edits the number edits the picture, and the
//! model and native evaluation follow.
//!
//! A target may have to write a name differently (`lda_`, `count_2`, `turns%`).
//! How it did is seen in the unedited program, where names and numbers are
//! both known; the edited one is then searched for those names.

use crate::failure::{Failure, Outcome};
use crate::files;
use crate::machine::{File, Machine};
use slowlight_compiler::backend::Document;
use slowlight_compiler::plan::{ParamPlan, Plan};
use std::path::Path;

/// Params by name, with the values of their components.
pub type Values = Vec<(String, Vec<f64>)>;

/// The sources of a program in a directory: all Jack classes, or the one
/// BASIC or assembly source, which is named like the scene if there are several.
///
/// # Errors
/// Where there is none, or no telling which.
pub fn read(dir: &Path, scene: &str, machine: Machine) -> Outcome<Vec<File>> {
    let extension = machine.extension();
    let mut paths = files::list(dir, extension)?;
    if paths.len() > 1 && !machine.many_sources() {
        paths.retain(|p| p.file_stem().is_some_and(|s| s == scene));
    }
    if paths.is_empty() && matches!(machine, Machine::Bbc(_)) {
        // A post's text.
        paths = files::list(dir, "txt")?;
        paths.retain(|p| {
            p.file_name()
                .is_some_and(|n| n == format!("{scene}.toot.txt").as_str())
        });
    }
    if paths.is_empty() {
        let message = format!("{} has no {scene}.{extension}", dir.display());
        return Err(Failure::Wrong(message));
    }
    let mut found = Vec::new();
    for path in paths {
        let name = path.file_name().map(|n| n.to_string_lossy().into_owned());
        found.push(File::text(
            &name.unwrap_or_default(),
            &files::read_text(&path)?,
        ));
    }
    Ok(found)
}

/// Whether sources are a plan's program, but for as many lines as its parameter block has.
pub fn is_of(plan: &Plan, edited: &[File]) -> bool {
    let changed = |document: &Document| {
        let Ok(file) = source(edited, &document.name) else {
            return usize::MAX;
        };
        let text = file.as_text();
        let (own, other) = (document.text.lines(), text.lines());
        let unlike = own
            .clone()
            .zip(other.clone())
            .filter(|(own, other)| own != other);
        unlike.count() + own.count().abs_diff(other.count())
    };
    let documents = slowlight_compiler::backend::emit(plan);
    let changed = documents.iter().map(changed).fold(0, usize::saturating_add);
    changed <= plan.params.len() + 2
}

/// The params' values in edited sources, as `--set` would give them. `plan` and
/// `unedited` are the scene's own.
///
/// # Errors
/// Where a line is missing or its number is odd.
pub fn values(plan: &Plan, unedited: &[Document], edited: &[File]) -> Outcome<Values> {
    let mut found: Values = Vec::new();
    if plan.params.is_empty() {
        return Ok(found);
    }
    let (file, names) = unedited
        .iter()
        .find_map(|d| Some((d.name.as_str(), block(plan, &d.text)?)))
        .ok_or_else(|| Failure::Wrong("the program has no parameter block".to_owned()))?;
    let source = source(edited, file)?;
    let text = source.as_text();
    for ((param, written), name) in plan.graph.params.iter().zip(&plan.params).zip(names) {
        let value = value(written, name, &source.name, &text)?;
        match found.last_mut() {
            Some((name, values)) if *name == param.name => values.push(value),
            _ => found.push((param.name.clone(), vec![value])),
        }
    }
    Ok(found)
}

/// The edited source that stands for an unedited one.
fn source<'f>(edited: &'f [File], name: &str) -> Outcome<&'f File> {
    match edited {
        [only] => Ok(only),
        many => many
            .iter()
            .find(|f| f.name == name)
            .ok_or_else(|| Failure::Wrong(format!("{name}, which has the parameters, is missing"))),
    }
}

/// The rows that the edited sources draw. `plan` and `unedited` are the scene's own.
///
/// # Errors
/// Where a line is missing or the screen has no such rows.
pub fn rows(plan: &Plan, unedited: &[Document], edited: &[File]) -> Outcome<(u32, u32)> {
    let found = unedited
        .iter()
        .find_map(|d| Some((d, row_names(plan, &d.text)?)));
    let Some((document, names)) = found else {
        return Ok(plan.rows);
    };
    let source = source(edited, &document.name)?;
    let text = source.as_text();
    let (least, greatest) = plan.shown_rows();
    let row = |name: &str| {
        let (number, line) = written(name, &source.name, &text)?;
        let row = number.parse().ok();
        let row = row.filter(|row| (least..=greatest).contains(row));
        row.ok_or_else(|| {
            let what = format!("{}:{line}: `{number}` is no value for {name}", source.name);
            Failure::Wrong(format!("{what}: the screen shows rows {least}..{greatest}"))
        })
    };
    let [first, last] = names;
    match (row(first)?, row(last)?) {
        rows if rows.0 <= rows.1 => Ok(rows),
        (from, to) => {
            let what = format!(
                "{}: it draws no row: {first} is {from}, {last}",
                source.name
            );
            Err(Failure::Wrong(format!("{what} {to}")))
        }
    }
}

/// What an unedited text calls the first and last row that it draws: they are given
/// their values one behind the other.
fn row_names<'d>(plan: &Plan, text: &'d str) -> Option<[&'d str; 2]> {
    let params = block(plan, text)?;
    let all: Vec<(&str, &str)> = text.lines().flat_map(assignments).collect();
    let is = |(name, value): (&str, &str), label: &str, row: u32| {
        (stands_for(name, label) || stands_for(name, &format!("{label}_row")))
            && value == row.to_string()
            && !params.contains(&name)
    };
    all.windows(2).find_map(|pair| {
        let [first, last] = [*pair.first()?, *pair.get(1)?];
        let rows = is(first, "first", plan.rows.0) && is(last, "last", plan.rows.1);
        rows.then_some([first.0, last.0])
    })
}

/// What an unedited text calls the params, if it has the parameter block: lines
/// in the params' order, with their values.
fn block<'d>(plan: &Plan, text: &'d str) -> Option<Vec<&'d str>> {
    let mut lines = text.lines();
    let mut names = Vec::new();
    for param in &plan.params {
        let expected: f64 = param.text.parse().ok()?;
        let name = lines.find_map(|line| {
            let (name, value) = assignments(line).next()?;
            let same = value.parse::<f64>().is_ok_and(|v| v == expected);
            (same && stands_for(name, &param.label)).then_some(name)
        })?;
        names.push(name);
    }
    Some(names)
}

/// Whether a target may have made `name` of a label: in small letters, with a
/// number or `_` behind it where it is taken, and with the sign of its type.
fn stands_for(name: &str, label: &str) -> bool {
    let name = name.trim_end_matches('%');
    let small = label.to_ascii_lowercase();
    let rest = name
        .strip_prefix(label)
        .or_else(|| name.strip_prefix(&small));
    rest.is_some_and(|r| r.is_empty() || r.strip_prefix('_').is_some_and(is_digits))
}

fn is_digits(text: &str) -> bool {
    text.bytes().all(|b| b.is_ascii_digit())
}

/// What a text gives to a name at first, and in which line.
fn written<'t>(name: &str, file: &str, text: &'t str) -> Outcome<(&'t str, u32)> {
    let mut all =
        (text.lines().zip(1..)).flat_map(|(line, n)| assignments(line).map(move |a| (a, n)));
    let found = all.find_map(|((found, value), line)| (found == name).then_some((value, line)));
    found.ok_or_else(|| {
        let message = format!("{file}: the parameter block has no line `{name} = number`");
        Failure::Wrong(message)
    })
}

fn value(param: &ParamPlan, name: &str, file: &str, text: &str) -> Outcome<f64> {
    let (number, line) = written(name, file, text)?;
    let odd = |why: &str| {
        let message = format!("{file}:{line}: `{number}` is no value for {name}: {why}");
        Failure::Wrong(message)
    };
    let value: f64 = number.parse().map_err(|_| odd("it is no number"))?;
    match param.digits {
        _ if !value.is_finite() => Err(odd("it is no number")),
        None => Ok(value),
        Some(_) if value.fract() != 0.0 => Err(odd("it must be whole")),
        Some(digits) => Ok(value / 10f64.powi(i32::from(digits))),
    }
}

/// The names and the values of a line's statements that give one to the other.
fn assignments(line: &str) -> impl Iterator<Item = (&str, &str)> {
    let line = line.trim_start();
    let line = line.trim_start_matches(|c: char| c.is_ascii_digit());
    line.split(':').filter_map(assigned)
}

fn assigned(line: &str) -> Option<(&str, &str)> {
    let line = line.trim_start();
    let line = line
        .strip_prefix("let ")
        .or_else(|| line.strip_prefix("LET "))
        .map_or(line, str::trim_start);
    let (name, value) = line.split_once('=')?;
    let name = name.trim_end();
    let identifier = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '%';
    if name.is_empty() || !name.chars().all(identifier) {
        return None;
    }
    let value = value.split(';').next().unwrap_or(value);
    let value = value.split("//").next().unwrap_or(value);
    let value = value.split("REM").next().unwrap_or(value);
    Some((name, value.trim()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_read_in_every_dialect() {
        let first = |line| assignments(line).next();
        for line in [
            "eye_y = -0.1",
            "   40 eye_y=-0.1",
            "40eye_y = -0.1: REM up",
            "40 LET eye_y = -0.1 REM up",
            "  let eye_y = -0.1; // up",
            "eye_y = -0.1 ; up",
        ] {
            assert_eq!(first(line), Some(("eye_y", "-0.1")), "{line}");
        }
        let both: Vec<_> = assignments("50first%=0:last%=239:REM rows").collect();
        assert_eq!(both, [("first%", "0"), ("last%", "239")]);
        for line in [
            "; eye_y = 1",
            "eye_y + 1 = 2",
            "* = $0800",
            "eye_y",
            "= 1",
            "",
        ] {
            assert_eq!(first(line), None, "{line}");
        }
    }

    #[test]
    fn targets_may_change_names() {
        for name in ["eye", "eye_", "eye_2", "eye%", "eye_2%"] {
            assert!(stands_for(name, "eye"), "{name}");
        }
        for name in ["eye_x", "eyes", "ey", "my_eye", "Eye"] {
            assert!(!stands_for(name, "eye"), "{name}");
        }
        for name in ["ENDpoint_x", "endpoint_x", "endpoint_x_2%"] {
            assert!(stands_for(name, "ENDpoint_x"), "{name}");
        }
    }
}
