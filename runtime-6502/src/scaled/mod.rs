//! Fixed point in 16 bits, where each value has its own number of fraction bits.
//!
//! A real is an int from -32767 to 32767 at a scale that the plan chooses for it
//! ([`slowlight_routine::scale`]); an int is one of 32 bits, kept in the bytes that its
//! range needs. Sums and comparisons are written in place, since their operands are read
//! at one scale ([`read`]). A product is made of quarter squares: only as much of it as
//! is needed, the upper 24 of 32 bits. A root is looked up in a table of 192 entries, in
//! proportion. What leaves 16 bits saturates, if the ranges do not prove that it cannot.
//!
//! Sines, cosines and powers of e are looked up as well ([`sines`], [`powers`]), where their
//! points leave bits enough. Functions that are rarer are those of 16.16, their operand and result
//! shifted.

pub mod byte;
#[cfg(test)]
mod byte_tests;
#[cfg(test)]
mod figures_tests;
pub mod inline;
pub mod inline_byte;
#[cfg(test)]
mod inline_tests;
#[cfg(test)]
mod int_product_tests;
#[cfg(test)]
mod int_root_tests;
#[cfg(test)]
mod kinds;
pub mod logarithms;
pub mod long;
pub mod model;
mod parts;
pub mod powers;
mod read;
#[cfg(test)]
mod read_tests;
#[cfg(test)]
mod reciprocal_root_tests;
mod routines;
#[cfg(test)]
mod short_tests;
pub mod sines;
#[cfg(test)]
mod sines_tests;
mod templates;
mod templates_byte;
mod templates_long;
#[cfg(test)]
mod tests;
mod wide;

pub use read::{Pace, Read, floor, read};
pub use templates::{copied, short, squared};

pub(crate) use parts::ALL as PARTS;

use slowlight_routine::scale;
use slowlight_routine::{Bits, Format, Narrow, Overhead, Runtime, Value};

/// Bits of a real.
pub const BITS: u8 = 16;

/// The format of the reals.
pub const REAL: Format = Format::Scaled { bits: BITS };

/// The format of reals of 24 bits.
pub const LONG: Format = Format::Scaled { bits: long::BITS };

/// The format of reals of 8 bits.
pub const BYTE: Format = Format::Scaled { bits: byte::BITS };

/// The first byte of the zero page that this runtime leaves alone.
pub const FREE_ZERO_PAGE: u8 = 0x34;
/// The same where reals have 24 bits.
pub const LONG_FREE_ZERO_PAGE: u8 = 0x40;

/// The runtime of fixed-point reals with points of their own.
pub static FIXED16: Runtime = USUAL;

/// The same for programs that draw rows in passes and runs of columns.
pub static FIXED16_IN_RUNS: Runtime = Runtime {
    segments: true,
    ..USUAL
};

/// The runtime of the same in 24 bits.
pub static FIXED24: Runtime = USUAL_LONG;

/// The same for programs that draw rows in passes and runs of columns.
pub static FIXED24_IN_RUNS: Runtime = Runtime {
    segments: true,
    ..USUAL_LONG
};

/// The runtime of reals of 16 bits or 8, each in as many as the picture asks for.
pub static FIXED12: Runtime = MIXED_SHORT;

/// The same for programs that draw rows in passes and runs of columns.
pub static FIXED12_IN_RUNS: Runtime = Runtime {
    segments: true,
    ..MIXED_SHORT
};

/// The runtime of reals of 24 bits or 16, each in as many as the picture asks for.
pub static FIXED20: Runtime = MIXED;

/// The same for programs that draw rows in passes and runs of columns.
pub static FIXED20_IN_RUNS: Runtime = Runtime {
    segments: true,
    ..MIXED
};

/// In 8 bits most pixels come out wrong, so a part of these is more.
const MIXED_SHORT: Runtime = Runtime {
    format: "fixed12",
    narrow: Some(Narrow {
        bits: byte::BITS,
        wrong: 100,
    }),
    routines: &routines::ALL_SHORT,
    ..USUAL
};

const MIXED: Runtime = Runtime {
    format: "fixed20",
    narrow: Some(Narrow {
        bits: BITS,
        wrong: 5,
    }),
    routines: &routines::ALL_MIXED,
    ..USUAL_LONG
};

const USUAL_LONG: Runtime = Runtime {
    format: "fixed24",
    real: LONG,
    routines: &routines::ALL_LONG,
    param_digits: |greatest, ranged| {
        let most = scale::most(long::BITS) as f64;
        Some(scale::param_digits(greatest, ranged, most))
    },
    ..USUAL
};

const USUAL: Runtime = Runtime {
    format: "fixed16",
    real: REAL,
    routines: &routines::ALL,
    parts: crate::parts::ALL,
    encode,
    decode,
    shifted: model::shifted,
    reciprocals: true,
    middle: true,
    overhead: OVERHEAD,
    param_digits: |greatest, ranged| {
        Some(scale::param_digits(
            greatest,
            ranged,
            scale::most(BITS) as f64,
        ))
    },
    param_bits: |scaled, _| scaled as Bits,
    ..crate::USUAL
};

/// An int of four bytes is added to another.
pub(crate) const OVERHEAD: Overhead = Overhead {
    step: Some(38),
    test: 3,
    index: 6,
    ..Overhead::NONE
};

/// The nearest bits, saturating; of a real without a scale, those of its int.
fn encode(value: Value, format: Format) -> Bits {
    match format {
        Format::Fixed { bits, frac } => scale::nearest(value.real(), frac, bits),
        Format::Scaled { bits } => scale::nearest(value.real(), 0, bits),
        Format::Bool => Bits::from(value.truth()),
        _ => crate::model::bits(value.int()),
    }
}

fn decode(bits: Bits, format: Format) -> Value {
    let int = crate::model::int(bits);
    match format {
        Format::Bool => Value::Bool(bits != 0),
        Format::Fixed { frac, .. } => Value::Real(f64::from(int) * (-f64::from(frac)).exp2()),
        Format::Scaled { .. } => Value::Real(f64::from(int)),
        _ => Value::Int(int),
    }
}
