//! Fixed point in 16 bits, where each value has its own number of fraction bits: a sum
//! is one addition of the machine's.
//!
//! A real is an int from -32767 to 32767 at a scale that the plan chooses for it
//! ([`slowlight_routine::scale`]). Sums, comparisons, least and greatest are those of ints,
//! since their operands are read at one scale. A product is put together from four of
//! bytes, rounded to its 15 upper bits; a quotient is divided out bit by bit; a root is
//! looked up in a table of 193 entries, and interpolated.
//!
//! What leaves 16 bits saturates, if the ranges do not prove that it cannot.
//!
//! # How a routine is written
//! As for ints, with the number that scales come to at `{n}`
//! ([`slowlight_routine::scale`]). [`read`] writes an operand at another scale.

pub mod functions;
pub mod model;
mod routines;
#[cfg(test)]
pub(crate) mod tests;

use crate::{INT, SUM, TERM, param_digits, parts};
use slowlight_routine::scale::{self, Scales};
use slowlight_routine::{Bits, Format, Overhead, Runtime, Value};

/// Bits of a real.
pub const BITS: u8 = 16;

/// The format of the reals.
pub const REAL: Format = Format::Scaled { bits: BITS };

/// The runtime of fixed-point reals.
pub static FIXED16: Runtime = Runtime {
    name: "jack",
    format: "fixed16",
    real: REAL,
    int: INT,
    routines: &routines::ALL,
    parts: parts::ALL,
    encode,
    decode,
    shifted: slowlight_routine::scale::shifted,
    quotient: f64::INFINITY,
    overhead: Overhead {
        read: [0, 1],
        write: [4; 2],
        test: 4,
        index: 4,
        ..Overhead::NONE
    },
    segments: false,
    reciprocals: true,
    middle: false,
    narrow: None,
    derives: false,
    kept: slowlight_routine::whole,
    loose: None,
    param_most: crate::model::MOST as f64,
    param_digits,
    param_bits: |scaled, _| scaled as Bits,
};

/// The nearest bits, saturating; of a real without a scale, those of its int.
fn encode(value: Value, format: Format) -> Bits {
    match format {
        Format::Fixed { bits, frac } => scale::nearest(value.real(), frac, bits),
        Format::Scaled { bits } => scale::nearest(value.real(), 0, bits),
        _ => (crate::F316.encode)(value, format),
    }
}

fn decode(bits: Bits, format: Format) -> Value {
    let real = |frac: i8| f64::from(crate::model::int(bits)) * (-f64::from(frac)).exp2();
    match format {
        Format::Fixed { frac, .. } => Value::Real(real(frac)),
        Format::Scaled { .. } => Value::Real(real(0)),
        _ => (crate::F316.decode)(bits, format),
    }
}

/// An operand read with so many more fraction bits, and how tightly that binds; `fits` says
/// that it is known not to leave 16 bits. What part of the runtime it needs, if any.
pub fn read((text, level): (&str, u8), by: i32, fits: bool) -> (String, u8, Option<&'static str>) {
    let term = match level {
        TERM => text.to_owned(),
        _ => format!("({text})"),
    };
    match by {
        0 => (text.to_owned(), level, None),
        // As dear as a product on the VM, and much cheaper on the processor.
        1 if fits && is_name(text) => (format!("{text} + {text}"), SUM, None),
        1..15 if fits => (format!("{term} * {}", 1 << by), SUM, None),
        1.. => {
            let (most, unit) = match by {
                1..15 => (32767 >> by, 1 << by),
                _ => (0, 0),
            };
            let call = format!("Fixed.left({text}, {most}, {unit})");
            (call, TERM, Some("Fixed.left"))
        }
        -15..0 => {
            let call = format!("Fixed.right({text}, {})", 1 << (-by - 1));
            (call, TERM, Some("Fixed.right"))
        }
        // Less than half of the last place.
        _ => ("0".to_owned(), TERM, None),
    }
}

fn is_name(text: &str) -> bool {
    text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// A routine's text with what its number comes to; a, b and r are the scales of the
/// operands and of the result, where that is all of them.
pub fn filled(template: &str, n: i32) -> String {
    let power = |by: i32| (1i32 << by.clamp(0, 14)).to_string();
    let scales = Scales::unpacked(n);
    let [a, b] = scales.args.map(i32::from);
    let r = i32::from(scales.result);
    [
        ("{r}", r.to_string()),
        ("{14-a}", (14 - a).to_string()),
        ("{2^(13-a)}", power(13 - a)),
        ("{2^(15-a)}", power(15 - a)),
        ("{2^(a-5)}", power(a - 5)),
        ("{2^(15-b)}", power(15 - b)),
        ("{2^(b-5)}", power(b - 5)),
        ("{2^(r-10)}", power(r - 10)),
        (
            "{32767/2^(r-10)}",
            (32767 >> (r - 10).clamp(0, 15)).to_string(),
        ),
        ("{2^(14-r)}", power(14 - r)),
        ("{2^(9-r)}", power(9 - r)),
        ("{2^(-r-1)}", power(-r - 1)),
        ("{n}", n.to_string()),
        ("{2^n}", power(n)),
        ("{2^(n-17)}", power(n - 17)),
        ("{2^(13-n)}", power(13 - n)),
        ("{2^(16-n)}", power(16 - n)),
        ("{2^(n-9)}", power(n - 9)),
        (
            "{2^(15-n)}",
            if n > 0 { power(15 - n) } else { "0".to_owned() },
        ),
        (
            "{32767/2^(15-n)}",
            (32767 >> (15 - n).clamp(0, 15)).to_string(),
        ),
        ("{2^((14-n)/2)}", power((14 - n) / 2)),
        ("{2^((15-n)/2)}", power((15 - n) / 2)),
        ("{2^((16-n)/2)}", power((16 - n) / 2)),
    ]
    .into_iter()
    .fold(template.to_owned(), |text, (hole, made)| {
        text.replace(hole, &made)
    })
}
