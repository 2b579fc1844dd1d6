//! What a 6502 computes with: 32-bit fixed point and 32-bit ints, as routines.
//!
//! A real is two's complement 16.16: 16 bits before the point, the sign among
//! them, and 16 behind; an int is two's complement of 32 bits; a bool is a byte,
//! 0 or 1. Numbers lie in memory low byte first. Results that do not fit saturate;
//! roundings go to the nearest, halves away from zero. Every routine has a model
//! in [`model`] that computes the same bits.
//!
//! # How a routine is written
//! A [`Form::Statement`](slowlight_routine::Form::Statement) is here one of two things:
//!
//! - a **name**: a subroutine. Its operands go to `acc` and `arg` in the zero
//!   page, its result is in `acc`; of floating-point reals ([`float`]) to `fa` and `fb`;
//! - a **template**: instructions, one a line. `{0.2}` is byte 2 of the first
//!   argument and `{r.2}` of the result; `{n}` is a number that makes labels unique.
//!   Where an argument is a constant its bytes become immediate operands. `[ ]` holds what
//!   is done for each byte `k` (`{0.k}`), and `{#n-16}` what follows from where the points
//!   of the values are, for reals that have their own ([`scaled`]).
//!   The result may be the place of an argument only where the template says so
//!   (none does): bytes of the result are written before all arguments are read.
//!
//! A bool that a routine computes is left in the **carry** flag, for a branch or
//! to be stored. [`write`](mod@write) does all this.
//!
//! Costs are of such a use as a whole, with all places in the zero page: loads,
//! call and stores included. Cycles are means over operands drawn evenly from
//! -8 to 8 (reals; roots from 0) and -1000 to 1000 (ints), measured by the tests.
//!
//! # Memory
//! `$00-$1d` is the runtime's (see the part `zero_page`), to `$33` where reals have points
//! of their own (`scaled_page`), to `$3e` where they float (`float_page`). Its tables of quarter squares are in the program, or in
//! 2,048 bytes that `make_squares` fills at the start ([`squares`]). All else is free.

mod fill;
pub mod float;
pub mod log;
pub mod model;
mod parts;
mod routines;
pub mod scaled;
pub mod squares;
mod templates;
pub mod tidy;
pub mod write;

#[cfg(test)]
mod tests;

use slowlight_routine::{Bits, Format, Overhead, Runtime, Value};

/// The first byte of the zero page that the runtime leaves alone.
pub const FREE_ZERO_PAGE: u8 = 0x1E;
/// The first byte behind the stack that the runtime leaves alone.
pub const FREE_MEMORY: u16 = 0x0200;

/// The first byte of the zero page that a runtime leaves alone.
pub fn free_zero_page(runtime: &Runtime) -> u8 {
    match runtime.real {
        Format::Scaled { bits: 16 } => scaled::FREE_ZERO_PAGE,
        Format::Scaled { .. } => scaled::LONG_FREE_ZERO_PAGE,
        Format::Log { .. } => log::FREE_ZERO_PAGE,
        Format::Real40 => float::FREE_ZERO_PAGE,
        _ => FREE_ZERO_PAGE,
    }
}

/// Format of the reals.
pub const FIXED: Format = Format::Fixed { bits: 32, frac: 16 };
/// Format of the ints.
pub const INT: Format = Format::Int { bits: 32 };

/// The runtime of reals in 16.16.
pub static FIXED16_16: Runtime = USUAL;

const USUAL: Runtime = Runtime {
    name: "6502",
    format: "fixed16.16",
    real: FIXED,
    int: INT,
    routines: &routines::ALL,
    parts: parts::ALL,
    encode,
    decode,
    shifted: slowlight_routine::scale::shifted,
    quotient: f64::INFINITY,
    overhead: Overhead {
        write: [36; 2],
        test: 36,
        ..Overhead::NONE
    },
    segments: false,
    reciprocals: false,
    middle: false,
    narrow: None,
    derives: false,
    kept: slowlight_routine::whole,
    loose: None,
    param_most: 32767.0,
    param_digits,
    param_bits,
};

/// The nearest bits, saturating.
fn encode(value: Value, format: Format) -> Bits {
    match format {
        Format::Bool => Bits::from(value.truth()),
        Format::Fixed { frac, .. } => {
            model::bits((value.real() * f64::from(1u32 << frac)).round() as i32)
        }
        _ => model::bits(value.int()),
    }
}

fn decode(bits: Bits, format: Format) -> Value {
    match format {
        Format::Bool => Value::Bool(bits != 0),
        Format::Fixed { frac, .. } => {
            Value::Real(f64::from(model::int(bits)) / f64::from(1u32 << frac))
        }
        _ => Value::Int(model::int(bits)),
    }
}

/// Thousandths, which fit 32 bits for every value that the format has.
fn param_digits(_: f64, _: bool) -> Option<u8> {
    Some(3)
}

/// The program divides the two integers as if they were 16.16.
fn param_bits(scaled: i64, digits: u8) -> Bits {
    let clamp = |n: i64| n.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32;
    let unit = clamp(10i64.saturating_pow(u32::from(digits)));
    model::bits(model::fixed_divide(clamp(scaled), unit))
}
