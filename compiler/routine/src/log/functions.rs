//! Sines, arcs, powers and logarithms, bit for bit as runtimes compute them.
//!
//! Series are summed up with the tables, `1 - z k1 (1 - z k2 (1 - ...))` for the square z:
//! each further term is smaller, so its rounding counts less. What is linear in a
//! logarithm, a power, is computed with that as an int.

use super::model::{LEAST, Log, MOST, OCTAVE, WHOLE, clamp, difference, half, log_of, sum, whole};
use super::tables::tables;

/// The logarithms of a quarter, a half and an eighth of a turn.
const QUARTER: i32 = 667;
const HALF_TURN: i32 = 1691;
const EIGHTH: i32 = -357;
/// What an int that counts units of logarithms is too large by, to be a natural one.
const UNITS: i32 = 10781;

/// Of the sine's series; its relative error is 9.3e-6 up to a quarter turn.
const SINE: [i32; 3] = [-5575, -4426, -2647];
/// Of the arc tangent's; 6.6e-5 up to the root of 2 less 1.
const ARC: [i32; 2] = [-907, -1623];

/// x times the series in x^2. Where x is below 2^-5.5 that is x, to half a unit.
fn series(x: i32, terms: &[i32]) -> i32 {
    if x < -5632 {
        return x;
    }
    let next = |rest, term| difference(0, x + x + rest + term);
    x + terms.iter().fold(0, next)
}

/// The angle of a ratio of at most 1: by that of (1 - x)/(1 + x) from the root of 2 less 1 on.
fn arc(x: i32) -> i32 {
    if x < -1302 {
        return series(x, &ARC);
    }
    let other = difference(0, x) - sum(0, x);
    difference(EIGHTH, series(other, &ARC))
}

/// The angle of (x, y) = (b, a), both positive.
fn angle(a: i32, b: i32) -> i32 {
    match a < b {
        true => arc(a - b),
        false => difference(QUARTER, arc(b - a)),
    }
}

/// The nearest int to 2^(a/1024), at most 32767: between entries of the table of whole
/// numbers' logarithms, from 256 on, in proportion.
fn units(mut a: i32) -> i32 {
    if a > 15 * OCTAVE - 1 {
        return 32767;
    }
    if a < 8 * OCTAVE {
        return (whole(a + OCTAVE) + 1) / 2;
    }
    let mut unit = 1;
    while a > 9 * OCTAVE - 1 {
        a -= OCTAVE;
        unit += unit;
    }
    let n = whole(a);
    let at = |n: i32| tables().logs.get(n as usize).copied().unwrap_or(LEAST);
    let gap = at(n + 1) - at(n);
    n * unit + ((a - at(n)) * unit + gap / 2) / gap
}

impl Log {
    /// The sine of the magnitude and `quarter` quarter turns. From 256 of these on, with
    /// values more than a quarter turn apart, magnitudes count as whole quarters.
    fn quarter_sine(self, quarter: i32) -> Log {
        let turns = whole(self.log - QUARTER);
        let rest = match turns {
            0 => self.abs(),
            1..=255 => self.abs().sub(Log {
                plus: true,
                log: log_of(turns) + QUARTER,
            }),
            _ => Log::ZERO,
        };
        let quarters = Log {
            plus: true,
            log: QUARTER,
        };
        let angle = match (turns + quarter) & 1 {
            0 => rest,
            _ => quarters.sub(rest),
        };
        let back = (turns + quarter) & 2 != 0;
        Log {
            plus: angle.plus != back,
            log: series(angle.log, &SINE),
        }
    }

    pub fn sin(self) -> Log {
        let sine = self.quarter_sine(0);
        Log {
            plus: sine.plus == self.plus,
            ..sine
        }
    }

    pub fn cos(self) -> Log {
        self.quarter_sine(1)
    }

    pub fn tan(self) -> Log {
        self.sin().div(self.cos())
    }

    /// The angle of (y, x) = (self, x).
    pub fn atan2(self, x: Log) -> Log {
        let inner = angle(self.log, x.log);
        let log = match x.plus {
            true => inner.max(LEAST),
            false => difference(HALF_TURN, inner),
        };
        Log { log, ..self }
    }

    /// Of the argument clamped to -1..1.
    pub fn asin(self) -> Log {
        let log = match self.log < 0 {
            true => angle(self.log, self.beside()),
            false => QUARTER,
        };
        Log { log, ..self }
    }

    /// Of the argument clamped to -1..1.
    pub fn acos(self) -> Log {
        let inner = match self.log < 0 {
            true => angle(self.beside(), self.log),
            false => LEAST,
        };
        let log = match self.plus {
            true => inner,
            false => difference(HALF_TURN, inner),
        };
        Log { plus: true, log }
    }

    /// The root of 1 less the square.
    fn beside(self) -> i32 {
        half(difference(0, self.log + self.log))
    }

    /// e to this power.
    pub fn exp(self) -> Log {
        let n = units(self.log + UNITS);
        Log {
            plus: true,
            log: clamp(if self.plus { n } else { -n }),
        }
    }

    /// Natural; of 0 or a negative the most negative value.
    pub fn log(self) -> Log {
        if !self.plus || self.log <= LEAST {
            return Log {
                plus: false,
                log: MOST,
            };
        }
        let log = match self.log {
            0 => LEAST,
            n => log_of(n) - UNITS,
        };
        Log {
            plus: self.log >= 0,
            log,
        }
    }

    /// x^0 is 1, 0 to a negative the largest value, a negative to a fraction 0. Whole
    /// exponents multiply the logarithm exactly.
    pub fn pow(self, b: Log) -> Log {
        let of = |plus, log| Log { plus, log };
        if b.log <= LEAST {
            return of(true, 0);
        }
        if self.log <= LEAST {
            return if b.plus { Log::ZERO } else { of(true, MOST) };
        }
        let n = whole(b.log);
        let exact = n <= WHOLE && tables().logs.get(n as usize) == Some(&b.log);
        if !self.plus && !exact && b.log <= 9 * OCTAVE {
            return Log::ZERO;
        }
        let plus = self.plus || !exact || n & 1 == 0;
        let size = self.log.abs();
        let product = match size {
            0 => 0,
            _ if !exact => units(b.log + log_of(size)),
            _ if size > MOST / n => MOST,
            _ => size * n,
        };
        let less = (self.log < 0) == b.plus;
        of(plus, clamp(if less { -product } else { product }))
    }
}
