//! Powers of ten as BASIC II takes them: in its accumulator of 40 bits, one at a time.
//!
//! Found from what the ROM makes of ten thousand decimal texts, which are not all correctly
//! rounded: ten times is eight times and a fourth of that; a tenth is a sixteenth of
//! (1 + 1/2)(1 + 1/16)(1 + 1/256)... = 1.6, each factor a shift, rounded by the last bit that
//! leaves, and an addition, whose own overflow is truncated.

use super::{Real40, RealError, arith};

const TOP: u64 = 1 << 39;

/// A positive number before its rounding: `mantissa` / 2^40 x 2^(`exp` - 128), with the mantissa
/// below 2^40 and its top bit set, or zero.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wide {
    mantissa: u64,
    exp: i32,
}

impl Wide {
    /// An integer below 2^40.
    pub fn new(n: u64) -> Self {
        let mut wide = Self {
            mantissa: n & ((1 << 40) - 1),
            exp: 168,
        };
        if wide.mantissa != 0 {
            let shift = wide.mantissa.leading_zeros() - 24;
            wide.mantissa <<= shift;
            wide.exp -= shift as i32;
        }
        wide
    }

    /// The mantissa with itself shifted down added.
    fn with_part(mut self, shift: u32) -> Self {
        self.mantissa += (self.mantissa >> shift) + (self.mantissa >> (shift - 1) & 1);
        if self.mantissa >= 2 * TOP {
            self.mantissa >>= 1;
            self.exp += 1;
        }
        self
    }

    /// Times ten.
    pub fn up(mut self) -> Self {
        self.exp += 3;
        self.with_part(2)
    }

    /// A tenth.
    pub fn down(mut self) -> Self {
        self.exp -= 4;
        [1, 4, 8, 16, 32].into_iter().fold(self, Self::with_part)
    }

    /// Times a power of ten; too large a one ends early, in what is too big or zero.
    pub fn scaled(self, power: i32) -> Self {
        let mut wide = self;
        for _ in 0..power.unsigned_abs().min(200) {
            wide = if power < 0 { wide.down() } else { wide.up() };
        }
        wide
    }

    /// The mantissa with four bits before the point; of a number from 1 to 16 and a little.
    fn aligned(self) -> u64 {
        match DIGIT - self.exp {
            down @ 0..64 => self.mantissa >> down,
            up => self.mantissa << up.unsigned_abs().min(8),
        }
    }

    /// Rounded to a real.
    pub fn real(self) -> Result<Real40, RealError> {
        if self.mantissa == 0 {
            return Ok(Real40::ZERO);
        }
        arith::round(false, self.exp, self.mantissa)
    }
}

/// The exponent at which a mantissa's top four bits are a whole digit.
const DIGIT: i32 = 132;
const TEN: u64 = 10 << 36;

/// The size of a real as `keep` decimal digits (ASCII), rounded as the ROM does: it brings the
/// number between 1 and 10, adds half of the last digit, a 5 divided by ten so many times, and
/// takes the digits off the top. Answers also the first digit's power of ten.
pub(crate) fn digits(x: Real40, keep: usize) -> (Vec<u8>, i32) {
    if x.is_zero() {
        return (vec![b'0'; keep], 0);
    }
    let mut wide = Wide {
        mantissa: u64::from(x.mantissa()) << 8,
        exp: i32::from(x.exponent()),
    };
    let mut power = 0;
    loop {
        if wide.exp > DIGIT || wide.exp == DIGIT && wide.mantissa >= TEN {
            wide = wide.down();
            power += 1;
        } else if wide.exp < DIGIT - 3 {
            wide = wide.up();
            power -= 1;
        } else {
            break;
        }
    }
    let half = Wide::new(5).scaled(-(keep as i32));
    let gap = (wide.exp - half.exp).clamp(0, 63);
    wide.mantissa += half.mantissa >> gap;
    if wide.mantissa >= 2 * TOP {
        wide.mantissa >>= 1;
        wide.exp += 1;
    }
    let mut rest = wide.aligned();
    if rest >= TEN {
        rest = wide.down().aligned();
        power += 1;
    }
    let mut list = Vec::with_capacity(keep);
    for _ in 0..keep {
        list.push(b'0' + (rest >> 36) as u8 % 10);
        rest = (rest & ((1 << 36) - 1)) * 10;
    }
    (list, power)
}
