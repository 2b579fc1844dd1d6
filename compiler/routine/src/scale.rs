//! Reals of which each has its own number of fraction bits.
//!
//! In [`Format::Scaled`] a value is an int, and where its point stands is the plan's
//! affair: n with f fraction bits ("of scale f") is n / 2^f. So a routine for such reals
//! is one for ints that takes, at most, one number beside its arguments: how far the
//! exact result's point is from where the plan wants it ([`Scales::number`]). The number
//! is a routine's last argument: its model is given it after the operands, its domain
//! as a range of one value, and its text has holes for it. A domain is given all ranges in units of
//! the last place, as the machine holds them, and an error is so many of the result's.
//!
//! An operand is read at the scale that the operation wants ([`shifted`]), which may
//! differ from its own; so sums and comparisons have operands of one scale only.
//!
//! [`Format::Scaled`]: crate::Format::Scaled

use crate::{Bits, Op, Range, Type};

/// The fewest fraction bits that a value may have.
pub const FEWEST: i8 = -15;
/// The most that one of 16 bits may have, and that all of them know who pack them
/// ([`Scales::unpacked`]).
pub const MOST: i8 = 30;

/// The most fraction bits that a value of so many bits may have.
pub const fn finest(bits: u8) -> i8 {
    MOST + bits as i8 - 16
}

/// Where the points of an operation's operands are when it is carried out, and that of its
/// result; 0 for ints.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Scales {
    /// Those of the operands as they are read.
    pub args: [i8; 2],
    /// That of the result.
    pub result: i8,
}

impl Scales {
    /// What a routine has to know of them; 0 where nothing.
    pub fn number(&self, op: Op) -> i32 {
        let [a, b] = self.args.map(i32::from);
        let result = i32::from(self.result);
        match op {
            // By how many bits the product is longer than the result.
            Op::Mul => a + b - result,
            // By how many bits the dividend has to be longer.
            Op::Div => result + b - a,
            // By how many bits the radicand has to be longer.
            Op::Sqrt => 2 * result - a,
            Op::IntRoot => result,
            // By how many bits 2 is raised of which the root is divided.
            Op::ReciprocalRoot => 2 * result + a,
            Op::Floor => a,
            // The result has those that are given.
            Op::Sin | Op::Cos => a,
            // 1 where a value is added to itself: it is read as twice what it is.
            Op::Add => a - result,
            Op::Tan | Op::Exp | Op::Log => packed([a, 0, result]),
            Op::Pow => packed([a, b, result]),
            _ => 0,
        }
    }

    /// The scales of an operation whose routines must know all of them, from its number.
    pub fn unpacked(number: i32) -> Scales {
        let [a, b, result] = [4096, 64, 1].map(|unit| (number / unit % 64 - 32) as i8);
        Scales {
            args: [a, b],
            result,
        }
    }
}

/// Three scales in one number.
fn packed(scales: [i32; 3]) -> i32 {
    scales.iter().fold(0, |all, scale| all * 64 + scale + 32)
}

/// The fraction bits that an operation's result of so many bits always has, where its
/// routines know no others: as many as fit beside the greatest, and as many as they have.
pub fn given(op: Op, bits: u8) -> Option<i8> {
    match op {
        Op::Sin | Op::Cos | Op::Asin => Some(sine(bits)),
        Op::Acos | Op::Atan2 => Some((bits as i8 - 3).min(FUNCTION)),
        _ => None,
    }
}

/// Fraction bits of a number of so many bits from -1 to 1 that a function has or takes.
pub fn sine(bits: u8) -> i8 {
    (bits as i8 - 2).min(FUNCTION)
}

/// The most fraction bits that functions have.
pub const FUNCTION: i8 = 16;

/// The int of largest magnitude in so many bits; the least is its negative.
pub const fn most(bits: u8) -> i64 {
    let bits = if bits > 62 { 62 } else { bits };
    (1 << (bits - 1)) - 1
}

/// An int of `bits` bits read with so many more fraction bits (or fewer): saturates, and
/// rounds half away from 0.
pub fn shifted(value: i64, by: i32, bits: u8) -> i64 {
    let most = most(bits);
    match by {
        0 => value,
        1.. => (value << by.min(48)).clamp(-most, most),
        _ if by < -48 => 0,
        _ => {
            let half = 1i64 << (-by - 1);
            ((value.abs() + half) >> -by) * value.signum()
        }
    }
}

/// Decimal digits of a param that is written as a whole number: as many, up to four, as
/// leave the greatest magnitude within `most`; up to three without a range, so that there
/// is room for other values.
pub fn param_digits(greatest: f64, ranged: bool, most: f64) -> u8 {
    let fits = |d: &u8| greatest * 10f64.powi(i32::from(*d)) <= most;
    let digits = if ranged { 4 } else { 3 };
    (0..=digits).rev().find(fits).unwrap_or(0)
}

/// A range of reals in units of the last place at a scale.
pub fn in_units(range: Range, scale: i8) -> Range {
    let by = f64::from(scale).exp2();
    Range {
        nonzero: range.nonzero,
        ..Range::new(range.lo * by, range.hi * by)
    }
}

/// The most fraction bits with which a magnitude fits into so many bits.
pub fn fitting(magnitude: f64, bits: u8) -> i8 {
    let most = most(bits) as f64;
    let fits = |scale: &i8| magnitude * f64::from(*scale).exp2() <= most;
    (FEWEST..=finest(bits)).rev().find(fits).unwrap_or(FEWEST)
}

/// Whether an operation has anything to do with reals, so that scales matter.
pub fn concerns(op: Op) -> bool {
    op.result() == Type::Real || op.args().contains(&Type::Real)
}

/// The int that a real is at a scale: the nearest, saturating.
pub fn nearest(value: f64, scale: i8, bits: u8) -> Bits {
    let most = most(bits) as f64;
    let units = (value * f64::from(scale).exp2()).round();
    // NaN is no constant.
    (units.clamp(-most, most) as i64) as Bits
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shifts_round_and_saturate() {
        for (value, by, wanted) in [
            (3, 0, 3),
            (3, 2, 12),
            (-3, 2, -12),
            (20000, 1, 32767),
            (-20000, 1, -32767),
            (1, 40, 32767),
            (3, -1, 2),
            (-3, -1, -2),
            (5, -2, 1),
            (6, -2, 2),
            (-6, -2, -2),
            (32767, -15, 1),
            (32767, -16, 0),
            (32767, -60, 0),
        ] {
            assert_eq!(shifted(value, by, 16), wanted, "{value} by {by}");
        }
    }

    #[test]
    fn a_number_of_all_scales_tells_them() {
        for (a, b, result) in [(0, 0, 0), (FEWEST, MOST, FEWEST), (MOST, 5, 14)] {
            let scales = Scales {
                args: [a, b],
                result,
            };
            assert_eq!(Scales::unpacked(scales.number(Op::Pow)), scales);
        }
    }

    #[test]
    fn a_magnitude_has_the_most_bits_that_fit() {
        for (magnitude, scale) in [
            (0.0, MOST),
            (0.999, 15),
            (1.0, 14),
            (1.9999, 14),
            (32767.0, 0),
            (32768.0, -1),
            (f64::INFINITY, FEWEST),
        ] {
            assert_eq!(fitting(magnitude, 16), scale, "{magnitude}");
        }
        assert_eq!(nearest(-1.5, 14, 16) as i64, -24576);
        assert_eq!(nearest(1e9, 0, 16) as i64, 32767);
    }
}
