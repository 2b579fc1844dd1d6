//! Ints and remainders, bit for bit as the Jack source computes them.

use super::Wide;
use crate::model::{MOST, magnitude};

impl Wide {
    pub fn floor(self) -> i32 {
        if self.m == 0 {
            return 0;
        }
        if self.e < 127 {
            return -self.s;
        }
        if self.e > 141 {
            return if self.s == 1 { -MOST } else { MOST };
        }
        let places = 154 - self.e;
        let whole = (self.m >> places) as i32;
        let cut = self.m & ((1 << places) - 1) > 0 && whole < MOST;
        if self.s == 1 {
            -(whole + i32::from(cut))
        } else {
            whole
        }
    }

    /// Half away from zero.
    pub fn round(self) -> i32 {
        let whole = match self.e {
            _ if self.m == 0 => 0,
            ..126 => 0,
            142.. => MOST,
            e => (((self.m >> (153 - e)) + 1) >> 1).min(i64::from(MOST)) as i32,
        };
        if self.s == 1 { -whole } else { whole }
    }

    /// The remainder with the divisor's sign, by subtracting the divisor at
    /// ever lower places; 0 where the divisor is 0.
    pub fn modulo(self, b: Wide) -> Wide {
        if self.m == 0 || b.m == 0 {
            return Wide::ZERO;
        }
        let rest = if self.e < b.e {
            self
        } else {
            let mut rest = self.m;
            for place in (b.e..=self.e).rev() {
                rest -= if rest >= b.m { b.m } else { 0 };
                rest += if place > b.e { rest } else { 0 };
            }
            let (s, e, m) = (self.s, b.e, rest);
            Wide { s, e, m }.normal()
        };
        if rest.m == 0 || rest.s == b.s {
            rest
        } else {
            rest.add(b)
        }
    }

    /// From an int, exactly.
    pub fn from_int(i: i32) -> Wide {
        Wide {
            s: i32::from(i < 0),
            e: 154,
            m: i64::from(magnitude(i)),
        }
        .normal()
    }
}
