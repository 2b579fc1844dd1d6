//! Sines and arcs, bit for bit as the Jack source computes
//! them.
//!
//! An argument is reduced exactly, in ints. What is left is a fraction of 14
//! bits, for which a polynomial is summed up in such fractions ([`fraction`],
//! [`series`]; the terms come from Remez's exchange); the result is the reduced
//! argument times that, rounded ([`Float::product`]), so that small results
//! keep all their bits. The errors are a few units in the last place, of 2^-13.

use super::{Float, Sums, power};

/// The product of two fractions of 14 bits, 0 to 16384 for 1, to the nearest.
pub(super) fn fraction(a: i32, b: i32) -> i32 {
    let (h, l, k, m) = (a / 128, a & 127, b / 128, b & 127);
    h * k + (h * m + l * k + l * m / 128 + 64) / 128
}

/// Terms of a polynomial, as fractions of 14 bits, the last first.
pub(super) struct Terms(pub(super) &'static [i32]);

/// sin(2 r) / 2r in r^2, signs alternating.
const SINE: Terms = Terms(&[11, 208, 2184, 10923, 16384]);
/// arctan(x) / x in x^2, signs alternating.
const ARCTANGENT: Terms = Terms(&[131, 613, 1382, 2214, 3258, 5460, 16384]);
/// (arcsin(x) / x - 1) / x^2 in x^2.
const ARCSINE: Terms = Terms(&[749, 688, 1231, 2731]);

/// c0 + x (c1 + x (c2 + ...)), with - for + where `minus`.
pub(super) fn series(terms: &Terms, x: i32, minus: bool) -> i32 {
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
    pub(super) fn of_part(part: i32) -> Float {
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
    fn quarter_sine<S: Sums>(self, quarter: i32) -> Float {
        let (turns, left) = self.reduced();
        let quadrant = turns + quarter;
        let excess = |n| EXCESS.product(Float::from_int(n));
        // The excess of each quarter turn taken away is put back.
        let angle = match quadrant & 1 {
            1 => S::sub(S::sub(QUARTER, left), excess(turns + 1)),
            _ if turns > 0 => S::add(left, excess(turns)),
            _ => left,
        };
        let half = angle.scale(-1).part();
        let shape = Float::of_part(series(&SINE, fraction(half, half), true));
        let sine = angle.product(shape);
        let s = (sine.s + (quadrant & 2) / 2) & 1;
        Float { s, ..sine }
    }

    pub fn sin<S: Sums>(self) -> Float {
        let sine = self.quarter_sine::<S>(0);
        let s = (sine.s + self.s) & 1;
        Float { s, ..sine }
    }

    pub fn cos<S: Sums>(self) -> Float {
        self.quarter_sine::<S>(1)
    }

    pub fn tan<S: Sums>(self) -> Float {
        self.sin::<S>().ratio(self.cos::<S>())
    }

    /// The angle of (y, x) = (self, x), 0 of (0, 0).
    pub fn atan2<S: Sums>(self, x: Float) -> Float {
        if self.m == 0 && x.m == 0 {
            return Float::ZERO;
        }
        let flat = self.abs().less(x.abs());
        let ratio = if flat { self.ratio(x) } else { x.ratio(self) }.abs();
        let part = ratio.part();
        let shape = Float::of_part(series(&ARCTANGENT, fraction(part, part), true));
        let mut angle = ratio.product(shape);
        if !flat {
            angle = S::sub(QUARTER, angle);
        }
        if x.s == 1 && x.m > 0 {
            angle = S::sub(QUARTER.scale(1), angle);
        }
        let s = if self.m > 0 { self.s } else { 0 };
        Float { s, ..angle }
    }

    /// Below 1/2 the arc sine of the magnitude, from there on its arc cosine,
    /// as twice the arc sine of the root of (1 - x)/2; and whether it is this.
    fn small_arc<S: Sums>(self) -> (Float, bool) {
        let large = self.m > 0 && self.e > 125;
        let (sine, square) = if large {
            let less = if self.e > 126 { 0 } else { 16384 - self.m };
            (S::root(Float::from_int(less).scale(-15)), less / 2)
        } else {
            let part = self.part();
            (self.abs(), fraction(part, part))
        };
        let shape = 16384 + fraction(square, series(&ARCSINE, square, false));
        let arc = sine.product(Float::of_part(shape));
        (if large { arc.scale(1) } else { arc }, large)
    }

    /// Of the argument clamped to -1..1.
    pub fn asin<S: Sums>(self) -> Float {
        let (arc, large) = self.small_arc::<S>();
        let arc = if large { S::sub(QUARTER, arc) } else { arc };
        Float { s: self.s, ..arc }
    }

    /// Of the argument clamped to -1..1.
    pub fn acos<S: Sums>(self) -> Float {
        match self.small_arc::<S>() {
            (arc, true) if self.s == 0 => arc,
            (arc, true) => S::sub(QUARTER.scale(1), arc),
            (arc, false) => S::sub(QUARTER, Float { s: self.s, ..arc }),
        }
    }
}
