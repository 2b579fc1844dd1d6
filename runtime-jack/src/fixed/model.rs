//! Fixed-point reals, bit for bit as the class `Fixed` computes them.
//!
//! Each function mirrors one subroutine of [`crate::parts`]; the tests run both. Operands
//! are from -32767 to 32767.

use crate::model::MOST;
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

/// The root of a * 2^by, to 1.4; `by` from 1 to 15. Of a negative: 0.
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
fn root(mut a: i32, mut down: i32) -> i32 {
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

/// The greatest whole number not above a / 2^by; `by` from 0 to 14.
pub fn floor(a: i32, by: i32) -> i32 {
    a >> by
}
