//! What the routines of fixed point compute whose values have points of their own, bit for
//! bit. Operands are from -32767 to 32767.

use crate::model as wide;
use slowlight_routine::scale::{Scales, most};
use std::sync::OnceLock;

/// Bits of a real.
const BITS: u8 = super::BITS;

/// The greatest.
const MOST: i64 = most(BITS);

/// Held to the ends of so many bits.
pub fn held(value: i64, bits: u8) -> i32 {
    value.clamp(-most(bits), most(bits)) as i32
}

/// So many bits to the right, to the nearest, halves upwards.
pub fn right(value: i64, by: u32) -> i64 {
    match by {
        0 => value,
        63.. => 0,
        _ => (value + (1 << (by - 1))) >> by,
    }
}

/// An int read with so many more fraction bits, or fewer: the reading of this runtime.
pub fn shifted(value: i64, by: i32, bits: u8) -> i64 {
    let made = match by {
        0.. => value << by.min(40),
        _ => right(value, by.unsigned_abs()),
    };
    made.clamp(-most(bits), most(bits))
}

/// floor(n n / 4), upper byte.
fn quarter_square(n: i64) -> i64 {
    (n * n / 4) >> 8
}

/// The product of two bytes over 256, of which only upper bytes were subtracted.
pub(super) fn upper(a: i64, b: i64) -> i64 {
    quarter_square(a + b) - quarter_square(a - b)
}

/// The upper 24 bits of a product of 32, perhaps one of their units off.
pub fn product(a: i32, b: i32) -> i64 {
    let [a, b] = [a, b].map(i64::from);
    let [la, lb] = [a & 255, b & 255];
    // All of it but what the lower bytes make.
    let rest = (a * b - la * lb) >> 8;
    rest + upper(la, lb)
}

/// The same of a square, exactly.
pub fn square(a: i32) -> i64 {
    (i64::from(a) * i64::from(a)) >> 8
}

/// 24 bits cut to what is wanted of a product that is `n` bits longer than its result.
fn cut(product: i64, n: i32) -> i32 {
    match n {
        17.. => held(right(product >> 8, (n - 16).unsigned_abs()), BITS),
        8.. => held(right(product, (n - 8).unsigned_abs()), BITS),
        _ => held(product << (8 - n).min(30), BITS),
    }
}

/// a b / 2^n.
pub fn multiply(a: i32, b: i32, n: i32) -> i32 {
    cut(product(a, b), n)
}

/// a a / 2^n.
pub fn squared(a: i32, n: i32) -> i32 {
    cut(square(a), n)
}

/// The whole product with points wherever they are.
pub fn any_product(a: i32, b: i32, n: i32) -> i32 {
    held(shifted(i64::from(a) * i64::from(b), -n, 62), BITS)
}

/// A table's lower and upper bytes, and what leads from each entry to the next.
fn bytes(entries: &[i32], which: usize) -> Vec<i32> {
    let of = |pair: &[i32]| match which {
        0 => pair[0] & 255,
        1 => pair[0] >> 8,
        _ => (pair[1] - pair[0]).abs(),
    };
    entries.windows(2).map(of).collect()
}

/// What lies so many 256ths behind an entry.
fn between(entries: &[i32], at: usize, part: i64) -> i64 {
    let (from, step) = (entries[at], i64::from(entries[at + 1] - entries[at]));
    i64::from(from) + upper(step.abs(), part) * step.signum()
}

/// 2^31 / b for b from 2^15 to 2^16, where b is 2^15 and 128 times 0 to 256; the first is
/// the greatest that fits.
fn reciprocals() -> &'static [i32] {
    static ALL: OnceLock<Vec<i32>> = OnceLock::new();
    ALL.get_or_init(|| {
        // What is taken away for what lies between two is cut, so they are a little too small.
        let of = |k: i32| 2f64.powi(31) / f64::from(32768 + 128 * k) - 0.4;
        (0..=256)
            .map(|k| (of(k).round() as i32).min(65535))
            .collect()
    })
}

/// The table's lower and upper bytes, and what leads from each entry to the next.
pub fn reciprocal_bytes(which: usize) -> Vec<i32> {
    bytes(reciprocals(), which)
}

/// 2^31 over a number from 2^15 to 2^16.
pub fn reciprocal(b: i64) -> i64 {
    between(reciprocals(), (b >> 7 & 255) as usize, (b & 127) * 2)
}

/// a / b * 2^n, off by less than 1.4; by 0 the greatest with the sign of a.
pub fn divide(a: i32, b: i32, n: i32) -> i32 {
    if a == 0 {
        return 0;
    }
    if b == 0 {
        return a.signum() * MOST as i32;
    }
    let (mut up, mut down, mut before) = (i64::from(a.abs()), i64::from(b.abs()), n);
    while down < 1 << 15 {
        (down, before) = (down * 2, before + 1);
    }
    while up < 1 << 14 {
        (up, before) = (up * 2, before - 1);
    }
    let less = reciprocal(down) - 65536;
    let product = product(up as i32, less as i32) + (up << 8);
    let made = match before - 15 {
        2.. => MOST,
        more @ 0.. => right(product << more, 8).min(MOST),
        fewer => right(product >> 8, fewer.unsigned_abs()),
    };
    if (a < 0) == (b < 0) {
        made as i32
    } else {
        -made as i32
    }
}

/// The first entry of the table of roots.
pub const FIRST_ROOT: i32 = 64;

/// sqrt(k / 256) * 2^15 for k from [`FIRST_ROOT`] to 256.
fn roots() -> &'static [i32] {
    static ROOTS: OnceLock<Vec<i32>> = OnceLock::new();
    ROOTS.get_or_init(|| {
        // What lies between two is cut, so they are a little too large.
        let root = |k: i32| (f64::from(k) / 256.0).sqrt() * 32768.0 + 0.3;
        let held = |k: i32| (root(k).round() as i32).min(MOST as i32);
        (FIRST_ROOT..=256).map(held).collect()
    })
}

/// The table's lower and upper bytes, and what leads from each entry to the next.
pub fn root_bytes(which: usize) -> Vec<i32> {
    bytes(roots(), which)
}

/// The root of a * 2^n, n from 1 to 15; 0 of a negative.
pub fn root(a: i32, n: i32) -> i32 {
    if a < 1 {
        return 0;
    }
    let odd = n & 1;
    let (mut a, mut halvings) = (i64::from(a) << odd, (14 + odd - n) / 2);
    while a < 1 << 14 {
        (a, halvings) = (a << 2, halvings + 1);
    }
    right(root_of_16(a), halvings.unsigned_abs()) as i32
}

/// 2^15 times the root of a number from 2^14 to 2^16, over 2^16.
fn root_of_16(a: i64) -> i64 {
    between(roots(), ((a >> 8) as i32 - FIRST_ROOT) as usize, a & 255)
}

/// The root of an int with so many fraction bits; 0 of a negative. Of the int its upper 16
/// bits from the first pair on are looked at that is not 0.
pub fn int_root(a: i32, frac: i32) -> i32 {
    if a < 1 {
        return 0;
    }
    let pairs = a.leading_zeros() / 2;
    let upper = i64::from(a) << (2 * pairs) >> 16;
    match pairs as i32 - 1 - frac {
        ..0 => MOST as i32,
        halvings => right(root_of_16(upper), halvings.unsigned_abs()) as i32,
    }
}

/// 2^14 / sqrt(k / 256) for k from [`FIRST_ROOT`] to 256.
fn reciprocal_roots() -> &'static [i32] {
    static ALL: OnceLock<Vec<i32>> = OnceLock::new();
    ALL.get_or_init(|| {
        // What is taken away for what lies between two is cut, so they are a little too small.
        let of = |k: i32| 16384.0 / (f64::from(k) / 256.0).sqrt() - 0.2;
        (FIRST_ROOT..=256).map(|k| of(k).round() as i32).collect()
    })
}

/// The table's lower and upper bytes, and what leads from each entry to the next.
pub fn reciprocal_root_bytes(which: usize) -> Vec<i32> {
    bytes(reciprocal_roots(), which)
}

/// The root of 2^n over that of a, off by less than 1.65; the greatest of what is not above 0.
pub fn reciprocal_root(a: i32, n: i32) -> i32 {
    if a < 1 {
        return MOST as i32;
    }
    let odd = n & 1;
    let (mut a, mut halvings) = (i64::from(a) << odd, 22 - (n + odd) / 2);
    while a < 1 << 14 {
        (a, halvings) = (a << 2, halvings - 1);
    }
    let at = ((a >> 8) as i32 - FIRST_ROOT) as usize;
    let found = between(reciprocal_roots(), at, a & 255);
    match halvings {
        ..0 => MOST as i32,
        16.. => 0,
        _ => right(found, halvings.unsigned_abs()).min(MOST) as i32,
    }
}

/// A real of some scale in 16.16.
fn in_16_16(a: i32, scale: i8) -> i32 {
    let by = 16 - i32::from(scale);
    let made = match by {
        0.. => i64::from(a) << by,
        _ => right(i64::from(a), by.unsigned_abs()),
    };
    made.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
}

/// 16.16 at some scale in so many bits.
fn from_16_16(a: i32, scale: i8, bits: u8) -> i32 {
    shifted(i64::from(a), i32::from(scale) - 16, bits) as i32
}

/// A function of 16.16 whose operand and result have points of their own.
pub fn function(of: fn(i32) -> i32, a: i32, scales: [i8; 2], bits: u8) -> i32 {
    from_16_16(of(in_16_16(a, scales[0])), scales[1], bits)
}

/// The angle of a point at a scale; its coordinates' does not matter, so it is one at which
/// both fit.
pub fn arctangent2(y: i32, x: i32, result: i8, bits: u8) -> i32 {
    let legs = if bits > 16 { 9 } else { 4 };
    from_16_16(
        wide::arctangent2(in_16_16(y, legs), in_16_16(x, legs)),
        result,
        bits,
    )
}

/// A power.
pub fn power(a: i32, b: i32, scales: Scales, bits: u8) -> i32 {
    let [x, y] = [(a, scales.args[0]), (b, scales.args[1])].map(|(v, s)| in_16_16(v, s));
    from_16_16(wide::power(x, y), scales.result, bits)
}
