//! Sines and cosines out of a table of a quarter of a turn, 256 entries, in proportion: bit
//! for bit as `asm/scaled/sine.asm` computes them.

use super::model::{right, upper};
use std::f64::consts::FRAC_PI_2;
use std::sync::OnceLock;

/// Fraction bits of angles for which this is of use: with fewer the product with 2 / pi is more
/// than eight places of the result off.
pub const POINTS: std::ops::RangeInclusive<i32> = 5..=16;

/// Sines with 15 bits behind the point. An angle's 16 bits are what is left of more, so they
/// stand for what lies half a unit further on; then the way back is the other bits, too.
fn sines() -> &'static [i32] {
    static SINES: OnceLock<Vec<i32>> = OnceLock::new();
    SINES.get_or_init(|| {
        let angle = |k: i32| (f64::from(256 * k) + 0.5) / 65536.0 * FRAC_PI_2;
        // What is found is rounded by halves, upwards.
        let held = |k: i32| (angle(k).sin() * 32768.0 - 0.2).round() as i32;
        (0..=256).map(held).collect()
    })
}

/// The table's bytes.
pub fn bytes(which: usize) -> Vec<i32> {
    apart(sines(), which)
}

/// A table's lower bytes, which differences are taken of, or its upper ones.
pub(super) fn apart(table: &[i32], which: usize) -> Vec<i32> {
    match which {
        0 => table.iter().map(|entry| entry & 255).collect(),
        _ => table.iter().take(256).map(|entry| entry >> 8).collect(),
    }
}

/// An angle with n bits behind the point in quarters of a turn, 16 bits behind theirs.
fn quarters(a: i32, n: i32) -> i64 {
    let wide = i64::from(a & 0xFFFF);
    let (low, high) = (wide & 255, wide >> 8);
    let less = (13 * high + upper(13, low)) >> 1;
    let below = if a < 0 { (163 << 16) - (13 << 7) } else { 0 };
    (163 * wide - less - below) << (16 - n).clamp(0, 11) >> 8
}

/// What a table has for 16 bits: the entry of the upper eight, and as much of what leads to the
/// next as the others say.
pub(super) fn in_proportion(table: &[i32], at: i32) -> i64 {
    let pair = &table[(at >> 8) as usize..];
    i64::from(pair[0]) + upper(i64::from(pair[1] - pair[0]), i64::from(at & 255))
}

/// The sine of so many quarters of a turn, 14 bits behind the point.
fn looked_up(quarters: i64) -> i32 {
    let (quarter, into) = (quarters >> 16, (quarters & 0xFFFF) as i32);
    let into = if quarter & 1 == 1 {
        0xFFFF - into
    } else {
        into
    };
    let sine = right(in_proportion(sines(), into), 1) as i32;
    if quarter & 2 == 2 { -sine } else { sine }
}

/// The sine of radians with n bits behind the point.
pub fn sine(a: i32, n: i32) -> i32 {
    looked_up(quarters(a, n))
}

/// The cosine of the same: the sine a quarter further on.
pub fn cosine(a: i32, n: i32) -> i32 {
    looked_up(quarters(a, n) + 0x1_0000)
}
