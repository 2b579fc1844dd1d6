//! Sines, arcs, powers and logarithms, bit for bit as the Jack source computes
//! them.
//!
//! An argument is reduced exactly, in ints. What is left is a fraction of 14
//! bits, for which a polynomial is summed up in such fractions ([`fraction`],
//! [`series`]; the terms come from Remez's exchange); the result is the reduced
//! argument times that, rounded ([`Float::product`]), so that small results
//! keep all their bits. The errors are a few units in the last place, of 2^-13.

use super::{Float, power};

/// The product of two fractions of 14 bits, 0 to 16384 for 1, to the nearest.
fn fraction(a: i32, b: i32) -> i32 {
    let (h, l, k, m) = (a / 128, a & 127, b / 128, b & 127);
    h * k + (h * m + l * k + l * m / 128 + 64) / 128
}

/// Terms of a polynomial, as fractions of 14 bits, the last first.
struct Terms(&'static [i32]);

/// sin(2 r) / 2r in r^2, signs alternating.
const SINE: Terms = Terms(&[11, 208, 2184, 10923, 16384]);
/// (2^x - 1) / x.
const POWER_OF_TWO: Terms = Terms(&[29, 151, 912, 3936, 11357]);
/// ln(1 + x) / x, signs alternating.
const LOGARITHM: Terms = Terms(&[2001, 3077, 3351, 4079, 5459, 8192, 16384]);
/// arctan(x) / x in x^2, signs alternating.
const ARCTANGENT: Terms = Terms(&[131, 613, 1382, 2214, 3258, 5460, 16384]);
/// (arcsin(x) / x - 1) / x^2 in x^2.
const ARCSINE: Terms = Terms(&[749, 688, 1231, 2731]);

/// c0 + x (c1 + x (c2 + ...)), with - for + where `minus`.
fn series(terms: &Terms, x: i32, minus: bool) -> i32 {
    let step = |sum: i32, term: &i32| {
        let higher = fraction(x, sum);
        if minus { term - higher } else { term + higher }
    };
    terms.0.iter().fold(0, step)
}

/// pi / 2, too large by `EXCESS`; pi is this, scaled.
const QUARTER: Float = Float {
    s: 0,
    e: 127,
    m: 12868,
};
const EXCESS: Float = Float {
    s: 0,
    e: 109,
    m: 9566,
};
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
    /// The fraction of 14 bits that a magnitude of at most 1 is; the rest is cut.
    fn part(self) -> i32 {
        match 126 - self.e {
            14.. => 0,
            -1 => 16384,
            places => self.m / power(places),
        }
    }

    /// A fraction of 14 bits, at most 2, as a Float; its 15th bit is rounded.
    fn of_part(part: i32) -> Float {
        let float = |e, m| Float { s: 0, e, m };
        match part {
            0 => Float::ZERO,
            16384.. => float(127, (part + 1) / 2),
            _ => float(126, part).normal(),
        }
    }

    /// To the nearest, unlike `mul`.
    pub fn product(self, b: Float) -> Float {
        let s = (self.s + b.s) & 1;
        if self.m == 0 || b.m == 0 {
            return Float { s, ..Float::ZERO };
        }
        let (h, l, k, n) = (self.m / 128, self.m & 127, b.m / 128, b.m & 127);
        let middle = h * n + l * k + l * n / 128;
        let (mut m, mut rest, mut e) = (h * k + middle / 128, middle & 127, self.e + b.e - 126);
        if m < 8192 {
            rest += rest;
            m = 2 * m + rest / 128;
            rest &= 127;
            e -= 1;
        }
        m += rest / 64;
        if m > 16383 {
            (e, m) = (e + 1, 8192);
        }
        Float { s, e, m }.ended()
    }

    /// To the nearest, unlike `div`; by zero as there.
    pub fn ratio(self, b: Float) -> Float {
        if self.m == 0 {
            return Float::ZERO;
        }
        if b.m == 0 {
            return Float::largest(self.s);
        }
        let (mut rest, mut e) = (self.m, self.e - b.e + 127);
        if rest < b.m {
            rest += rest;
            e -= 1;
        }
        rest -= b.m;
        let mut m = 1;
        while m < 8192 {
            rest += rest;
            m += m;
            if rest >= b.m {
                rest -= b.m;
                m += 1;
            }
        }
        if rest + rest >= b.m {
            m += 1;
        }
        if m > 16383 {
            (e, m) = (e + 1, 8192);
        }
        let s = (self.s + b.s) & 1;
        Float { s, e, m }.ended()
    }

    /// How many quarter turns are in the magnitude of an angle, and what is
    /// left, exactly, when each counts [`QUARTER`]. From 32768 on, where two
    /// Floats are more than a radian apart, an angle counts as 0.
    fn reduced(self) -> (i32, Float) {
        if self.e < 127 {
            return (0, self.abs());
        }
        if self.e > 141 || self.m == 0 {
            return (0, Float::ZERO);
        }
        let (mut rest, mut turns) = (self.m, 0);
        for place in (127..=self.e).rev() {
            turns += turns;
            if rest >= QUARTER.m {
                rest -= QUARTER.m;
                turns += 1;
            }
            rest += if place > 127 { rest } else { 0 };
        }
        let left = Float {
            s: 0,
            e: 127,
            m: rest,
        };
        (
            turns,
            if rest == 0 {
                Float::ZERO
            } else {
                left.normal()
            },
        )
    }

    /// The sine of the magnitude and `quarter` quarter turns.
    fn quarter_sine(self, quarter: i32) -> Float {
        let (turns, left) = self.reduced();
        let quadrant = turns + quarter;
        let excess = |n| EXCESS.product(Float::from_int(n));
        // The excess of each quarter turn taken away is put back.
        let angle = match quadrant & 1 {
            1 => QUARTER.sub(left).sub(excess(turns + 1)),
            _ if turns > 0 => left.add(excess(turns)),
            _ => left,
        };
        let half = angle.scale(-1).part();
        let shape = Float::of_part(series(&SINE, fraction(half, half), true));
        let sine = angle.product(shape);
        let s = (sine.s + (quadrant & 2) / 2) & 1;
        Float { s, ..sine }
    }

    pub fn sin(self) -> Float {
        let sine = self.quarter_sine(0);
        let s = (sine.s + self.s) & 1;
        Float { s, ..sine }
    }

    pub fn cos(self) -> Float {
        self.quarter_sine(1)
    }

    pub fn tan(self) -> Float {
        self.sin().ratio(self.cos())
    }

    /// The angle of (y, x) = (self, x), 0 of (0, 0).
    pub fn atan2(self, x: Float) -> Float {
        if self.m == 0 && x.m == 0 {
            return Float::ZERO;
        }
        let flat = self.abs().less(x.abs());
        let ratio = if flat { self.ratio(x) } else { x.ratio(self) }.abs();
        let part = ratio.part();
        let shape = Float::of_part(series(&ARCTANGENT, fraction(part, part), true));
        let mut angle = ratio.product(shape);
        if !flat {
            angle = QUARTER.sub(angle);
        }
        if x.s == 1 && x.m > 0 {
            angle = QUARTER.scale(1).sub(angle);
        }
        let s = if self.m > 0 { self.s } else { 0 };
        Float { s, ..angle }
    }

    /// Below 1/2 the arc sine of the magnitude, from there on its arc cosine,
    /// as twice the arc sine of the root of (1 - x)/2; and whether it is this.
    fn small_arc(self) -> (Float, bool) {
        let large = self.m > 0 && self.e > 125;
        let (sine, square) = if large {
            let less = if self.e > 126 { 0 } else { 16384 - self.m };
            (Float::from_int(less).scale(-15).near_root(), less / 2)
        } else {
            let part = self.part();
            (self.abs(), fraction(part, part))
        };
        let shape = 16384 + fraction(square, series(&ARCSINE, square, false));
        let arc = sine.product(Float::of_part(shape));
        (if large { arc.scale(1) } else { arc }, large)
    }

    /// Of the argument clamped to -1..1.
    pub fn asin(self) -> Float {
        let (arc, large) = self.small_arc();
        let arc = if large { QUARTER.sub(arc) } else { arc };
        Float { s: self.s, ..arc }
    }

    /// Of the argument clamped to -1..1.
    pub fn acos(self) -> Float {
        match self.small_arc() {
            (arc, true) if self.s == 0 => arc,
            (arc, true) => QUARTER.scale(1).sub(arc),
            (arc, false) => QUARTER.sub(Float { s: self.s, ..arc }),
        }
    }

    /// A root with one step more than `sqrt`, by `ratio`.
    fn near_root(self) -> Float {
        let root = self.sqrt();
        if root.m == 0 {
            return root;
        }
        root.add(self.ratio(root)).scale(-1)
    }

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
    pub fn log(self) -> Float {
        if self.m == 0 || self.s == 1 {
            return Float::largest(1);
        }
        let (n, near) = self.near_log();
        LN_2.product(Float::from_int(n)).add(near)
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
