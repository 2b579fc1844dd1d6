//! Logarithmic reals: the runtime for Jack in which a product costs an addition.
//!
//! What the format means is in [`slowlight_routine::log`]. Here a real is an int and a
//! boolean, and the program makes the tables at its start.
//! The tables of sums and of differences go to 4,608; what is further apart, where an entry
//! is seldom another than the last, is told by comparisons, which take no room on the heap.
//!
//! # How a routine is written
//! As for Floats, but that a [`Form::Statement`](slowlight_routine::Form::Statement) is
//! whole statements of Jack, a line each: `{0}`, `{1}` and `{r}` are the logarithms of
//! the arguments and the result, `{0+}`, `{1+}` and `{r+}` their signs, true for plus.
//! Whoever writes them leaves out a sign that the ranges know. The result may share the
//! variables of an argument.

mod processor;
mod routines;
#[cfg(test)]
mod tests;

pub use processor::on_processor;

use crate::{INT, param_digits, parts};
use slowlight_routine::log::model::{LEAST, Log};
use slowlight_routine::log::{LOG, kept, loose, param_bits};
use slowlight_routine::{Bits, Format, Loose, Overhead, Runtime, Value};

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
    overhead: Overhead {
        read: [1; 2],
        nested: 3,
        write: [3; 2],
        test: 2,
        index: 2,
        ..Overhead::NONE
    },
    segments: false,
    reciprocals: false,
    middle: false,
    narrow: None,
    derives: false,
    kept,
    loose: Some(Loose {
        held: LEAST,
        instead: |routine| loose::instead(routine, &routines::ALL),
        least: loose::least,
    }),
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
