//! What BBC BASIC can compute: routines for every operation, over the 40-bit reals and 32-bit
//! integers of BASIC II, each with its bit-exact model.
//!
//! Most routines are expressions of BASIC itself. Where an operation of BASIC is not total (a
//! division by zero, an overflow, `INT` of a large number), the expression is offered for the
//! ranges in which it is, and a function `FN...` for the rest.
//!
//! # Conventions
//!
//! - **Levels** of [`Form::Expression`](slowlight_routine::Form): OR 1, AND 2, comparisons 3,
//!   + and - and a minus sign 4, * / DIV MOD 5, ^ 6, operands 7 ([`level`]).
//! - **Types**: BASIC keeps whole numbers as integers until an operation needs a real, and adds
//!   integers as integers, which wrap on BASIC II. A real of the plan may therefore be an integer
//!   in BASIC ([`Op::ToReal`](slowlight_routine::Op) is written as nothing at all). That is the same value as long as
//!   sums stay within 2^30; where that is not proved, a function takes them, whose parameters are
//!   reals.
//! - **Booleans** are 0 and 1 as bits, 0 and -1 in BASIC.
//! - **Constants** are decimals of at most ten digits ([`literal`]), which BASIC II reads with
//!   correct rounding. Reals saturate at 1.7E38 ([`BIG`]), not at the format's odd last value.
//! - **Parts** are lines of BASIC without numbers. Their functions use only their parameters and
//!   LOCALs, so that they cannot disturb the program's variables. What is set once, before
//!   anything else, has a name in capitals; expressions may read it, too, if they need that part.

mod functions;
pub mod guards;
mod model;
mod routines;

use slowlight_isa::real40::Real40;
use slowlight_isa::real40::text::{Parsed, parse};
use slowlight_routine::{Bits, Format, Overhead, Runtime, Value};

/// The reals.
pub const REAL: Format = Format::Real40;
/// The ints.
pub const INT: Format = Format::Int { bits: 32 };

/// Where reals saturate: the largest power of ten's tidy multiple below 2^127.
pub const BIG: f64 = 1.7e38;

/// Where guarded quotients saturate: near enough to [`BIG`] to stand for it,
/// far enough from it that products of one with lengths, and their sums, need no guard.
pub const FAR: f64 = 1e33;

/// BASIC II's cycles, as they come to in whole programs (`cargo bench --bench prices`). Of single
/// statements the ROM takes 1,245 for `C%=C%+S%` on resident variables, 804 for `C%=A%` and
/// 1,243 for `X=A`; a real is read in 560 if it is the first of its letter, which most are not,
/// and each before it takes 103.
const OVERHEAD: Overhead = Overhead {
    step: Some(1245),
    read: [300, 740],
    digit: 150,
    write: [500, 500],
    test: 320,
    index: 1000,
    ..Overhead::NONE
};

/// How tightly BASIC's operators bind.
pub mod level {
    /// OR and EOR.
    pub const OR: u8 = 1;
    /// AND.
    pub const AND: u8 = 2;
    /// `< = >` and so on.
    pub const COMPARE: u8 = 3;
    /// `+` and `-`.
    pub const SUM: u8 = 4;
    /// `* / DIV MOD`, and a minus sign before a product (it binds tighter than those, so it
    /// is the first factor's: the same value).
    pub const PRODUCT: u8 = 5;
    /// `^`.
    pub const POWER: u8 = 6;
    /// Variables, literals, functions, brackets.
    pub const OPERAND: u8 = 7;
}

/// BBC BASIC with 40-bit reals.
pub static RUNTIME: Runtime = Runtime {
    name: "bbc",
    format: "real40",
    real: REAL,
    int: INT,
    routines: routines::ALL,
    parts: functions::ALL,
    encode,
    decode,
    shifted: slowlight_routine::scale::shifted,
    quotient: FAR,
    overhead: OVERHEAD,
    segments: true,
    reciprocals: false,
    middle: false,
    narrow: None,
    derives: true,
    kept: slowlight_routine::whole,
    loose: None,
    param_most: BIG,
    param_digits: decimal,
    param_bits,
};

/// A real as BASIC writes it: at most ten significant digits, the nearest such decimal.
pub fn literal(x: f64) -> String {
    let x = x.clamp(-BIG, BIG);
    if x == 0.0 {
        return "0".to_owned();
    }
    // Ten digits, then without the zeros at their end.
    let text = format!("{x:.9e}");
    let (mantissa, power) = text.split_once('e').unwrap_or((&text, "0"));
    let power: i32 = power.parse().unwrap_or(0);
    let digits: String = mantissa.chars().filter(char::is_ascii_digit).collect();
    let digits = digits.trim_end_matches('0');
    let sign = if x < 0.0 { "-" } else { "" };
    let count = digits.len() as i32;
    let point = power + 1;
    let plain = match point {
        _ if !(-3..=10).contains(&point) => None,
        _ if point <= 0 => Some(format!("0.{}{digits}", "0".repeat(-point as usize))),
        _ if point >= count => Some(format!("{digits}{}", "0".repeat((point - count) as usize))),
        _ => digits
            .split_at_checked(point as usize)
            .map(|(whole, rest)| format!("{whole}.{rest}")),
    };
    let plain = plain.unwrap_or_else(|| match digits.split_at_checked(1) {
        Some((first, rest)) if !rest.is_empty() => format!("{first}.{rest}E{power}"),
        _ => format!("{digits}E{power}"),
    });
    format!("{sign}{plain}")
}

/// The real that BASIC reads from [`literal`].
pub fn nearest(x: f64) -> Real40 {
    let text = literal(x);
    let size = text.trim_start_matches('-');
    let value = match parse(size.as_bytes()) {
        Ok(Some((Parsed::Int(n), _))) => Real40::from_i32(n),
        Ok(Some((Parsed::Real(r), _))) => r,
        _ => Real40::ZERO,
    };
    if text.len() > size.len() {
        value.negate()
    } else {
        value
    }
}

fn encode(value: Value, format: Format) -> Bits {
    match format {
        Format::Bool => u64::from(value.truth()),
        Format::Real40 => nearest(value.real()).to_bits(),
        _ => model::from_int(value.int()),
    }
}

fn decode(bits: Bits, format: Format) -> Value {
    match format {
        Format::Bool => Value::Bool(bits != 0),
        Format::Real40 => Value::Real(Real40::from_bits(bits).to_f64()),
        _ => Value::Int(model::int(bits)),
    }
}

/// Params are decimals.
fn decimal(_: f64, _: bool) -> Option<u8> {
    None
}

fn param_bits(scaled: i64, digits: u8) -> Bits {
    nearest(scaled as f64 / 10f64.powi(i32::from(digits))).to_bits()
}

#[cfg(test)]
mod tests;
