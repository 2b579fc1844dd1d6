//! Natural logarithms out of a table of those from 1 to 2, 256 entries, in proportion: bit for bit
//! as `asm/scaled/logarithm.asm` computes them.

use super::model::upper;
use std::sync::OnceLock;

/// Bits behind the point of what is looked up.
const POINT: i32 = 24;

/// Logarithms of 1 + k / 256.
fn logarithms() -> &'static [i64] {
    static LOGARITHMS: OnceLock<Vec<i64>> = OnceLock::new();
    LOGARITHMS.get_or_init(|| {
        let logarithm = |k: i32| (f64::from(k) / 256.0).ln_1p() * f64::from(POINT).exp2();
        (0..=256).map(|k| logarithm(k).round() as i64).collect()
    })
}

/// What a number of 16.16 whose upper bit has this place has of them, and half of a result's place.
fn shifts(place: u32) -> i64 {
    let twos = f64::from(place as i32 - 16) * std::f64::consts::LN_2;
    (twos * f64::from(POINT).exp2()).round() as i64 + 128
}

/// The bytes of the logarithms, from the lowest on.
pub fn bytes(which: u32) -> Vec<i32> {
    // Of what differences are taken there is one more.
    let many = if which < 2 { 257 } else { 256 };
    byte(logarithms().iter().take(many).copied(), which)
}

/// The bytes of what shifts make.
pub fn shift_bytes(which: u32) -> Vec<i32> {
    byte((0..32).map(shifts), which)
}

fn byte(of: impl Iterator<Item = i64>, which: u32) -> Vec<i32> {
    of.map(|value| (value >> (8 * which) & 255) as i32)
        .collect()
}

/// The natural logarithm in 16.16; of 0 and below the most negative.
pub fn logarithm(a: i32) -> i32 {
    if a <= 0 {
        return i32::MIN;
    }
    let shifted = a.unsigned_abs() << a.leading_zeros();
    let place = 31 - a.leading_zeros();
    // What is behind the upper bit, 16 bits of it, rounded.
    let at = i64::from(((shifted << 1 >> 15) + 1) >> 1);
    let (place, at) = if at > 0xFFFF {
        (place + 1, 0)
    } else {
        (place, at)
    };
    let pair = &logarithms()[(at >> 8) as usize..];
    let (step, part) = (pair[1] - pair[0], at & 255);
    let more = part * (step >> 8) + upper(part, step & 255);
    ((pair[0] + more + shifts(place)) >> (POINT - 16)) as i32
}
