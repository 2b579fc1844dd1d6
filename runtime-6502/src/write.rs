//! Writes the use of a routine as lines of assembly.

use crate::fill::template;
use crate::{log, scaled};
use slowlight_routine::{Bits, Form, Format, Range, Routine};

/// Where an argument is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// In memory, low byte first, from this symbol on.
    At(String),
    /// There in fewer bytes.
    Held(String, Shape),
    /// A logarithm there, in two bytes, of a real whose sign is known: true for plus.
    Signed(String, bool),
    /// Nowhere: its bits are known.
    Constant(Bits),
}

/// In how many bytes a number is kept, and what these tell of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shape {
    /// How many there are.
    pub bytes: u8,
    /// Whether the number may be below 0; if not, all further bytes are 0.
    pub signed: bool,
    /// Whether the upper bit tells the sign, where the number is never below 0.
    pub spare: bool,
}

impl Shape {
    /// The fewest bytes for a range of whole numbers.
    pub fn of(range: Range, most: u8) -> Shape {
        let signed = range.lo < 0.0;
        let room = |bytes: u8, bits: i32| f64::from(i32::from(bytes) * 8 - bits).exp2();
        let fits = |bytes: &u8| match signed {
            true => range.within(-room(*bytes, 1), room(*bytes, 1) - 1.0),
            false => range.hi <= room(*bytes, 0) - 1.0,
        };
        let bytes = (1..most).find(fits).unwrap_or(most);
        let spare = !signed && range.hi <= room(bytes, 1) - 1.0;
        // What fills all bytes has a sign as its format has.
        let signed = signed || bytes == most && !spare;
        Shape {
            bytes,
            signed,
            spare,
        }
    }

    /// All bytes of a number that may be negative.
    pub fn whole(bytes: u8) -> Shape {
        Shape {
            bytes,
            signed: true,
            spare: false,
        }
    }

    /// Bytes that are needed to see the sign.
    pub(crate) fn needed(self) -> u8 {
        self.bytes + u8::from(!self.signed && !self.spare)
    }
}

impl Place {
    /// How it is kept, where a whole number has so many bytes.
    pub(crate) fn shape(&self, most: u8) -> Shape {
        match self {
            Place::At(_) => Shape::whole(most),
            Place::Held(_, shape) => *shape,
            Place::Signed(..) => Shape::whole(most),
            Place::Constant(bits) => Shape::of(Range::point(*bits as i64 as f64), most),
        }
    }
}

/// Where a result goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Goal<'a> {
    /// Into memory from this symbol on.
    At(&'a str),
    /// The same, but only so many bytes.
    Held(&'a str, u8),
    /// Only for bools: it stays in the carry flag.
    Carry,
}

/// Bytes of a value in memory.
pub fn size(format: Format) -> u8 {
    match format {
        Format::Bool => 1,
        Format::Fixed { bits, .. } | Format::Scaled { bits } | Format::Int { bits } => bits / 8,
        // The sign last.
        Format::Log { .. } => 3,
        Format::Real40 => 5,
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
        Place::Held(symbol, shape) if k < shape.bytes => byte_at(symbol, k),
        Place::Held(..) => "#$00".to_owned(),
        Place::Signed(symbol, _) if k < 2 => byte_at(symbol, k),
        Place::Signed(_, plus) => format!("#${:02x}", u8::from(!plus)),
        Place::Constant(bits) => format!("#${:02x}", (bits >> (8 * u32::from(k))) & 0xFF),
    }
}

/// Copies a value into memory: so many bytes of it, extended where it has fewer.
pub fn copy_bytes(from: &Place, to: &str, bytes: u8, lines: &mut Vec<String>) {
    let own = match from {
        Place::Held(_, shape) if shape.signed => shape.bytes.min(bytes),
        _ => bytes,
    };
    let mut held = None;
    for k in 0..own {
        let operand = byte(from, k);
        if held.as_ref() != Some(&operand) {
            lines.push(format!("        lda {operand}"));
        }
        lines.push(format!("        sta {}", byte_at(to, k)));
        // An immediate operand stays in the accumulator for the next byte.
        held = operand.starts_with('#').then_some(operand);
    }
    if own < bytes {
        // 0 or $ff by the sign, which is the carry's now.
        for line in ["asl", "lda #0", "adc #$ff", "eor #$ff"] {
            lines.push(format!("        {line}"));
        }
        for k in own..bytes {
            lines.push(format!("        sta {}", byte_at(to, k)));
        }
    }
}

/// Copies a value into memory.
pub fn copy(from: &Place, to: &str, format: Format, lines: &mut Vec<String>) {
    copy_bytes(from, to, size(format), lines);
}

/// Adds a number that is known to one in memory: bytes that stay as they are are not
/// touched, and what the carry alone may change only where there is one.
pub fn add_constant(to: &str, bytes: u8, constant: Bits, serial: u32, lines: &mut Vec<String>) {
    let part = |k: u8| (constant >> (8 * u32::from(k))) & 0xFF;
    let at = |k: u8| byte_at(to, k);
    let mut code = |text: String| {
        let indent = if text.ends_with(':') { "" } else { "        " };
        lines.push(format!("{indent}{text}"));
    };
    let Some(first) = (0..bytes).find(|k| part(*k) != 0) else {
        return;
    };
    let above = |fill: Bits| {
        (first + 1..bytes)
            .rev()
            .take_while(|k| part(*k) == fill)
            .count()
    };
    let (zeros, ones) = (above(0), above(0xFF));
    let lent = |k: u8| format!("borrow{}{serial}", ["a", "b", "c", "d"][usize::from(k & 3)]);
    let end = bytes - zeros.max(ones) as u8;
    for k in first..end {
        if k == first {
            code("clc".to_owned());
        }
        code(format!("lda {}", at(k)));
        code(format!("adc #${:02x}", part(k)));
        code(format!("sta {}", at(k)));
    }
    if end == bytes {
        return;
    }
    if ones > zeros {
        // Less 1, but for the carry.
        code(format!("bcs stepped{serial}"));
        for k in end..bytes - 1 {
            code(format!("lda {}", at(k)));
            code(format!("bne {}", lent(k)));
        }
        for k in (end..bytes).rev() {
            if k < bytes - 1 {
                code(format!("{}:", lent(k)));
            }
            code(format!("dec {}", at(k)));
        }
    } else {
        code(format!("bcc stepped{serial}"));
        for k in end..bytes {
            code(format!("inc {}", at(k)));
            if k < bytes - 1 {
                code(format!("bne stepped{serial}"));
            }
        }
    }
    code(format!("stepped{serial}:"));
}

/// Stores the carry flag as a bool.
pub fn store_carry(to: &str, lines: &mut Vec<String>) {
    lines.push("        lda #0".to_owned());
    lines.push("        rol".to_owned());
    lines.push(format!("        sta {to}"));
}

/// The use of a routine.
#[derive(Clone, Copy, Debug)]
pub struct Use<'a> {
    /// What is computed.
    pub routine: &'a Routine,
    /// Its operands.
    pub args: &'a [Place],
    /// Where the result goes.
    pub goal: &'a Goal<'a>,
    /// Must differ at each use in a program.
    pub serial: u32,
    /// What a routine has to know of its values' points ([`slowlight_routine::scale`]).
    pub number: i32,
    /// Whether what may be written out is called.
    pub calls: bool,
}

/// The instructions that compute a routine; answers what part of the runtime they need
/// beside those of the routine, if any.
pub fn instructions(used: Use<'_>, lines: &mut Vec<String>) -> Option<&'static str> {
    let Form::Statement(text) = used.routine.form else {
        return None;
    };
    let (square, same) = match used.args {
        [a, b] if a == b => {
            let whole = (text == "fixed_multiply").then_some(("fixed_square", "fixed_square"));
            (scaled::squared(text).or(whole), log::same(text))
        }
        _ => (None, None),
    };
    let short = scaled::short(text, full_of(used.routine)).filter(|_| used.calls);
    let made = square.or(short);
    let text = same.or(made.map(|s| s.0)).unwrap_or(text);
    let looked_up = text
        .contains("look ")
        .then(|| log::looked_up(text, used.calls));
    let text = looked_up.as_deref().unwrap_or(text);
    let need = made.map(|s| s.1);
    let (routine, full) = (used.routine, size(used.routine.result));
    let (to, bytes) = match *used.goal {
        Goal::At(to) => (Some(to), full),
        Goal::Held(to, bytes) => (Some(to), bytes),
        Goal::Carry => (None, full),
    };
    if let (Some(made), Some(to), [from, ..]) = (text.strip_prefix('!'), to, used.args) {
        match made {
            "floor" => scaled::floor((from, full_of(routine)), used.number, (to, bytes), lines),
            _ => copy_bytes(&held_in(from, full_of(routine)), to, bytes, lines),
        }
    } else if text.contains(char::is_whitespace) {
        template(text, used, bytes, lines);
    } else {
        let count = match square {
            Some(_) => 1,
            None => used.args.len(),
        };
        operands(routine, used.args.get(..count).unwrap_or_default(), lines);
        lines.push(format!("        jsr {text}"));
        if let (Some(to), false) = (to, routine.result == Format::Bool) {
            let [result, _] = accumulators(routine.result);
            copy_bytes(&Place::At(result.to_owned()), to, bytes, lines);
        }
    }
    if let (Some(to), Format::Bool) = (to, routine.result) {
        store_carry(to, lines);
    }
    need
}

/// Bytes of a routine's first operand.
pub(crate) fn full_of(routine: &Routine) -> u8 {
    routine.args.first().map_or(4, |format| size(*format))
}

/// A number of so many bytes, to be extended.
fn held_in(from: &Place, bytes: u8) -> Place {
    match from {
        Place::At(symbol) => Place::Held(symbol.clone(), Shape::whole(bytes)),
        other => other.clone(),
    }
}

/// Where a subroutine has its operands of a format, and in the first of them its result.
fn accumulators(format: Format) -> [&'static str; 2] {
    match format {
        Format::Real40 => ["fa", "fb"],
        _ => ["acc", "arg"],
    }
}

/// Copies a subroutine's operands to where it wants them.
fn operands(routine: &Routine, args: &[Place], lines: &mut Vec<String>) {
    if let [a @ Place::At(_), b] = args
        && a == b
    {
        // A square: each byte is loaded once.
        let format = routine.args.first().copied().unwrap_or(routine.result);
        let bytes = size(format).max(4);
        for k in 0..bytes {
            lines.push(format!("        lda {}", byte(a, k)));
            for to in accumulators(format) {
                lines.push(format!("        sta {}", byte_at(to, k)));
            }
        }
        return;
    }
    for (k, (place, format)) in args.iter().zip(routine.args).take(2).enumerate() {
        copy(place, accumulators(*format)[k], *format, lines);
    }
}

/// By how many bits the reciprocal of a divisor that needs no shift is longer than the
/// quotient of the first operand, a power of two, in so many bits.
pub fn shift_of_one(one: Option<&Place>, number: i32, bits: i32) -> i32 {
    let one = match one {
        Some(Place::Constant(bits)) => bits.trailing_zeros() as i32,
        _ => 0,
    };
    2 * bits - 1 - one - number
}
