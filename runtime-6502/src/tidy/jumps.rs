//! Jumps: to where they end up, and none where the program comes there by itself.

use super::code::{Line, Names, Operand, is_branch};
use super::rules::Edit;
use rustc_hash::FxHashSet;
use std::ops::Range;

/// Bytes that a branch reaches, counted as if each instruction had as many as it may have.
const REACH: usize = 120;

/// The edits of one round; none of them changes what another looks at.
pub(super) fn edits(lines: &[Line], names: &Names, own: &Range<usize>) -> Vec<(usize, Edit)> {
    let mut edits = Vec::new();
    let met = met(lines);
    let mut k = own.start;
    while k < own.end {
        let found = unreached(lines, &met, k)
            .or_else(|| idle(lines, names, k))
            .or_else(|| around(lines, names, k))
            .or_else(|| further(lines, names, k));
        match found {
            Some((more, end)) => {
                edits.extend(more);
                k = end;
            }
            None => k += 1,
        }
    }
    edits
}

type Found = Option<(Vec<(usize, Edit)>, usize)>;

/// The labels that something goes to, or names.
fn met(lines: &[Line]) -> FxHashSet<&str> {
    let operands = lines.iter().filter_map(|line| match line {
        Line::Code(code) => match &code.operand {
            Operand::Label(label) => Some(label.as_str()),
            _ => None,
        },
        _ => None,
    });
    operands.collect()
}

pub(super) fn name(lines: &[Line], k: usize) -> &str {
    match lines.get(k) {
        Some(Line::Code(code)) => &code.name,
        _ => "",
    }
}

pub(super) fn label(lines: &[Line], k: usize) -> Option<&str> {
    match lines.get(k)? {
        Line::Code(code) => match &code.operand {
            Operand::Label(label) => Some(label),
            _ => None,
        },
        _ => None,
    }
}

/// The next line that is not silent, nor a label.
pub(super) fn next_code(lines: &[Line], from: usize) -> Option<usize> {
    let rest = lines.get(from..)?.iter();
    let skipped = rest
        .take_while(|line| matches!(line, Line::Silent | Line::Label(_)))
        .count();
    (from + skipped < lines.len()).then_some(from + skipped)
}

/// Instructions behind a jump that nothing else comes to.
fn unreached(lines: &[Line], met: &FxHashSet<&str>, k: usize) -> Found {
    if !matches!(name(lines, k), "jmp" | "rts") {
        return None;
    }
    let mut gone = Vec::new();
    let mut end = k + 1;
    loop {
        match lines.get(end)? {
            Line::Code(_) => gone.push((end, Edit::Gone)),
            Line::Silent => {}
            Line::Label(label) if !met.contains(label.as_str()) => {}
            Line::Label(_) | Line::Data => break,
        }
        end += 1;
    }
    (!gone.is_empty()).then_some((gone, end))
}

/// A jump or a branch to what stands behind it.
fn idle(lines: &[Line], names: &Names, k: usize) -> Found {
    if name(lines, k) != "jmp" && !is_branch(name(lines, k)) {
        return None;
    }
    let to = names.line_of(label(lines, k)?)?;
    (k < to && next_code(lines, k + 1) == next_code(lines, to))
        .then(|| (vec![(k, Edit::Gone)], k + 1))
}

/// The branch that goes where another goes on.
fn opposite(branch: &str) -> Option<&'static str> {
    Some(match branch {
        "bcc" => "bcs",
        "bcs" => "bcc",
        "beq" => "bne",
        "bne" => "beq",
        "bmi" => "bpl",
        "bpl" => "bmi",
        "bvc" => "bvs",
        "bvs" => "bvc",
        _ => return None,
    })
}

/// A branch around a jump, where a branch reaches as far.
fn around(lines: &[Line], names: &Names, k: usize) -> Found {
    let other = opposite(name(lines, k))?;
    let jump = next_code(lines, k + 1)?;
    // Nothing else may come to the jump.
    let between = lines.get(k + 1..jump)?;
    if name(lines, jump) != "jmp" || between.iter().any(|line| matches!(line, Line::Label(_))) {
        return None;
    }
    let over = names.line_of(label(lines, k)?)?;
    let to = label(lines, jump)?;
    let line = names.line_of(to)?;
    let near = over > jump && next_code(lines, jump + 1) == next_code(lines, over);
    (near && reaches(lines, jump, line)).then(|| {
        let edits = vec![
            (k, Edit::Instead(format!("{other} {to}"))),
            (jump, Edit::Gone),
        ];
        (edits, jump + 1)
    })
}

/// A jump or a branch to a jump.
fn further(lines: &[Line], names: &Names, k: usize) -> Found {
    let own = name(lines, k);
    if own != "jmp" && !is_branch(own) {
        return None;
    }
    let to = next_code(lines, names.line_of(label(lines, k)?)?)?;
    let label = (name(lines, to) == "jmp").then(|| label(lines, to))??;
    let line = names.line_of(label)?;
    let other = to != k && next_code(lines, line) != Some(to) && next_code(lines, line) != Some(k);
    (other && (own == "jmp" || reaches(lines, k, line)))
        .then(|| (vec![(k, Edit::Instead(format!("{own} {label}")))], k + 1))
}

/// Whether a branch reaches from a line to another, whatever else becomes of what is between.
pub(super) fn reaches(lines: &[Line], from: usize, to: usize) -> bool {
    let range = if from < to { from..to } else { to..from };
    let Some(between) = lines.get(range) else {
        return false;
    };
    let bytes = between.iter().map(|line| match line {
        Line::Code(code) => match &code.operand {
            Operand::None => 1,
            Operand::Cell(at, _) if *at < 0x100 => 2,
            Operand::Immediate(..) | Operand::Pointed(..) => 2,
            Operand::Label(_) if is_branch(&code.name) => 2,
            _ => 3,
        },
        Line::Data => REACH,
        Line::Silent | Line::Label(_) => 0,
    });
    bytes.sum::<usize>() <= REACH
}
