//! What Jack computes with: the 14-bit floats of the Jack ray marcher, and ints.
//!
//! A real is a `Float`: an object of three words, sign, exponent and mantissa,
//! with the arithmetic of a published ray marcher in Jack, "Float316": 14 bits
//! that truncate, no infinities; unlike there a difference keeps a guard bit, which
//! costs nothing: sums take 99 commands instead of 119. An int is Jack's own, 16 bits.
//! Every routine has a model in [`model`] that computes the same bits.
//!
//! # Ends
//! Exponents stay within -8000..8000 (2^±8000; a comparison of sums of two such
//! fits 16 bits also where a machine compares by subtracting): what would be
//! larger is the largest value, what would be smaller is zero. Ints saturate at
//! ±32767; only `&` can make -32768, which the saturating routines take for
//! -32767. A zero may have either sign, which nothing looks at.
//!
//! # How a routine is written
//! - [`Form::Expression`](slowlight_routine::Form::Expression): a Jack
//!   expression of ints, booleans, and variables that hold Floats. Jack has no
//!   precedence, so there are two levels: [`TERM`], and [`SUM`], which takes
//!   parentheses inside another expression.
//! - [`Form::Statement`](slowlight_routine::Form::Statement): what follows `do`;
//!   `{r}` is the variable that holds the result, a Float made beforehand, and
//!   `{0}`, `{1}` are the arguments. It may be that of an argument, save for the
//!   second of `mod`.
//!
//! Nothing is allocated: results go into Floats that exist. [`classes`] puts
//! the classes together from the parts that a program needs.
//!
//! [`wide`] has the same with 28 bits, [`log`] and [`fixed`] have reals that are ints.
//!
//! # Costs
//! Cycles are VM commands, means over operands drawn at random, measured by the
//! tests, the loads of the operands and the store of the result left out; a
//! call of the operating system counts 1. Bytes are words of ROM as the usual
//! translation makes them, roughly.

#[macro_use]
mod macros;
pub mod fixed;
pub mod log;
pub mod model;
pub mod os;
mod parts;
#[macro_use]
mod routines;
pub mod wide;

#[cfg(test)]
pub(crate) mod tests;

pub use parts::{classes, classes_for_processor, has_init};

use model::Float;
use slowlight_routine::{Bits, Format, Overhead, Runtime, Value};

/// The level of a variable, a call, or what stands in parentheses.
pub const TERM: u8 = 1;
/// The level of an expression with an operator.
pub const SUM: u8 = 0;

/// Format of the ints.
pub const INT: Format = Format::Int { bits: 16 };

/// The runtime of reals in Float316.
pub static F316: Runtime = CUT;

/// The runtime of the same reals, rounded.
pub static F316R: Runtime = Runtime {
    format: "f316r",
    real: Format::Float316 { rounded: true },
    routines: &routines::rounded::ALL,
    parts: &parts::ROUNDED,
    param_bits: |scaled, digits| of_param(scaled, digits, Float::ratio),
    ..CUT
};

const CUT: Runtime = Runtime {
    name: "jack",
    format: "f316",
    real: Format::Float316 { rounded: false },
    int: INT,
    routines: &routines::ALL,
    parts: parts::ALL,
    encode,
    decode,
    shifted: slowlight_routine::scale::shifted,
    quotient: f64::INFINITY,
    overhead: Overhead {
        write: [11; 2],
        test: 11,
        ..Overhead::NONE
    },
    segments: false,
    reciprocals: false,
    middle: false,
    narrow: None,
    derives: false,
    kept: slowlight_routine::whole,
    loose: None,
    param_most: model::MOST as f64,
    param_digits,
    param_bits: |scaled, digits| of_param(scaled, digits, Float::div),
};

/// The nearest bits, saturating.
fn encode(value: Value, format: Format) -> Bits {
    match format {
        Format::Bool => Bits::from(value.truth()),
        Format::Float316 { .. } => Float::nearest(value.real()).bits(),
        _ => model::int_bits(model::saturate(value.int())),
    }
}

fn decode(bits: Bits, format: Format) -> Value {
    match format {
        Format::Bool => Value::Bool(bits != 0),
        Format::Float316 { .. } => Value::Real(Float::from_bits(bits).value()),
        _ => Value::Int(model::int(bits)),
    }
}

/// Of a param, which is an int in the source.
fn param_digits(greatest: f64, ranged: bool) -> Option<u8> {
    let most = f64::from(model::MOST);
    Some(slowlight_routine::scale::param_digits(
        greatest, ranged, most,
    ))
}

/// The program divides the two ints as Floats.
fn of_param(scaled: i64, digits: u8, div: fn(Float, Float) -> Float) -> Bits {
    let [scaled, unit] = param_ints(scaled, digits);
    div(Float::from_int(scaled), Float::from_int(unit)).bits()
}

/// A param's int, and the power of ten that it is divided by.
fn param_ints(scaled: i64, digits: u8) -> [i32; 2] {
    let most = i64::from(model::MOST);
    let unit = 10i64.saturating_pow(u32::from(digits));
    [scaled, unit].map(|n| n.clamp(-most, most) as i32)
}

/// What a real's class makes a value of, in the order of `Float.constant`'s arguments: sign,
/// exponent, and one or two words of the mantissa, the upper first.
pub fn words(bits: Bits, format: Format) -> Vec<i32> {
    match format {
        wide::REAL => wide::model::Wide::from_bits(bits).words().to_vec(),
        _ => {
            let Float { s, e, m } = Float::from_bits(bits);
            vec![s, e, m]
        }
    }
}
