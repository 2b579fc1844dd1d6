//! What the routines compute, bit for bit, on the raw bits of their operands.

mod functions;
pub use functions::*;

use slowlight_routine::Bits;

/// The 32 bits that a value's [`Bits`] hold.
pub fn int(bits: Bits) -> i32 {
    bits as u32 as i32
}

/// A value's [`Bits`]: sign-extended.
pub fn bits(value: i32) -> Bits {
    i64::from(value) as u64
}

/// `magnitude` with a sign, saturating.
fn signed(magnitude: u64, negative: bool) -> i32 {
    let magnitude = i64::try_from(magnitude).unwrap_or(i64::MAX);
    let value = if negative { -magnitude } else { magnitude };
    value.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
}

fn unlike(a: i32, b: i32) -> bool {
    (a < 0) != (b < 0)
}

/// Product in 16.16, to the nearest, halves away from zero; saturates.
pub fn fixed_multiply(a: i32, b: i32) -> i32 {
    let product = u64::from(a.unsigned_abs()) * u64::from(b.unsigned_abs());
    signed((product + 0x8000) >> 16, unlike(a, b))
}

/// Quotient in 16.16, to the nearest, halves away from zero; saturates; 0/0 is 0.
pub fn fixed_divide(a: i32, b: i32) -> i32 {
    if b == 0 {
        return by_zero(a);
    }
    let (dividend, divisor) = (
        u64::from(a.unsigned_abs()) << 16,
        u64::from(b.unsigned_abs()),
    );
    signed((2 * dividend + divisor) / (2 * divisor), unlike(a, b))
}

/// x/0.
fn by_zero(a: i32) -> i32 {
    match a {
        0 => 0,
        1.. => i32::MAX,
        _ => i32::MIN,
    }
}

/// Square root in 16.16, to the nearest; 0 for a negative.
pub fn root(a: i32) -> i32 {
    let square = u64::from(a.max(0).unsigned_abs()) << 16;
    let floor = square.isqrt();
    signed(floor + u64::from(square - floor * floor > floor), false)
}

/// Floored quotient of ints; saturates; 0/0 is 0.
pub fn int_divide(a: i32, b: i32) -> i32 {
    if b == 0 {
        return by_zero(a);
    }
    let (a, b) = (i64::from(a), i64::from(b));
    let floor = a.div_euclid(b) - i64::from(b < 0 && a.rem_euclid(b) != 0);
    floor.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
}

/// `a - b floor(a / b)`, ints or fixed point; 0 where b is 0.
pub fn modulo(a: i32, b: i32) -> i32 {
    if b == 0 {
        return 0;
    }
    let (a, b) = (i64::from(a), i64::from(b));
    let rest = a.rem_euclid(b.abs());
    (if b < 0 && rest != 0 { rest + b } else { rest }) as i32
}

/// 16.16 to the nearest int, halves away from zero.
pub fn fixed_round(a: i32) -> i32 {
    let half = if a < 0 { 0x7FFF } else { 0x8000 };
    ((i64::from(a) + half) >> 16) as i32
}

/// An int as 16.16; saturates.
pub fn fixed_from_int(a: i32) -> i32 {
    (i64::from(a) << 16).clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
}

/// `a / 2^k`, to the nearest, halves upwards.
pub fn shift_round(a: i32, k: u32) -> i32 {
    ((i64::from(a) + (1 << k >> 1)) >> k) as i32
}
