//! Sines, logarithms and what comes of them, bit for bit as `asm/` computes them.
//!
//! All but sines and cosines, which are looked up, rest on one thing: a polynomial in 32-bit fractions ([`series`]), whose
//! terms come from Remez's exchange for the interval that the argument is
//! reduced to. The terms' own error is stated with each; what a step cuts off
//! adds at most 2^-31. In 16.16 both are far below the last place, so that
//! nearly every result is the nearest or the one beside it.

use super::{fixed_divide, root, signed};
use std::f64::consts::FRAC_PI_2;
use std::sync::OnceLock;

/// A polynomial c0 -+ c1 x +- ...: terms in 1.31, the last first.
pub struct Terms {
    /// Whether signs alternate.
    alternate: bool,
    terms: &'static [u32],
}

impl Terms {
    /// The bytes that `series.asm` reads: how many terms follow the first, the
    /// mask, and the terms, each exclusive-or the mask.
    pub fn table(&self) -> Vec<i32> {
        let mask = if self.alternate { u32::MAX } else { 0 };
        let mut bytes = vec![self.terms.len() as i32 - 1, (mask & 0xFF) as i32];
        for term in self.terms {
            bytes.extend((term ^ mask).to_le_bytes().map(i32::from));
        }
        bytes
    }
}

/// sin(x pi/2) / x in x^2, for x from 0 to 1; off by 2^-27.2 at most.
pub const SINE: Terms = Terms {
    alternate: true,
    terms: &[
        0x0004_F85F,
        0x0099_29AD,
        0x0A33_478F,
        0x52AE_F0C7,
        0xC90F_DA94,
    ],
};

/// arctan(x) / x in x^2, for x from 0 to 1; off by 2^-20.7 at most.
pub const ARCTANGENT: Terms = Terms {
    alternate: true,
    terms: &[
        0x0106_5ECC,
        0x04CA_EE99,
        0x0ACC_1D7A,
        0x114B_AB7A,
        0x1974_AD69,
        0x2AA8_9882,
        0x7FFF_FB1B,
    ],
};

/// 2^x for x from 0 to 1, exact at 0; off by 2^-32 at most.
pub const POWER_OF_TWO: Terms = Terms {
    alternate: false,
    terms: &[
        0x0000_AE0F,
        0x0004_C91B,
        0x002B_E00B,
        0x013B_19F1,
        0x071A_C50B,
        0x1EBF_BDD2,
        0x58B9_0BFC,
        0x8000_0000,
    ],
};

/// log2((1 + s) / (1 - s)) / 2s in (2s)^2, for 2s from 0 to 2/3; off by 2^-32.7 at most.
pub const LOGARITHM: Terms = Terms {
    alternate: false,
    terms: &[
        0x0005_A356,
        0x0013_BFF8,
        0x0069_B4C1,
        0x024E_E88A,
        0x0F63_8520,
        0xB8AA_3B29,
    ],
};

/// 2 / pi, 32 bits behind the point.
const TWO_OVER_PI: u32 = 0xA2F9_836E;
/// log2(e), 31 bits behind the point.
const LOG2_E: u32 = 0xB8AA_3B29;
/// ln(2), 32 bits behind the point.
const LN_2: u32 = 0xB172_17F8;
/// pi / 2 and pi, 32 bits behind the point.
const QUARTER: i64 = 0x1_921F_B544;
const HALF: i64 = 0x3_243F_6A89;

fn times(a: u32, b: u32) -> u64 {
    u64::from(a) * u64::from(b)
}

/// The upper half of a product.
fn upper(product: u64) -> u32 {
    (product >> 32) as u32
}

/// The polynomial's value at x, which is in 0.32: 1.31.
fn series(terms: &Terms, x: u32) -> u32 {
    let mut rest = terms.terms.iter();
    let mut sum = rest.next().copied().unwrap_or(0);
    for term in rest {
        let higher = upper(times(sum, x));
        sum = if terms.alternate {
            term.wrapping_sub(higher)
        } else {
            term.wrapping_add(higher)
        };
    }
    sum
}

/// x P(x x) with 63 bits behind the point, for x in 0.32.
fn odd_series(terms: &Terms, x: u32) -> u64 {
    times(series(terms, upper(times(x, x))), x)
}

/// In which quadrant a magnitude is, and how far into it, 0.32.
fn quadrants(a: i32) -> (u32, u32) {
    let product = times(a.unsigned_abs(), TWO_OVER_PI);
    (upper(product) >> 16, (product >> 16) as u32)
}

/// The magnitude of a sine, 63 bits behind the point.
fn quadrant_sine(quadrant: u32, into: u32) -> u64 {
    odd_series(&SINE, if quadrant & 1 == 1 { !into } else { into })
}

/// A quarter of a turn's sines, 257 with 23 bits behind the point. Between two the chord lies below
/// the arc, by 0.31 of the last place of 16.16 at most: so they are raised by half of that.
fn quarter_sines() -> &'static [u32] {
    static SINES: OnceLock<Vec<u32>> = OnceLock::new();
    SINES.get_or_init(|| {
        let sine = |k: u32| (f64::from(k) / 256.0 * FRAC_PI_2).sin();
        let held = |k| (sine(k) * (f64::from(1 << 23) + 19.7)).round() as u32;
        (0..=256).map(held).collect()
    })
}

/// Their bytes, the lowest first; of the highest there are 256.
pub(crate) fn wide_sines(which: u32) -> Vec<i32> {
    let bytes = quarter_sines().iter().map(|sine| sine >> (8 * which) & 255);
    let bytes = bytes.map(|byte| byte as i32);
    bytes.take(if which == 2 { 256 } else { 257 }).collect()
}

/// A magnitude in quarters of a turn, 24 bits behind the point: byte by byte from the lowest.
fn quarters(a: u32) -> u64 {
    let bytes = a.to_le_bytes().into_iter();
    bytes.fold(0, |sum, byte| {
        (sum >> 8) + times(u32::from(byte), TWO_OVER_PI)
    })
}

/// The sine of so many quarters of a turn, by the table: 256 parts of each, and in proportion.
fn looked_up(quarters: u64) -> i32 {
    let (quarter, into) = (quarters >> 24, quarters as u32 & 0xFF_FFFF);
    let into = if quarter & 1 == 1 {
        into ^ 0xFF_FFFF
    } else {
        into
    };
    let pair = &quarter_sines()[(into >> 16) as usize..];
    let [less, more] = [pair[0], pair[1]];
    let (step, on) = (more - less, into & 0xFFFF);
    let product = (step >> 8) * (on >> 8)
        + (((step >> 8) * (on & 255)) >> 8)
        + (((step & 255) * (on >> 8)) >> 8);
    signed(u64::from((less + product + 64) >> 7), quarter & 2 == 2)
}

/// The sine of radians.
pub fn sine(a: i32) -> i32 {
    looked_up(quarters(a.unsigned_abs()) + if a < 0 { 2 << 24 } else { 0 })
}

/// The cosine of radians: the sine a quadrant on.
pub fn cosine(a: i32) -> i32 {
    looked_up(quarters(a.unsigned_abs()) + (1 << 24))
}

/// The tangent of radians: sine over cosine; saturates.
pub fn tangent(a: i32) -> i32 {
    let (quadrant, into) = quadrants(a);
    let half = |quadrant| upper(quadrant_sine(quadrant, into)) >> 1;
    let quotient = fixed_divide(half(quadrant) as i32, half(quadrant ^ 1) as i32);
    if (quadrant & 1 == 1) != (a < 0) {
        -quotient
    } else {
        quotient
    }
}

/// The angle of (y, x), both at least 0 and not both 0; 32 bits behind the point.
fn arctangent(y: u32, x: u32) -> i64 {
    let (least, most) = (y.min(x), y.max(x));
    let ratio = if least == most {
        u32::MAX
    } else {
        ((u64::from(least) << 32) / u64::from(most.max(1))) as u32
    };
    let angle = (odd_series(&ARCTANGENT, ratio) >> 31) as i64;
    if y >= x { QUARTER - angle } else { angle }
}

/// 32 bits behind the point become 16, to the nearest.
fn round(wide: i64) -> i32 {
    ((wide + 0x8000) >> 16) as i32
}

/// The angle of (y, x); 0 of (0, 0).
pub fn arctangent2(y: i32, x: i32) -> i32 {
    if y == 0 && x == 0 {
        return 0;
    }
    let right = arctangent(y.unsigned_abs(), x.unsigned_abs());
    let angle = round(if x < 0 { HALF - right } else { right });
    if y < 0 { -angle } else { angle }
}

/// 2^6.5 times the root of a number at most 2.
fn large_root(a: i32) -> u32 {
    root(a << 13).unsigned_abs()
}

/// The angle of a cosine, which is clamped to -1..1: twice that of
/// (root of 1 - x, root of 1 + x), which loses nothing near the ends.
fn arccosine_wide(x: i32) -> i64 {
    let x = x.clamp(-0x1_0000, 0x1_0000);
    2 * arctangent(large_root(0x1_0000 - x), large_root(0x1_0000 + x))
}

pub fn arccosine(x: i32) -> i32 {
    round(arccosine_wide(x))
}

pub fn arcsine(x: i32) -> i32 {
    round(QUARTER - arccosine_wide(x))
}

/// 2^(n + f) in 16.16, f in 0.32; none where it is too large.
fn power_of_two(n: i32, f: u32) -> Option<i32> {
    match n {
        15.. => None,
        ..-17 => Some(0),
        _ => {
            let shifted = u64::from(series(&POWER_OF_TWO, f)) >> (14 - n);
            i32::try_from((shifted + 1) >> 1).ok()
        }
    }
}

/// e^a; saturates.
pub fn exponential(a: i32) -> i32 {
    if a >= 16 << 16 {
        return i32::MAX;
    }
    if a < -16 << 16 {
        return 0;
    }
    let exponent = times(a.unsigned_abs() << 1, LOG2_E) as i64;
    let exponent = if a < 0 { !exponent } else { exponent };
    power_of_two((exponent >> 48) as i32, (exponent >> 16) as u32).unwrap_or(i32::MAX)
}

/// log2(a) times `by`, with 32 bits more behind the point than `by` has; a is
/// above 0, at most 2^31. With a = 2^e m, 1 <= m < 2 and s = (m - 1)/(m + 1),
/// the logarithm of m is 2s P(4 s s).
fn logarithm_times(a: u32, by: u32) -> i128 {
    let e = 15 - a.leading_zeros() as i32;
    // 2^30 m, from which 2^30 (m - 1) and 2^29 (m + 1) make 2s.
    let m = if e == 15 { 1 << 30 } else { a << (14 - e) };
    let twice_s = ((u64::from(m - (1 << 30)) << 32) / u64::from((m + (1 << 30)) >> 1)) as u32;
    let fraction = (odd_series(&LOGARITHM, twice_s) >> 31) as u32;
    i128::from(times(fraction, by)) + ((i128::from(by) * i128::from(e)) << 32)
}

/// The natural logarithm; of 0 and below the most negative.
pub fn logarithm(a: i32) -> i32 {
    if a <= 0 {
        return i32::MIN;
    }
    let wide = logarithm_times(a.unsigned_abs(), LN_2);
    ((wide + (1 << 47)) >> 48) as i32
}

/// a^b; saturates. x^0 is 1, 0 to a negative the largest value, a negative to
/// a fraction 0.
pub fn power(a: i32, b: i32) -> i32 {
    let negative = a < 0 && b & 0x1_0000 != 0;
    match () {
        () if b == 0 => return 0x1_0000,
        () if a == 0 => return if b < 0 { i32::MAX } else { 0 },
        () if a < 0 && b & 0xFFFF != 0 => return 0,
        () => {}
    }
    let exponent = logarithm_times(a.unsigned_abs(), b.unsigned_abs());
    let exponent = if b < 0 { !exponent } else { exponent };
    let whole = (exponent >> 48).clamp(-128, 127) as i32;
    match power_of_two(whole, (exponent >> 16) as u32) {
        Some(magnitude) => signed(u64::from(magnitude.unsigned_abs()), negative),
        None => signed(u64::MAX, negative),
    }
}
