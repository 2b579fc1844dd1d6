//! Powers of e out of a table of those of two from 1 to 2, 256 entries, in proportion: bit for
//! bit as `asm/scaled/exponential.asm` computes them.

use super::model::{held, right, upper};
use super::sines::{apart, in_proportion};
use slowlight_routine::scale::Scales;
use std::sync::OnceLock;

/// Whether this is right for an exponent's and a power's points: enough of the exponent, whose
/// whole part fits a byte, and no more bits of the result than the table has.
pub fn has(scales: Scales) -> bool {
    (10..=16).contains(&scales.args[0]) && (0..=15).contains(&scales.result)
}

/// What leads from the last entry but one to the last.
const STEEPEST: i32 = 177;

/// Powers of two with 15 bits behind the point, of what lies half a unit of 2^-16 further on:
/// a fraction is what is left of more bits.
fn powers() -> &'static [i32] {
    static POWERS: OnceLock<Vec<i32>> = OnceLock::new();
    POWERS.get_or_init(|| {
        let fraction = |k: i32| (f64::from(256 * k) + 0.5) / 65536.0;
        // What is found is rounded by halves, upwards.
        let rounded = |k: i32| (fraction(k).exp2() * 32768.0 - 0.3).round() as i32;
        let mut all: Vec<i32> = (0..=256).map(rounded).collect();
        // What lies before the end does not leave 16 bits.
        all[256] = 0xFFFF;
        all[255] = all[255].min(0xFFFF - STEEPEST);
        all
    })
}

/// The table's bytes.
pub fn bytes(which: usize) -> Vec<i32> {
    apart(powers(), which)
}

/// An exponent of e as one of two, 16 bits behind the point.
fn exponent(a: i32, n: i8) -> i64 {
    let wide = i64::from(a & 0xFFFF);
    let (low, high) = (wide & 255, wide >> 8);
    let more = (169 * high + upper(169, low)) >> 1;
    let below = if a < 0 { (369 << 16) + (169 << 7) } else { 0 };
    (369 * wide + more - below) << (16 - n).clamp(0, 6) >> 8
}

/// e to the a, whose and whose result's points are told; saturates.
pub fn exponential(a: i32, scales: Scales) -> i32 {
    let exponent = exponent(a, scales.args[0]);
    let halvings = 15 - i64::from(scales.result) - (exponent >> 16);
    match halvings {
        ..1 => held(i64::MAX, super::BITS),
        18.. => 0,
        _ => {
            let found = in_proportion(powers(), (exponent & 0xFFFF) as i32);
            held(right(found, halvings.unsigned_abs() as u32), super::BITS)
        }
    }
}
