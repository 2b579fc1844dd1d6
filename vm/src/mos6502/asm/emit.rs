//! Second pass: every symbol is known; out come the bytes.

use slowlight_isa::opcodes::Mode;

use super::expr::{Expr, NoValue};
use super::layout::{Layout, Output, Placed};
use super::parse::Datum;
use super::symbols::Symbols;
use super::{Assembly, Faults, LineSpan};

struct Pass<'f> {
    symbols: &'f Symbols,
    faults: &'f mut Faults,
    bytes: Vec<u8>,
}

pub(super) fn emit(layout: &Layout<'_>, symbols: &Symbols, faults: &mut Faults) -> Assembly {
    let mut pass = Pass {
        symbols,
        faults,
        bytes: Vec::new(),
    };
    let mut lines = Vec::new();
    for placed in &layout.placed {
        pass.output(placed);
        if placed.length > 0 {
            lines.push(LineSpan {
                address: u16::try_from(placed.address).unwrap_or(u16::MAX),
                length: placed.length,
                line: placed.line,
                code: matches!(placed.output, Output::Instruction { .. }),
            });
        }
    }
    Assembly {
        origin: u16::try_from(layout.origin).unwrap_or(u16::MAX),
        bytes: pass.bytes,
        symbols: symbols
            .iter()
            .filter_map(|s| Some((s.name.clone(), s.value?)))
            .collect(),
        lines,
    }
}

impl Pass<'_> {
    fn output(&mut self, placed: &Placed<'_>) {
        match &placed.output {
            Output::Bytes(data) => {
                for datum in data.iter() {
                    match datum {
                        Datum::Text(text) => self.bytes.extend(text),
                        Datum::Value(expr) => self.byte(placed, expr, "a byte"),
                    }
                }
            }
            Output::Words(words) => words.iter().for_each(|w| self.word(placed, w)),
            Output::Fill { count, fill } => {
                let value = fill.map_or(0, |e| self.within(placed, e, 0xFF, "a byte"));
                let end = self.bytes.len() + *count as usize;
                self.bytes.resize(end, value.to_le_bytes()[0]);
            }
            Output::Instruction {
                opcode,
                mode,
                operand,
            } => {
                self.bytes.push(*opcode);
                let Some(expr) = operand else { return };
                match mode {
                    Mode::Relative => self.branch(placed, expr),
                    Mode::Immediate => self.byte(placed, expr, "an immediate operand"),
                    _ if mode.bytes() == 3 => self.word(placed, expr),
                    _ => self.byte(placed, expr, "a zero-page address"),
                }
            }
        }
    }

    /// A value; faults about symbols without one were reported by the first pass.
    fn value(&mut self, placed: &Placed<'_>, expr: &Expr) -> Option<i64> {
        match expr.value(self.symbols, i64::from(placed.address)) {
            Ok(value) => Some(value),
            Err(NoValue::Unknown(_)) => None,
            Err(NoValue::Wrong(why)) => {
                self.faults.add(placed.line, expr.column, why);
                None
            }
        }
    }

    fn within(&mut self, placed: &Placed<'_>, expr: &Expr, limit: u16, what: &str) -> u16 {
        let Some(value) = self.value(placed, expr) else {
            return 0;
        };
        match u16::try_from(value) {
            Ok(fits) if fits <= limit => fits,
            _ => {
                let message = format!("{what} must be 0 to {limit}; this is {value}");
                self.faults.add(placed.line, expr.column, message);
                0
            }
        }
    }

    fn byte(&mut self, placed: &Placed<'_>, expr: &Expr, what: &str) {
        let value = self.within(placed, expr, 0xFF, what);
        self.bytes.push(value.to_le_bytes()[0]);
    }

    fn word(&mut self, placed: &Placed<'_>, expr: &Expr) {
        let value = self.within(placed, expr, 0xFFFF, "an address or word");
        self.bytes.extend(value.to_le_bytes());
    }

    fn branch(&mut self, placed: &Placed<'_>, expr: &Expr) {
        let target = self
            .value(placed, expr)
            .unwrap_or(i64::from(placed.address));
        let distance = target - i64::from(placed.address) - 2;
        match i8::try_from(distance) {
            Ok(near) => self.bytes.push(near.cast_unsigned()),
            Err(_) => {
                let message = format!(
                    "a branch reaches from -128 to 127 bytes, and this is {distance}: branch around a `jmp`"
                );
                self.faults.add(placed.line, expr.column, message);
                self.bytes.push(0);
            }
        }
    }
}
