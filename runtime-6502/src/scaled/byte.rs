//! What routines compute whose results have 8 bits, bit for bit, and their tables.

use super::model::{held, right, shifted, upper};
use std::sync::OnceLock;

/// Bits of such a real.
pub const BITS: u8 = 8;

/// a b / 2^n: the product's upper byte has less to be shifted.
pub fn multiply(a: i32, b: i32, n: i32) -> i32 {
    let product = i64::from(a) * i64::from(b);
    match n {
        9..=15 => held(right(product >> 8, n.unsigned_abs() - 8), BITS),
        _ => held(shifted(product, -n, 62), BITS),
    }
}

/// The greatest whole number whose square is not above a number of 16 bits.
pub fn whole_root(a: i32) -> i32 {
    (a.max(0) as u32).isqrt() as i32
}

/// The root of half of a number of 16 bits; 0 of a negative.
pub fn root(a: i32) -> i32 {
    held(right(i64::from(whole_root(2 * a)), 1), BITS)
}

/// The root of an int with so many fraction bits.
pub fn int_root(a: i32, frac: i32) -> i32 {
    held(
        right(i64::from(super::model::int_root(a, frac + 8)), 8),
        BITS,
    )
}

/// The root of 2^n over that of a number of 16 bits; the greatest of what is not above 0.
pub fn reciprocal_root(a: i32, n: i32) -> i32 {
    let long = super::model::reciprocal_root(a, n + 16);
    held(right(i64::from(long), 8), BITS)
}

/// The upper byte of the first number whose root is looked up by it.
const FIRST_ROOT: i32 = 64;

/// Of each upper byte, what a root is less 1 or as it is, and from which lower byte on it is one
/// more: squares from 2^14 on are further apart than 256.
pub fn root_bytes(which: usize) -> Vec<i32> {
    let of = |upper: i32| {
        let first = whole_root(upper << 8);
        let next = (first + 1) * (first + 1) - (upper << 8);
        match next {
            0..256 => [first, next],
            // Always: there is no lower byte from which never.
            _ => [first - 1, 0],
        }
    };
    (FIRST_ROOT..256)
        .map(|upper| of(upper)[which.min(1)])
        .collect()
}

/// 2^16 over the middle of numbers of nine bits, of whose last eight each has an entry.
pub fn inverses() -> &'static [i32] {
    static ALL: OnceLock<Vec<i32>> = OnceLock::new();
    ALL.get_or_init(|| {
        let of = |k: i32| (65536.0 / (256.5 + f64::from(k))).round() as i32;
        (0..256).map(|k| of(k).min(255)).collect()
    })
}

/// a / b * 2^n of numbers of 16 bits, off by less than 1.5; by 0 the greatest with the sign of a.
pub fn divide(a: i32, b: i32, n: i32) -> i32 {
    let most = held(i64::MAX, BITS);
    if a == 0 {
        return 0;
    }
    if b == 0 {
        return a.signum() * most;
    }
    let (mut up, mut down, mut before) = (i64::from(a.abs()), i64::from(b.abs()), n);
    while down < 1 << 15 {
        (down, before) = (down * 2, before + 1);
    }
    while up < 1 << 15 {
        (up, before) = (up * 2, before - 1);
    }
    let inverse = i64::from(inverses()[(down >> 7 & 255) as usize]);
    let product = (up >> 8) * inverse + upper(inverse, up & 255);
    let made = match before - 7 {
        1.. => i64::from(most),
        0 => right(product, 8),
        less => right(product >> 8, less.unsigned_abs()),
    };
    let made = held(made, BITS);
    if (a < 0) == (b < 0) { made } else { -made }
}
