//! Reads the options that choose a target, its screen, and what is left out.

use crate::failure::{Failure, Outcome, unknown};
use slowlight_compiler::backend::mos6502::syntax;
use slowlight_compiler::backend::mos6502::syntax::{SYNTAXES, Syntax};
use slowlight_compiler::planner::THRIFTS;
use slowlight_compiler::targets;
use slowlight_compiler::targets::Target;
use std::collections::BTreeSet;

/// Reads `--target`.
///
/// # Errors
/// Where there is no such target: what there is.
pub fn target(name: &str) -> Result<&'static Target, String> {
    let names = targets::every().map(|t| t.name);
    targets::find(name).ok_or_else(|| unknown("target", name, names))
}

/// What there is for `--target`, in one line.
pub fn known_targets() -> String {
    let names: Vec<&str> = targets::every().map(|t| t.name).collect();
    format!(
        "targets: {} (`slowlight targets` says more)",
        names.join(", ")
    )
}

/// Reads `--syntax`.
///
/// # Errors
/// Where programs cannot be written for such an assembler: for which they can.
pub fn syntax(name: &str) -> Result<&'static Syntax, String> {
    let names = SYNTAXES.iter().map(|s| s.name);
    syntax::find(name).ok_or_else(|| unknown("syntax", name, names))
}

/// What stands for every format that a machine has.
pub const ALL_FORMATS: &str = "all";

/// Reads a `--format` of any machine, or `all`.
///
/// # Errors
/// Where no machine has it: what there is.
pub fn format_or_all(name: &str) -> Result<String, String> {
    let formats = targets::every().flat_map(targets::formats);
    let names: BTreeSet<&str> = formats.map(|t| t.runtime.format).collect();
    match name == ALL_FORMATS || names.contains(name) {
        true => Ok(name.to_owned()),
        false => Err(unknown("format", name, names)),
    }
}

/// Reads `--page`: hexadecimal, with or without `&`, a whole page of memory.
///
/// # Errors
/// Where it is none that programs may begin at.
pub fn page(text: &str) -> Result<u16, String> {
    let digits = text.strip_prefix('&').unwrap_or(text);
    match u16::from_str_radix(digits, 16) {
        Ok(page) if page % 256 == 0 && (0xe00..=0x2f00).contains(&page) => Ok(page),
        _ => Err("programs begin at a whole page from E00 to 2F00, as in --page E00".to_owned()),
    }
}

/// Reads `--block`: `4`, or columns and rows, `4x2`.
///
/// # Errors
/// Where it is no size of a block.
pub fn block(text: &str) -> Result<(u32, u32), String> {
    let (wide, high) = text.split_once('x').unwrap_or((text, text));
    let number = |t: &str| {
        t.trim()
            .parse()
            .ok()
            .filter(|n| (1..=MOST_IN_BLOCK).contains(n))
    };
    match (number(wide), number(high)) {
        (Some(wide), Some(high)) => Ok((wide, high)),
        _ => Err(format!(
            "a block is N or W x H pixels, each from 1 to {MOST_IN_BLOCK}, as in --block 4 or --block 4x2"
        )),
    }
}

/// Columns or rows of a block at most.
pub const MOST_IN_BLOCK: u32 = 128;

/// Reads `--thrift`.
///
/// # Errors
/// Where there is no such step.
pub fn thrift(text: &str) -> Result<u8, String> {
    let last = THRIFTS - 1;
    let step = text.parse().ok().filter(|n| usize::from(*n) <= last);
    step.ok_or_else(|| format!("memory is spared in steps from 0 to {last}"))
}

/// Reads the most turns that a loop may take.
///
/// # Errors
/// Where it is no number of turns.
pub fn turns(text: &str) -> Result<u32, String> {
    let number = text.parse().ok().filter(|n| (1..=65535).contains(n));
    number.ok_or_else(|| "a loop takes from 1 to 65535 turns".to_owned())
}

/// Reads `A..B` or `A` as rows of a picture.
///
/// # Errors
/// Where it is not that, or not in the picture.
pub fn rows(text: &str, height: u32) -> Outcome<(u32, u32)> {
    let (first, last) = text.split_once("..").unwrap_or((text, text));
    let last = last.strip_prefix('=').unwrap_or(last);
    let number = |t: &str| t.trim().parse::<u32>().ok();
    match (number(first), number(last)) {
        (Some(first), Some(last)) if first <= last && last < height => Ok((first, last)),
        (Some(first), Some(last)) if first > last => Err(Failure::Usage(format!(
            "--rows {text}: the first row is below the last"
        ))),
        (Some(_), Some(_)) => Err(Failure::Usage(format!(
            "--rows {text}: the picture has rows 0..{}",
            height - 1
        ))),
        _ => Err(Failure::Usage(format!(
            "--rows {text}: write first..last, as in 0..{}",
            height - 1
        ))),
    }
}

/// Reads `--error`: `0.5%` or `0.005`.
///
/// # Errors
/// Where it is no share.
pub fn share(text: &str) -> Result<f64, String> {
    let (number, size) = match text.trim().strip_suffix('%') {
        Some(number) => (number.trim_end(), 0.01),
        None => (text.trim(), 1.0),
    };
    match number.parse::<f64>() {
        Ok(n) if (0.0..=1.0).contains(&(n * size)) => Ok(n * size),
        _ => Err("write an error as a share, as in 0.5% or 0.005".to_owned()),
    }
}
