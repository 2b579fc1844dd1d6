//! Sines, logarithms and what comes of them, bit for bit as `asm/float` computes them.
//!
//! All rest on polynomials in fractions of 32 bits, whose terms come from Remez's exchange for
//! the interval that the argument is reduced to. Their own error is stated with each; what a step
//! cuts off adds at most 2^-31. The argument is a float again where the polynomial is multiplied
//! by it, so that small results are as near as others.

use super::model::{BIAS, Real, packed, product, upper};

/// A polynomial c0 -+ c1 x +- ...: terms in 1.31, the last first.
pub struct Terms {
    /// Whether signs alternate.
    alternate: bool,
    terms: &'static [u32],
}

impl Terms {
    /// The bytes that `series.asm` reads: how many terms follow the first, the mask, and the
    /// terms, each exclusive-or the mask.
    pub fn table(&self) -> Vec<i32> {
        let mask = if self.alternate { u32::MAX } else { 0 };
        let mut bytes = vec![self.terms.len() as i32 - 1, (mask & 0xFF) as i32];
        for term in self.terms {
            bytes.extend((term ^ mask).to_le_bytes().map(i32::from));
        }
        bytes
    }

    /// The value at x, which is in 0.32: 1.31.
    pub(super) fn at(&self, x: u32) -> u32 {
        let mut rest = self.terms.iter();
        let mut sum = rest.next().copied().unwrap_or(0);
        for term in rest {
            let higher = upper(sum, x) as u32;
            sum = match self.alternate {
                true => term.wrapping_sub(higher),
                false => term.wrapping_add(higher),
            };
        }
        sum
    }
}

/// sin(x pi/2) / x in x^2, for x from 0 to 1; off by 2^-35 at most.
pub const SINE: Terms = Terms {
    alternate: true,
    terms: &[
        0x0000_1CCA,
        0x0005_4051,
        0x0099_6898,
        0x0A33_5E03,
        0x52AE_F394,
        0xC90F_DAA2,
    ],
};

/// arctan(x) / x in x^2, for x from 0 to 1; off by 2^-31.4 at most.
pub const ARCTANGENT: Terms = Terms {
    alternate: true,
    terms: &[
        0x0024_70D0,
        0x00EF_5756,
        0x02E1_2B36,
        0x05B6_0FB3,
        0x089E_CE36,
        0x0B45_D8FF,
        0x0E27_0D27,
        0x1247_1AB5,
        0x1999_7A9D,
        0x2AAA_A9F2,
        0x7FFF_FFFF,
    ],
};

/// 2^x for x from 0 to 1, exact at 0; off by 2^-32 at most.
pub const EXPONENTIAL: Terms = Terms {
    alternate: false,
    terms: &[
        0x0000_AE0F,
        0x0004_C91B,
        0x002B_E00B,
        0x013B_19F1,
        0x071A_C50B,
        0x1EBF_BDD2,
        0x58B9_0BFC,
        0x8000_0000,
    ],
};

/// ln((1 + z) / (1 - z)) / 2z in z^2, for z up to (sqrt 2 - 1)/(sqrt 2 + 1); off by 2^-37 at most.
pub const LOGARITHM: Terms = Terms {
    alternate: false,
    terms: &[
        0x0F1D_A080,
        0x1243_29F9,
        0x1999_A9D2,
        0x2AAA_AA9B,
        0x8000_0000,
    ],
};

/// 2/pi, 32 bits behind the point.
const TWO_OVER_PI: u32 = 0xA2F9_836E;
/// log2(e), 31 bits behind the point.
const LOG2_E: u32 = 0xB8AA_3B29;
/// Half the root of 2, 32 bits behind the point.
const HALF_ROOT: u32 = 0xB504_F333;
const LN_2: Real = Real::plus(BIAS, 0xB172_17F8);
const QUARTER: Real = Real::plus(BIAS + 1, 0xC90F_DAA2);
const HALF: Real = Real::plus(BIAS + 2, 0xC90F_DAA2);
/// The bits of fractions of turns.
const WIDE: u64 = (1 << 40) - 1;

/// The sine of an angle that is so many quadrants further.
fn turned(a: Real, quadrants: u32) -> Real {
    let (mut quadrant, mut exp, mut wide) = (quadrants, BIAS, 0);
    if !a.is_zero() && a.exp < BIAS + 40 {
        let product = u128::from(product(a.man, TWO_OVER_PI));
        match a.exp > BIAS {
            true => {
                let turns = product << (a.exp - BIAS);
                quadrant = quadrant.wrapping_add((turns >> 40) as u32);
                wide = turns as u64 & WIDE;
            }
            false => (exp, wide) = (a.exp, product as u64),
        }
    }
    if quadrant & 1 == 1 {
        // From the other end.
        wide = !(wide >> (BIAS - exp).min(40)) & WIDE;
        exp = BIAS;
    }
    let into = super::model::normal(false, exp, wide);
    into.odd(&SINE, quadrant & 2 == 2)
}

impl Real {
    /// The sine of radians.
    pub fn sin(self) -> Real {
        turned(self, if self.negative { 2 } else { 0 })
    }

    /// The cosine of radians: the sine a quadrant on.
    pub fn cos(self) -> Real {
        turned(self, 1)
    }

    pub fn tan(self) -> Real {
        self.sin().div(self.cos())
    }

    /// The angle of (y, x); 0 of (0, 0).
    pub fn atan2(self, x: Real) -> Real {
        let (y, x_size) = (self.abs(), x.abs());
        let flat = !x_size.less(y);
        let (least, most) = if flat { (y, x_size) } else { (x_size, y) };
        if most.is_zero() {
            return Real::ZERO;
        }
        let mut angle = least.div(most).odd(&ARCTANGENT, false);
        if !flat {
            angle = angle.neg().add(QUARTER);
        }
        if x.negative {
            angle = angle.neg().add(HALF);
        }
        if self.negative { angle.neg() } else { angle }
    }

    /// x within -1..1, and the root of (1 + x)(1 - x).
    fn other(self) -> (Real, Real) {
        let x = match self.exp > BIAS {
            true => Real {
                negative: self.negative,
                ..Real::ONE
            },
            false => self,
        };
        let product = x.neg().add(Real::ONE).mul(x.add(Real::ONE));
        (x, product.sqrt())
    }

    pub fn acos(self) -> Real {
        let (x, other) = self.other();
        other.atan2(x)
    }

    pub fn asin(self) -> Real {
        let (x, other) = self.other();
        x.atan2(other)
    }

    /// e^x; saturates.
    pub fn exp(self) -> Real {
        if self.is_zero() {
            return Real::ONE;
        }
        if self.exp >= BIAS + 8 {
            return match self.negative {
                true => Real::ZERO,
                false => Real::most(false),
            };
        }
        let product = product(self.man, LOG2_E);
        let wide = match self.exp - BIAS + 1 {
            left @ 0.. => product << left,
            right => product >> (-right).min(40),
        };
        let (whole, part) = ((wide >> 40) as i32, wide & WIDE);
        let (exp, part) = match self.negative {
            true => (BIAS - whole, !part & WIDE),
            false => (BIAS + 1 + whole, part),
        };
        let power = EXPONENTIAL.at((part >> 8) as u32);
        let below_two = power >> 31 == 1;
        packed(false, exp, if below_two { power } else { u32::MAX })
    }

    /// The natural logarithm; of 0 and below the most negative.
    pub fn log(self) -> Real {
        if self.negative || self.is_zero() {
            return Real::most(true);
        }
        let exp = if self.man < HALF_ROOT { BIAS + 1 } else { BIAS };
        let part = Real::plus(exp, self.man);
        let z = part.sub(Real::ONE).div(part.add(Real::ONE));
        let mut low = z.odd(&LOGARITHM, z.negative);
        low.exp += i32::from(!low.is_zero());
        Real::from_int(self.exp - exp).mul(LN_2).add(low)
    }

    /// a^b; saturates. x^0 is 1, 0 to a negative the greatest, a negative to a fraction 0.
    pub fn pow(self, by: Real) -> Real {
        if by.is_zero() {
            return Real::ONE;
        }
        if self.is_zero() {
            return match by.negative {
                true => Real::most(false),
                false => Real::ZERO,
            };
        }
        let mut odd = false;
        if self.negative && by.exp <= BIAS + 32 {
            if by.exp <= BIAS {
                return Real::ZERO;
            }
            let shifted = u64::from(by.man) << (by.exp - BIAS);
            if shifted as u32 != 0 {
                return Real::ZERO;
            }
            odd = shifted >> 32 & 1 == 1;
        }
        let power = self.abs().log().mul(by).exp();
        if odd { power.neg() } else { power }
    }
}
