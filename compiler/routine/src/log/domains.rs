//! How far the operations on logarithmic reals are off, and for which ranges they are right
//! without a test: the same wherever they are computed.

use crate::{Error, Range};

/// Products are exact between the format's ends.
pub const PRODUCT: Error = Error::Mixed {
    relative: 1e-12,
    absolute: ZERO,
};
/// Entries of the table of sums are right to 0.54 units, what a far summand adds to 0.76.
pub const SUMS: Error = Error::Mixed {
    relative: 4.8e-4,
    absolute: ZERO,
};
/// Those of differences to 0.6 units, and to 1.22 where the summands are as near as 2^(1/4).
pub const DIFFERENCES: Error = Error::Mixed {
    relative: 8.4e-4,
    absolute: ZERO,
};
/// Half a unit is cut.
pub const ROOT: Error = Error::Mixed {
    relative: 3.4e-4,
    absolute: ZERO,
};
/// The logarithms of whole numbers are right to 0.55 units; from 512 on they are sums.
pub const WHOLE: Error = Error::Mixed {
    relative: 8.5e-4,
    absolute: ZERO,
};
/// What is as near to a whole number as logarithms tell counts as that; nine bits.
pub const STEP: Error = Error::Mixed {
    relative: 1.0 / 256.0,
    absolute: 1.0,
};
/// A quotient that is cut beside a whole number moves the result by the divisor.
pub const UNKNOWN: Error = Error::Absolute(131_072.0);
/// Of angles up to 1: one unit of 1.
pub const NEAR_SINE: Error = Error::Absolute(6.8e-4);
/// The whole quarter turns of an angle are taken away as a value of the format: of 64, half a
/// unit is 0.02.
pub const SINE: Error = Error::Absolute(0.022);
/// From 256 quarter turns on these are all that counts.
pub const ANY_SINE: Error = Error::Absolute(2.0);
/// Up to 1.4, where the cosine is 0.17.
pub const TANGENT: Error = Error::Mixed {
    relative: 2e-3,
    absolute: ZERO,
};
/// Three sums, of which the last counts most.
pub const ARC: Error = Error::Mixed {
    relative: 1e-3,
    absolute: ZERO,
};
pub const NEAR_EXP: Error = Error::Relative(8.2e-4);
/// An exponent of 2 is as near as a table of whole numbers' logarithms tells, of 16
/// octaves 1/100.
pub const EXP: Error = Error::Mixed {
    relative: 0.01,
    absolute: ZERO,
};
/// There the exponent is a product with a logarithm of its own.
pub const POWER: Error = Error::Mixed {
    relative: 0.0155,
    absolute: ZERO,
};
/// A whole number's logarithm, and the constant's rounding.
pub const LOGARITHM: Error = Error::Mixed {
    relative: 1.1e-3,
    absolute: ZERO,
};
/// The least magnitude, which stands for 0.
pub const ZERO: f64 = 1.0 / 8192.0;

/// Magnitudes that need no clamping above, with room for what roundings add.
pub const HIGH: f64 = 60_000.0;

/// The least magnitude in a range.
pub fn least(range: &Range) -> f64 {
    range.lo.max(-range.hi).max(ZERO)
}

pub fn high(result: Range) -> bool {
    result.within(-HIGH, HIGH)
}

/// Products that stay between the ends.
pub fn inner_product(args: &[Range], result: Range) -> bool {
    matches!(args, [a, b, ..] if high(result) && least(a) * least(b) >= ZERO)
}

pub fn inner_quotient(args: &[Range], result: Range) -> bool {
    low_quotient(args, result) && high_quotient(args, result)
}

/// Divisors below the least magnitude are held as that, which makes quotients smaller.
pub fn low_quotient(args: &[Range], result: Range) -> bool {
    high(result) || matches!(args, [a, b, ..] if a.magnitude() < HIGH * least(b))
}

pub fn high_quotient(args: &[Range], _: Range) -> bool {
    matches!(args, [a, b, ..] if least(a) >= ZERO * b.magnitude())
}

pub fn near_angle(args: &[Range], _: Range) -> bool {
    args.iter().all(|a| a.within(-1.0, 1.0))
}

pub fn angle(args: &[Range], _: Range) -> bool {
    args.iter().all(|a| a.within(-64.0, 64.0))
}

pub fn near_tangent(args: &[Range], _: Range) -> bool {
    args.iter().all(|a| a.within(-1.4, 1.4))
}

/// A first argument that is more than what stands for 0, and a result that fits.
pub fn above_zero(args: &[Range], result: Range) -> bool {
    high(result) && args.first().is_some_and(|a| a.lo > 1.001 * ZERO)
}

/// What is known of an operand's sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    Plus,
    Minus,
    Any,
}

impl Sign {
    /// 0 is held as a small number above it.
    fn is_of(self, range: &Range) -> bool {
        match self {
            Sign::Plus => range.lo >= 0.0,
            Sign::Minus => range.hi < 0.0,
            Sign::Any => true,
        }
    }
}

/// Two arguments of such signs, and a sum that fits.
pub fn signs(args: &[Range], result: Range, [first, second]: [Sign; 2]) -> bool {
    matches!(args, [a, b, ..] if first.is_of(a) && second.is_of(b)) && high(result)
}

/// What differences are taken from: where one magnitude is at least this, so that the
/// greater is, nothing that is left of it is less than the format tells from 0.
pub const AMPLE: f64 = 0.181;

pub fn ample(args: &[Range]) -> bool {
    args.iter().any(|a| least(a) >= AMPLE)
}

/// Results that need no clamping above.
pub fn fits(_: &[Range], result: Range) -> bool {
    high(result)
}

pub fn plus(args: &[Range], _: Range) -> bool {
    args.iter().all(|a| a.lo >= 0.0)
}

/// Of what is chosen in another's place only ([`super::loose`]).
pub fn never(_: &[Range], _: Range) -> bool {
    false
}

pub fn first_plus(args: &[Range], _: Range) -> bool {
    args.first().is_some_and(|a| a.lo >= 0.0)
}

pub fn second_plus(args: &[Range], _: Range) -> bool {
    args.get(1).is_some_and(|b| b.lo >= 0.0)
}

pub fn first_minus(args: &[Range], _: Range) -> bool {
    args.first().is_some_and(|a| a.hi < 0.0)
}

pub fn second_minus(args: &[Range], _: Range) -> bool {
    args.get(1).is_some_and(|b| b.hi < 0.0)
}

pub fn zero(range: Option<&Range>) -> bool {
    range.and_then(|r| r.constant()) == Some(0.0)
}

pub fn against_zero(args: &[Range], _: Range) -> bool {
    zero(args.get(1))
}

pub fn from_zero(args: &[Range], _: Range) -> bool {
    zero(args.first())
}
