//! Floating-point reals: the runtime for the 6502 in which pictures are as exact as they become.
//!
//! A real is five bytes, those of BBC BASIC: 32 bits of mantissa, low byte first, the sign in
//! place of the leading bit, which is always 1, and an exponent, 128 more than it is, last. It
//! stands for 0.1mmm... times 2^(exponent - 128); of 0 all bytes are 0. Magnitudes go from 2^-128
//! to nearly 2^127; what is greater saturates, what is less becomes 0. Nothing is BASIC's but the
//! layout: results are rounded to the nearest here, and functions go ways of their own.
//!
//! Each operation but comparisons, signs and products by powers of two is a subroutine on `fa` and
//! `fb` in the zero page. A product is made of quarter squares, of which the lower columns are
//! left out: its last place is right but for 3/128 of one. An int is one of 32 bits.

mod functions;
mod model;
mod parts;
mod routines;
mod templates;
#[cfg(test)]
mod tests;

use model::Real;
use slowlight_routine::{Bits, Format, Overhead, Runtime, Value, scale};

/// The first byte of the zero page that this runtime leaves alone.
pub const FREE_ZERO_PAGE: u8 = 0x3F;

/// The greatest int that a param is written with.
const PARAM: f64 = 2_147_483_647.0;

/// Reals of a mantissa of 32 bits.
pub static REAL40: Runtime = Runtime {
    format: "real40",
    real: Format::Real40,
    routines: &routines::ALL,
    parts: &parts::ALL,
    encode,
    decode,
    overhead: Overhead {
        write: [36, 45],
        ..crate::USUAL.overhead
    },
    param_most: PARAM,
    param_digits: |greatest, ranged| Some(scale::param_digits(greatest, ranged, PARAM)),
    param_bits,
    reciprocals: true,
    ..crate::USUAL
};

/// The nearest bits, saturating.
fn encode(value: Value, format: Format) -> Bits {
    match format {
        Format::Real40 => Real::nearest(value.real()).bits(),
        _ => (crate::USUAL.encode)(value, format),
    }
}

fn decode(bits: Bits, format: Format) -> Value {
    match format {
        Format::Real40 => Value::Real(Real::from_bits(bits).value()),
        _ => (crate::USUAL.decode)(bits, format),
    }
}

/// The program divides one int by the other.
fn param_bits(scaled: i64, digits: u8) -> Bits {
    let ends = (i64::from(i32::MIN), i64::from(i32::MAX));
    let of = |n: i64| Real::from_int(n.clamp(ends.0, ends.1) as i32);
    of(scaled)
        .div(of(10i64.saturating_pow(u32::from(digits))))
        .bits()
}
