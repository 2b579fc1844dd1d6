//! Logarithmic reals: the runtimes for the 6502 in which a product costs an addition.
//!
//! What the format means is in [`slowlight_routine::log`]. Here a real is three bytes: its
//! logarithm, low byte first, and a sign, 1 where it is below 0; of a real whose sign the
//! ranges know the third is neither written nor read ([`crate::write::Place::Signed`]). All 16
//! bits of the logarithm count: with ten behind the point (`log10`) magnitudes end at 2^32 and
//! 2^-32, with eleven (`log11`) at 2^16 and 2^-16. What is beyond them, the overflow flag
//! tells. An int is one of 32 bits, kept in the bytes that its range needs.
//!
//! # Tables
//! Of ten bits, what a sum adds to the greater logarithm has a byte for each distance up to six
//! octaves, and a second one up to where it is below 256; so has what a difference adds, which
//! is negative. Behind six octaves some steps are counted. These are 17,666 bytes of the
//! program. Of eleven bits, there is an entry for each distance up to two octaves, for each two
//! up to six, and then for each 16: 29,954 bytes. Where there is memory ([`with_whole_tables`])
//! each distance has an entry with two bytes as far as that is not 0 or 255 for sure, 24,066
//! bytes or 36,866. Whole parts come from 1,024 bytes of
//! mantissas, or 2,048, logarithms of ints from two tables of 513.

mod look;
mod parts;
mod routines;
mod tables;
mod templates;
#[cfg(test)]
mod tests;

pub use look::looked_up;
pub use templates::same;

use crate::scaled::OVERHEAD;
use slowlight_routine::log::kept;
use slowlight_routine::log::model::Logarithm;
use slowlight_routine::{Bits, Format, Overhead, Runtime, Value, scale};

/// The first byte of the zero page that this runtime leaves alone.
pub const FREE_ZERO_PAGE: u8 = 0x3A;

/// The greatest int that a param is written with.
const PARAM: f64 = 32767.0;

/// Logarithmic reals, ten bits behind the point.
pub static LOG10: Runtime = Runtime {
    format: "log10",
    routines: &routines::WITH_TEN,
    parts: &parts::WITH_TEN,
    ..of::<10>()
};

/// The same with eleven.
pub static LOG11: Runtime = Runtime {
    format: "log11",
    routines: &routines::WITH_ELEVEN,
    parts: &parts::WITH_ELEVEN,
    ..of::<11>()
};

/// A runtime of logarithms with whole tables, which take more memory and are quicker; another
/// one as it is.
pub fn with_whole_tables(runtime: &'static Runtime) -> &'static Runtime {
    match runtime.real {
        real if real == LOG10.real => &LOG10_WHOLE,
        real if real == LOG11.real => &LOG11_WHOLE,
        _ => runtime,
    }
}

static LOG10_WHOLE: Runtime = Runtime {
    parts: &parts::WITH_TEN_WHOLE,
    ..LOG10
};
static LOG11_WHOLE: Runtime = Runtime {
    parts: &parts::WITH_ELEVEN_WHOLE,
    ..LOG11
};

/// For programs that draw rows in passes and runs of columns.
pub static LOG10_IN_RUNS: Runtime = in_runs(LOG10);
pub static LOG11_IN_RUNS: Runtime = in_runs(LOG11);

const fn in_runs(runtime: Runtime) -> Runtime {
    Runtime {
        overhead: OVERHEAD,
        segments: true,
        ..runtime
    }
}

const fn of<const FRAC: u8>() -> Runtime {
    Runtime {
        real: Logarithm::<FRAC, true>::FORMAT,
        encode: encode::<FRAC>,
        decode: decode::<FRAC>,
        quotient: Logarithm::<FRAC, true>::END,
        kept,
        overhead: Overhead {
            step: None,
            write: [4, 4],
            ..OVERHEAD
        },
        param_most: PARAM,
        param_digits: |greatest, ranged| Some(scale::param_digits(greatest, ranged, PARAM)),
        param_bits: param_bits::<FRAC>,
        ..crate::USUAL
    }
}

/// The nearest bits, saturating.
fn encode<const FRAC: u8>(value: Value, format: Format) -> Bits {
    match format {
        Format::Log { .. } => Logarithm::<FRAC, true>::nearest(value.real()).bits(),
        _ => (crate::USUAL.encode)(value, format),
    }
}

fn decode<const FRAC: u8>(bits: Bits, format: Format) -> Value {
    match format {
        Format::Log { .. } => Value::Real(Logarithm::<FRAC, true>::from_bits(bits).value()),
        _ => (crate::USUAL.decode)(bits, format),
    }
}

/// The program takes one int's logarithm from the other's.
fn param_bits<const FRAC: u8>(scaled: i64, digits: u8) -> Bits {
    let ends = (i64::from(i32::MIN), i64::from(i32::MAX));
    let of = |n: i64| Logarithm::<FRAC, true>::from_wide_int(n.clamp(ends.0, ends.1) as i32);
    of(scaled)
        .div(of(10i64.saturating_pow(u32::from(digits))))
        .bits()
}
