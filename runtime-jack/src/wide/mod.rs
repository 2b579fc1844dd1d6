//! Floats of four words, "Float416": sign, exponent, and a mantissa of 28 bits in two words.
//!
//! What the floats of three words ([`crate::model`]) have in 14 bits is here in 28: sums,
//! products, quotients and roots are rounded, to a little more than half a unit in the last
//! place, and functions are off by a few. Exponents have the same ends. It takes about twice the
//! commands, and pictures are those of `f64` but for single pixels.
//!
//! The class has the same name, and what is in an object is the same, with the mantissa's
//! lower word behind the others.

pub mod model;
mod parts;
mod routines;
#[cfg(test)]
mod tests;

use crate::F316R;
use model::Wide;
use slowlight_routine::{Bits, Format, Runtime, Value};

/// The format of the reals.
pub const REAL: Format = Format::Float416;

/// The runtime of reals in Float416.
pub static F416: Runtime = Runtime {
    format: "f416",
    real: REAL,
    routines: &routines::ALL,
    parts: parts::ALL,
    encode,
    decode,
    param_bits,
    reciprocals: true,
    ..crate::CUT
};

/// The nearest bits, saturating.
fn encode(value: Value, format: Format) -> Bits {
    match format {
        REAL => Wide::nearest(value.real()).bits(),
        _ => (F316R.encode)(value, format),
    }
}

fn decode(bits: Bits, format: Format) -> Value {
    match format {
        REAL => Value::Real(Wide::from_bits(bits).value()),
        _ => (F316R.decode)(bits, format),
    }
}

/// The program divides the two ints as reals.
fn param_bits(scaled: i64, digits: u8) -> Bits {
    let [scaled, unit] = crate::param_ints(scaled, digits);
    Wide::from_int(scaled).div(Wide::from_int(unit)).bits()
}
