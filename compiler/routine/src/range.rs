//! Intervals of reals, as routines' domains see them.

/// All values between two bounds; integers and booleans (0, 1) included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The least value; may be minus infinity.
    pub lo: f64,
    /// The greatest value; may be infinity. Never below `lo`.
    pub hi: f64,
    /// Whether 0 is known to be excluded, although it may lie between the bounds.
    pub nonzero: bool,
}

impl Range {
    /// Every real.
    pub const ALL: Range = Range {
        lo: f64::NEG_INFINITY,
        hi: f64::INFINITY,
        nonzero: false,
    };

    /// From `lo` to `hi`; every real where these are no interval.
    pub fn new(lo: f64, hi: f64) -> Range {
        if lo <= hi {
            Range {
                lo,
                hi,
                nonzero: lo > 0.0 || hi < 0.0,
            }
        } else {
            Range::ALL
        }
    }

    /// One value.
    pub fn point(value: f64) -> Range {
        Range::new(value, value)
    }

    /// The value, if there is only one.
    pub fn constant(self) -> Option<f64> {
        (self.lo == self.hi).then_some(self.lo)
    }

    /// Whether `value` may occur.
    pub fn contains(self, value: f64) -> bool {
        self.lo <= value && value <= self.hi && !(value == 0.0 && self.nonzero)
    }

    /// Whether every value lies in `lo..=hi`.
    pub fn within(self, lo: f64, hi: f64) -> bool {
        lo <= self.lo && self.hi <= hi
    }

    /// The least range that holds both.
    pub fn join(self, other: Range) -> Range {
        Range {
            lo: self.lo.min(other.lo),
            hi: self.hi.max(other.hi),
            nonzero: self.nonzero && other.nonzero,
        }
    }

    /// What both hold; `self` where that is empty (a path that is never taken).
    pub fn meet(self, other: Range) -> Range {
        let (lo, hi) = (self.lo.max(other.lo), self.hi.min(other.hi));
        if lo > hi {
            return self;
        }
        Range {
            nonzero: self.nonzero || other.nonzero || lo > 0.0 || hi < 0.0,
            lo,
            hi,
        }
    }

    /// The greatest magnitude.
    pub fn magnitude(self) -> f64 {
        self.lo.abs().max(self.hi.abs())
    }
}
