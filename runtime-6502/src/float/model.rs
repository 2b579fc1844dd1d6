//! What the routines compute, bit for bit, on reals as sign, exponent and mantissa.

use super::functions::Terms;
use slowlight_routine::Bits;

/// The exponent that stands for 2^0.
pub const BIAS: i32 = 128;
/// The greatest exponent.
const MOST: i32 = 255;

/// A real: its magnitude is `man` / 2^32 times 2^(`exp` - 128); of 0 all are 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Real {
    pub negative: bool,
    pub exp: i32,
    pub man: u32,
}

impl Real {
    pub const ZERO: Real = Real {
        negative: false,
        exp: 0,
        man: 0,
    };
    pub const ONE: Real = Real::plus(BIAS + 1, 1 << 31);

    pub const fn plus(exp: i32, man: u32) -> Real {
        let negative = false;
        Real { negative, exp, man }
    }

    /// The greatest one, or its opposite.
    pub fn most(negative: bool) -> Real {
        Real {
            negative,
            exp: MOST,
            man: u32::MAX,
        }
    }

    /// From 40 bits: the exponent, the sign in place of the mantissa's leading bit, the mantissa.
    pub fn from_bits(bits: Bits) -> Real {
        let exp = (bits >> 32) as i32 & 0xFF;
        let man = bits as u32;
        match exp {
            0 => Real::ZERO,
            _ => Real {
                negative: man >> 31 == 1,
                exp,
                man: man | 1 << 31,
            },
        }
    }

    pub fn bits(self) -> Bits {
        let man = self.man & (u32::MAX >> 1) | u32::from(self.negative) << 31;
        Bits::from(self.exp as u8) << 32 | Bits::from(man)
    }

    pub fn value(self) -> f64 {
        let size = f64::from(self.man) * f64::from(self.exp - BIAS - 32).exp2();
        if self.negative { -size } else { size }
    }

    /// The nearest one; saturates.
    pub fn nearest(x: f64) -> Real {
        let size = x.abs().min(2f64.powi(200));
        if size < 2f64.powi(-200) || x.is_nan() {
            return Real::ZERO;
        }
        let bits = size.to_bits();
        let exp = (bits >> 52) as i32 - 1022 + BIAS;
        // Of 53 bits of mantissa the upper 40 and those that the rounding hangs on.
        let mantissa = bits & ((1 << 52) - 1) | 1 << 52;
        rounded(x < 0.0, exp, (mantissa + (1 << 20)) >> 13 & !0xFF)
    }

    pub fn is_zero(self) -> bool {
        self.exp == 0
    }

    pub fn neg(self) -> Real {
        Real {
            negative: !self.negative && !self.is_zero(),
            ..self
        }
    }

    pub fn abs(self) -> Real {
        Real {
            negative: false,
            ..self
        }
    }

    fn signed(self, negative: bool) -> Real {
        Real {
            negative: negative && !self.is_zero(),
            ..self
        }
    }

    fn size(self) -> (i32, u32) {
        (self.exp, self.man)
    }

    pub fn sign(self) -> i32 {
        match (self.is_zero(), self.negative) {
            (true, _) => 0,
            (_, true) => -1,
            _ => 1,
        }
    }

    pub fn less(self, other: Real) -> bool {
        match (self.negative, other.negative) {
            (false, false) => self.size() < other.size(),
            (true, true) => other.size() < self.size(),
            (negative, _) => negative,
        }
    }

    pub fn min(self, other: Real) -> Real {
        if other.less(self) { other } else { self }
    }

    pub fn max(self, other: Real) -> Real {
        if self.less(other) { other } else { self }
    }

    pub fn add(self, other: Real) -> Real {
        if other.is_zero() {
            return self;
        }
        if self.is_zero() {
            return other;
        }
        let (great, small) = match self.exp < other.exp {
            true => (other, self),
            false => (self, other),
        };
        let upper = i64::from(great.man) << 8;
        let lower = (i64::from(small.man) << 8) >> (great.exp - small.exp).min(40);
        if great.negative == small.negative {
            let sum = upper + lower;
            let more = i32::from(sum >> 40 != 0);
            return rounded(great.negative, great.exp + more, (sum >> more) as u64);
        }
        let rest = upper - lower;
        let negative = great.negative != (rest < 0);
        normal(negative, great.exp, rest.unsigned_abs())
    }

    pub fn sub(self, other: Real) -> Real {
        match other.is_zero() {
            true => self,
            false => self.add(Real {
                negative: !other.negative,
                ..other
            }),
        }
    }

    pub fn mul(self, other: Real) -> Real {
        if self.is_zero() || other.is_zero() {
            return Real::ZERO;
        }
        let exp = self.exp + other.exp - BIAS;
        let product = product(self.man, other.man);
        let short = i32::from(product >> 39 == 0);
        rounded(
            self.negative != other.negative,
            exp - short,
            product << short,
        )
    }

    pub fn div(self, other: Real) -> Real {
        if self.is_zero() {
            return Real::ZERO;
        }
        if other.is_zero() {
            return Real::most(self.negative);
        }
        let whole = i32::from(self.man >= other.man);
        let (dividend, divisor) = (u64::from(self.man) << (32 - whole), u64::from(other.man));
        let half = 2 * (dividend % divisor) >= divisor;
        rounded(
            self.negative != other.negative,
            self.exp - other.exp + BIAS + whole,
            (dividend / divisor) << 8 | u64::from(half) << 7,
        )
    }

    pub fn sqrt(self) -> Real {
        if self.negative || self.is_zero() {
            return Real::ZERO;
        }
        let odd = self.exp & 1 == 1;
        // Twice what is left of the radicand, 32 bits behind the point.
        let mut left = match odd {
            true => u64::from(self.man) - (1 << 31),
            false => (u64::from(self.man) << 1) - (1 << 31),
        };
        let mut root = 1u64 << 31;
        for bit in (8..31).rev() {
            let tried = root | 1 << (bit - 1);
            if left >= tried {
                left -= tried;
                root |= 1 << bit;
            }
            left <<= 1;
        }
        let mut lowest = 0;
        for _ in 0..8 {
            let one = left >= root;
            left -= if one { root } else { 0 };
            left <<= 1;
            lowest = lowest << 1 | u64::from(one);
        }
        let half = u64::from(left >= root);
        let exp = self.exp / 2 + 64 + i32::from(odd);
        rounded(false, exp, (root | lowest) << 8 | half << 7)
    }

    /// The remainder with the divisor's sign.
    pub fn modulo(self, by: Real) -> Real {
        if by.is_zero() || self.is_zero() {
            return Real::ZERO;
        }
        let rest = match self.exp < by.exp {
            true => self.signed(by.negative),
            false => {
                let mut left = u64::from(self.man);
                for turn in (0..=self.exp - by.exp).rev() {
                    left -= if left >= u64::from(by.man) {
                        u64::from(by.man)
                    } else {
                        0
                    };
                    left <<= i32::from(turn > 0);
                }
                if left == 0 {
                    return Real::ZERO;
                }
                normal(by.negative, by.exp, left << 8)
            }
        };
        match self.negative != by.negative {
            true => rest.neg().add(by),
            false => rest,
        }
    }

    /// The magnitude cut to a whole number, and what is below its last place: its first eight
    /// bits, and whether there are more. None where an int does not hold it.
    fn whole(self) -> Option<(u32, u8, bool)> {
        if self.exp >= BIAS + 32 {
            return None;
        }
        let by = (BIAS + 32 - self.exp) as u32;
        let wide = u128::from(self.man) << 96;
        let (kept, fraction) = match by {
            0 => (self.man, 0),
            1..=31 => (self.man >> by, wide << (32 - by)),
            _ => (0, wide.checked_shr(by - 32).unwrap_or(0)),
        };
        let lost = by > 120 && !self.is_zero();
        Some((kept, (fraction >> 120) as u8, fraction << 8 != 0 || lost))
    }

    pub fn floor(self) -> i32 {
        match self.whole() {
            None => end(self.negative),
            Some((kept, first, more)) if self.negative => {
                (kept + u32::from(first != 0 || more)).wrapping_neg() as i32
            }
            Some((kept, ..)) => kept as i32,
        }
    }

    /// The nearest, halves away from 0.
    pub fn round(self) -> i32 {
        let Some((kept, first, _)) = self.whole() else {
            return end(self.negative);
        };
        let nearest = i64::from(kept) + i64::from(first >> 7);
        let signed = if self.negative { -nearest } else { nearest };
        signed.min(i64::from(i32::MAX)) as i32
    }

    pub fn from_int(n: i32) -> Real {
        normal(n < 0, BIAS + 32, u64::from(n.unsigned_abs()) << 8)
    }

    /// x P(x x) of a magnitude up to 1.
    pub(super) fn odd(self, terms: &Terms, negative: bool) -> Real {
        if self.is_zero() {
            return self;
        }
        let (exp, man) = match self.exp {
            129.. => (BIAS, u32::MAX),
            exp => (exp, self.man),
        };
        let square = upper(man, man) >> (2 * (BIAS - exp)).min(40);
        let series = terms.at(square as u32);
        normal(negative, exp + 1, product(series, man))
    }
}

/// The end of the ints.
fn end(negative: bool) -> i32 {
    if negative { i32::MIN } else { i32::MAX }
}

/// Upper 40 of 64 bits of a product, as `product.asm` adds it up.
pub fn product(a: u32, b: u32) -> u64 {
    let squares = |n: i32| (n * n / 4) >> 8;
    let mut sum = 0;
    for (i, x) in a.to_le_bytes().into_iter().enumerate() {
        for (j, y) in b.to_le_bytes().into_iter().enumerate() {
            let (x, y) = (i32::from(x), i32::from(y));
            sum += match i + j {
                0 | 1 => 0,
                2 => (squares(x + y) - squares(x - y)) as u64,
                column => ((x * y) as u64) << (8 * (column - 3)),
            };
        }
    }
    sum
}

/// Its upper 32 bits.
pub(super) fn upper(a: u32, b: u32) -> u64 {
    product(a, b) >> 8
}

/// A mantissa of 40 bits whose leading bit need not be one.
pub(super) fn normal(negative: bool, exp: i32, wide: u64) -> Real {
    match wide {
        0 => Real::ZERO,
        _ => {
            let by = wide.leading_zeros() as i32 - 24;
            rounded(negative, exp - by, wide << by)
        }
    }
}

/// The same of one that has it, to the nearest.
pub(super) fn rounded(negative: bool, exp: i32, wide: u64) -> Real {
    let man = (wide >> 8) + (wide >> 7 & 1);
    let more = (man >> 32) as i32;
    packed(negative, exp + more, (man >> more) as u32)
}

/// Exponents beyond the ends: the greatest, or 0.
pub(super) fn packed(negative: bool, exp: i32, man: u32) -> Real {
    match exp {
        ..=0 => Real::ZERO,
        1..=MOST => Real { negative, exp, man },
        _ => Real::most(negative),
    }
}
