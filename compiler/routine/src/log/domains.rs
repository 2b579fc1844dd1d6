//! How far the operations on logarithmic reals are off, and for which ranges they are right
//! without a test: the same wherever they are computed.

use super::model::Logarithm;
use crate::{Error, Range};

/// What is as near to a whole number as logarithms tell counts as that; nine bits.
pub const STEP: Error = Error::Mixed {
    relative: 1.0 / 256.0,
    absolute: 1.0,
};
/// Of angles up to 1: one unit of 1 of ten bits.
pub const NEAR_SINE: Error = Error::Absolute(6.8e-4);
/// The same by tables ([`super::tables::Curve`]): 1.3 of them.
pub const NEAR_SINE_BY_TABLE: Error = Error::Absolute(8.8e-4);
/// The whole quarter turns of an angle are taken away as a value of the format: of 64, half a
/// unit is 0.02.
pub const SINE: Error = Error::Absolute(0.022);
/// From 256 quarter turns on these are all that counts.
pub const ANY_SINE: Error = Error::Absolute(2.0);
pub const NEAR_EXP: Error = Error::Relative(8.2e-4);

impl<const FRAC: u8, const WIDE: bool> Logarithm<FRAC, WIDE> {
    /// The least magnitude, which stands for 0.
    pub const LEAST_MAGNITUDE: f64 = 1.0 / (1u64 << (-Self::LEAST / Self::OCTAVE)) as f64;
    /// The greatest magnitude, or a little more.
    pub const END: f64 = (1u64 << ((Self::MOST + 1) / Self::OCTAVE)) as f64;
    /// Magnitudes that need no clamping above, with room for what roundings add.
    pub const HIGH: f64 = Self::END * 60_000.0 / 65_536.0;
    /// The least power of 2: its exponent, an int of units, is not less than -32767.
    const LEAST_POWER: f64 = match WIDE {
        true => 1.002 * Self::LEAST_MAGNITUDE,
        false => Self::LEAST_MAGNITUDE,
    };
    /// A unit of the last place, of one of ten bits.
    const UNIT: f64 = if FRAC == 10 { 1.0 } else { 0.5 };

    /// How many times 16 octaves an exponent has.
    const EXPONENTS: f64 = if Self::END > 65_536.0 { 2.0 } else { 1.0 };

    /// A quotient that is cut beside a whole number moves the result by the divisor.
    pub const UNKNOWN: Error = Error::Absolute(2.0 * Self::END);
    /// Products are exact between the format's ends.
    pub const PRODUCT: Error = Error::Mixed {
        relative: 1e-12,
        absolute: Self::LEAST_MAGNITUDE,
    };
    /// Entries of the table of sums are right to 0.54 units, what a far summand adds to 0.76.
    pub const SUMS: Error = Error::Mixed {
        relative: 4.8e-4 * Self::UNIT,
        absolute: Self::LEAST_MAGNITUDE,
    };
    /// Those of differences to 0.6 units, and to 1.22 where the summands are as near as 2^(1/4).
    pub const DIFFERENCES: Error = Error::Mixed {
        relative: 8.4e-4 * Self::UNIT,
        absolute: Self::LEAST_MAGNITUDE,
    };
    /// Half a unit is cut.
    pub const ROOT: Error = Error::Mixed {
        relative: 3.4e-4 * Self::UNIT,
        absolute: Self::LEAST_MAGNITUDE,
    };
    /// The logarithms of whole numbers are right to 0.55 units; from 512 on they are sums.
    pub const WHOLE: Error = Error::Mixed {
        relative: 8.5e-4 * Self::UNIT,
        absolute: Self::LEAST_MAGNITUDE,
    };
    /// Up to 1.4, where the cosine is 0.17.
    pub const TANGENT: Error = Error::Mixed {
        relative: 2e-3,
        absolute: Self::LEAST_MAGNITUDE,
    };
    /// Three sums, of which the last counts most. Where the least magnitude is larger, what is
    /// beyond a thousandth is within that.
    pub const ARC: Error = Error::Mixed {
        relative: if WIDE { 1.25e-3 } else { 1e-3 },
        absolute: Self::LEAST_MAGNITUDE,
    };
    /// An exponent of 2 is as near as a table of whole numbers' logarithms tells, of 16
    /// octaves 1/100.
    pub const EXP: Error = Error::Mixed {
        relative: 0.01 * Self::EXPONENTS,
        absolute: Self::LEAST_POWER,
    };
    /// There the exponent is a product with a logarithm of its own.
    pub const POWER: Error = Error::Mixed {
        relative: 0.0155 * Self::EXPONENTS,
        absolute: Self::LEAST_POWER,
    };
    /// A whole number's logarithm, and the constant's rounding.
    pub const LOGARITHM: Error = Error::Mixed {
        relative: 1.1e-3,
        absolute: Self::LEAST_MAGNITUDE,
    };

    /// The least magnitude in a range.
    pub fn least(range: &Range) -> f64 {
        range.lo.max(-range.hi).max(Self::LEAST_MAGNITUDE)
    }

    pub fn high(result: Range) -> bool {
        result.within(-Self::HIGH, Self::HIGH)
    }

    /// Products that stay between the ends.
    pub fn inner_product(args: &[Range], result: Range) -> bool {
        matches!(args, [a, b, ..] if Self::high(result) && Self::least(a) * Self::least(b) >= Self::LEAST_MAGNITUDE)
    }

    pub fn inner_quotient(args: &[Range], result: Range) -> bool {
        Self::low_quotient(args, result) && Self::high_quotient(args, result)
    }

    /// Divisors below the least magnitude are held as that, which makes quotients smaller.
    pub fn low_quotient(args: &[Range], result: Range) -> bool {
        Self::high(result)
            || matches!(args, [a, b, ..] if a.magnitude() < Self::HIGH * Self::least(b))
    }

    pub fn high_quotient(args: &[Range], _: Range) -> bool {
        matches!(args, [a, b, ..] if Self::least(a) >= Self::LEAST_MAGNITUDE * b.magnitude())
    }

    /// A first argument that is more than what stands for 0, and a result that fits.
    pub fn above_zero(args: &[Range], result: Range) -> bool {
        Self::high(result)
            && args
                .first()
                .is_some_and(|a| a.lo > 1.001 * Self::LEAST_MAGNITUDE)
    }

    /// Two arguments of such signs, and a sum that fits.
    pub fn signs(args: &[Range], result: Range, [first, second]: [Sign; 2]) -> bool {
        matches!(args, [a, b, ..] if first.is_of(a) && second.is_of(b)) && Self::high(result)
    }

    /// Results that need no clamping above.
    pub fn fits(_: &[Range], result: Range) -> bool {
        Self::high(result)
    }

    pub fn ample(args: &[Range]) -> bool {
        args.iter().any(|a| Self::least(a) >= Self::AMPLE)
    }

    /// What differences are taken from: where one magnitude is at least this, so that the
    /// greater is, nothing that is left of it is less than the format tells from 0.
    pub const AMPLE: f64 = 0.181;
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
