//! Logarithmic reals, bit for bit as runtimes compute them.
//!
//! Each function mirrors a subroutine of each runtime that has the format; their tests run
//! both.

use super::tables::{Tables, tables};
use crate::{Bits, Format};

/// Jack's: ten bits behind the point, and room in a word for what is loose.
pub type Log = Logarithm<10, false>;
/// Units of a logarithm in an octave: 2^(log / OCTAVE) is the magnitude.
pub const OCTAVE: i32 = Log::OCTAVE;
/// The greatest logarithm, of 2^16 nearly: what is larger saturates there.
pub const MOST: i32 = Log::MOST;
/// The least, of 2^-13: what is smaller, 0 among it, is held as that, but for a while
/// where nobody minds ([`super::loose`]).
pub const LEAST: i32 = Log::LEAST;
/// How far apart summands may be that Jack's tables know.
pub const NEAR: i32 = 6144;
/// Logarithms of whole numbers are kept up to this one.
pub const WHOLE: i32 = 512;

/// A real: 2^(log / [`OCTAVE`](Self::OCTAVE)), negative unless `plus`. `FRAC` bits of the
/// logarithm are behind its point; `WIDE`: all 16 bits count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Logarithm<const FRAC: u8, const WIDE: bool> {
    pub plus: bool,
    /// From [`LEAST`](Self::LEAST) to [`MOST`](Self::MOST), or less where that is loose.
    pub log: i32,
}

// The subroutines' names, which are also those of the operators' traits.
#[allow(clippy::should_implement_trait)]
impl<const FRAC: u8, const WIDE: bool> Logarithm<FRAC, WIDE> {
    /// Units in an octave.
    pub const OCTAVE: i32 = 1 << FRAC;
    /// The greatest logarithm.
    pub const MOST: i32 = if WIDE { 32767 } else { 16383 };
    /// The least, which stands for 0.
    pub const LEAST: i32 = if WIDE { -32768 } else { -13312 };

    /// What stands for 0: the least magnitude.
    pub const ZERO: Self = Self {
        plus: true,
        log: Self::LEAST,
    };

    /// The format.
    pub const FORMAT: Format = Format::Log {
        frac: FRAC,
        octaves: ((Self::MOST + 1) / Self::OCTAVE) as u8,
    };

    pub(super) fn tables() -> &'static Tables {
        tables(FRAC)
    }

    /// The bits: the logarithm (two's complement) in 0..16, 1 in 16 where negative.
    pub fn bits(self) -> Bits {
        Bits::from(self.log as u16) | Bits::from(!self.plus) << 16
    }

    /// From bits.
    pub fn from_bits(bits: Bits) -> Self {
        Self {
            plus: bits >> 16 & 1 == 0,
            log: i32::from(bits as u16 as i16),
        }
    }

    /// The nearest value, by the ratio.
    pub fn nearest(x: f64) -> Self {
        let size = if x.is_nan() { 0.0 } else { x.abs() };
        Self {
            plus: x >= 0.0 || x.is_nan(),
            log: Self::clamp((size.log2() * f64::from(Self::OCTAVE)).round() as i32),
        }
    }

    /// The value.
    pub fn value(self) -> f64 {
        let size = (f64::from(self.log) / f64::from(Self::OCTAVE)).exp2();
        if self.plus { size } else { -size }
    }

    pub fn neg(self) -> Self {
        Self {
            plus: !self.plus,
            ..self
        }
    }

    pub fn abs(self) -> Self {
        Self { plus: true, ..self }
    }

    pub fn mul(self, b: Self) -> Self {
        Self {
            plus: self.plus == b.plus,
            log: Self::clamp(self.log + b.log),
        }
    }

    pub fn div(self, b: Self) -> Self {
        Self {
            plus: self.plus == b.plus,
            log: Self::clamp(self.log - b.log),
        }
    }

    /// A product as small as it comes.
    pub fn loose_mul(self, b: Self) -> Self {
        Self {
            plus: self.plus == b.plus,
            log: (self.log + b.log).min(Self::MOST),
        }
    }

    /// A quotient as small as it comes.
    pub fn loose_div(self, b: Self) -> Self {
        Self {
            plus: self.plus == b.plus,
            log: (self.log - b.log).min(Self::MOST),
        }
    }

    pub fn add(self, b: Self) -> Self {
        if self.plus == b.plus {
            let log = Self::sum(self.log, b.log);
            return Self { log, ..self };
        }
        let plus = if b.log > self.log { b.plus } else { self.plus };
        let log = Self::difference(self.log, b.log);
        Self { plus, log }
    }

    pub fn sub(self, b: Self) -> Self {
        self.add(b.neg())
    }

    /// Of a negative 0.
    pub fn sqrt(self) -> Self {
        match self.plus {
            true => Self {
                plus: true,
                log: Self::half(self.log),
            },
            false => Self::ZERO,
        }
    }

    pub fn less(self, b: Self) -> bool {
        match (self.plus, b.plus) {
            (true, true) => self.log < b.log,
            (false, false) => b.log < self.log,
            (_, plus) => plus,
        }
    }

    pub fn min(self, b: Self) -> Self {
        if self.less(b) { self } else { b }
    }

    pub fn max(self, b: Self) -> Self {
        if self.less(b) { b } else { self }
    }

    /// Of an int of 16 bits; what is larger counts as the largest.
    pub fn from_int(i: i32) -> Self {
        Self {
            plus: i >= 0,
            log: Self::log_of(i),
        }
    }

    /// Of any int: beyond 15 bits that of its half, an octave above.
    pub fn from_wide_int(i: i32) -> Self {
        let (mut size, mut log) = (i.saturating_abs(), 0);
        while size > 32767 {
            size /= 2;
            log += Self::OCTAVE;
        }
        Self {
            plus: i >= 0,
            log: Self::clamp(log + Self::log_of(size)),
        }
    }

    /// The greatest whole number not above, or the next where that is as near as
    /// logarithms tell; from 512 on, of nine bits.
    pub fn floor(self) -> i32 {
        self.wide_floor().clamp(-32767, 32767)
    }

    /// The same where ints have more than 16 bits.
    pub fn wide_floor(self) -> i32 {
        let n = Self::wide_whole(self.log);
        match self.plus {
            true => n,
            false if self.log > 9 * Self::OCTAVE => -n,
            false if n <= WHOLE && Self::of_whole(n) == self.log => -n,
            false => -n - 1,
        }
    }

    /// The nearest whole number, halves away from 0.
    pub fn round(self) -> i32 {
        self.wide_round().clamp(-32767, 32767)
    }

    /// The same where ints have more than 16 bits, halves away from 0: half of twice the
    /// magnitude's whole part, which from 512 on has no more digits.
    pub fn wide_round(self) -> i32 {
        let n = match self.log < 8 * Self::OCTAVE {
            true => (Self::wide_whole(self.log + Self::OCTAVE) + 1) / 2,
            false => Self::wide_whole(self.log),
        };
        if self.plus { n } else { -n }
    }

    /// There is no 0.
    pub fn sign(self) -> i32 {
        if self.plus { 1 } else { -1 }
    }

    /// a - b * floor(a / b), or 0 where that is no remainder: of large quotients the floor
    /// has nine bits, and a product may be a last place above a.
    pub fn modulo(self, b: Self) -> Self {
        let n = Self::from_int(self.div(b).floor());
        let left = self.sub(n.mul(b));
        match left.plus == b.plus && left.log < b.log {
            true => left,
            false => Self {
                plus: b.plus,
                ..Self::ZERO
            },
        }
    }

    /// A logarithm kept between the ends.
    pub fn clamp(log: i32) -> i32 {
        log.clamp(Self::LEAST, Self::MOST)
    }

    /// Of the sum of two values of one sign, from those of both.
    pub(super) fn sum(a: i32, b: i32) -> i32 {
        let (more, less) = (a.max(b), a.min(b));
        (more + Self::added(more - less)).min(Self::MOST)
    }

    /// Of the difference of two values, from those of both.
    pub(super) fn difference(a: i32, b: i32) -> i32 {
        let (more, less) = (a.max(b), a.min(b));
        match more == less {
            true => Self::LEAST,
            false => (more - Self::taken(more - less)).max(Self::LEAST),
        }
    }

    /// What a summand adds to a logarithm that is greater by this, 0 or more.
    pub fn added(apart: i32) -> i32 {
        Self::tables().sums.at(apart)
    }

    /// What it takes away where it is subtracted, the two being unlike.
    pub fn taken(apart: i32) -> i32 {
        Self::tables().differences.at(apart)
    }

    /// Half of a logarithm, rounded down.
    pub(super) fn half(log: i32) -> i32 {
        log.div_euclid(2)
    }

    /// floor(2^(log / OCTAVE)); from 512 on of nine bits, at most 32767. 0 below 1.
    pub(super) fn whole(log: i32) -> i32 {
        Self::wide_whole(log).min(32767)
    }

    /// The same, at most 2^31 - 1.
    fn wide_whole(mut log: i32) -> i32 {
        if log < 0 {
            return 0;
        }
        if log >= 31 * Self::OCTAVE {
            return i32::MAX;
        }
        let mut doubled = 0;
        while log > 9 * Self::OCTAVE - 1 {
            log -= Self::OCTAVE;
            doubled += 1;
        }
        let logs = &Self::tables().logs;
        let n = logs.partition_point(|entry| *entry <= log) as i32 - 1;
        n << doubled
    }

    /// The logarithm of an int's magnitude.
    pub(super) fn log_of(i: i32) -> i32 {
        let i = i.saturating_abs().min(32767);
        if i < WHOLE {
            return Self::of_whole(i);
        }
        let (high, low) = (Self::of_whole(i / 64) + 6 * Self::OCTAVE, i & 63);
        match low {
            0 => high,
            _ => Self::sum(high, Self::of_whole(low)),
        }
    }

    /// That of a whole number up to [`WHOLE`], the least of 0.
    pub(super) fn of_whole(n: i32) -> i32 {
        let known = Self::tables().logs.get(n as usize).filter(|_| n > 0);
        known.copied().unwrap_or(Self::LEAST)
    }
}
