//! The params: scaled integers in the parameter block, checked once at the
//! start and made what the program computes with.

use super::homes::Homes;
use super::logs;
use super::memory::Machine;
use super::slots::Slot;
use super::syntax::Syntax;
use super::{Text, bbc, c64};
use crate::ir::graph::*;
use crate::plan::Plan;
use slowlight_routine::{Format, Type};
use slowlight_runtime_6502::write::{self, Place as Operand};

/// What is written into the table of params.
pub(super) struct Entry {
    /// Its symbol in the parameter block, and where its value goes.
    pub symbol: String,
    pub slot: Slot,
    /// The value as written, and what it may be.
    pub text: String,
    pub least: String,
    pub greatest: String,
    pub unit: String,
    /// What to divide it by for a real; 0 for an int, or where its bits are written.
    pub divisor: u32,
    /// Whether it is a logarithm: three bytes.
    pub log: bool,
    /// Whether it floats, in five bytes; the last one where its bits are written, as the value's
    /// four are the others.
    pub float: Option<u8>,
    /// The fraction bits of a real that has its own.
    pub scale: Option<i8>,
}

impl Entry {
    /// Whether it is divided, where its point is its own.
    fn is_divided(&self) -> bool {
        self.divisor > 1 && self.scale.is_some_and(|scale| scale >= 0)
    }

    /// The parts of the runtime that it is taken with.
    pub fn needs(&self, plan: &Plan) -> Option<&'static str> {
        match plan.points() {
            None => (self.divisor > 0).then_some(match plan.runtime.real {
                Format::Log { .. } => "log_param",
                Format::Real40 => "float_ratio",
                _ => "fixed_divide",
            }),
            Some(_) => {
                let [divide, hold] = match is_long(plan) {
                    true => ["divide24", "hold24"],
                    false => ["divide16", "narrow"],
                };
                match self.is_divided() {
                    true => Some(divide),
                    false => self.scale.map(|_| hold),
                }
            }
        }
    }
}

/// What a program calls the first and the last row to draw: that for other rows is the same, but
/// for these numbers.
pub const ROWS: [&str; 2] = ["first_row", "last_row"];

pub(super) fn entries(plan: &Plan, homes: &Homes) -> Vec<Entry> {
    let bound = |text: Option<&String>, end: i32| {
        let parsed = text
            .and_then(|t| t.parse::<i64>().ok())
            .unwrap_or(i64::from(end));
        parsed
            .clamp(i64::from(i32::MIN), i64::from(i32::MAX))
            .to_string()
    };
    let mut all: Vec<Entry> = Vec::new();
    for (k, (p, symbol)) in plan.params.iter().zip(&homes.params).enumerate() {
        let role = plan.graph.params.get(k).map(|p| p.role);
        if matches!(role, Some(Role::Input(_))) {
            continue;
        }
        let digits = u32::from(p.digits.unwrap_or(0));
        let real = plan.graph.params.get(k).is_some_and(|p| p.ty == Type::Real);
        all.push(Entry {
            symbol: symbol.clone(),
            slot: Slot::Param(k as u32),
            text: p.text.clone(),
            least: bound(p.range.as_ref().map(|r| &r.0), i32::MIN),
            greatest: bound(p.range.as_ref().map(|r| &r.1), i32::MAX),
            unit: unit(real, digits),
            // Without digits it is the number's bits that are written.
            divisor: match p.digits {
                Some(_) if real => 10u32.saturating_pow(digits),
                _ => 0,
            },
            log: real && logs::are(plan),
            float: Some((p.bits >> 32) as u8)
                .filter(|_| real && plan.runtime.real == Format::Real40),
            scale: match p.digits {
                // The number's bits are at its own scale as they are.
                None => Some(0).filter(|_| real && plan.points().is_some()),
                Some(_) => scale(plan, ParamId(k as u32)).filter(|_| real),
            },
        });
    }
    let shown = plan.shown_rows();
    let rows = [(false, plan.rows.0), (true, plan.rows.1)];
    for ((is_last, row), name) in rows.into_iter().zip(ROWS) {
        all.push(Entry {
            symbol: name.to_owned(),
            slot: Slot::Rows(is_last),
            text: row.to_string(),
            least: shown.0.to_string(),
            greatest: shown.1.to_string(),
            unit: "a row".to_owned(),
            divisor: 0,
            log: false,
            float: None,
            scale: None,
        });
    }
    all
}

/// The fraction bits of a param that has its own.
fn scale(plan: &Plan, param: ParamId) -> Option<i8> {
    let points = plan.points()?;
    let is = |id: &NodeId| plan.graph.node(*id) == Node::Param(param);
    Some(plan.graph.ids().find(is).map_or(0, |id| points.own(id)))
}

/// Whether reals with points of their own have three bytes.
fn is_long(plan: &Plan) -> bool {
    write::size(plan.runtime.real) > 2
}

/// Makes a real with a point of its own of the whole number in `acc`.
fn made(plan: &Plan, entry: &Entry, scale: i8, home: &str) -> String {
    if is_long(plan) {
        let (take, from) = match (entry.is_divided(), scale) {
            (true, _) => (
                format!("ldy #{scale} | jsr divide24 | sta prod+5"),
                "prod+3",
            ),
            (false, 0..) => (format!("ldy #{scale} | jsr narrow24_left"), "acc"),
            (false, _) => (
                format!("ldy #{} | jsr narrow24_right", -i32::from(scale)),
                "acc",
            ),
        };
        let mut lines = Vec::new();
        write::copy_bytes(&Operand::At(from.to_owned()), home, 3, &mut lines);
        return format!("jsr take_param | {take} | {}", lines.join(" | "));
    }
    let take = match (entry.is_divided(), scale) {
        (true, _) => format!("ldy #{scale} | jsr divide16"),
        (false, 0..) => format!("ldy #{scale} | jsr narrow_left"),
        (false, _) => format!("ldy #{} | jsr narrow_right", -i32::from(scale)),
    };
    format!("jsr take_param | {take} | sta {home} | stx {home}+1")
}

fn unit(real: bool, digits: u32) -> String {
    match (real, digits) {
        (true, 1) => "tenths".to_owned(),
        (true, 2) => "hundredths".to_owned(),
        (true, 3) => "thousandths".to_owned(),
        (true, d) => format!("the value times 10^{d}"),
        (false, _) => "a whole number".to_owned(),
    }
}

/// The check of the params, and their making.
pub(super) fn take_params(
    plan: &Plan,
    homes: &Homes,
    entries: &[Entry],
    syntax: &Syntax,
    text: &mut Text,
) {
    text.headline("the parameters, checked and made numbers of the runtime's");
    let which = homes.name(Slot::Which);
    text.label("take_params");
    for (k, entry) in entries.iter().enumerate() {
        let home = homes.name(entry.slot);
        let number = (k + 1).min(255);
        text.line(format!("        ; {}", entry.symbol));
        text.code(&format!(
            "lda #<(param{k}) | sta prod | lda #>(param{k}) | sta prod+1 | lda #{number}"
        ));
        if let Some(scale) = entry.scale {
            text.code(&made(plan, entry, scale, home));
            continue;
        }
        if let Some(exponent) = entry.float {
            text.code("jsr take_param");
            let mut lines = Vec::new();
            match entry.divisor {
                0 => {
                    write::copy_bytes(&Operand::At("acc".to_owned()), home, 4, &mut lines);
                    lines.push(format!("        lda #${exponent:02x}"));
                    lines.push(format!("        sta {home}+4"));
                }
                _ => write::copy_bytes(&Operand::At("fa".to_owned()), home, 5, &mut lines),
            }
            lines.iter().for_each(|line| text.line(line));
            continue;
        }
        text.code(&format!(
            "jsr take_param | lda acc | sta {home} | lda acc+1 | sta {home}+1"
        ));
        text.code(&format!("lda acc+2 | sta {home}+2"));
        if !entry.log {
            text.code(&format!("lda acc+3 | sta {home}+3"));
        }
    }
    text.code("rts");
    let divide = entries.iter().any(|e| e.divisor > 0);
    let template = if divide { TAKE_REAL } else { TAKE_INT };
    let machine = Machine::of(plan);
    let take = TAKE.replace("WHICH", which);
    text.line(match machine {
        Machine::Plain => take,
        _ => take.replace("sta exit_port", "jmp wrong_param"),
    });
    // Where points are the params' own, they are divided by who knows them.
    let template = match plan.points() {
        Some(_) => template.replace("jmp fixed_divide", "rts"),
        None => template.replace(
            "fixed_divide",
            match plan.runtime.real {
                Format::Log { .. } => "log_ratio",
                Format::Real40 => "float_ratio",
                _ => "fixed_divide",
            },
        ),
    };
    text.line(template);
    if machine != Machine::Plain {
        text.label("wrong_param");
    }
    match machine {
        Machine::Plain => {}
        Machine::Bbc => bbc::wrong(text),
        Machine::C64 => c64::wrong(text),
    }
    for (k, entry) in entries.iter().enumerate() {
        let symbol = &entry.symbol;
        text.line(format!(
            "param{k}:{:20}; {symbol}: value, least, greatest, divisor",
            ""
        ));
        text.line(format!("        .byte {}", value_bytes(entry, syntax)));
        let numbers = [&entry.least, &entry.greatest, &entry.divisor.to_string()];
        for number in numbers.map(|n| n.parse::<i64>().unwrap_or(0)) {
            let [a, b, c, d, ..] = number.to_le_bytes();
            text.line(format!("        .byte {a}, {b}, {c}, {d}"));
        }
    }
}

/// The four bytes of a param's value, of its symbol where the assembler can tell
/// them from that.
fn value_bytes(entry: &Entry, syntax: &Syntax) -> String {
    let (symbol, bits) = (&entry.symbol, syntax.symbol_bits);
    let value = entry.text.parse::<i64>().unwrap_or(0);
    let half = 1i64 << (bits - 1);
    if bits >= 32 {
        format!("<({symbol}), >({symbol}), <(({symbol}) >> 16), <(({symbol}) >> 24)")
    } else if (-half..half).contains(&value) {
        let sign = format!("<(0-(({symbol}) >> {}))", bits - 1);
        format!("<({symbol}), >({symbol}), <(({symbol}) >> 16), {sign}")
    } else {
        let [a, b, c, d, ..] = value.to_le_bytes();
        format!("{a}, {b}, {c}, {d}")
    }
}

/// The check of one param.
const TAKE: &str = "
; acc = the parameter whose entry prod points to; its number is in a
take_param:
        sta WHICH
        ldy #3
take_value:
        lda (prod),y
        sta acc,y
        dey
        bpl take_value
        ldy #4                      ; below the least?
        lda acc
        cmp (prod),y
        iny
        lda acc+1
        sbc (prod),y
        iny
        lda acc+2
        sbc (prod),y
        iny
        lda acc+3
        sbc (prod),y
        bvc take_least
        eor #$80
take_least:
        bmi take_wrong
        ldy #8                      ; above the greatest?
        lda (prod),y
        cmp acc
        iny
        lda (prod),y
        sbc acc+1
        iny
        lda (prod),y
        sbc acc+2
        iny
        lda (prod),y
        sbc acc+3
        bvc take_greatest
        eor #$80
take_greatest:
        bpl take_right
take_wrong:
        lda WHICH
        sta exit_port
take_right:";

/// Reals are divided; ints have the divisor 0.
const TAKE_REAL: &str = "        ldy #12
        lda (prod),y
        sta arg
        iny
        lda (prod),y
        sta arg+1
        iny
        lda (prod),y
        sta arg+2
        iny
        lda (prod),y
        sta arg+3
        ora arg+2
        ora arg+1
        ora arg
        beq take_int
        jmp fixed_divide
take_int:
        rts
";

const TAKE_INT: &str = "        rts\n";
