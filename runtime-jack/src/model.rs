//! Float316, bit for bit as the Jack source computes it; the 16-bit ints are in [`int`].
//!
//! Each function mirrors one subroutine of [`crate::parts`]; the test runs both.

mod functions;
mod int;
mod powers;
mod rounded;
pub use int::*;
pub use rounded::{Cut, Rounded, Sums};

use slowlight_routine::Bits;

/// The greatest exponent field; what would be larger becomes [`Float::largest`].
pub const TOP: i32 = 8000;
/// The least exponent field; what would be smaller becomes zero.
pub const BOTTOM: i32 = -8000;

/// A real: m/8192 x 2^(e - 127), negative where s is 1; m is in 8192..=16383, or 0 for zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Float {
    /// 1 for negative. The sign of a zero means nothing.
    pub s: i32,
    /// The exponent, with bias 127; from [`BOTTOM`] to [`TOP`], 0 for zero.
    pub e: i32,
    /// The mantissa, 14 bits, the first of them 1; 0 for zero.
    pub m: i32,
}

/// 2^k for k in 0..=14, as the part `Float.makePowers` keeps them.
fn power(k: i32) -> i32 {
    1 << k.clamp(0, 14)
}

// The subroutines' names, which are also those of the operators' traits.
#[allow(clippy::should_implement_trait)]
impl Float {
    /// Zero.
    pub const ZERO: Float = Float { s: 0, e: 0, m: 0 };

    /// The bits: m in 0..16, e (two's complement) in 16..32, s in 32.
    pub fn bits(self) -> Bits {
        let word = |x: i32| Bits::from(x as u16);
        word(self.m) | word(self.e) << 16 | Bits::from(self.s == 1) << 32
    }

    /// From bits; what is no value of the format counts as zero.
    pub fn from_bits(bits: Bits) -> Float {
        let s = i32::from(bits >> 32 & 1 == 1);
        let e = i32::from((bits >> 16) as u16 as i16);
        let m = i32::from(bits as u16);
        if (8192..=16383).contains(&m) && (BOTTOM..=TOP).contains(&e) {
            Float { s, e, m }
        } else {
            Float { s, ..Float::ZERO }
        }
    }

    /// The value of greatest magnitude, negative where `s` is 1.
    pub fn largest(s: i32) -> Float {
        Float {
            s,
            e: TOP,
            m: 16383,
        }
    }

    /// Kept between the ends of the exponent: the largest above, zero below.
    fn ended(self) -> Float {
        match self.e {
            e if e > TOP => Float::largest(self.s),
            e if e < BOTTOM => Float::ZERO,
            _ => self,
        }
    }

    /// `m` doubled until its first bit is 1, `e` counted down; `m` is not 0.
    fn normal(mut self) -> Float {
        while self.m < 8192 {
            self.m += self.m;
            self.e -= 1;
        }
        self
    }

    /// The nearest value, halves to even; saturating.
    pub fn nearest(x: f64) -> Float {
        let x = if x.is_nan() { 0.0 } else { x };
        if x.abs() < f64::MIN_POSITIVE {
            return Float::ZERO;
        }
        let s = i32::from(x < 0.0);
        if x.is_infinite() {
            return Float::largest(s);
        }
        let exponent = (x.abs().to_bits() >> 52) as i32 - 1023;
        let unit = 8192.0 / 2f64.powi(exponent.clamp(-1000, 1000));
        let unit = unit / 2f64.powi(exponent - exponent.clamp(-1000, 1000));
        let m = (x.abs() * unit).round_ties_even() as i32;
        let (e, m) = if m > 16383 {
            (exponent + 128, 8192)
        } else {
            (exponent + 127, m)
        };
        Float { s, e, m }
    }

    /// The value; saturating at the ends of `f64`.
    pub fn value(self) -> f64 {
        let e = (self.e - 140).clamp(-1200, 1200);
        let magnitude = f64::from(self.m) * 2f64.powi(e / 2) * 2f64.powi(e - e / 2);
        let magnitude = magnitude.min(f64::MAX);
        if self.s == 1 && self.m > 0 {
            -magnitude
        } else {
            magnitude
        }
    }

    /// Halves h and l of 7 bits each; the product of the low ones is dropped.
    pub fn mul(self, b: Float) -> Float {
        let s = (self.s + b.s) & 1;
        if self.m == 0 || b.m == 0 {
            return Float { s, ..Float::ZERO };
        }
        let (h, k) = (self.m / 128, b.m / 128);
        let m = h * k + (h * (b.m & 127) + (self.m & 127) * k) / 128;
        let e = self.e + b.e - 126;
        Float { s, e, m }.normal().ended()
    }

    /// Times 2^k, exact but for the ends.
    pub fn scale(self, k: i32) -> Float {
        let e = self.e + k;
        if self.m == 0 {
            self
        } else {
            Float { e, ..self }.ended()
        }
    }

    /// Where the signs differ, one bit behind the mantissa's last is kept until the
    /// difference is known; what is shifted out of the smaller behind that is lost.
    pub fn add(self, b: Float) -> Float {
        let (large, small) = if self.e < b.e { (b, self) } else { (self, b) };
        if large.m == 0 {
            return small;
        }
        let apart = large.e - small.e;
        if apart > 14 {
            return large;
        }
        let Float { s, e, m } = large;
        if s == small.s {
            let sum = m + small.m / power(apart);
            if sum < 16384 {
                return Float { s, e, m: sum };
            }
            let m = sum / 2;
            return Float { s, e: e + 1, m }.ended();
        }
        let twice = 2 * m - 2 * small.m / power(apart);
        if twice > 16383 {
            return Float { s, e, m: twice / 2 };
        }
        if twice == 0 {
            return Float::ZERO;
        }
        let s = if twice < 0 { 1 - s } else { s };
        let m = twice.abs();
        Float { s, e: e - 1, m }.normal().ended()
    }

    pub fn neg(self) -> Float {
        Float {
            s: 1 - self.s,
            ..self
        }
    }

    pub fn abs(self) -> Float {
        Float { s: 0, ..self }
    }

    pub fn sub(self, b: Float) -> Float {
        self.add(b.neg())
    }

    /// Fourteen steps of compare and subtract; the divisor is halved each time.
    pub fn div(self, b: Float) -> Float {
        if self.m == 0 {
            return Float::ZERO;
        }
        if b.m == 0 {
            return Float::largest(self.s);
        }
        let (mut rest, mut divisor, mut m) = (self.m, b.m, 0);
        while divisor > 0 {
            m += m;
            if rest >= divisor {
                rest -= divisor;
                m += 1;
            }
            divisor /= 2;
        }
        let (s, e) = ((self.s + b.s) & 1, self.e + 127 - b.e);
        Float { s, e, m }.normal().ended()
    }

    /// Two steps of Newton's from the mean of the operand, scaled to 1 to 4, and of what
    /// it is nearer to, 1 or 4; 0 for negatives.
    pub fn sqrt(self) -> Float {
        if self.m == 0 || self.s == 1 {
            return Float::ZERO;
        }
        let e = (self.e + 8000) / 2 - 4000 + 63 + (self.e & 1);
        let even = if self.e & 1 == 0 { 4096 } else { 0 };
        let m = self.m / 2 + 4096 + even;
        let mut root = Float { s: 0, e, m };
        for _ in 0..2 {
            root = root.add(self.ratio(root)).scale(-1);
        }
        root
    }

    pub fn less(self, b: Float) -> bool {
        if self.m == 0 {
            return b.m > 0 && b.s == 0;
        }
        if b.m == 0 || self.s != b.s {
            return self.s == 1;
        }
        let apart = if self.e == b.e {
            self.m - b.m
        } else {
            self.e - b.e
        };
        if self.s == 1 { apart > 0 } else { apart < 0 }
    }

    pub fn equal(self, b: Float) -> bool {
        self.m == b.m && (self.m == 0 || (self.e == b.e && self.s == b.s))
    }

    pub fn min(self, b: Float) -> Float {
        if b.less(self) { b } else { self }
    }

    pub fn max(self, b: Float) -> Float {
        if self.less(b) { b } else { self }
    }

    pub fn sign(self) -> i32 {
        if self.m == 0 { 0 } else { 1 - self.s - self.s }
    }

    pub fn floor(self) -> i32 {
        if self.m == 0 {
            return 0;
        }
        if self.e < 127 {
            return -self.s;
        }
        let unit = power(140 - self.e);
        let whole = match self.e {
            e if e > 141 => MOST,
            141 => self.m + self.m,
            _ => self.m / unit,
        };
        let cut = self.e < 140 && whole * unit != self.m;
        if self.s == 1 {
            -(whole + i32::from(cut))
        } else {
            whole
        }
    }

    /// Half away from zero.
    pub fn round(self) -> i32 {
        let whole = match self.e {
            _ if self.m == 0 => 0,
            e if e < 126 => 0,
            e if e > 141 => MOST,
            141 => self.m + self.m,
            140 => self.m,
            e => (self.m + power(139 - e)) / power(140 - e),
        };
        if self.s == 1 { -whole } else { whole }
    }

    /// The remainder with the divisor's sign, by subtracting the divisor at
    /// ever lower places; 0 where the divisor is 0.
    pub fn modulo<S: Sums>(self, b: Float) -> Float {
        if self.m == 0 || b.m == 0 {
            return Float::ZERO;
        }
        let rest = if self.e < b.e {
            self
        } else {
            let mut rest = self.m;
            for place in (b.e..=self.e).rev() {
                rest -= if rest >= b.m { b.m } else { 0 };
                rest += if place > b.e { rest } else { 0 };
            }
            if rest == 0 {
                return Float::ZERO;
            }
            Float {
                s: self.s,
                e: b.e,
                m: rest,
            }
            .normal()
            .ended()
        };
        if rest.m == 0 || rest.s == b.s {
            rest
        } else {
            S::add(rest, b)
        }
    }

    /// From an int; above 16383 its last bit is cut.
    pub fn from_int(i: i32) -> Float {
        let magnitude = magnitude(i);
        if magnitude == 0 {
            return Float::ZERO;
        }
        let (e, m) = if magnitude > 16383 {
            (141, magnitude / 2)
        } else {
            (140, magnitude)
        };
        Float {
            s: i32::from(i < 0),
            e,
            m,
        }
        .normal()
    }
}
