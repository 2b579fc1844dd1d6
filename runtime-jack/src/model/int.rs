//! 16-bit ints, bit for bit as the Jack source computes them: they saturate,
//! where the machine's own arithmetic wraps.

use slowlight_routine::Bits;

/// The greatest int; the least is its negative, save for what `&` may make.
pub const MOST: i32 = 32767;

/// An int's bits: sign-extended.
pub fn int_bits(i: i32) -> Bits {
    Bits::from(i as u32) | if i < 0 { !0 << 32 } else { 0 }
}

/// The int that bits stand for: the low 16, as the machine holds it.
pub fn int(bits: Bits) -> i32 {
    i32::from(bits as u16 as i16)
}

/// What the machine makes of a result that has no end of its own.
pub fn wrap(i: i32) -> i32 {
    i32::from(i as i16)
}

/// Saturating; a sum with one negative operand is exact.
pub fn sum(a: i32, b: i32) -> i32 {
    if (a < 0) == (b < 0) {
        saturate(a + b)
    } else {
        a + b
    }
}

/// Saturating; a difference of two alike in sign is exact.
pub fn difference(a: i32, b: i32) -> i32 {
    if (a < 0) == (b < 0) {
        a - b
    } else {
        saturate(a - b)
    }
}

/// Kept within [`MOST`].
pub fn saturate(i: i32) -> i32 {
    i.clamp(-MOST, MOST)
}

/// The magnitude; -32768 counts as -32767.
pub fn magnitude(i: i32) -> i32 {
    i.abs().min(MOST)
}

/// Floors; by 0: the greatest with the dividend's sign, 0/0 is 0.
pub fn divide(a: i32, b: i32) -> i32 {
    if b == 0 {
        return a.signum() * MOST;
    }
    let (n, d) = (magnitude(a), magnitude(b));
    if (a < 0) == (b < 0) {
        n / d
    } else {
        -(n / d + i32::from(n % d != 0))
    }
}

/// With the divisor's sign; 0 where the divisor is 0.
pub fn modulo(a: i32, b: i32) -> i32 {
    let (n, d) = (magnitude(a), magnitude(b));
    let rest = if d == 0 { 0 } else { n % d };
    let rest = if rest == 0 || (a < 0) == (b < 0) {
        rest
    } else {
        d - rest
    };
    if b < 0 { -rest } else { rest }
}

/// Saturating.
pub fn multiply(a: i32, b: i32) -> i32 {
    saturate(magnitude(a) * magnitude(b) * a.signum() * b.signum())
}
