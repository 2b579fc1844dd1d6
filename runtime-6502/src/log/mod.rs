//! Logarithmic reals: the runtime for the 6502 in which a product costs an addition.
//!
//! What the format means is in [`slowlight_routine::log`]: the same numbers as in Jack. Here a
//! real is three bytes: its logarithm, low byte first, and a sign, 1 where it is below 0; of a
//! real whose sign the ranges know the third is neither written nor read
//! ([`crate::write::Place::Signed`]). An int is one of 32 bits, kept in the bytes that its
//! range needs.
//!
//! # Tables
//! What a sum adds to the greater logarithm has a byte for each distance up to six octaves,
//! and a second one up to where it is below 256; so has what a difference adds, which is
//! negative. Behind six octaves some steps are counted. These 17,664 bytes are part of the
//! program. Whole parts come from 1,024 bytes of mantissas, logarithms of ints from two tables
//! of 513.

mod parts;
mod routines;
mod tables;
mod templates;
#[cfg(test)]
mod tests;

pub(crate) use parts::ALL as PARTS;
pub use templates::same;

use crate::scaled::STEPPING;
use slowlight_routine::log::model::{LEAST, Log};
use slowlight_routine::log::{LOG, kept, loose};
use slowlight_routine::{Bits, Format, Loose, Runtime, Value, scale};

/// The first byte of the zero page that this runtime leaves alone.
pub const FREE_ZERO_PAGE: u8 = 0x32;

/// The greatest int that a param is written with.
const PARAM: f64 = 32767.0;

/// The runtime of logarithmic reals, ten bits behind the point.
pub static LOG10: Runtime = USUAL;

const USUAL: Runtime = Runtime {
    format: "log10",
    real: LOG,
    routines: &routines::ALL,
    encode,
    decode,
    quotient: 65536.0,
    kept,
    loose: Some(Loose {
        held: LEAST,
        instead: |routine| loose::instead(routine, &routines::ALL),
        least: loose::least,
    }),
    statement: 4,
    index: 6,
    param_most: PARAM,
    param_digits: |greatest, ranged| Some(scale::param_digits(greatest, ranged, PARAM)),
    param_bits,
    ..crate::USUAL
};

/// The same for programs that draw rows in passes and runs of columns.
pub static LOG10_IN_RUNS: Runtime = Runtime {
    stepping: Some(STEPPING),
    segments: true,
    ..USUAL
};

/// The nearest bits, saturating.
fn encode(value: Value, format: Format) -> Bits {
    match format {
        Format::Log { .. } => Log::nearest(value.real()).bits(),
        _ => (crate::USUAL.encode)(value, format),
    }
}

fn decode(bits: Bits, format: Format) -> Value {
    match format {
        Format::Log { .. } => Value::Real(Log::from_bits(bits).value()),
        _ => (crate::USUAL.decode)(bits, format),
    }
}

/// The program takes one int's logarithm from the other's.
fn param_bits(scaled: i64, digits: u8) -> Bits {
    let ends = (i64::from(i32::MIN), i64::from(i32::MAX));
    let of = |n: i64| Log::from_wide_int(n.clamp(ends.0, ends.1) as i32);
    of(scaled)
        .div(of(10i64.saturating_pow(u32::from(digits))))
        .bits()
}
