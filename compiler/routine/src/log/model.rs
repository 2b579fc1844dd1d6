//! Logarithmic reals, bit for bit as runtimes compute them.
//!
//! Each function mirrors a subroutine of each runtime that has the format; their tests run
//! both.

use super::tables::tables;
use crate::Bits;

/// Units of a logarithm in an octave: 2^(log / OCTAVE) is the magnitude.
pub const OCTAVE: i32 = 1024;
/// The greatest logarithm, of 2^16 nearly: what is larger saturates there.
pub const MOST: i32 = 16383;
/// The least, of 2^-13: what is smaller, 0 among it, is held as that, but for a while
/// where nobody minds ([`super::loose`]).
pub const LEAST: i32 = -13312;
/// How far apart summands may be that the tables know.
pub const NEAR: i32 = 6144;
/// Logarithms of whole numbers are kept up to this one.
pub const WHOLE: i32 = 512;

/// A real: 2^(log/1024), negative unless `plus`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Log {
    pub plus: bool,
    /// From [`LEAST`] to [`MOST`], or less where that is loose.
    pub log: i32,
}

// The subroutines' names, which are also those of the operators' traits.
#[allow(clippy::should_implement_trait)]
impl Log {
    /// What stands for 0: the least magnitude.
    pub const ZERO: Log = Log {
        plus: true,
        log: LEAST,
    };

    const HALF: Log = Log {
        plus: true,
        log: -OCTAVE,
    };

    /// The bits: the logarithm (two's complement) in 0..16, 1 in 16 where negative.
    pub fn bits(self) -> Bits {
        Bits::from(self.log as u16) | Bits::from(!self.plus) << 16
    }

    /// From bits.
    pub fn from_bits(bits: Bits) -> Log {
        Log {
            plus: bits >> 16 & 1 == 0,
            log: i32::from(bits as u16 as i16),
        }
    }

    /// The nearest value, by the ratio.
    pub fn nearest(x: f64) -> Log {
        let size = if x.is_nan() { 0.0 } else { x.abs() };
        Log {
            plus: x >= 0.0 || x.is_nan(),
            log: clamp((size.log2() * f64::from(OCTAVE)).round() as i32),
        }
    }

    /// The value.
    pub fn value(self) -> f64 {
        let size = (f64::from(self.log) / f64::from(OCTAVE)).exp2();
        if self.plus { size } else { -size }
    }

    pub fn neg(self) -> Log {
        Log {
            plus: !self.plus,
            ..self
        }
    }

    pub fn abs(self) -> Log {
        Log { plus: true, ..self }
    }

    pub fn mul(self, b: Log) -> Log {
        Log {
            plus: self.plus == b.plus,
            log: clamp(self.log + b.log),
        }
    }

    pub fn div(self, b: Log) -> Log {
        Log {
            plus: self.plus == b.plus,
            log: clamp(self.log - b.log),
        }
    }

    /// A product as small as it comes.
    pub fn loose_mul(self, b: Log) -> Log {
        Log {
            plus: self.plus == b.plus,
            log: (self.log + b.log).min(MOST),
        }
    }

    /// A quotient as small as it comes.
    pub fn loose_div(self, b: Log) -> Log {
        Log {
            plus: self.plus == b.plus,
            log: (self.log - b.log).min(MOST),
        }
    }

    pub fn add(self, b: Log) -> Log {
        if self.plus == b.plus {
            let log = sum(self.log, b.log);
            return Log { log, ..self };
        }
        let plus = if b.log > self.log { b.plus } else { self.plus };
        let log = difference(self.log, b.log);
        Log { plus, log }
    }

    pub fn sub(self, b: Log) -> Log {
        self.add(b.neg())
    }

    /// Of a negative 0.
    pub fn sqrt(self) -> Log {
        match self.plus {
            true => Log {
                plus: true,
                log: half(self.log),
            },
            false => Log::ZERO,
        }
    }

    pub fn less(self, b: Log) -> bool {
        match (self.plus, b.plus) {
            (true, true) => self.log < b.log,
            (false, false) => b.log < self.log,
            (_, plus) => plus,
        }
    }

    pub fn min(self, b: Log) -> Log {
        if self.less(b) { self } else { b }
    }

    pub fn max(self, b: Log) -> Log {
        if self.less(b) { b } else { self }
    }

    /// Of an int of 16 bits; what is larger counts as the largest.
    pub fn from_int(i: i32) -> Log {
        Log {
            plus: i >= 0,
            log: log_of(i),
        }
    }

    /// Of any int: beyond 16 bits that of its half, an octave above.
    pub fn from_wide_int(i: i32) -> Log {
        let log = match i.saturating_abs() {
            size @ ..=32767 => log_of(size),
            size @ ..=65535 => clamp(log_of(size / 2) + OCTAVE),
            _ => MOST,
        };
        Log { plus: i >= 0, log }
    }

    /// The greatest whole number not above, or the next where that is as near as
    /// logarithms tell; from 512 on, of nine bits.
    pub fn floor(self) -> i32 {
        self.wide_floor().clamp(-32767, 32767)
    }

    /// The same where ints have more than 16 bits.
    pub fn wide_floor(self) -> i32 {
        let n = wide_whole(self.log);
        match self.plus {
            true => n,
            false if self.log > 9 * OCTAVE => -n,
            false if tables().logs.get(n as usize) == Some(&self.log) => -n,
            false => -n - 1,
        }
    }

    pub fn round(self) -> i32 {
        self.add(Log::HALF).floor()
    }

    /// The same where ints have more than 16 bits.
    pub fn wide_round(self) -> i32 {
        self.add(Log::HALF).wide_floor()
    }

    /// There is no 0.
    pub fn sign(self) -> i32 {
        if self.plus { 1 } else { -1 }
    }

    /// a - b * floor(a / b), or 0 where that is no remainder: of large quotients the floor
    /// has nine bits, and a product may be a last place above a.
    pub fn modulo(self, b: Log) -> Log {
        let n = Log::from_int(self.div(b).floor());
        let left = self.sub(n.mul(b));
        match left.plus == b.plus && left.log < b.log {
            true => left,
            false => Log {
                plus: b.plus,
                ..Log::ZERO
            },
        }
    }
}

/// A logarithm kept between the ends.
pub fn clamp(log: i32) -> i32 {
    log.clamp(LEAST, MOST)
}

/// Of the sum of two values of one sign, from those of both.
pub(super) fn sum(a: i32, b: i32) -> i32 {
    let (more, less) = (a.max(b), a.min(b));
    (more + added(more - less)).min(MOST)
}

/// Of the difference of two values, from those of both.
pub(super) fn difference(a: i32, b: i32) -> i32 {
    let (more, less) = (a.max(b), a.min(b));
    match more == less {
        true => LEAST,
        false => (more - taken(more - less)).max(LEAST),
    }
}

/// What a summand adds to a logarithm that is greater by this, 0 or more.
pub fn added(apart: i32) -> i32 {
    let entry = tables().sums.get(apart as usize);
    entry.copied().unwrap_or_else(|| rest(apart))
}

/// What it takes away where it is subtracted, the two being unlike.
pub fn taken(apart: i32) -> i32 {
    let entry = tables().differences.get(apart as usize);
    entry.copied().unwrap_or_else(|| rest(apart))
}

/// Beyond which distances a far smaller summand adds less than 1/2, 3/2, ... units.
pub const STEPS: [i32; 23] = [
    11805, 10182, 9427, 8930, 8559, 8263, 8016, 7804, 7619, 7455, 7307, 7173, 7050, 6936, 6830,
    6732, 6640, 6553, 6471, 6393, 6319, 6249, 6182,
];

/// What a far smaller summand adds, or takes away.
fn rest(apart: i32) -> i32 {
    STEPS.iter().filter(|step| apart <= **step).count() as i32
}

/// Half of a logarithm, rounded down.
pub(super) fn half(log: i32) -> i32 {
    log.div_euclid(2)
}

/// floor(2^(log / 1024)); from 512 on of nine bits, at most 32767. 0 below 1.
pub(super) fn whole(log: i32) -> i32 {
    wide_whole(log).min(32767)
}

/// The same without that end: up to 65408.
fn wide_whole(mut log: i32) -> i32 {
    if log < 0 {
        return 0;
    }
    let mut doubled = 0;
    while log > 9 * OCTAVE - 1 {
        log -= OCTAVE;
        doubled += 1;
    }
    let n = tables().logs.partition_point(|entry| *entry <= log) as i32 - 1;
    n << doubled
}

/// The logarithm of an int's magnitude.
pub(super) fn log_of(i: i32) -> i32 {
    let i = i.saturating_abs().min(32767);
    let logs = &tables().logs;
    let at = |n: i32| logs.get(n as usize).copied().unwrap_or(LEAST);
    if i < WHOLE {
        return at(i);
    }
    let (high, low) = (i / 64, i & 63);
    match low {
        0 => at(high) + 6 * OCTAVE,
        _ => sum(at(high) + 6 * OCTAVE, at(low)),
    }
}
