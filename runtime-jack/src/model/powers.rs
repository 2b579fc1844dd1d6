//! Powers and logarithms, bit for bit as the Jack source computes them: an
//! exponent of 2 is summed up as an int and a fraction of 14 bits.

use super::functions::{Terms, fraction, series};
use super::{Float, Sums, power};

/// (2^x - 1) / x.
const POWER_OF_TWO: Terms = Terms(&[29, 151, 912, 3936, 11357]);
/// ln(1 + x) / x, signs alternating.
const LOGARITHM: Terms = Terms(&[2001, 3077, 3351, 4079, 5459, 8192, 16384]);
/// ln(2).
const LN_2: Float = Float {
    s: 0,
    e: 126,
    m: 11357,
};

/// An exponent being summed up: whole + part/16384.
#[derive(Default)]
struct Exponent {
    whole: i32,
    part: i32,
}

impl Exponent {
    /// Adds (high + low/16384) / 2^places; what is beyond all results counts as 32767.
    fn split(&mut self, high: i32, low: i32, places: i32, negative: bool) {
        let (mut high, mut low, mut places) = (high, low, places);
        while places < 0 {
            if high > 8191 || places < -30 {
                *self = Exponent {
                    whole: if negative { -32767 } else { 32767 },
                    part: 0,
                };
                return;
            }
            low += low;
            high = 2 * high + low / 16384;
            low &= 16383;
            places += 1;
        }
        if places > 14 {
            low = high / 2;
            high = 0;
            places -= 15;
        }
        if places > 14 {
            low = 0;
        } else {
            let unit = power(places);
            low = low / unit + (high & (unit - 1)) * (16384 / unit);
            high /= unit;
        }
        if !negative {
            self.whole += high;
            self.part += low;
        } else {
            self.whole -= high;
            if low > 0 {
                self.whole -= 1;
                self.part += 16384 - low;
            }
        }
        if self.part > 16383 {
            self.part -= 16384;
            self.whole += 1;
        }
    }

    /// Adds a log2(e), whose constant is 1 + 7253/2^14 + 1893/2^28.
    fn natural(&mut self, a: Float) {
        if a.m == 0 {
            return;
        }
        if a.e > 140 {
            self.split(16383, 0, -1, a.s == 1);
            return;
        }
        let (mut high, mut low) = long_product(a.m, 7253);
        low += fraction(a.m, 1893);
        high += a.m;
        if low > 16383 {
            low -= 16384;
            high += 1;
        }
        self.split(high, low, 140 - a.e, a.s == 1);
    }

    /// 2 to the exponent.
    fn raise(&self) -> Float {
        let m = 8192 + (fraction(self.part, series(&POWER_OF_TWO, self.part, false)) + 1) / 2;
        let (e, m) = if m > 16383 { (128, 8192) } else { (127, m) };
        match self.whole {
            ..-8127 => Float::ZERO,
            7874.. => Float::largest(0),
            whole => Float {
                s: 0,
                e: e + whole,
                m,
            }
            .ended(),
        }
    }
}

/// The product of two 14-bit ints, as its upper and its lower 14 bits.
fn long_product(a: i32, b: i32) -> (i32, i32) {
    let (h, l, k, m) = (a / 128, a & 127, b / 128, b & 127);
    let middle = h * m + l * k;
    let low = (middle & 127) * 128 + l * m;
    (h * k + middle / 128 + low / 16384, low & 16383)
}

impl Float {
    pub fn exp(self) -> Float {
        let mut exponent = Exponent::default();
        exponent.natural(self);
        exponent.raise()
    }

    /// A magnitude as 2^n r, r from 0.707 to 1.414: n and the logarithm of r.
    fn near_log(self) -> (i32, Float) {
        let (n, away) = if self.m > 11585 {
            (self.e - 126, self.m - 16384)
        } else {
            (self.e - 127, 2 * (self.m - 8192))
        };
        let part = away.abs();
        let shape = Float::of_part(series(&LOGARITHM, part, away > 0));
        let near = Float::of_part(part).product(shape);
        let s = i32::from(away < 0);
        (n, Float { s, ..near })
    }

    /// Natural; of 0 or a negative the most negative value.
    pub fn log<S: Sums>(self) -> Float {
        if self.m == 0 || self.s == 1 {
            return Float::largest(1);
        }
        let (n, near) = self.near_log();
        S::add(LN_2.product(Float::from_int(n)), near)
    }

    /// x^0 is 1, 0 to a negative the largest value, a negative to a fraction 0.
    pub fn pow(self, b: Float) -> Float {
        if b.m == 0 {
            return Float::from_int(1);
        }
        if self.m == 0 {
            return if b.s == 1 {
                Float::largest(0)
            } else {
                Float::ZERO
            };
        }
        let mut s = 0;
        if self.s == 1 {
            match b.parity() {
                Some(odd) => s = odd,
                None => return Float::ZERO,
            }
        }
        let (n, near) = self.near_log();
        let mut exponent = Exponent::default();
        exponent.natural(near.product(b));
        // b n, exactly: n has 13 bits.
        let (high, low) = long_product(b.m, n.abs());
        if n != 0 {
            exponent.split(high, low, 126 - b.e, (n < 0) != (b.s == 1));
        }
        let raised = exponent.raise();
        Float { s, ..raised }
    }

    /// Whether a whole number is odd; none of a fraction.
    fn parity(self) -> Option<i32> {
        if self.e > 140 {
            return Some(0);
        }
        if self.e < 127 {
            return None;
        }
        let unit = power(140 - self.e);
        let whole = self.m / unit;
        (whole * unit == self.m).then_some(whole & 1)
    }
}
