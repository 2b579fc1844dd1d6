//! Opcodes that an assembler has no names for, as bytes.

use crate::source::Span;
use rustc_hash::FxHashMap;
use slowlight_isa::opcodes::{self, Mode, OPCODES, Trust};

/// What says how long an operand is: the addresses of a program's symbols.
pub(super) struct Bytes<'t> {
    symbols: FxHashMap<&'t str, u32>,
}

impl<'t> Bytes<'t> {
    pub fn new(lines: &'t [(String, Option<Span>)]) -> Bytes<'t> {
        let symbol = |line: &'t str| {
            let code = line.split(';').next().unwrap_or(line);
            let (name, value) = code.split_once(" = ")?;
            let hexadecimal = value.trim().strip_prefix('$')?;
            Some((name, u32::from_str_radix(hexadecimal, 16).ok()?))
        };
        Bytes {
            symbols: lines.iter().filter_map(|(line, _)| symbol(line)).collect(),
        }
    }

    /// An undocumented instruction in the one form (see [`super`]), as bytes and a remark.
    pub fn of(&self, line: &str) -> Option<String> {
        let code = line.split(';').next().unwrap_or(line).trim_end();
        let body = code.trim_start();
        let (name, operand) = body.split_once(' ').unwrap_or((body, ""));
        if body.len() == code.len() || !is_undocumented(name) {
            return None;
        }
        let (mode, inner) = self.mode(operand);
        let opcode = opcodes::find(name, mode)?;
        let operand = match mode.bytes() {
            3 => format!("<({inner}), >({inner})"),
            _ => inner.to_owned(),
        };
        Some(format!("        .byte ${opcode:02x}, {operand} ; {body}"))
    }

    /// Where an operand is, and what stands in it.
    fn mode<'o>(&self, operand: &'o str) -> (Mode, &'o str) {
        if let Some(number) = operand.strip_prefix('#') {
            return (Mode::Immediate, number);
        }
        let pointed = operand.strip_prefix('(');
        if let Some(pointer) = pointed.and_then(|p| p.strip_suffix("),y")) {
            return (Mode::IndirectY, pointer);
        }
        if let Some(table) = operand.strip_suffix(",y") {
            return (Mode::AbsoluteY, table);
        }
        let end = operand.find(['+', '-']).unwrap_or(operand.len());
        let (name, more) = operand.split_at(end);
        let more: i64 = more.trim_start_matches('+').parse().unwrap_or(0);
        let at = (self.symbols.get(name)).map(|at| i64::from(*at) + more);
        match at {
            Some(0..=0xFF) => (Mode::ZeroPage, operand),
            _ => (Mode::Absolute, operand),
        }
    }
}

/// Whether no data sheet has a mnemonic.
fn is_undocumented(name: &str) -> bool {
    let mut named = OPCODES.iter().filter(|o| o.mnemonic == name).peekable();
    named.peek().is_some() && named.all(|o| o.trust != Trust::Documented)
}
