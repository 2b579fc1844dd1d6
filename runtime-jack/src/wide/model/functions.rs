//! Sines and arcs, bit for bit as the Jack source computes them.
//!
//! As for the floats of three words ([`crate::model`]): an argument is reduced exactly, and
//! the result is what is left of it times a polynomial, summed up in fractions of 28 bits
//! whose terms come from Remez's exchange. Arcs are those of two operands.

use super::fractions::{Terms, series};
use super::{END, Wide};

/// (1 - sin(2 r) / 2r) / r^2 in r^2, signs alternating; to 2^-33.
const SINE: Terms = Terms(&[6619, 189_229, 3_408_673, 35_791_392, 178_956_971]);
/// (1 - arctan(x) / x) / x^2 in x^2, signs alternating; to 2^-28.9.
#[rustfmt::skip]
const ARCTANGENT: Terms = Terms(&[
    420_305, 2_548_243, 7_237_394, 13_321_941, 18_982_483, 24_013_301, 29_772_114, 38_344_050, 53_686_983, 89_478_485,
]);

/// pi / 2, too large by `EXCESS`; pi is this, scaled.
const QUARTER: Wide = Wide {
    s: 0,
    e: 127,
    m: 12867 << 14 | 15787,
};
const EXCESS: Wide = Wide {
    s: 0,
    e: 99,
    m: 14202 << 14 | 5950,
};

/// 1 less what a polynomial makes of a square, times that square.
fn shape(terms: &Terms, square: i64) -> Wide {
    let all = super::fractions::fraction(square, series(terms, square, true));
    Wide::of_fraction(END - all)
}

impl Wide {
    /// How many quarter turns are in the magnitude of an angle, and what is
    /// left, exactly, when each counts [`QUARTER`]. From 32768 on an angle counts as 0.
    fn reduced(self) -> (i32, Wide) {
        if self.e < 127 {
            return (0, self.abs());
        }
        if self.e > 141 || self.m == 0 {
            return (0, Wide::ZERO);
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
        let (s, e, m) = (0, 127, rest);
        (turns, Wide { s, e, m }.normal())
    }

    /// The sine of the magnitude and `quarter` quarter turns.
    fn quarter_sine(self, quarter: i32) -> Wide {
        let (turns, left) = self.reduced();
        let quadrant = turns + quarter;
        let excess = |n| EXCESS.mul(Wide::from_int(n));
        // The excess of each quarter turn taken away is put back.
        let angle = match quadrant & 1 {
            1 => QUARTER.sub(left).sub(excess(turns + 1)),
            _ if turns > 0 => left.add(excess(turns)),
            _ => left,
        };
        let sine = angle.mul(shape(&SINE, angle.scale(-1).square()));
        let s = (sine.s + (quadrant & 2) / 2) & 1;
        Wide { s, ..sine }
    }

    pub fn sin(self) -> Wide {
        let sine = self.quarter_sine(0);
        let s = (sine.s + self.s) & 1;
        Wide { s, ..sine }
    }

    pub fn cos(self) -> Wide {
        self.quarter_sine(1)
    }

    pub fn tan(self) -> Wide {
        self.sin().div(self.cos())
    }

    /// The angle of (y, x) = (self, x), 0 of (0, 0).
    pub fn atan2(self, x: Wide) -> Wide {
        if self.m == 0 && x.m == 0 {
            return Wide::ZERO;
        }
        let flat = self.abs().less(x.abs());
        let ratio = if flat { self.div(x) } else { x.div(self) }.abs();
        let mut angle = ratio.mul(shape(&ARCTANGENT, ratio.square()));
        if !flat {
            angle = QUARTER.sub(angle);
        }
        if x.s == 1 && x.m > 0 {
            angle = QUARTER.scale(1).sub(angle);
        }
        let s = if self.m > 0 { self.s } else { 0 };
        Wide { s, ..angle }
    }

    /// The root of 1 less the square: the other leg of a right angle.
    fn leg(self) -> Wide {
        if self.e > 126 {
            return Wide::ZERO;
        }
        let a = self.abs();
        Wide::ONE.add(a).mul(Wide::ONE.sub(a)).sqrt()
    }

    /// Of the argument clamped to -1..1.
    pub fn asin(self) -> Wide {
        self.atan2(self.leg())
    }

    /// Of the argument clamped to -1..1.
    pub fn acos(self) -> Wide {
        self.leg().atan2(self)
    }
}
