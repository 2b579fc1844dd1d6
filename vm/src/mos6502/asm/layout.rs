//! First pass: the mode, size and address of every statement, then all symbols.

use slowlight_isa::opcodes::{self, Mode};

use super::Faults;
use super::expr::{Expr, NoValue};
use super::parse::{Action, Datum, Operand, Statement};
use super::symbols::Symbols;

/// What a statement puts into memory.
pub(super) enum Output<'s> {
    Instruction {
        opcode: u8,
        mode: Mode,
        operand: Option<&'s Expr>,
    },
    Bytes(&'s [Datum]),
    Words(&'s [Expr]),
    Fill {
        count: u32,
        fill: Option<&'s Expr>,
    },
}

/// A statement with its place.
pub(super) struct Placed<'s> {
    pub line: u32,
    pub address: u32,
    pub length: u32,
    pub output: Output<'s>,
}

/// The program's statements in order, without what makes no bytes.
pub(super) struct Layout<'s> {
    pub origin: u32,
    pub placed: Vec<Placed<'s>>,
    /// The address behind the last byte; beyond 64K where the program is too long.
    pub end: u32,
}

/// Memory ends here.
pub(super) const END: u32 = 0x1_0000;

struct Pass<'s, 'f> {
    symbols: &'f mut Symbols,
    faults: &'f mut Faults,
    /// Symbols that are assigned other numbers than the text's.
    others: &'f [(usize, i64)],
    layout: Layout<'s>,
    /// Address of the next byte.
    here: u32,
    /// Assignments that mention what is not known yet, with their `*`.
    waiting: Vec<(usize, &'s Expr, i64)>,
    waiting_lines: Vec<u32>,
}

pub(super) fn layout<'s>(
    statements: &'s [Statement],
    others: &[(usize, i64)],
    symbols: &mut Symbols,
    faults: &mut Faults,
) -> Layout<'s> {
    let mut pass = Pass {
        symbols,
        faults,
        others,
        layout: Layout {
            origin: 0,
            placed: Vec::new(),
            end: 0,
        },
        here: 0,
        waiting: Vec::new(),
        waiting_lines: Vec::new(),
    };
    let mut over = None;
    for statement in statements {
        if let Some(label) = statement.label {
            pass.symbols.set(label, i64::from(pass.here));
        }
        if let Some(action) = &statement.action {
            pass.place(statement, action);
        }
        if pass.here > END && over.is_none() {
            over = Some((statement.line, statement.column));
        }
    }
    pass.layout.end = pass.here;
    if let Some((line, column)) = over {
        // What else is wrong may well follow from this.
        let more = pass.here - END;
        let message = format!("the program goes beyond $FFFF, by {more} bytes");
        pass.faults.add(line, column, message);
        return pass.layout;
    }
    let Pass {
        symbols,
        faults,
        layout,
        waiting,
        waiting_lines,
        ..
    } = pass;
    for (i, why) in symbols.settle(&waiting) {
        if let (Some((_, expr, _)), Some(line)) = (waiting.get(i), waiting_lines.get(i)) {
            faults.add(*line, expr.column, why);
        }
    }
    report_unknown(symbols, faults);
    layout
}

/// Every symbol must have a value by now.
fn report_unknown(symbols: &Symbols, faults: &mut Faults) {
    for symbol in symbols.iter().filter(|s| s.value.is_none()) {
        match symbol.defined {
            None => {
                let (line, column) = symbol.used;
                faults.add(line, column, format!("`{}` is not defined", symbol.name));
            }
            Some((line, column)) => {
                let message = format!(
                    "the value of `{}` depends on itself or on an error",
                    symbol.name
                );
                faults.add(line, column, message);
            }
        }
    }
}

impl<'s> Pass<'s, '_> {
    fn now(&self, expr: &Expr) -> Result<i64, NoValue> {
        expr.value(self.symbols, i64::from(self.here))
    }

    /// A value that the layout depends on, so that it must be known already.
    fn needed(&mut self, expr: &Expr, line: u32, limit: u32, what: &str) -> Option<u32> {
        let message = match self.now(expr) {
            Ok(value) => match u32::try_from(value) {
                Ok(value) if value <= limit => return Some(value),
                _ => format!("{what} must be 0 to {limit}; this is {value}"),
            },
            Err(NoValue::Unknown(symbol)) => {
                format!(
                    "`{}` must be defined above, as {what} depends on it",
                    self.symbols.name(symbol)
                )
            }
            Err(NoValue::Wrong(why)) => why.to_owned(),
        };
        self.faults.add(line, expr.column, message);
        None
    }

    fn place(&mut self, statement: &Statement, action: &'s Action) {
        let line = statement.line;
        let (length, output) = match action {
            Action::Origin(expr) => return self.origin(expr, line),
            Action::Assign(symbol, expr) => return self.assign(*symbol, expr, line),
            Action::Bytes(data) => {
                let length = data.iter().map(|d| match d {
                    Datum::Value(_) => 1,
                    Datum::Text(text) => text.len(),
                });
                (length.sum::<usize>() as u32, Output::Bytes(data))
            }
            Action::Words(words) => (2 * words.len() as u32, Output::Words(words)),
            Action::Reserve(count, fill) => {
                let count = self
                    .needed(count, line, END, "the number of bytes")
                    .unwrap_or(0);
                (
                    count,
                    Output::Fill {
                        count,
                        fill: fill.as_ref(),
                    },
                )
            }
            Action::Instruction(mnemonic, operand) => match self.choose(mnemonic, operand) {
                Some((opcode, mode, operand)) => (
                    u32::from(mode.bytes()),
                    Output::Instruction {
                        opcode,
                        mode,
                        operand,
                    },
                ),
                None => {
                    let message = format!("`{mnemonic}` cannot have {}", describe(operand));
                    self.faults.add(line, statement.column, message);
                    return;
                }
            },
        };
        let placed = Placed {
            line,
            address: self.here,
            length,
            output,
        };
        self.layout.placed.push(placed);
        self.here = self.here.saturating_add(length);
    }

    fn origin(&mut self, expr: &Expr, line: u32) {
        let Some(target) = self.needed(expr, line, END - 1, "the origin") else {
            return;
        };
        if !self.layout.placed.is_empty() && target != self.here {
            let message = "the origin cannot move behind the first byte: pad with `.res`";
            self.faults.add(line, expr.column, message);
            return;
        }
        self.here = target;
        if self.layout.placed.is_empty() {
            self.layout.origin = target;
        }
    }

    fn assign(&mut self, symbol: usize, expr: &'s Expr, line: u32) {
        let other = self.others.iter().find(|(other, _)| *other == symbol);
        match other.map_or_else(|| self.now(expr), |(_, value)| Ok(*value)) {
            Ok(value) => self.symbols.set(symbol, value),
            Err(NoValue::Unknown(_)) => {
                self.waiting.push((symbol, expr, i64::from(self.here)));
                self.waiting_lines.push(line);
            }
            Err(NoValue::Wrong(why)) => self.faults.add(line, expr.column, why),
        }
    }

    /// The opcode for an operand: the zero page where its value is known and
    /// below 256, or where there is nothing else.
    fn choose(&self, mnemonic: &str, operand: &'s Operand) -> Option<(u8, Mode, Option<&'s Expr>)> {
        let (modes, expr): (&[Mode], _) = match operand {
            Operand::None => (&[Mode::Implied, Mode::Accumulator], None),
            Operand::Accumulator => (&[Mode::Accumulator], None),
            Operand::Immediate(e) => (&[Mode::Immediate], Some(e)),
            Operand::Indirect(e) => (&[Mode::Indirect], Some(e)),
            Operand::IndirectX(e) => (&[Mode::IndirectX], Some(e)),
            Operand::IndirectY(e) => (&[Mode::IndirectY], Some(e)),
            Operand::Address(e) => (&[Mode::Relative, Mode::ZeroPage, Mode::Absolute], Some(e)),
            Operand::AddressX(e) => (&[Mode::ZeroPageX, Mode::AbsoluteX], Some(e)),
            Operand::AddressY(e) => (&[Mode::ZeroPageY, Mode::AbsoluteY], Some(e)),
        };
        let small = expr
            .and_then(|e| self.now(e).ok())
            .is_some_and(|value| (0..256).contains(&value));
        let zero_page = |m: Mode| matches!(m, Mode::ZeroPage | Mode::ZeroPageX | Mode::ZeroPageY);
        let mut found = modes
            .iter()
            .filter_map(|m| Some((opcodes::find(mnemonic, *m)?, *m)));
        let first = found.next()?;
        let (opcode, mode) = match found.next() {
            Some(wider) if zero_page(first.1) && !small => wider,
            _ => first,
        };
        Some((opcode, mode, expr))
    }
}

fn describe(operand: &Operand) -> &'static str {
    match operand {
        Operand::None => "no operand",
        Operand::Accumulator => "the accumulator as its operand",
        Operand::Immediate(_) => "an immediate operand",
        Operand::Address(_) => "an address as its operand",
        Operand::AddressX(_) => "an operand indexed by x",
        Operand::AddressY(_) => "an operand indexed by y",
        Operand::Indirect(_) => "an indirect operand",
        Operand::IndirectX(_) => "an operand of the form (zp,x)",
        Operand::IndirectY(_) => "an operand of the form (zp),y",
    }
}
