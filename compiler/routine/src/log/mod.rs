//! Logarithmic reals: what the format `log10` means, for every runtime that has it.
//!
//! A real is held as 1024 times the binary logarithm of its magnitude, in 16 bits, and a
//! sign. What a sum adds to the greater logarithm is looked up in a table of 6,144 entries,
//! what a difference takes away in another. Sums are right to 0.7 of the last place, 4.8e-4
//! of themselves, and differences of near values to 1.2; products, quotients and powers of
//! two are exact. Magnitudes end at 2^16 above and 2^-13 below, which stands for 0; so
//! lengths of vectors end at 2^8, where their squares do, and a 0 has the sign that it came
//! with.
//!
//! Models, tables, errors, domains and what may be smaller than the least magnitude are here;
//! how a machine computes them, and how quickly, is its runtime's.

pub mod domains;
mod functions;
pub mod loose;
pub mod model;
pub mod tables;

use crate::{Bits, Format, Range};
use model::Log;

/// The format of Jack's reals.
pub const LOG: Format = Log::FORMAT;

/// The greatest int that a param's digits may make.
const INT_MOST: i64 = 32767;

/// The bits of a param: the program takes one int's logarithm from the other's.
pub fn param_bits(scaled: i64, digits: u8) -> Bits {
    let of = |n: i64| Log::from_int(n.clamp(-INT_MOST, INT_MOST) as i32);
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

/// What programs keep of a real: a sign that is known is written where it is read.
pub fn kept(bits: Bits, range: Range) -> Bits {
    match known_sign(range) {
        Some(plus) => {
            let log = Log::from_bits(bits).log;
            Log { plus, log }.bits()
        }
        None => bits,
    }
}
