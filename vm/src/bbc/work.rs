//! What BASIC II's work on values costs, in cycles of 2 MHz: the part of a statement's cost that
//! only shows when it runs.
//!
//! Each formula was found by giving the genuine ROM many operands and counting, with interrupts
//! off, what the statement took: the loops in the ROM's arithmetic show as straight lines in the
//! number of bits, of set bits, of places shifted. `cost` has the parts that the text decides.

use slowlight_isa::real40::Real40;

/// An integer made a real: shifted up until its top bit is set, by bytes, then by bits.
#[inline]
pub(crate) fn int_to_real(n: i32) -> u32 {
    if n == 0 {
        return 103;
    }
    let zeros = n.unsigned_abs().leading_zeros();
    103 + 51 * u32::from(n < 0) + 44 * (zeros / 8) + 38 * (zeros % 8)
}

/// A real made an integer: shifted down, by bytes, then by bits.
#[inline]
pub(crate) fn real_to_int(x: Real40) -> u32 {
    let Some(places) = x.exponent().checked_sub(128) else {
        return 131;
    };
    let (bytes, bits) = (u32::from(places) / 8, u32::from(places) % 8);
    798u32.saturating_sub(66 * bytes + 60 * bits) + 33 * u32::from(x.is_negative())
}

/// INT of a real.
#[inline]
pub(crate) fn floor(x: Real40) -> u32 {
    if x.is_zero() {
        return 142;
    }
    94 + real_to_int(x) + 90 * u32::from(x.is_negative())
}

/// a + b = sum: aligning the smaller, then shifting what cancelled back up.
#[inline]
pub(crate) fn add(a: Real40, b: Real40, sum: Real40) -> u32 {
    if a.is_zero() || b.is_zero() {
        return if b.is_zero() { 330 } else { 200 };
    }
    let (ea, eb) = (u32::from(a.exponent()), u32::from(b.exponent()));
    let gap = ea.abs_diff(eb);
    let aligning = match gap {
        0 => 0,
        // Nothing of the smaller is left.
        40.. => 60,
        _ => 35 + 37 * (gap / 8) + 30 * (gap % 8),
    };
    let top = ea.max(eb);
    let shifting = match u32::from(sum.exponent()) {
        0 => 60,
        e if e > top => 29,
        e => 47 * ((top - e) % 8) + 40 * ((top - e) / 8),
    };
    380 + aligning + shifting
}

/// An operation whose left side alone is an integer: it is made a real with the other set aside.
pub(crate) const LEFT_INT: u64 = 170;

/// How much more a - b is than the sum with the sign changed.
pub(crate) const SUBTRACT: u32 = 67;

/// a x b = product: an addition for each set bit of b.
#[inline]
pub(crate) fn mul(a: Real40, b: Real40, product: Real40) -> u32 {
    if a.is_zero() || b.is_zero() {
        return if a.is_zero() { 336 } else { 216 };
    }
    let exact = i32::from(a.exponent()) + i32::from(b.exponent()) - 128;
    let up = i32::from(product.exponent()) < exact;
    2_130 + 58 * b.mantissa().count_ones() + 63 * u32::from(up)
}

/// a / b = quotient: a subtraction for each set bit of the quotient.
#[inline]
pub(crate) fn div(a: Real40, quotient: Real40) -> u32 {
    if a.is_zero() {
        return 317;
    }
    // The guard bits, which are not seen, are about half set.
    2_700 + 31 * (quotient.mantissa().count_ones() + 3)
}

/// A product of integers: `None` where BASIC II makes both reals first.
#[inline]
pub(crate) fn int_mul(a: i32, b: i32) -> Option<u32> {
    const SMALL: u32 = 1 << 15;
    if a.unsigned_abs() >= SMALL || b.unsigned_abs() >= SMALL {
        return None;
    }
    let b = b.unsigned_abs();
    Some(307 + 42 * (32 - b.leading_zeros()) + 33 * b.count_ones())
}

/// DIV and MOD: a turn for each bit of the dividend, a subtraction for each of the quotient.
#[inline]
pub(crate) fn int_div(a: i32, b: i32) -> u32 {
    let quotient = a.unsigned_abs().checked_div(b.unsigned_abs()).unwrap_or(0);
    1_215 + 62 * (32 - a.unsigned_abs().leading_zeros()) + 14 * quotient.count_ones()
}

/// x ^ y: a multiplication for each turn of a small whole power, else by way of LN and EXP.
pub(crate) fn pow(y: Real40) -> u32 {
    match y.to_i32() {
        Ok(n) if Real40::from_i32(n) == y && n.abs() < 64 => {
            200 + 3_000 * n.unsigned_abs() + if n < 0 { 3_480 } else { 0 }
        }
        _ => 89_000,
    }
}

/// SIN (`ahead` 0) and COS (1), more than near 0: angles of 1 and more are reduced to an eighth
/// of a turn either way, and an odd number of quarter turns takes a square root.
pub(crate) fn quarter_turns(x: Real40, ahead: u64) -> u32 {
    let reduced = x.exponent() > 128;
    let quarters = if reduced {
        (x.to_f64().abs() * std::f64::consts::FRAC_2_PI).round() as u64
    } else {
        0
    };
    let root = !(quarters + ahead).is_multiple_of(2);
    5_300 * u32::from(reduced) + 21_000 * u32::from(root)
}

/// TAN and ATN of 1 and more, beyond those of less.
pub(crate) fn beyond_one(x: Real40, more: u32) -> u32 {
    if x.exponent() > 128 { more } else { 0 }
}

/// EXP: the whole part of the power is a power of e.
pub(crate) fn exp(x: Real40) -> u32 {
    let size = x.to_f64().abs();
    match size {
        0.0..0.5 => 0,
        _ => 3_900 + 3_400 * (size.min(99.0) as u32),
    }
}

/// LN, and what it takes to bring a number between 1 and 2.
pub(crate) fn ln(x: Real40) -> u32 {
    if x.exponent() == 129 { 0 } else { 2_300 }
}

/// A number turned into decimal text.
pub(crate) fn number_text(x: Real40) -> u32 {
    // Three digits take ten bits.
    let bits = u32::from(x.exponent().saturating_sub(128));
    9_800 + 740 * (bits * 3 / 10)
}

/// Strings: what each character costs.
pub(crate) mod text {
    /// Put into a variable.
    pub const STORED: u64 = 24;
    /// Taken from a variable or from memory, or pushed on the stack.
    pub const READ: u64 = 14;
    /// Pushed on the stack and pulled, as the parts of a string are taken.
    pub const PART: u64 = 32;
    /// Pushed, to be searched.
    pub const HAY: u64 = 19;
    /// Appended.
    pub const JOINED: u64 = 13;
    /// Written by STRING$.
    pub const REPEATED: u64 = 23;
    /// Compared, while they are equal.
    pub const EQUAL: u64 = 20;
    /// Passed by INSTR.
    pub const SEARCHED: u64 = 41;
}

/// A character drawn in MODE 7, more than a control code.
pub(crate) const CHARACTER: u64 = 170;
/// A new line, more than two control codes.
pub(crate) const NEW_LINE: u64 = 740;
