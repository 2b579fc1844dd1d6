//! Sines, arcs, powers and logarithms, bit for bit as runtimes compute them.
//!
//! Sines and arcs are read off tables of how far they are below their arguments ([`Curve`])
//! where the machine has these, in wide formats. Elsewhere series are summed up with the tables
//! of sums, `1 - z k1 (1 - z k2 (1 - ...))` for the square z: each further term is smaller, so
//! its rounding counts less. What is linear in a logarithm, a power, is computed with that as
//! an int.

use super::model::{Logarithm, WHOLE};
#[cfg(doc)]
use super::tables::Curve;

/// What hangs on how many units an octave has.
pub struct Constants {
    /// The logarithms of a quarter and a half of a turn.
    pub quarter: i32,
    pub half_turn: i32,
    /// What an int that counts units of logarithms is too large by, to be a natural one.
    pub units: i32,
}

const TEN: Constants = Constants {
    quarter: 667,
    half_turn: 1691,
    units: 10781,
};

const ELEVEN: Constants = Constants {
    quarter: 1334,
    half_turn: 3382,
    units: 23611,
};

/// The terms of series, as logarithms of ten bits: only the Hack sums them, and has no others.
mod series {
    /// Of the sine's; its relative error is 9.3e-6 up to a quarter turn.
    pub const SINE: [i32; 3] = [-5575, -4426, -2647];
    /// Of the arc tangent's; 6.6e-5 up to the root of 2 less 1.
    pub const ARC: [i32; 2] = [-907, -1623];
    /// Below it a series is its first term, to half a unit.
    pub const SHORT: i32 = -5632;
    /// From the root of 2 less 1 on an arc is told by that of (1 - x)/(1 + x).
    pub const STEEP: i32 = -1302;
    /// The logarithm of an eighth of a turn.
    pub const EIGHTH: i32 = -357;
}

impl<const FRAC: u8, const WIDE: bool> Logarithm<FRAC, WIDE> {
    /// Those of this format.
    pub const CONSTANTS: Constants = if FRAC == 10 { TEN } else { ELEVEN };

    /// x times the series in x^2.
    fn series(x: i32, terms: &[i32]) -> i32 {
        if x < series::SHORT {
            return x;
        }
        let next = |rest, term| Self::difference(0, x + x + rest + term);
        x + terms.iter().fold(0, next)
    }

    /// The angle of a ratio of at most 1.
    fn arc(x: i32) -> i32 {
        if WIDE {
            return Self::tables().arc.at(x, Self::OCTAVE);
        }
        if x < series::STEEP {
            return Self::series(x, &series::ARC);
        }
        // In a word.
        let other = (Self::difference(0, x) - Self::sum(0, x)).max(i32::from(i16::MIN));
        Self::difference(series::EIGHTH, Self::series(other, &series::ARC))
    }

    /// The angle of (x, y) = (b, a), both positive.
    fn angle(a: i32, b: i32) -> i32 {
        match a < b {
            true => Self::arc(Self::clamp(a - b)),
            false => Self::difference(Self::CONSTANTS.quarter, Self::arc(Self::clamp(b - a))),
        }
    }

    /// The nearest int to 2^(a/OCTAVE), at most 32767: between entries of the table of whole
    /// numbers' logarithms, from 256 on, in proportion.
    fn units(mut a: i32) -> i32 {
        if a > 15 * Self::OCTAVE - 1 {
            return 32767;
        }
        if a < 8 * Self::OCTAVE {
            return (Self::whole(a + Self::OCTAVE) + 1) / 2;
        }
        let mut unit = 1;
        while a > 9 * Self::OCTAVE - 1 {
            a -= Self::OCTAVE;
            unit += unit;
        }
        let n = Self::whole(a);
        let at = Self::of_whole(n);
        let gap = Self::of_whole(n + 1) - at;
        n * unit + ((a - at) * unit + gap / 2) / gap
    }

    /// The sine of the magnitude and `quarter` quarter turns. From 256 of these on, with
    /// values more than a quarter turn apart, magnitudes count as whole quarters.
    fn quarter_sine(self, quarter: i32) -> Self {
        let turns = Self::whole(self.log - Self::CONSTANTS.quarter);
        let rest = match turns {
            0 => self.abs(),
            1..=255 => self.abs().sub(Self {
                plus: true,
                log: Self::log_of(turns) + Self::CONSTANTS.quarter,
            }),
            _ => Self::ZERO,
        };
        let quarters = Self {
            plus: true,
            log: Self::CONSTANTS.quarter,
        };
        let angle = match (turns + quarter) & 1 {
            0 => rest,
            _ => quarters.sub(rest),
        };
        let back = (turns + quarter) & 2 != 0;
        Self {
            plus: angle.plus != back,
            log: match WIDE {
                true => Self::tables().sine.flat_at(angle.log, Self::OCTAVE),
                false => Self::series(angle.log, &series::SINE),
            },
        }
    }

    pub fn sin(self) -> Self {
        let sine = self.quarter_sine(0);
        Self {
            plus: sine.plus == self.plus,
            ..sine
        }
    }

    pub fn cos(self) -> Self {
        self.quarter_sine(1)
    }

    pub fn tan(self) -> Self {
        self.sin().div(self.cos())
    }

    /// The angle of (y, x) = (self, x).
    pub fn atan2(self, x: Self) -> Self {
        let inner = Self::angle(self.log, x.log);
        let log = match x.plus {
            true => inner.max(Self::LEAST),
            false => Self::difference(Self::CONSTANTS.half_turn, inner),
        };
        Self { log, ..self }
    }

    /// Of the argument clamped to -1..1.
    pub fn asin(self) -> Self {
        let log = match self.log < 0 {
            true => Self::angle(self.log, self.beside()),
            false => Self::CONSTANTS.quarter,
        };
        Self { log, ..self }
    }

    /// Of the argument clamped to -1..1.
    pub fn acos(self) -> Self {
        let inner = match self.log < 0 {
            true => Self::angle(self.beside(), self.log),
            false => Self::LEAST,
        };
        let log = match self.plus {
            true => inner,
            false => Self::difference(Self::CONSTANTS.half_turn, inner),
        };
        Self { plus: true, log }
    }

    /// The root of 1 less the square.
    fn beside(self) -> i32 {
        Self::half(Self::difference(0, Self::clamp(self.log + self.log)))
    }

    /// e to this power.
    pub fn exp(self) -> Self {
        let n = Self::units(self.log + Self::CONSTANTS.units);
        Self {
            plus: true,
            log: Self::clamp(if self.plus { n } else { -n }),
        }
    }

    /// Natural; of 0 or a negative the most negative value.
    pub fn log(self) -> Self {
        if !self.plus || self.log <= Self::LEAST {
            return Self {
                plus: false,
                log: Self::MOST,
            };
        }
        let log = match self.log {
            0 => Self::LEAST,
            n => Self::log_of(n) - Self::CONSTANTS.units,
        };
        Self {
            plus: self.log >= 0,
            log,
        }
    }

    /// x^0 is 1, 0 to a negative the largest value, a negative to a fraction 0. Whole
    /// exponents multiply the logarithm exactly.
    pub fn pow(self, b: Self) -> Self {
        let of = |plus, log| Self { plus, log };
        if b.log <= Self::LEAST {
            return of(true, 0);
        }
        if self.log <= Self::LEAST {
            return if b.plus {
                Self::ZERO
            } else {
                of(true, Self::MOST)
            };
        }
        let n = Self::whole(b.log);
        let exact = n <= WHOLE && Self::of_whole(n) == b.log;
        if !self.plus && !exact && b.log <= 9 * Self::OCTAVE {
            return Self::ZERO;
        }
        let plus = self.plus || !exact || n & 1 == 0;
        let size = self.log.abs();
        let product = match size {
            0 => 0,
            _ if !exact => Self::units(b.log + Self::log_of(size)),
            _ if size > Self::MOST / n => Self::MOST,
            _ => size * n,
        };
        let less = (self.log < 0) == b.plus;
        of(plus, Self::clamp(if less { -product } else { product }))
    }
}
