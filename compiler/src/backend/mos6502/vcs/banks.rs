//! Banks: pieces of the work where what they need beside them fits into 4K, and the ways from
//! one to another.
//!
//! Bank k is written at $1000 + $2000 k, where the machine sees it as at $1000: so one source has
//! all of them, and labels say in which bank they are. An access to a hotspot puts another bank
//! under the running program. What does that stands at the same place in all of them, the same
//! byte for byte, so it goes on as if nothing had happened.

use super::Line;
use super::kernel;
use super::parts::{OF_SQUARES, SQUARES, Units, bytes, label};
use super::ram::{Places, instruction};
use super::work::{End, Piece};
use crate::plan::Plan;
use std::collections::{BTreeMap, BTreeSet};

/// Where in a bank the program may be: behind the cartridge's RAM, and before what is the same
/// in all of them.
const FIRST: u32 = 0x100;
const COMMON: u32 = 0xE70;
/// Before the hotspots.
const END: u32 = 0xFF0;

/// The cartridge.
pub(super) struct Packed {
    pub lines: Vec<Line>,
    pub banks: u32,
    pub rom: u32,
}

struct Bank {
    pieces: Vec<usize>,
    units: BTreeSet<usize>,
    bytes: u32,
}

/// Packs the work into banks.
///
/// # Errors
/// Where there are too few, or something goes from piece to piece that may not.
pub(super) fn packed(
    plan: &Plan,
    pieces: Vec<Piece>,
    units: &Units,
    places: &Places,
    (boot, kernel): (Vec<Line>, Vec<Line>),
    shape: &kernel::Shape,
) -> Result<Packed, String> {
    let symbols = places.symbols().join("\n");
    let mut banks: Vec<Bank> = Vec::new();
    let mut of_piece = Vec::new();
    let mut now = 0;
    for (k, piece) in pieces.iter().enumerate() {
        let needs = units.needed(piece.lines.iter());
        let texts: Vec<String> = piece.lines.iter().map(|(l, _)| places.line(l)).collect();
        let own = bytes(texts.iter().map(String::as_str), &symbols).ok_or_else(|| {
            let line = piece.lines.first().map_or("", |(line, _)| line);
            format!("a piece of it has no length: {line}")
        })?;
        // What asks behind it, asks in it, and a way on.
        let asks = piece
            .lines
            .iter()
            .filter(|(l, _)| instruction(l) == Some(("jsr", "vcs_ask")));
        let leaving = piece.lines.iter().filter(|(line, _)| leaves(piece, line));
        let own = own + 13 + 10 * asks.count() as u32 + 3 * leaving.count() as u32;
        let added = |bank: &Bank| {
            let more = needs.difference(&bank.units);
            let more: u32 = more.filter_map(|n| Some(units.all.get(*n)?.bytes)).sum();
            own + more
        };
        let fits = |bank: &Bank| bank.bytes + added(bank) <= COMMON - FIRST;
        let at = match banks.get(now) {
            Some(bank) if fits(bank) => now,
            _ => {
                let fitting = banks.iter().enumerate().filter(|(_, bank)| fits(bank));
                let least = fitting.min_by_key(|(_, bank)| added(bank));
                least.map(|(at, _)| at).unwrap_or(banks.len())
            }
        };
        if at == banks.len() {
            banks.push(Bank {
                pieces: Vec::new(),
                units: BTreeSet::new(),
                bytes: 0,
            });
        }
        let Some(bank) = banks.get_mut(at) else {
            continue;
        };
        if !fits(bank) || banks.len() > 7 {
            return Err("its program does not fit into the eight banks of a cartridge".to_owned());
        }
        let Some(bank) = banks.get_mut(at) else {
            continue;
        };
        bank.bytes += added(bank);
        bank.units.extend(&needs);
        bank.pieces.push(k);
        of_piece.push(at as u32 + 1);
        now = at;
    }
    let count = match banks.len() + 1 {
        ..=2 => 2,
        3..=4 => 4,
        _ => 8,
    };
    let hotspot = |bank: u32| match count {
        2 => 0x1FF8 + bank,
        4 => 0x1FF6 + bank,
        _ => 0x1FF4 + bank,
    };
    let mut of_label: BTreeMap<String, usize> = BTreeMap::new();
    for (k, piece) in pieces.iter().enumerate() {
        let names = piece.lines.iter().filter_map(|(line, _)| label(line));
        of_label.extend(names.map(|name| (name.to_owned(), k)));
    }
    // The ways between banks.
    let mut ways: BTreeMap<String, u32> = BTreeMap::new();
    let bank_of = |piece: usize| of_piece.get(piece).copied().unwrap_or(0);
    let mut asked = 0;
    let mut texts: Vec<Vec<Line>> = Vec::new();
    for bank in &banks {
        let own = texts.len() as u32 + 1;
        let mut text: Vec<Line> = Vec::new();
        let mut push = |line: String, span| text.push((line, span));
        for (at, k) in bank.pieces.iter().enumerate() {
            let Some(piece) = pieces.get(*k) else {
                continue;
            };
            push(format!("vcs_piece_{k}:"), None);
            for (line, span) in &piece.lines {
                match instruction(line) {
                    Some(("jsr", "vcs_ask")) => {
                        ask(asked, own).into_iter().for_each(|l| push(l, *span));
                        asked += 1;
                    }
                    Some(("jmp", to)) if of_label.get(to).is_some_and(|to| bank_of(*to) != own) => {
                        let to_bank = of_label.get(to).map_or(0, |to| bank_of(*to));
                        ways.insert(to.to_owned(), to_bank);
                        push(format!("        jmp vcs_go_{to}"), *span);
                    }
                    Some((branch, to)) if leaves(piece, line) => {
                        let opposite = opposite(branch);
                        let to_bank = of_label.get(to).map_or(0, |to| bank_of(*to));
                        let way = match to_bank == own {
                            true => to.to_owned(),
                            false => format!("vcs_go_{to}"),
                        };
                        if to_bank != own {
                            ways.insert(to.to_owned(), to_bank);
                        }
                        push(format!("        {opposite} vcs_stays_{asked}"), *span);
                        push(format!("        jmp {way}"), *span);
                        push(format!("vcs_stays_{asked}:"), *span);
                        asked += 1;
                    }
                    _ => push(units.renamed(&places.line(line), own), *span),
                }
            }
            match piece.end {
                End::Jump => continue,
                End::Ask => ask(asked, own).into_iter().for_each(|l| push(l, None)),
                End::Publish => {
                    push(format!("{}{asked}:", super::PUBLISHED), None);
                    push(format!("        jsr vcs_publish_{own}"), None);
                }
            }
            asked += 1;
            let next = k + 1;
            if bank_of(next) != own {
                ways.insert(format!("vcs_piece_{next}"), bank_of(next));
                push(format!("        jmp vcs_go_vcs_piece_{next}"), None);
            } else if bank.pieces.get(at + 1) != Some(&next) {
                push(format!("        jmp vcs_piece_{next}"), None);
            }
        }
        for unit in bank.units.iter().filter(|unit| **unit != OF_SQUARES) {
            let lines = units.all.get(*unit).map(|unit| unit.lines.as_slice());
            for line in lines.unwrap_or_default() {
                push(units.renamed(&places.line(line), own), None);
            }
        }
        texts.push(text);
    }
    ways.insert(super::WORK.to_owned(), bank_of(0));
    let mut lines = head(plan, places, count);
    let mut rom = 0;
    for k in 0..count {
        let base = 0x1000 + 0x2000 * k;
        let push = |lines: &mut Vec<Line>, line: String| lines.push((line, None));
        push(&mut lines, format!("\n; ---- bank {k}"));
        match k {
            0 => push(&mut lines, format!("* = ${base:04x}")),
            _ => push(&mut lines, format!("        .res ${base:04x}-*, 255")),
        }
        push(&mut lines, format!("        .res ${FIRST:x}, 255"));
        let from = lines.len();
        let mut fixed = 0;
        if k == 0 {
            // In a page: the kernel has no cycle for crossing one. They are no instructions, as
            // some index behind the cartridge's RAM might seem to be.
            for (name, table) in kernel::tables(shape) {
                push(&mut lines, format!("{name}:"));
                let numbers: Vec<String> = table.iter().map(u8::to_string).collect();
                let rows = numbers.chunks(16).map(|row| row.join(", "));
                rows.for_each(|row| push(&mut lines, format!("        .byte {row}")));
            }
            lines.extend(boot.iter().map(|(line, span)| (places.line(line), *span)));
            push(&mut lines, format!("        jmp vcs_go_{}", super::WORK));
            lines.extend(kernel.iter().cloned());
        }
        let bank = (k as usize).checked_sub(1).and_then(|k| banks.get(k));
        if let Some(bank) = bank {
            if bank.units.contains(&OF_SQUARES) {
                let squares = units.all.first().map(|unit| unit.lines.as_slice());
                for line in squares.unwrap_or_default() {
                    push(&mut lines, units.renamed(line, k));
                }
                fixed = SQUARES;
            }
            let text = texts.get(k as usize - 1);
            lines.extend(text.into_iter().flatten().cloned());
        }
        let own = lines.get(from..).unwrap_or_default();
        let own: Vec<&str> = own.iter().map(|(line, _)| line.as_str()).collect();
        let used = bytes(own.into_iter(), &symbols).unwrap_or(fixed);
        if used > COMMON - FIRST {
            return Err("a bank of its program is too long".to_owned());
        }
        rom += used + (0x1000 - COMMON);
        push(
            &mut lines,
            format!("        .res ${:04x}-*, 255", base + COMMON),
        );
        common(&mut lines, k, count, &ways, hotspot)?;
    }
    Ok(Packed {
        lines,
        banks: count,
        rom,
    })
}

/// Whether a line branches out of its piece.
fn leaves(piece: &Piece, line: &str) -> bool {
    let Some((branch, to)) = instruction(line) else {
        return false;
    };
    let branches = branch.starts_with('b') && branch != "bit";
    branches && !piece.lines.iter().any(|(line, _)| label(line) == Some(to))
}

/// The branch that is taken where another is not.
fn opposite(branch: &str) -> &'static str {
    match branch {
        "bne" => "beq",
        "beq" => "bne",
        "bcc" => "bcs",
        "bcs" => "bcc",
        "bpl" => "bmi",
        "bmi" => "bpl",
        "bvc" => "bvs",
        _ => "bvc",
    }
}

/// Asks the timer.
fn ask(number: u32, bank: u32) -> Vec<String> {
    vec![
        format!("{}{number}:", super::ASKED),
        "        lda $0284".to_owned(),
        format!("{}16", super::LEAST),
        format!("        bcs vcs_on_{number}"),
        format!("{}{number}:", super::CROSSED),
        format!("        jsr vcs_cross_{bank}"),
        format!("vcs_on_{number}:"),
    ]
}

/// What is the same in all banks; the first has its labels.
fn common(
    lines: &mut Vec<Line>,
    bank: u32,
    count: u32,
    ways: &BTreeMap<String, u32>,
    hotspot: impl Fn(u32) -> u32,
) -> Result<(), String> {
    let mut length = 0;
    let mut put = |name: String, code: &[String]| {
        if bank == 0 {
            lines.push((format!("{name}:"), None));
        }
        for line in code {
            lines.push((format!("        {line}"), None));
            length += if line == "rts" { 1 } else { 3 };
        }
    };
    let to = |bank: u32| format!("bit ${:04x}", hotspot(bank));
    put("vcs_reset".to_owned(), &[to(0), "jmp vcs_boot".to_owned()]);
    for (name, bank) in ways {
        put(
            format!("vcs_go_{name}"),
            &[to(*bank), format!("jmp {name}")],
        );
    }
    for bank in 1..count {
        for (name, what) in [
            ("vcs_cross", "vcs_frame_part"),
            ("vcs_publish", "vcs_publish"),
        ] {
            let code = [to(0), format!("jsr {what}"), to(bank), "rts".to_owned()];
            put(format!("{name}_{bank}"), &code);
        }
    }
    if length > END - COMMON {
        return Err("there are too many ways between the banks of its program".to_owned());
    }
    let vectors = 0x1FFA + 0x2000 * bank;
    lines.push((format!("        .res ${vectors:04x}-*, 255"), None));
    lines.push((
        "        .word vcs_reset, vcs_reset, vcs_reset".to_owned(),
        None,
    ));
    Ok(())
}

/// What stands before the banks.
fn head(plan: &Plan, places: &Places, banks: u32) -> Vec<Line> {
    let image = &plan.graph.image;
    let mut text = vec![
        format!(
            "; {}: {} columns of {} rows, for an Atari VCS (PAL), {}K in banks with RAM ({})",
            plan.name,
            image.width,
            image.height,
            4 * banks,
            plan.runtime.format
        ),
        format!(
            "; Generated by slowlight. Run it with `slowlight vm {} {}.asm`.",
            plan.target.name, plan.name
        ),
        String::new(),
        "; what the timer has for making playfield at least, and for the slice behind it"
            .to_owned(),
        format!("{} = 40", super::PUBLISH),
        String::new(),
        "; ---- values: the cartridge's RAM is stored to at $1000, and read 128 bytes behind"
            .to_owned(),
    ];
    text.extend(places.symbols());
    text.into_iter().map(|line| (line, None)).collect()
}
