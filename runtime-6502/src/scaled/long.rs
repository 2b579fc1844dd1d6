//! What the routines of 24 bits compute, bit for bit, where they are not those of 16 with
//! another width. Operands are from -8388607 to 8388607.
//!
//! Roots and reciprocals are made alike: looked up by the upper eight bits, in proportion
//! between two entries, and then made better by what is wrong with that, which is seen in
//! two bytes from the middle of a product: its square, and its product with the divisor.

use super::model::{held, right, shifted, upper};
use slowlight_routine::scale::most;
use std::sync::OnceLock;

/// Bits of a real.
pub const BITS: u8 = 24;

/// The greatest.
const MOST: i64 = most(BITS);

/// All 24 bits.
const ALL: i64 = (1 << 24) - 1;

/// A number's byte.
fn byte(n: i64, k: u32) -> i64 {
    n >> (8 * k) & 255
}

/// The upper 32 bits of a product of 48, perhaps three of their units off.
fn product(a: i32, b: i32) -> i64 {
    let [a, b] = [a, b].map(i64::from);
    let [a0, a1, b0, b1] = [byte(a, 0), byte(a, 1), byte(b, 0), byte(b, 1)];
    let rest = (a * b - a0 * b0 - ((a0 * b1 + a1 * b0) << 8)) >> 16;
    rest + upper(a0, b1) + upper(a1, b0)
}

/// a b / 2^n for n from 20 to 47.
pub fn multiply(a: i32, b: i32, n: i32) -> i32 {
    let product = product(a, b);
    let made = match n {
        25.. => right(product >> 8, (n - 24).unsigned_abs()),
        _ => right(product, (n - 16).unsigned_abs()),
    };
    held(made, BITS)
}

/// The whole product with points wherever they are.
pub fn any_product(a: i32, b: i32, n: i32) -> i32 {
    let product = i64::from(a) * i64::from(b);
    match n {
        1.. => held(right(product, n.unsigned_abs()), BITS),
        _ => held(shifted(i64::from(held(product, BITS)), -n, BITS), BITS),
    }
}

/// A table's entries at `from` and behind, and what leads from each to the next.
struct Table {
    from: usize,
    entries: Vec<i64>,
}

impl Table {
    /// Of an entry's three bytes, and the two of its step, one of all but the last.
    fn bytes(&self, which: u32) -> Vec<i32> {
        let of = |pair: &[i64]| match which {
            0..3 => byte(pair[0], which) as i32,
            _ => byte((pair[1] - pair[0]).abs(), which - 3) as i32,
        };
        self.entries.windows(2).map(of).collect()
    }

    /// What lies so many 65536ths behind an entry.
    fn between(&self, at: usize, part: i64) -> i64 {
        let pair = &self.entries[at - self.from..];
        let step = (pair[1] - pair[0]).abs();
        let (s0, s1, p0, p1) = (byte(step, 0), byte(step, 1), byte(part, 0), byte(part, 1));
        let more = s1 * p1 + upper(s0, p1) + upper(s1, p0);
        pair[0] + more * (pair[1] - pair[0]).signum()
    }
}

/// Bits 16 to 31 of a product of two numbers without a sign, but for what is carried from
/// below; of 16 bits, with a sign.
fn middle(a: i64, b: i64) -> i64 {
    let [a0, a1, a2] = [0, 1, 2].map(|k| byte(a, k));
    let [b0, b1, b2] = [0, 1, 2].map(|k| byte(b, k));
    let lower = a0 * b2 + a1 * b1 + a2 * b0 + upper(a0, b1) + upper(a1, b0);
    lower + ((a1 * b2 + a2 * b1) << 8)
}

/// A number better by `by` and a byte over 65536.
fn corrected(value: i64, by: i64, factor: i64) -> i64 {
    let by = i64::from(by as i16);
    let size = by.abs();
    let more = right(factor * (size >> 8) + upper(factor, size & 255), 8);
    (value + more * by.signum()).min(ALL)
}

/// 2^47 / b for b that are 2^23 and 2^15 times 0 to 256.
fn reciprocals() -> &'static Table {
    static TABLE: OnceLock<Table> = OnceLock::new();
    TABLE.get_or_init(|| {
        let of = |k: i32| 2f64.powi(47) / f64::from((1 << 23) + (k << 15));
        Table {
            from: 0,
            entries: (0..=256).map(|k| (of(k).round() as i64).min(ALL)).collect(),
        }
    })
}

/// The bytes of the table of reciprocals, and those of its steps.
pub fn reciprocal_bytes(which: u32) -> Vec<i32> {
    reciprocals().bytes(which)
}

/// 2^47 over a number from 2^23 to 2^24.
pub fn reciprocal(b: i64) -> i64 {
    let first = reciprocals().between((b >> 15 & 255) as usize, b << 1 & 0xFFFF);
    corrected(first, -2 * middle(first, b), first >> 16)
}

/// A magnitude shifted to bit 23, and by how many bits.
fn up(b: i32) -> (i64, i32) {
    let by = (i64::from(b.unsigned_abs()) << 40).leading_zeros() as i32;
    (i64::from(b.unsigned_abs()) << by, by)
}

/// So many bits to the right, without a sign, and then with it.
fn quotient(made: i64, negative: bool) -> i32 {
    let made = made.min(MOST) as i32;
    if negative { -made } else { made }
}

/// a / b * 2^n where a is a power of two; by 0 the greatest.
pub fn one_over(a: i32, b: i32, n: i32) -> i32 {
    if b == 0 {
        return MOST as i32;
    }
    let (down, by) = up(b);
    let made = match 47 - a.trailing_zeros() as i32 - n - by {
        ..=0 => MOST,
        fewer => right(reciprocal(down), fewer.unsigned_abs()),
    };
    quotient(made, b < 0)
}

/// a / b * 2^n; by 0 the greatest with the sign of a.
pub fn divide(a: i32, b: i32, n: i32) -> i32 {
    if a == 0 {
        return 0;
    }
    if b == 0 {
        return a.signum() * MOST as i32;
    }
    let ((down, by), (over, less)) = (up(b), up(a));
    let over = over >> 1;
    // As the product has it, of 2^24 less.
    let product = product((reciprocal(down) - ALL - 1) as i32, over as i32) + (over << 8);
    let made = match n + by - (less - 1) - 23 {
        2.. => MOST,
        more @ 0.. => right(product << more, 8),
        fewer => right(product >> 8, fewer.unsigned_abs()),
    };
    quotient(made, (a < 0) != (b < 0))
}

/// The first entry of the table of roots.
const FIRST_ROOT: usize = 64;

/// sqrt(k / 256) * 2^24 for k from [`FIRST_ROOT`] to 256.
fn roots() -> &'static Table {
    static TABLE: OnceLock<Table> = OnceLock::new();
    TABLE.get_or_init(|| {
        let root = |k: usize| (k as f64 / 256.0).sqrt() * 2f64.powi(24);
        Table {
            from: FIRST_ROOT,
            entries: (FIRST_ROOT..=256)
                .map(|k| (root(k).round() as i64).min(ALL))
                .collect(),
        }
    })
}

/// The bytes of the table of roots, and those of its steps.
pub fn root_bytes(which: u32) -> Vec<i32> {
    roots().bytes(which)
}

/// 256 over the root of a number from 1/4 to 1, halved, by its upper byte.
fn inverse(k: usize) -> i64 {
    (128.0 / ((k as f64 + 0.5) / 256.0).sqrt()).round() as i64
}

/// The table of those.
pub fn inverse_bytes() -> Vec<i32> {
    (FIRST_ROOT..256).map(|k| inverse(k) as i32).collect()
}

/// The root of a * 2^n, n from 1 to 23; 0 of a negative.
pub fn root(a: i32, n: i32) -> i32 {
    if a < 1 {
        return 0;
    }
    let odd = n & 1;
    let (mut a, mut halvings) = (i64::from(a) << odd, (24 + odd - n) / 2);
    while a < 1 << 22 {
        (a, halvings) = (a << 2, halvings + 1);
    }
    let at = (a >> 16) as usize;
    let first = roots().between(at, a & 0xFFFF);
    let less = ((a & 255) << 8) - middle(first, first);
    let made = corrected(first, less, inverse(at));
    right(made, halvings.unsigned_abs()).min(MOST) as i32
}
