//! Memory: 128 bytes of the RIOT's, and 128 of the cartridge's, which are stored to at one place
//! and read at another.
//!
//! What is pointed through, indexed, or changed where it stands, is in the zero page; so is what
//! is used most, and what is left goes to the cartridge, where it is only loaded and stored.

use super::Line;
use crate::plan::Plan;
use std::collections::{BTreeMap, BTreeSet};

/// What the kernel has in the zero page: which part of the frame comes next, what is held.
pub const PHASE: &str = "$80";
/// See [`PHASE`].
pub const HANDS: &str = "$81";
/// Whether what was made playfield last has not been shown yet.
pub const FRESH: &str = "$82";

/// The bytes left to values, and to the stack behind them.
const FREE: std::ops::Range<u16> = 0x83..0xF8;

/// Where the cartridge's RAM is stored to, and how far behind that it is read.
pub const CHIP: u16 = 0x1000;
/// See [`CHIP`].
pub const READ: u16 = 0x80;
/// Rows of playfield: four bytes each, as four tables of so many.
pub const ROWS: u16 = 17;
/// Which columns are drawn on every line: as shown, and as they are worked out.
pub const MASKS: u16 = CHIP + 4 * ROWS;
/// See [`MASKS`].
pub const NEW_MASKS: u16 = MASKS + 4;
/// In which row each column begins.
pub const HEIGHTS: u16 = NEW_MASKS + 4;
/// What is left to values.
const SPARE: std::ops::Range<u16> = HEIGHTS + 32..CHIP + 0x80;

/// A name of bytes and how many they are.
pub struct Cell {
    pub name: String,
    pub bytes: u16,
}

/// Where all bytes are.
pub struct Places {
    at: BTreeMap<String, (u16, u16)>,
    pub ram: u32,
    pub chip: u32,
}

impl Places {
    /// Gives the names that texts use their places, those first that come first.
    ///
    /// # Errors
    /// Where there is no room.
    pub fn new(_: &Plan, cells: &[Cell], texts: &[&Vec<Line>]) -> Result<Places, String> {
        let known: BTreeSet<&str> = cells.iter().map(|cell| cell.name.as_str()).collect();
        let mut used: BTreeMap<&str, u16> = BTreeMap::new();
        let mut near: BTreeSet<&str> = BTreeSet::new();
        for (line, _) in texts.iter().flat_map(|text| text.iter()) {
            let Some((mnemonic, operand)) = instruction(line) else {
                continue;
            };
            let Some((name, by)) = symbol(operand) else {
                continue;
            };
            if !known.contains(name) {
                continue;
            }
            let bytes = used.entry(name).or_default();
            *bytes = (*bytes).max(by + 1);
            let plain = !operand.contains(['(', ',', '<', '>', '#']);
            let moves = matches!(
                mnemonic,
                "lda"
                    | "ldx"
                    | "ldy"
                    | "sta"
                    | "stx"
                    | "sty"
                    | "adc"
                    | "sbc"
                    | "and"
                    | "ora"
                    | "eor"
                    | "cmp"
                    | "cpx"
                    | "cpy"
                    | "bit"
            );
            if !plain || !moves {
                near.insert(name);
            }
        }
        let mut places = Places {
            at: BTreeMap::new(),
            ram: 3 + 8,
            chip: 4 * u32::from(ROWS) + 8 + 32,
        };
        let (mut next, mut spare) = (FREE.start, SPARE.start);
        let mut wanted = 0;
        let order = |near_only: bool| {
            let (used, near) = (&used, &near);
            cells.iter().filter_map(move |cell| {
                let name = cell.name.as_str();
                let bytes = used.get(name)?;
                (near.contains(name) == near_only)
                    .then_some((name, (*bytes).max(cell.bytes.min(*bytes))))
            })
        };
        for (name, bytes) in order(true).chain(order(false)) {
            wanted += bytes;
            let place = if next + bytes <= FREE.end {
                places.ram += u32::from(bytes);
                next += bytes;
                next - bytes
            } else if !near.contains(name) && spare + bytes <= SPARE.end {
                places.chip += u32::from(bytes);
                spare += bytes;
                spare - bytes
            } else {
                u16::MAX
            };
            places.at.insert(name.to_owned(), (place, bytes));
        }
        match places.at.values().any(|(at, _)| *at == u16::MAX) {
            true => Err(format!(
                "its values take {wanted} bytes of RAM; there are {} in the machine and {} in the \
                 cartridge",
                FREE.len(),
                SPARE.len()
            )),
            false => Ok(places),
        }
    }

    /// Where a name is stored to.
    pub fn at(&self, name: &str) -> Option<u16> {
        self.at.get(name).map(|(at, _)| *at)
    }

    /// Lines that name all places.
    pub fn symbols(&self) -> Vec<String> {
        let mut all: Vec<(&String, u16)> = self.at.iter().map(|(n, (at, _))| (n, *at)).collect();
        all.sort_by_key(|(_, at)| *at);
        let line = |(name, at): (&String, u16)| match at {
            0..=0xFF => format!("{name} = ${at:02x}"),
            _ => format!("{name} = ${at:04x}"),
        };
        all.into_iter().map(line).collect()
    }

    /// A line as it reads what is in the cartridge.
    pub fn line(&self, line: &str) -> String {
        let Some((mnemonic, operand)) = instruction(line) else {
            return line.to_owned();
        };
        let far = symbol(operand).and_then(|(name, _)| self.at(name));
        match far {
            Some(0x100..) if !mnemonic.starts_with("st") => {
                format!("        {mnemonic} {operand}+{READ}")
            }
            _ => line.to_owned(),
        }
    }
}

/// A line's instruction and operand.
pub fn instruction(line: &str) -> Option<(&str, &str)> {
    let code = line.strip_prefix("        ")?;
    let code = code.split(';').next()?.trim();
    let (mnemonic, operand) = code.split_once(' ').unwrap_or((code, ""));
    (!mnemonic.is_empty() && !mnemonic.starts_with('.')).then_some((mnemonic, operand.trim()))
}

/// The name in an operand, and what is added to it.
fn symbol(operand: &str) -> Option<(&str, u16)> {
    let inner = operand.trim_start_matches(['#', '<', '>', '(', ' ']);
    let end = inner.find(|c: char| !c.is_ascii_alphanumeric() && c != '_');
    let (name, rest) = inner.split_at(end.unwrap_or(inner.len()));
    let by = rest.strip_prefix('+').unwrap_or("0");
    let end = by.find(|c: char| !c.is_ascii_digit()).unwrap_or(by.len());
    let by = by.get(..end)?.parse().unwrap_or(0);
    (!name.is_empty()).then_some((name, by))
}
