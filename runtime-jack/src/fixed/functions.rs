//! Tangents, arcs, powers and logarithms in fixed point, bit for bit as the class `Fixed`
//! computes them.
//!
//! There are three tables of 257 entries, made by the program in steps with seven bits
//! more than their entries have, and read in proportion: arc tangents up to 1, powers of 2
//! from 0 to 1, and logarithms to the base 2 from 1 to 2. What is e to a power, or any
//! number, is 2 to the product with a logarithm, of which the whole part is exact.

use super::model::{div, left, mul, right, root, sine, turns};
use crate::model::{MOST, sum, wrap};
use slowlight_routine::scale::Scales;
use std::sync::OnceLock;

/// Half a turn, times 8192; a quarter, times 16384.
const ANGLE: i32 = 25736;
/// ln 2 times 32768; its part above 1 / 1024, times 1024; and the rest.
const LN_2: [i32; 3] = [22713, 709, 25];
/// 1 / ln 2 - 1, times 32768.
const ONE_OVER_LN_2: i32 = 14506;

/// A table of 257 entries: each, the last one aside, is the one before and what `step`
/// answers for that, in 128ths; the first starts with so many of these.
fn table(rest: i32, step: impl Fn(i32, i32) -> i32) -> Vec<i32> {
    let (mut value, mut rest) = (0, rest);
    let mut all = Vec::new();
    for k in 0..256 {
        all.push(value);
        rest += step(k, value);
        value += rest / 128;
        rest &= 127;
    }
    all.push(wrap(value));
    all
}

/// atan(k / 256) * 2^15 for k to 256.
pub fn arcs() -> &'static [i32] {
    static ARCS: OnceLock<Vec<i32>> = OnceLock::new();
    ARCS.get_or_init(|| table(64, |k, _| div(16384, 16384 + (k * (k + 1) / 2 + 1) / 2, 14)))
}

/// (2^(k/256) - 1) * 2^15 for k to 256; the last one is an int.
pub fn powers() -> &'static [i32] {
    static POWERS: OnceLock<Vec<i32>> = OnceLock::new();
    POWERS.get_or_init(|| {
        let mut all = table(50, |_, value| 11372 + mul(value, 11372));
        all[256] = MOST;
        all
    })
}

/// log2(1 + k / 256) * 2^15 for k to 256; the last one wraps.
pub fn logs() -> &'static [i32] {
    static LOGS: OnceLock<Vec<i32>> = OnceLock::new();
    LOGS.get_or_init(|| table(64, |k, _| div(23637, 2 * k + 513, 9)))
}

/// What a table of 257 has at a / 128, in proportion.
fn entry(table: &[i32], a: i32) -> i32 {
    let at = (a / 128) as usize;
    let least = table[at];
    least + (wrap(table[at + 1] - least) * (a & 127) + 64) / 128
}

/// The tangent.
pub fn tan(a: i32, scales: Scales) -> i32 {
    let turn = turns(a, i32::from(scales.args[0]));
    let bits = i32::from(scales.result);
    let made = div(sine(turn), sine(wrap(turn + 16384)), bits.max(0));
    match bits {
        0.. => made,
        _ => right(made, -bits),
    }
}

/// The arc tangent of a / b, at most 1, times 2^15.
fn arc(a: i32, b: i32) -> i32 {
    entry(arcs(), div(a, b, 15))
}

/// The angle of (x, y), times 2^13.
pub fn atan2(y: i32, x: i32) -> i32 {
    let (up, right) = (y.abs(), x.abs());
    let inner = match up > right {
        true => ANGLE / 2 - (arc(right, up) + 2) / 4,
        false => (arc(up, right) + 2) / 4,
    };
    let angle = if x < 0 { ANGLE - inner } else { inner };
    if y < 0 { -angle } else { angle }
}

/// The arc cosine of a magnitude, times 2^14: twice the arc tangent of a ratio of roots,
/// of which nothing is lost near 1.
fn half_arc(a: i32) -> i32 {
    match a.abs() {
        16384.. => 0,
        a => arc(root(16384 - a, 0), root(16384 + a, 0)),
    }
}

/// The arc sine of a / 2^14, clamped to -1..1, times 2^14.
pub fn asin(a: i32) -> i32 {
    let angle = ANGLE - half_arc(a);
    if a < 0 { -angle } else { angle }
}

/// The arc cosine of a / 2^14, clamped to -1..1, times 2^13.
pub fn acos(a: i32) -> i32 {
    let angle = (half_arc(a) + 1) / 2;
    if a < 0 { ANGLE - angle } else { angle }
}

/// An exponent and what it is the exponent of: 2^(b (k + part / 2^15)), or one over that.
struct Power {
    b: i32,
    k: i32,
    part: i32,
    under: bool,
}

impl Power {
    /// With b at one scale, and the result at another.
    fn value(self, of_b: i8, result: i8) -> i32 {
        let Power { b, k, part, under } = self;
        let under = under != (b < 0);
        let b = b.abs();
        let low = mul(b, part);
        let one = 1 << (of_b - 5);
        let whole = k * (b / 32) + low / 32 + (k * (b & 31) + (low & 31)) / 32;
        let whole = whole / one;
        let low = ((k * b + low) << (15 - of_b)) & 32767;
        let (whole, low) = match (under, low) {
            (false, _) => (whole, low),
            (true, 0) => (-whole, 0),
            (true, _) => (-whole - 1, 32768 - low),
        };
        match whole + i32::from(result) {
            15.. => MOST,
            whole @ 0..15 => (1 << whole) + right(entry(powers(), low), 15 - whole),
            -1 => 1,
            _ => 0,
        }
    }
}

/// e to this power.
pub fn exp(a: i32, scales: Scales) -> i32 {
    let power = Power {
        b: a,
        k: 1,
        part: ONE_OVER_LN_2,
        under: false,
    };
    power.value(scales.args[0], scales.result)
}

/// Of a above 0: the whole number below its logarithm to the base 2, and the part behind
/// that, times 2^15.
fn log2(mut a: i32, of_a: i8) -> (i32, i32) {
    let mut k = 14 - i32::from(of_a);
    while a < 16384 {
        a += a;
        k -= 1;
    }
    (k, entry(logs(), (a + a) & 32767))
}

/// Natural; of 0 or a negative the most negative value.
pub fn log(a: i32, scales: Scales) -> i32 {
    if a < 1 {
        return -MOST;
    }
    let (mut k, part) = log2(a, scales.args[0]);
    let [ln_2, above, rest] = LN_2;
    let mut part = mul(part, ln_2) + k * rest;
    // Both of one sign, so that what saturates does so rightly.
    if k < 0 && part > 0 {
        k += 1;
        part -= 32 * above;
    }
    let bits = i32::from(scales.result);
    let up = bits.max(10) - 10;
    let made = sum(raised(k * above, up), right(part, 5 - up));
    match bits {
        10.. => made,
        _ => right(made, (10 - bits).min(15)),
    }
}

fn raised(a: i32, by: i32) -> i32 {
    match by {
        0 => a,
        _ => left(a, by),
    }
}

/// x^0 is 1, 0 to a negative the largest value, a negative to a fraction 0.
pub fn pow(a: i32, b: i32, scales: Scales) -> i32 {
    let [of_a, of_b] = scales.args;
    if a == 0 && b != 0 {
        return if b < 0 { MOST } else { 0 };
    }
    if a < 0 && b & ((1 << of_b) - 1) != 0 {
        return 0;
    }
    let minus = a < 0 && b & 1 << of_b != 0;
    let (k, part) = log2(a.abs().max(1), of_a);
    let under = k < 0;
    let (k, part) = match (under, part) {
        (false, _) => (k, part),
        (true, 0) => (-k, 0),
        (true, _) => (-k - 1, 32768 - part),
    };
    let made = Power { b, k, part, under }.value(of_b, scales.result);
    if minus { -made } else { made }
}
