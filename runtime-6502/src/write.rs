//! Writes the use of a routine as lines of assembly.

use slowlight_routine::{Bits, Form, Format, Routine};

/// Where an argument is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// In memory, low byte first, from this symbol on.
    At(String),
    /// Nowhere: its bits are known.
    Constant(Bits),
}

/// Where a result goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Goal<'a> {
    /// Into memory from this symbol on.
    At(&'a str),
    /// Only for bools: it stays in the carry flag.
    Carry,
}

/// Bytes of a value in memory.
pub fn size(format: Format) -> u8 {
    match format {
        Format::Bool => 1,
        _ => 4,
    }
}

/// Byte `k` of what lies at a symbol.
pub fn byte_at(symbol: &str, k: u8) -> String {
    if k == 0 {
        symbol.to_owned()
    } else {
        format!("{symbol}+{k}")
    }
}

/// An operand for byte `k` of a place.
pub fn byte(place: &Place, k: u8) -> String {
    match place {
        Place::At(symbol) => byte_at(symbol, k),
        Place::Constant(bits) => format!("#${:02x}", (bits >> (8 * u32::from(k))) & 0xFF),
    }
}

/// Copies a value into memory.
pub fn copy(from: &Place, to: &str, format: Format, lines: &mut Vec<String>) {
    let mut held = None;
    for k in 0..size(format) {
        let operand = byte(from, k);
        if held.as_ref() != Some(&operand) {
            lines.push(format!("        lda {operand}"));
        }
        lines.push(format!("        sta {}", byte_at(to, k)));
        // An immediate operand stays in the accumulator for the next byte.
        held = matches!(from, Place::Constant(_)).then_some(operand);
    }
}

/// Stores the carry flag as a bool.
pub fn store_carry(to: &str, lines: &mut Vec<String>) {
    lines.push("        lda #0".to_owned());
    lines.push("        rol".to_owned());
    lines.push(format!("        sta {to}"));
}

/// The instructions that compute a routine. `serial` must differ at each use in a program.
pub fn instructions(
    routine: &Routine,
    args: &[Place],
    goal: &Goal<'_>,
    serial: u32,
    lines: &mut Vec<String>,
) {
    let Form::Statement(text) = routine.form else {
        return;
    };
    if text.contains(char::is_whitespace) {
        template(text, args, goal, serial, lines);
    } else {
        operands(routine, args, lines);
        lines.push(format!("        jsr {text}"));
        if let (Goal::At(to), false) = (goal, routine.result == Format::Bool) {
            copy(&Place::At("acc".to_owned()), to, routine.result, lines);
        }
    }
    if let (Goal::At(to), Format::Bool) = (goal, routine.result) {
        store_carry(to, lines);
    }
}

/// Copies a subroutine's operands to where it wants them.
fn operands(routine: &Routine, args: &[Place], lines: &mut Vec<String>) {
    if let [a @ Place::At(_), b] = args
        && a == b
    {
        // A square: each byte is loaded once.
        for k in 0..4 {
            lines.push(format!("        lda {}", byte(a, k)));
            lines.push(format!("        sta {}", byte_at("acc", k)));
            lines.push(format!("        sta {}", byte_at("arg", k)));
        }
        return;
    }
    for ((place, format), to) in args.iter().zip(routine.args).zip(["acc", "arg"]) {
        copy(place, to, *format, lines);
    }
}

/// Fills in a template's places.
fn template(text: &str, args: &[Place], goal: &Goal<'_>, serial: u32, lines: &mut Vec<String>) {
    let instructions = text
        .split(['|', '\n'])
        .map(str::trim)
        .filter(|i| !i.is_empty());
    for line in instructions {
        let mut filled = String::new();
        let mut rest = line;
        while let Some((before, behind)) = rest.split_once('{') {
            let (inside, after) = behind.split_once('}').unwrap_or((behind, ""));
            filled.push_str(before);
            filled.push_str(&placeholder(inside, args, goal, serial));
            rest = after;
        }
        filled.push_str(rest);
        let indent = if filled.ends_with(':') {
            ""
        } else {
            "        "
        };
        lines.push(format!("{indent}{filled}"));
    }
}

fn placeholder(inside: &str, args: &[Place], goal: &Goal<'_>, serial: u32) -> String {
    let Some((which, k)) = inside.split_once('.') else {
        return serial.to_string();
    };
    let k = k.parse().unwrap_or(0);
    match (which.parse::<usize>(), goal) {
        (Ok(arg), _) => args
            .get(arg)
            .map_or_else(String::new, |place| byte(place, k)),
        (Err(_), Goal::At(to)) => byte_at(to, k),
        (Err(_), Goal::Carry) => String::new(),
    }
}
