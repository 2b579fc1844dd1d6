//! Units: what of the runtime, and which tables, stand in a bank beside the work that needs them.

use super::Line;
use super::ram::instruction;
use super::work::{self, Work};
use crate::backend::mos6502::Text;
use crate::backend::mos6502::extent::extent;
use crate::backend::mos6502::homes::Homes;
use crate::backend::mos6502::table;
use crate::plan::Plan;
use slowlight_runtime_6502::squares::TABLES;
use std::collections::{BTreeMap, BTreeSet};

/// Bytes of the quarter squares.
pub(super) const SQUARES: u32 = 0x800;

/// Lines that stand together.
pub(super) struct Unit {
    pub lines: Vec<String>,
    pub bytes: u32,
    /// The units that it needs itself, by number.
    needs: BTreeSet<usize>,
}

/// All units, the quarter squares the first.
pub(super) struct Units {
    pub all: Vec<Unit>,
    /// Which unit has a label.
    pub labels: BTreeMap<String, usize>,
}

/// The number of the quarter squares.
pub(super) const OF_SQUARES: usize = 0;

impl Units {
    /// Those of a work.
    ///
    /// # Errors
    /// Where one cannot be measured.
    pub fn new(plan: &Plan, _: &Homes, work: &Work) -> Result<Units, String> {
        let mut squares = Text::default();
        for table in TABLES {
            squares.label(table.label);
            squares.bytes(table.bytes());
        }
        let mut texts: Vec<Vec<String>> = vec![lines(squares)];
        let clamp = work.lines.iter().any(|(line, _)| line == "clamp_index:");
        if clamp {
            texts.push(table::CLAMP.lines().map(str::to_owned).collect());
        }
        let parts = work.parts.iter().filter(|part| part.name != "squares");
        texts.extend(parts.map(|part| work::source(part).lines().map(str::to_owned).collect()));
        let mut tables = Text::default();
        table::data(plan, &mut tables);
        for (name, bytes) in &work.tables {
            tables.label(name);
            tables.bytes(bytes.iter().copied());
        }
        for line in lines(tables) {
            match (label(&line), texts.last_mut()) {
                (None, Some(last)) => last.push(line),
                _ => texts.push(vec![line]),
            }
        }
        for text in &mut texts {
            // One of two branches is always taken, which not everybody sees who reads it.
            let last = text.iter().rev().find_map(|line| instruction(line));
            if last.is_some_and(|(name, _)| name.starts_with('b') && name != "bit") {
                text.push("        rts".to_owned());
            }
        }
        let mut labels = BTreeMap::new();
        for (k, text) in texts.iter().enumerate() {
            labels.extend(
                text.iter()
                    .filter_map(|line| Some((label(line)?.to_owned(), k))),
            );
        }
        let mut units = Units {
            all: Vec::new(),
            labels,
        };
        for (k, lines) in texts.into_iter().enumerate() {
            let needs = lines
                .iter()
                .flat_map(|line| units.named(line))
                .filter(|n| *n != k);
            let needs = needs.collect();
            let bytes = match k {
                OF_SQUARES => SQUARES,
                _ => bytes(lines.iter().map(String::as_str), "").ok_or("a part has no length")?,
            };
            units.all.push(Unit {
                lines,
                bytes,
                needs,
            });
        }
        Ok(units)
    }

    /// The units whose labels a line names.
    fn named(&self, line: &str) -> Vec<usize> {
        let labelled = words(line).filter_map(|word| self.labels.get(word).copied());
        // The pointers into the quarter squares are the same for all banks.
        let pointed = line.contains("(sum") || line.contains("(dif");
        labelled.chain(pointed.then_some(OF_SQUARES)).collect()
    }

    /// All units that lines need.
    pub fn needed<'l>(&self, lines: impl Iterator<Item = &'l Line>) -> BTreeSet<usize> {
        let mut open: Vec<usize> = lines.flat_map(|(line, _)| self.named(line)).collect();
        let mut found = BTreeSet::new();
        while let Some(unit) = open.pop() {
            if found.insert(unit) {
                let needs = self.all.get(unit).map(|unit| unit.needs.iter());
                open.extend(needs.into_iter().flatten());
            }
        }
        found
    }

    /// The lines of all units that lines need.
    pub fn lines(&self, of: &[Line]) -> Vec<Line> {
        let needed = self.needed(of.iter());
        let units = needed.iter().filter_map(|unit| self.all.get(*unit));
        let lines = units.flat_map(|unit| unit.lines.iter().cloned());
        lines.map(|line| (line, None)).collect()
    }

    /// A line with the labels that a bank has of its own.
    pub fn renamed(&self, line: &str, bank: u32) -> String {
        let (code, remark) = line
            .split_once(';')
            .map_or((line, None), |(c, r)| (c, Some(r)));
        let mut out = String::new();
        let mut rest = code;
        let letter = |c: char| c.is_ascii_alphanumeric() || c == '_';
        while let Some(at) = rest.find(letter) {
            let (before, behind) = rest.split_at(at);
            let end = behind.find(|c| !letter(c)).unwrap_or(behind.len());
            let (word, behind) = behind.split_at(end);
            out.push_str(before);
            out.push_str(word);
            if self.labels.contains_key(word) {
                out.push_str(&format!("_b{bank}"));
            }
            rest = behind;
        }
        out.push_str(rest);
        if let Some(remark) = remark {
            out.push_str(&format!(";{remark}"));
        }
        out
    }
}

fn lines(text: Text) -> Vec<String> {
    let lines = text.lines.into_iter().map(|(line, _)| line);
    let lines = lines.flat_map(|line| line.split('\n').map(str::to_owned).collect::<Vec<_>>());
    lines
        .filter(|line| !line.is_empty() && !line.starts_with(';'))
        .collect()
}

/// The label that a line is.
pub(super) fn label(line: &str) -> Option<&str> {
    let code = line.split(';').next()?.trim_end();
    code.strip_suffix(':').filter(|name| !name.starts_with(' '))
}

fn words(line: &str) -> impl Iterator<Item = &str> {
    let code = line.split(';').next().unwrap_or(line);
    let letter = |c: char| c.is_ascii_alphanumeric() || c == '_';
    code.split(move |c| !letter(c))
        .filter(|word| !word.is_empty())
}

/// Bytes of lines, given those that name places.
pub(super) fn bytes<'l>(lines: impl Iterator<Item = &'l str>, symbols: &'l str) -> Option<u32> {
    let head = symbols.lines().chain(std::iter::once("* = $1000"));
    let all = extent(head.chain(lines), "")?;
    Some(all.end - all.origin)
}
