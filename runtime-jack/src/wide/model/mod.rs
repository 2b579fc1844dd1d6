//! Float416, bit for bit as the Jack source computes it.
//!
//! Each function mirrors one subroutine of [`super::parts`]; a test runs both. The
//! machine has a mantissa in two words, the upper and the lower 14 bits of what is one
//! number here.

mod conversions;
mod fractions;
mod functions;
mod powers;

use crate::model::{BOTTOM, TOP};
use slowlight_routine::Bits;

/// The least mantissa: its first bit is 1.
pub const LEAST: i64 = 1 << 27;
/// One more than the greatest mantissa.
pub const END: i64 = 1 << 28;

/// A real: m/2^27 x 2^(e - 127), negative where s is 1; m is in 2^27..2^28, or 0 for zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wide {
    /// 1 for negative. The sign of a zero means nothing.
    pub s: i32,
    /// The exponent, with bias 127; from [`BOTTOM`] to [`TOP`], 0 for zero.
    pub e: i32,
    /// The mantissa, 28 bits, the first of them 1; 0 for zero.
    pub m: i64,
}

/// The digits of 7 bits of a number of 28, the last first.
fn digits(m: i64) -> [i64; 4] {
    [m & 127, m >> 7 & 127, m >> 14 & 127, m >> 21]
}

/// The product of two numbers of 28 bits, over 2^21, of whose digits' products the last three
/// are left out and those in the middle cut, after so much is added: what the subroutines do.
fn product(a: i64, b: i64, added: i64) -> i64 {
    let ([t, r, q, p], [o, n, k, h]) = (digits(a), digits(b));
    let x = (q * o + t * k) / 128 + r * n / 128 + added;
    let y = p * o + q * n + r * k + t * h + x;
    let z = p * n + q * k + r * h;
    y + ((((p * h) << 7) + p * k + q * h) << 14) + (z << 7)
}

// The subroutines' names, which are also those of the operators' traits.
#[allow(clippy::should_implement_trait)]
impl Wide {
    /// Zero.
    pub const ZERO: Wide = Wide { s: 0, e: 0, m: 0 };

    /// 1.
    pub const ONE: Wide = Wide {
        s: 0,
        e: 127,
        m: LEAST,
    };

    /// The bits: the mantissa's words in 0..16 and 16..32, the upper one there, e (two's
    /// complement) in 32..48, s in 48.
    pub fn bits(self) -> Bits {
        let [s, e, m, l] = self.words();
        let word = |x: i32| Bits::from(x as u16);
        word(l) | word(m) << 16 | word(e) << 32 | word(s) << 48
    }

    /// From bits; what is no value of the format counts as zero.
    pub fn from_bits(bits: Bits) -> Wide {
        let word = |at: u32| i64::from((bits >> at) as u16);
        let (s, e) = ((bits >> 48 & 1) as i32, i32::from((bits >> 32) as i16));
        let m = word(16) << 14 | word(0);
        let held = word(0) < 1 << 14 && word(16) < 1 << 14 && m >= LEAST;
        if held && (BOTTOM..=TOP).contains(&e) {
            Wide { s, e, m }
        } else {
            Wide { s, ..Wide::ZERO }
        }
    }

    /// As the machine has it: sign, exponent, and the mantissa's words, the upper first.
    pub fn words(self) -> [i32; 4] {
        [
            self.s,
            self.e,
            (self.m >> 14) as i32,
            (self.m & 16383) as i32,
        ]
    }

    /// The value of greatest magnitude, negative where `s` is 1.
    pub fn largest(s: i32) -> Wide {
        Wide {
            s,
            e: TOP,
            m: END - 1,
        }
    }

    /// Kept between the ends of the exponent: the largest above, zero below.
    fn ended(self) -> Wide {
        match self.e {
            e if e > TOP => Wide::largest(self.s),
            e if e < BOTTOM => Wide::ZERO,
            _ => self,
        }
    }

    /// A mantissa that may have been rounded up to the next power of two.
    fn carried(self) -> Wide {
        match self.m {
            END => Wide {
                e: self.e + 1,
                m: LEAST,
                ..self
            },
            _ => self,
        }
    }

    /// `m` doubled until its first bit is 1, `e` counted down; zero of 0.
    fn normal(mut self) -> Wide {
        if self.m == 0 {
            return Wide::ZERO;
        }
        while self.m < LEAST {
            self.m += self.m;
            self.e -= 1;
        }
        if self.e < BOTTOM { Wide::ZERO } else { self }
    }

    /// The nearest value, halves to even; saturating.
    pub fn nearest(x: f64) -> Wide {
        let x = if x.is_nan() { 0.0 } else { x };
        if x.abs() < f64::MIN_POSITIVE {
            return Wide::ZERO;
        }
        let s = i32::from(x < 0.0);
        if x.is_infinite() {
            return Wide::largest(s);
        }
        let exponent = (x.abs().to_bits() >> 52) as i32 - 1023;
        let unit = LEAST as f64 / 2f64.powi(exponent.clamp(-900, 900));
        let unit = unit / 2f64.powi(exponent - exponent.clamp(-900, 900));
        let m = (x.abs() * unit).round_ties_even() as i64;
        let e = exponent + 127;
        Wide { s, e, m }.carried()
    }

    /// The value; saturating at the ends of `f64`.
    pub fn value(self) -> f64 {
        let e = (self.e - 154).clamp(-1300, 1200);
        let magnitude = self.m as f64 * 2f64.powi(e / 2) * 2f64.powi(e - e / 2);
        let magnitude = magnitude.min(f64::MAX);
        if self.s == 1 && self.m > 0 {
            -magnitude
        } else {
            magnitude
        }
    }

    /// Digits of 7 bits each; of their 16 products the last three are left out, which is up to
    /// a sixteenth of a unit in the last place.
    pub fn mul(self, b: Wide) -> Wide {
        let s = (self.s + b.s) & 1;
        if self.m == 0 || b.m == 0 {
            return Wide { s, ..Wide::ZERO };
        }
        let all = product(self.m, b.m, 0);
        let (whole, rest) = (all >> 7, all & 127);
        let e = self.e + b.e - 126;
        let rounded = if whole < LEAST {
            Wide {
                s,
                e: e - 1,
                m: 2 * whole + (rest + 32) / 64,
            }
        } else {
            let m = whole + rest / 64;
            Wide { s, e, m }
        };
        rounded.carried().ended()
    }

    /// Times 2^k, exact but for the ends.
    pub fn scale(self, k: i32) -> Wide {
        let e = self.e + k;
        if self.m == 0 {
            self
        } else {
            Wide { e, ..self }.ended()
        }
    }

    /// A sum goes to the nearest, halves up. A difference keeps one bit behind the
    /// mantissa's last: to the nearest, halves down, but for what lies within half a
    /// unit under a power of two, which may become that power.
    pub fn add(self, b: Wide) -> Wide {
        let (large, small) = if self.e < b.e { (b, self) } else { (self, b) };
        if large.m == 0 {
            return small;
        }
        let apart = large.e - small.e;
        if apart > 28 {
            return large;
        }
        let Wide { s, e, m } = large;
        // What is shifted out of the smaller: its last bit is rounded.
        let shifted = |places: i32| small.m >> places;
        if s == small.s {
            let sum = m + shifted(apart);
            let (e, m) = if sum >= END {
                (e + 1, (sum + 1) / 2)
            } else if apart > 0 {
                (e, sum + (shifted(apart - 1) & 1))
            } else {
                (e, sum)
            };
            return Wide { s, e, m }.carried().ended();
        }
        if apart == 0 {
            let s = if m < small.m { 1 - s } else { s };
            let m = (m - small.m).abs();
            return Wide { s, e, m }.normal();
        }
        // Twice the difference: the last bit is the guard.
        let twice = 2 * m - shifted(apart - 1);
        if twice >= END {
            let m = twice / 2;
            return Wide { s, e, m };
        }
        let e = e - 1;
        let m = match apart {
            1 => twice,
            _ => twice - (shifted(apart - 2) & 1),
        };
        Wide { s, e, m }.normal()
    }

    pub fn neg(self) -> Wide {
        Wide {
            s: 1 - self.s,
            ..self
        }
    }

    pub fn abs(self) -> Wide {
        Wide { s: 0, ..self }
    }

    pub fn sub(self, b: Wide) -> Wide {
        self.add(b.neg())
    }

    /// Digits of 7, 6, 6, 6 and 2 bits, found with a divisor of 8 bits that is too large; what
    /// they lack is in the next, and the last is rounded.
    pub fn div(self, b: Wide) -> Wide {
        if self.m == 0 {
            return Wide::ZERO;
        }
        if b.m == 0 {
            return Wide::largest(self.s);
        }
        let s = (self.s + b.s) & 1;
        let mut e = self.e + 127 - b.e;
        let mut rest = self.m - b.m;
        if rest < 0 {
            e -= 1;
            rest += self.m;
        }
        let divisor = (b.m >> 20) + 1;
        let mut m = LEAST;
        for (by, unit) in [(128, 20), (64, 14), (64, 8), (64, 2)] {
            let digit = (rest >> 14) * (by / 64) / divisor;
            rest = rest * by - digit * b.m;
            m += digit << unit;
        }
        let upper = b.m >> 14;
        m += ((rest >> 14) + upper / 8) / (upper / 4);
        Wide { s, e, m }.carried().ended()
    }

    /// A root of the upper 14 bits, nearly; what is missing over twice that, less a small
    /// square; 0 for negatives.
    pub fn sqrt(self) -> Wide {
        if self.m == 0 || self.s == 1 {
            return Wide::ZERO;
        }
        let odd = self.e & 1 == 1;
        let (m, half) = match odd {
            true => (self.m >> 1, self.m & 1),
            false => (self.m, 0),
        };
        let (upper, lower) = (m >> 14, m & 16383);
        let g = upper.isqrt();
        let rest = (upper - g * g) * 64 + lower / 256;
        let c = rest / g;
        let mut root = g * 128 + (rest - c * c / 256 + g / 2) / g;
        let mut rest = m - root * root;
        if rest < 0 {
            root -= 1;
            rest += 2 * root + 1;
        }
        let divisor = root / 64 + 1;
        let first = rest / divisor;
        rest = rest * 64 + half * 32 - first * root;
        let second = rest / divisor;
        rest = rest * 64 - second * root - first * first / 4 + root / 4;
        let last = if rest < 0 { -1 } else { rest / (root / 2) };
        Wide {
            s: 0,
            e: (self.e + 8127) / 2 - 4000,
            m: (root << 14) + first * 128 + second * 2 + last,
        }
        .carried()
    }

    pub fn less(self, b: Wide) -> bool {
        if self.m == 0 {
            return b.m > 0 && b.s == 0;
        }
        if b.m == 0 || self.s != b.s {
            return self.s == 1;
        }
        let (one, other) = ((self.e, self.m), (b.e, b.m));
        if self.s == 1 {
            other < one
        } else {
            one < other
        }
    }

    pub fn equal(self, b: Wide) -> bool {
        self.m == b.m && (self.m == 0 || (self.e == b.e && self.s == b.s))
    }

    pub fn min(self, b: Wide) -> Wide {
        if b.less(self) { b } else { self }
    }

    pub fn max(self, b: Wide) -> Wide {
        if self.less(b) { b } else { self }
    }

    pub fn sign(self) -> i32 {
        if self.m == 0 { 0 } else { 1 - self.s - self.s }
    }
}
