//! Fractions of 28 bits, which polynomials are summed up in.

use super::{END, Wide, product};

/// The product of two fractions of 28 bits, 0 to 2^28 for 1; off by less than a unit.
pub(super) fn fraction(a: i64, b: i64) -> i64 {
    product(a, b, 64) >> 7
}

/// Terms of a polynomial, as fractions of 28 bits, the last first.
pub(super) struct Terms(pub(super) &'static [i64]);

/// c0 + x (c1 + x (c2 + ...)), with - for + where `minus`.
pub(super) fn series(terms: &Terms, x: i64, minus: bool) -> i64 {
    let step = |sum: i64, term: &i64| {
        let higher = fraction(x, sum);
        if minus { term - higher } else { term + higher }
    };
    let (first, rest) = (terms.0[0], &terms.0[1..]);
    rest.iter().fold(first, step)
}

/// A number being summed up: whole + part/2^28.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Fixed {
    pub whole: i32,
    pub part: i64,
}

/// What is beyond all results counts as this, and then other summands do not matter.
const BEYOND: i32 = 16384;

impl Fixed {
    /// Adds a real, whose magnitude is cut behind 28 bits of a fraction.
    pub fn gather(&mut self, a: Wide) {
        if a.m == 0 {
            return;
        }
        if a.e > 140 {
            self.whole = if a.s == 1 { -BEYOND } else { BEYOND };
            return;
        }
        let units = match a.e - 126 {
            ..-27 => 0,
            places @ ..0 => a.m >> -places,
            places => a.m << places,
        };
        let all = (i64::from(self.whole) << 28) + self.part + if a.s == 1 { -units } else { units };
        self.whole = (all >> 28) as i32;
        self.part = all & (END - 1);
    }
}

impl Wide {
    /// The square of a magnitude of at most 1, as a fraction.
    pub(super) fn square(self) -> i64 {
        let mut fixed = Fixed::default();
        fixed.gather(self.abs());
        let all = (i64::from(fixed.whole) << 28) + fixed.part;
        fraction(all, all)
    }

    /// A fraction, less than 2, as a real; its 29th bit is rounded.
    pub(super) fn of_fraction(part: i64) -> Wide {
        let (e, m) = match part {
            END.. => (127, (part + 1) / 2),
            _ => (126, part),
        };
        Wide { s: 0, e, m }.normal()
    }
}
