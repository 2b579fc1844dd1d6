//! Edited programs: the parameter block of a generated source, read back.
//!
//! Every target writes each scalar of a live param on a line of its own, as
//! `name = number`, perhaps with a line number or `let` before it and `;`, `:`
//! or a comment behind it. Whoever edits the number edits the picture, and the
//! model and native evaluation follow.

use crate::failure::{Failure, Outcome};
use crate::files;
use crate::machine::{File, Machine};
use slowlight_compiler::plan::{ParamPlan, Plan};
use std::path::Path;

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

/// The params' values in edited sources, as `--set` would give them.
///
/// # Errors
/// Where a line is missing or its number is odd.
pub fn values(plan: &Plan, sources: &[File]) -> Outcome<Vec<(String, Vec<f64>)>> {
    let mut found: Vec<(String, Vec<f64>)> = Vec::new();
    for (param, written) in plan.graph.params.iter().zip(&plan.params) {
        let value = value(written, sources)?;
        match found.last_mut() {
            Some((name, values)) if *name == param.name => values.push(value),
            _ => found.push((param.name.clone(), vec![value])),
        }
    }
    Ok(found)
}

fn value(param: &ParamPlan, sources: &[File]) -> Outcome<f64> {
    let label = &param.label;
    for source in sources {
        let text = source.as_text();
        for (k, line) in text.lines().enumerate() {
            let Some(number) = assigned(line, label) else {
                continue;
            };
            let odd = |why: &str| {
                let place = format!("{}:{}", source.name, k + 1);
                Failure::Wrong(format!(
                    "{place}: `{number}` is no value for {label}: {why}"
                ))
            };
            let value: f64 = number.parse().map_err(|_| odd("it is no number"))?;
            if !value.is_finite() {
                return Err(odd("it is no number"));
            }
            return match param.digits {
                None => Ok(value),
                Some(_) if value.fract() != 0.0 => Err(odd("it must be whole")),
                Some(digits) => Ok(value / 10f64.powi(i32::from(digits))),
            };
        }
    }
    Err(Failure::Wrong(format!(
        "the program's parameter block has no line `{label} = number`"
    )))
}

/// What a line gives to a name, if it does.
fn assigned<'l>(line: &'l str, label: &str) -> Option<&'l str> {
    let line = line.trim_start();
    let line = line.trim_start_matches(|c: char| c.is_ascii_digit());
    let line = line.trim_start();
    let line = line
        .strip_prefix("let ")
        .or_else(|| line.strip_prefix("LET "))
        .map_or(line, str::trim_start);
    let line = line.strip_prefix(label)?.trim_start();
    let value = line.strip_prefix('=')?.trim_start();
    // A comparison is not an assignment.
    if value.starts_with('=') {
        return None;
    }
    let end = value
        .find(|c: char| c == ';' || c == ':' || (c == '/' && value.contains("//")))
        .unwrap_or(value.len());
    let value = value.get(..end)?;
    let end = value.find(" REM").unwrap_or(value.len());
    Some(value.get(..end)?.trim())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_read_in_every_dialect() {
        for line in [
            "eye_y = -0.1",
            "   40 eye_y=-0.1",
            "40eye_y = -0.1: REM up",
            "40 LET eye_y = -0.1 REM up",
            "  let eye_y = -0.1; // up",
            "eye_y = -0.1 ; up",
        ] {
            assert_eq!(assigned(line, "eye_y"), Some("-0.1"), "{line}");
        }
        for line in [
            "eye_yy = 1",
            "my_eye_y = 1",
            "eye_y == 1",
            "; eye_y = 1",
            "eye_y + 1 = 2",
        ] {
            assert_eq!(assigned(line, "eye_y"), None, "{line}");
        }
    }
}
