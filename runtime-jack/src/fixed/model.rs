//! Fixed-point reals, bit for bit as the class `Fixed` computes them.
//!
//! Each function mirrors one subroutine of [`crate::parts`]; the tests run both. Operands
//! are from -32767 to 32767.

use crate::model::{MOST, wrap};
use slowlight_routine::scale;
use std::sync::OnceLock;

/// The first entry of the table of roots: a radicand is made at least 128 times that.
pub const FIRST_ROOT: usize = 64;

/// a * 2^-by, rounded half away from 0; `by` from 1 to 15.
pub fn right(a: i32, by: i32) -> i32 {
    let part = a.abs() >> (by - 1);
    (part - part / 2) * a.signum()
}

/// a * 2^by, saturating; `by` above 0.
pub fn left(a: i32, by: i32) -> i32 {
    scale::shifted(i64::from(a), by, super::BITS) as i32
}

/// The product's upper part, a * b / 2^15, rounded; off by less than 0.54.
pub fn mul(a: i32, b: i32) -> i32 {
    let (high, rest) = parts(a, b);
    (high * 2 + (rest + 32) / 64) * sign(a, b)
}

/// a * b / 2^16, rounded; off by less than 0.52.
pub fn half_mul(a: i32, b: i32) -> i32 {
    let (high, rest) = parts(a, b);
    (high + (rest + 64) / 128) * sign(a, b)
}

/// a * b / 2^by, rounded, saturating; `by` from 12 to 14; off by less than 0.8.
pub fn wide_mul(a: i32, b: i32, by: i32) -> i32 {
    let (high, rest) = parts(a, b);
    let down = 1 << (by - 9);
    let made = (high << (16 - by)) + (rest + down / 2) / down;
    made.min(MOST) * sign(a, b)
}

/// a * b / 2^16 of magnitudes in whole units, and what is above that in units of 1/128.
fn parts(a: i32, b: i32) -> (i32, i32) {
    let (a, b) = (a.abs(), b.abs());
    let (a, low_a, b, low_b) = (a / 256, a & 255, b / 256, b & 255);
    let rest = a * low_b / 2 + b * low_a / 2 + low_a / 2 * low_b / 256;
    (a * b, rest)
}

fn sign(a: i32, b: i32) -> i32 {
    if (a < 0) == (b < 0) { 1 } else { -1 }
}

/// a / b * 2^by to the nearest, saturating; by 0 the greatest with the sign of a.
pub fn div(a: i32, b: i32, by: i32) -> i32 {
    if b == 0 {
        return a.signum() * MOST;
    }
    let sign = sign(a, b);
    let (a, b) = (a.abs(), b.abs());
    let (mut whole, mut rest) = (a / b, a % b);
    for _ in 0..by {
        if whole > 16383 {
            return sign * MOST;
        }
        whole += whole;
        if rest < b - rest {
            rest += rest;
        } else {
            rest -= b - rest;
            whole += 1;
        }
    }
    if rest >= b - rest && whole < MOST {
        whole += 1;
    }
    sign * whole
}

/// The root of a * 2^by, to 1.5; `by` from 1 to 15. Of a negative: 0.
pub fn sqrt(a: i32, by: i32) -> i32 {
    // Fours can be taken out of odd scales only.
    match (by & 1, a > 16383) {
        _ if a < 1 => 0,
        (1, _) => root(a, (15 - by) / 2),
        (_, true) => root(a / 2, (14 - by) / 2),
        (_, false) => root(a + a, (16 - by) / 2),
    }
}

/// The root of a * 2^15, above 0, then divided by 2^down.
pub(super) fn root(mut a: i32, mut down: i32) -> i32 {
    while a < 8192 {
        a *= 4;
        down += 1;
    }
    let (at, part) = ((a / 128) as usize - FIRST_ROOT, a & 127);
    let least = roots()[at];
    let root = least + ((roots()[at + 1] - least) * part + 64) / 128;
    match down {
        0 => root,
        _ => right(root, down),
    }
}

/// sqrt(k / 256) * 2^15 for k from [`FIRST_ROOT`] to 256: of the numbers whose squares are
/// not above, the greatest.
pub fn roots() -> &'static [i32] {
    static ROOTS: OnceLock<Vec<i32>> = OnceLock::new();
    ROOTS.get_or_init(|| {
        let mut root = 16384;
        let mut all = Vec::new();
        for k in FIRST_ROOT as i32..256 {
            let mut step = 64;
            while step > 0 {
                if mul(root + step, root + step) <= k * 128 {
                    root += step;
                }
                step /= 2;
            }
            all.push(root);
        }
        all.push(MOST);
        all
    })
}

/// The sine of a / 2^by, in units of 2^-14; `by` from 0 to 13.
pub fn sin(a: i32, by: i32) -> i32 {
    sine(turns(a, by))
}

/// The cosine.
pub fn cos(a: i32, by: i32) -> i32 {
    sine(wrap(turns(a, by) + 16384))
}

/// a / 2^by radians in units of which 65536 are a turn; what is above that is lost.
pub(super) fn turns(a: i32, by: i32) -> i32 {
    wrap(a.wrapping_add(half_mul(a, 17907)) << (13 - by))
}

/// The sine of so many 65536ths of a turn.
pub(super) fn sine(mut turn: i32) -> i32 {
    let minus = turn < 0;
    if minus {
        turn = -turn;
    }
    if turn > 16384 {
        turn = 32768 - turn;
    }
    let (at, part) = ((turn / 128) as usize, turn & 127);
    let entry = |k: usize| sines().get(k).copied().unwrap_or(0);
    let least = entry(at);
    let made = least + ((entry(at + 1) - least) * part + 64) / 128;
    if minus { -made } else { made }
}

/// Sines of a quarter of a turn in 128 steps, times 2^14, and the last one twice: that in
/// the middle of two is the mean of these over the cosine of half their distance.
pub fn sines() -> &'static [i32] {
    static SINES: OnceLock<Vec<i32>> = OnceLock::new();
    SINES.get_or_init(|| {
        let mut all = vec![0; 130];
        all[128] = 16384;
        all[129] = 16384;
        let mut step = 64;
        for factor in [23170, 17734, 16705, 16463, 16404, 16389, 16385] {
            for k in (step..128).step_by(2 * step) {
                all[k] = mul(all[k - step] + all[k + step], factor);
            }
            step /= 2;
        }
        all
    })
}

/// The greatest whole number not above a / 2^by; `by` from 0 to 14.
pub fn floor(a: i32, by: i32) -> i32 {
    a >> by
}
