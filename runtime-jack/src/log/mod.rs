//! Logarithmic reals: the runtime for Jack in which a product costs an addition.
//!
//! A real is held as 1024 times the binary logarithm of its magnitude, in an int,
//! and a sign. What a sum adds to the greater logarithm is looked up in a table of
//! 6,144 entries, what a difference takes away in another; the program makes both at
//! its start. Sums are right to 0.7 of the last place, 4.8e-4 of themselves, and
//! differences of near values to 1.2; products, quotients and powers of two are exact. Magnitudes end at 2^16
//! above and 2^-13 below, which stands for 0; so lengths of vectors end at 2^8, where their
//! squares do, and a 0 has the sign that it came with.
//!
//! # How a routine is written
//! As for Floats, but that a [`Form::Statement`](slowlight_routine::Form::Statement) is
//! whole statements of Jack, a line each: `{0}`, `{1}` and `{r}` are the logarithms of
//! the arguments and the result, `{0+}`, `{1+}` and `{r+}` their signs, true for plus.
//! Whoever writes them leaves out a sign that the ranges know. The result may share the
//! variables of an argument.

mod functions;
mod loose;
pub mod model;
mod routines;
mod tables;
#[cfg(test)]
mod tests;

use self::model::Log;
use crate::{INT, param_digits, parts};
use slowlight_routine::{Bits, Format, Range, Runtime, Value};

/// The format of the reals.
pub const LOG: Format = Format::Log { frac: 10 };

/// The runtime of logarithmic reals, ten bits behind the point.
pub static LOG10: Runtime = Runtime {
    name: "jack",
    format: "log10",
    real: LOG,
    int: INT,
    routines: &routines::ALL,
    parts: parts::ALL,
    encode,
    decode,
    shifted: slowlight_routine::scale::shifted,
    quotient: 65536.0,
    stepping: None,
    segments: false,
    reciprocals: false,
    derives: false,
    kept,
    loose: Some(loose::LOOSE),
    statement: 4,
    index: 0,
    param_most: crate::model::MOST as f64,
    param_digits,
    param_bits,
};

/// The nearest bits, saturating.
fn encode(value: Value, format: Format) -> Bits {
    match format {
        Format::Log { .. } => Log::nearest(value.real()).bits(),
        _ => (crate::F316.encode)(value, format),
    }
}

fn decode(bits: Bits, format: Format) -> Value {
    match format {
        Format::Log { .. } => Value::Real(Log::from_bits(bits).value()),
        _ => (crate::F316.decode)(bits, format),
    }
}

/// The program takes one logarithm from the other.
fn param_bits(scaled: i64, digits: u8) -> Bits {
    let most = i64::from(crate::model::MOST);
    let of = |n: i64| Log::from_int(n.clamp(-most, most) as i32);
    of(scaled)
        .div(of(10i64.saturating_pow(u32::from(digits))))
        .bits()
}

/// The sign that a range holds alone, true for plus. 0 is held as a small number above it.
pub fn known_sign(range: Range) -> Option<bool> {
    match range {
        range if range.lo >= 0.0 => Some(true),
        range if range.hi < 0.0 => Some(false),
        _ => None,
    }
}

/// A sign that is known is not kept: programs write it where they read it.
fn kept(bits: Bits, range: Range) -> Bits {
    match known_sign(range) {
        Some(plus) => {
            let log = Log::from_bits(bits).log;
            Log { plus, log }.bits()
        }
        None => bits,
    }
}
