//! The most cycles that a program for a 6502 takes, found without running it.

use crate::failure::{Failure, Outcome};
use crate::format::{count, duration};
use slowlight_compiler::backend::Document;
use slowlight_compiler::plan::Plan;
use slowlight_compiler::targets::{System, Target};
use slowlight_vm::mos6502::plain::port;
use slowlight_vm::mos6502::worst::{Question, Unknown};
use slowlight_vm::mos6502::{Assembly, assemble};
use std::collections::{BTreeMap, BTreeSet};

/// Where a picture of a scene that moves begins, each row, and each pixel of one.
const PICTURE: &str = "next_picture";
const ROW: &str = "next_row";
const PIXEL: &str = "next_pixel";

/// Fails where cycles are lost that no program says.
///
/// # Errors
/// What takes them.
pub fn check(target: &Target) -> Outcome<()> {
    match target.system {
        System::Plain6502 => Ok(()),
        _ => Err(Failure::Usage(format!(
            "--worst is the plain 6502's: {} has interrupts, a video chip or a system whose \
             cycles are not in its programs",
            target.name
        ))),
    }
}

/// The most cycles of a plan's program, or of each picture where it moves.
///
/// # Errors
/// Why that is not known.
pub fn worst(plan: &Plan, text: &[Document]) -> Result<u64, String> {
    let [document] = text else {
        return Err("it is no single program".to_owned());
    };
    let Ok(assembly) = assemble(&document.text) else {
        return Err("it cannot be assembled".to_owned());
    };
    let label = |name: &str| {
        let value = assembly.symbols.get(name)?;
        u16::try_from(*value).ok()
    };
    let mut turns = Question::turns_of(&assembly, &document.text);
    let all = |(first, last): (u32, u32)| last - first + 1;
    turns.extend(label(ROW).map(|at| (at, all(plan.rows))));
    let picture = label(PICTURE).filter(|_| plan.graph.is_moving());
    let mut question = Question {
        assembly: &assembly,
        ram: 0..=0xFF,
        mirrored: false,
        turns,
        ends: picture.map_or_else(BTreeSet::new, |picture| jumps(&assembly, picture)),
        exit: Some(port::EXIT),
    };
    let from = picture.unwrap_or(assembly.origin);
    let mut found = question.worst(from);
    if let (Err(_), Some(pixel)) = (found, label(PIXEL)) {
        // Pixels that are counted one by one are fewer where they are drawn in passes; where
        // their loop has several ways in, they are as many as there are columns.
        question.turns.insert(pixel, all(plan.columns));
        found = question.worst(from);
    }
    let found = found.map_err(|unknown| told(&assembly, &document.name, unknown))?;
    // A picture's end is a jump to the next.
    Ok(found + if picture.is_some() { 3 } else { 0 })
}

/// What is said of it; `seconds` is how long the machine takes for so many cycles.
pub fn text(plan: &Plan, found: Result<u64, String>, seconds: impl Fn(f64) -> f64) -> String {
    let each = match plan.graph.is_moving() {
        true => " a picture",
        false => "",
    };
    match found {
        Ok(cycles) => format!(
            "at most {} cycles{each}, {}\n",
            count(cycles),
            duration(seconds(cycles as f64))
        ),
        Err(why) => format!("its worst time is not known: {why}\n"),
    }
}

/// The jumps to an address.
fn jumps(assembly: &Assembly, to: u16) -> BTreeSet<u16> {
    let [lo, hi] = to.to_le_bytes();
    let spans = assembly.lines.iter().filter(|span| span.code);
    let jump = |at: &u16| {
        let begin = usize::from(at - assembly.origin);
        assembly.bytes.get(begin..begin + 3) == Some(&[0x4C, lo, hi])
    };
    spans.map(|span| span.address).filter(jump).collect()
}

/// Why there is no bound, and where: at a label, or at some line behind one.
fn told(assembly: &Assembly, file: &str, Unknown { address, why }: Unknown) -> String {
    let labels: BTreeMap<u16, &str> = (assembly.symbols.iter())
        .filter_map(|(name, value)| Some((u16::try_from(*value).ok()?, name.as_str())))
        .filter(|(at, _)| *at >= assembly.origin)
        .collect();
    let at = match labels.range(..=address).next_back() {
        Some((at, name)) if *at == address => format!("`{name}`"),
        Some((_, name)) => format!("${address:04X}, behind `{name}`"),
        None => format!("${address:04X}"),
    };
    match assembly.line_at(address) {
        Some(line) => format!("{why} at {at}, line {line} of {file}"),
        None => format!("{why} at {at}"),
    }
}
