//! Powers and logarithms, bit for bit as the Jack source computes them: an
//! exponent of 2 is summed up as an int and a fraction of 28 bits.

use super::fractions::{Fixed, Terms, fraction, series};
use super::{END, LEAST, Wide};

/// (2^x - 1) / x; to 2^-32.
#[rustfmt::skip]
const POWER_OF_TWO: Terms = Terms(&[5570, 39_203, 359_425, 2_581_310, 14_899_361, 64_485_306, 186_065_280]);
/// (artanh(x) / x - 1) / x^2 in x^2; to 2^-23.3, where x^2 is below 2^-5.
const ARTANH: Terms = Terms(&[39_705_749, 53_671_919, 89_478_510]);
/// ln(2).
const LN_2: Wide = Wide {
    s: 0,
    e: 126,
    m: 11356 << 14 | 8575,
};
/// log2(e) - 1.
const LOG_E: Wide = Wide {
    s: 0,
    e: 125,
    m: 14506 << 14 | 3786,
};

impl Fixed {
    /// Adds a log2(e).
    fn natural(&mut self, a: Wide) {
        self.gather(a);
        self.gather(LOG_E.mul(a));
    }

    /// 2 to the exponent.
    fn raise(self) -> Wide {
        let all = fraction(self.part, series(&POWER_OF_TWO, self.part, false));
        match self.whole {
            ..-8127 => Wide::ZERO,
            7874.. => Wide::largest(0),
            whole => Wide {
                s: 0,
                e: 127 + whole,
                m: LEAST + (all + 1) / 2,
            }
            .carried()
            .ended(),
        }
    }
}

impl Wide {
    pub fn exp(self) -> Wide {
        let mut exponent = Fixed::default();
        exponent.natural(self);
        exponent.raise()
    }

    /// A magnitude as 2^n r, r from 0.707 to 1.414: n and the logarithm of r, which is twice
    /// the inverse hyperbolic tangent of (r - 1) / (r + 1).
    fn near_log(self) -> (i32, Wide) {
        let e = if self.m >> 14 > 11585 { 126 } else { 127 };
        let r = Wide { s: 0, e, m: self.m };
        let x = r.sub(Wide::ONE).div(r.add(Wide::ONE));
        let square = x.square();
        let more = fraction(square, series(&ARTANH, square, false));
        let near = x.mul(Wide::of_fraction(END + more)).scale(1);
        (self.e - e, near)
    }

    /// Natural; of 0 or a negative the most negative value.
    pub fn log(self) -> Wide {
        if self.m == 0 || self.s == 1 {
            return Wide::largest(1);
        }
        let (n, near) = self.near_log();
        LN_2.mul(Wide::from_int(n)).add(near)
    }

    /// x^0 is 1, 0 to a negative the largest value, a negative to a fraction 0.
    pub fn pow(self, b: Wide) -> Wide {
        if b.m == 0 {
            return Wide::ONE;
        }
        if self.m == 0 {
            return if b.s == 1 {
                Wide::largest(0)
            } else {
                Wide::ZERO
            };
        }
        let mut s = 0;
        if self.s == 1 {
            match b.parity() {
                Some(odd) => s = odd,
                None => return Wide::ZERO,
            }
        }
        let (n, near) = self.near_log();
        let mut exponent = Fixed::default();
        exponent.natural(near.mul(b));
        // b n, exactly: n has 13 bits, and each word of b 14.
        let n = Wide::from_int(n);
        let (upper, lower) = (b.m >> 14 << 14, b.m & 16383);
        exponent.gather(n.mul(Wide { m: upper, ..b }));
        exponent.gather(n.mul(Wide { m: lower, ..b }.normal()));
        Wide {
            s,
            ..exponent.raise()
        }
    }

    /// Whether a whole number is odd; none of a fraction.
    fn parity(self) -> Option<i32> {
        if self.e > 154 {
            return Some(0);
        }
        if self.e < 127 {
            return None;
        }
        let places = 154 - self.e;
        let whole = self.m >> places;
        (whole << places == self.m).then_some((whole & 1) as i32)
    }
}
