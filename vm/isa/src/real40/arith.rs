//! `+ - * /` and `SQR`, bit for bit as BASIC II does them.
//!
//! Each works on 40 bits, the mantissa's 32 and 8 guard bits below them, normalises, and
//! rounds once ([`round`]). Which operand is scanned and which is shifted matters in the
//! product, because its partial products are truncated: BASIC evaluates the left operand
//! first and pushes it, so the *right* operand is in the accumulator whose bits are scanned.

use super::{Real40, RealError};

/// Puts sign, biased exponent and mantissa (top bit set) together: zero below the range, an
/// error above it.
#[inline]
pub(crate) fn pack(negative: bool, exp: i32, mantissa: u32) -> Result<Real40, RealError> {
    if exp > 255 {
        Err(RealError::TooBig)
    } else if exp <= 0 {
        Ok(Real40::ZERO)
    } else {
        Ok(Real40::from_parts(negative, exp as u8, mantissa))
    }
}

/// Rounds a normalised 40-bit accumulator to 32: up above &80 in the guard byte, down below
/// it, and at &80 exactly the last bit is set (neither half-up nor half-even).
#[inline]
pub(super) fn round(negative: bool, exp: i32, wide: u64) -> Result<Real40, RealError> {
    let high = (wide >> 8) as u32;
    match (wide & 0xff).cmp(&0x80) {
        std::cmp::Ordering::Less => pack(negative, exp, high),
        std::cmp::Ordering::Equal => pack(negative, exp, high | 1),
        std::cmp::Ordering::Greater => match high.checked_add(1) {
            Some(up) => pack(negative, exp, up),
            None => pack(negative, exp + 1, 0x8000_0000),
        },
    }
}

/// Shifts the top set bit up to bit 39, then rounds.
#[inline]
fn normalise(negative: bool, exp: i32, wide: u64) -> Result<Real40, RealError> {
    if wide == 0 {
        return Ok(Real40::ZERO);
    }
    let shift = wide.leading_zeros() as i32 - 24;
    round(negative, exp - shift, wide << shift)
}

/// a + b: the smaller is shifted right, truncating, into the guard bits.
#[inline]
pub fn add(a: Real40, b: Real40) -> Result<Real40, RealError> {
    let (big, small) = if a.abs() >= b.abs() { (a, b) } else { (b, a) };
    if small.is_zero() {
        return Ok(big);
    }
    let exp = i32::from(big.exponent());
    let gap = u32::from(big.exponent() - small.exponent());
    let wide = u64::from(big.mantissa()) << 8;
    let moved = (u64::from(small.mantissa()) << 8)
        .checked_shr(gap)
        .unwrap_or(0);
    let negative = big.is_negative();
    if negative == small.is_negative() {
        let sum = wide + moved;
        if sum >> 40 != 0 {
            round(negative, exp + 1, sum >> 1)
        } else {
            round(negative, exp, sum)
        }
    } else {
        normalise(negative, exp, wide - moved)
    }
}

/// a - b.
#[inline]
pub fn sub(a: Real40, b: Real40) -> Result<Real40, RealError> {
    add(a, b.negate())
}

/// For four bits `n` of the scanned mantissa and the low four bits `lo` of the shifted one:
/// the sum of `lo >> s` over the set bits (s = 1 for the top one).
const PARTIAL: [u8; 256] = partial_table();

const fn partial_table() -> [u8; 256] {
    let mut table = [0; 256];
    let mut i = 0;
    while i < 256 {
        let (n, lo) = (i >> 4, i & 15);
        let mut s = 1;
        while s <= 4 {
            if n >> (4 - s) & 1 == 1 {
                table[i] += (lo >> s) as u8;
            }
            s += 1;
        }
        i += 1;
    }
    table
}

/// a x b. The ROM halves W = a's mantissa (40 bits) once for each bit of b's, from the top,
/// and adds W where the bit is set: every partial product is truncated to 40 bits.
///
/// Here four bits of b go at once: with W = 16 hi + lo, the four truncated halves weighted by
/// the bits are hi x bits + PARTIAL[bits, lo]. The first eight bits lose nothing, since the
/// low eight bits of W are zero.
#[inline]
pub fn mul(a: Real40, b: Real40) -> Result<Real40, RealError> {
    if a.is_zero() || b.is_zero() {
        return Ok(Real40::ZERO);
    }
    let scanned = b.mantissa();
    let shifted = u64::from(a.mantissa());
    let mut wide = shifted * u64::from(scanned >> 24);
    let mut w = shifted;
    let mut bits = scanned << 8;
    while bits != 0 {
        let nibble = (bits >> 28) as usize;
        let lo = (w & 15) as usize;
        w >>= 4;
        wide += w * nibble as u64 + u64::from(PARTIAL[(nibble << 4 | lo) & 255]);
        bits <<= 4;
    }
    let exp = i32::from(a.exponent()) + i32::from(b.exponent()) - 128;
    normalise(a.is_negative() != b.is_negative(), exp, wide)
}

/// a / b: a quotient of one whole bit and 38 more (so 7 guard bits), truncated, normalised,
/// rounded.
#[inline]
pub fn div(a: Real40, b: Real40) -> Result<Real40, RealError> {
    if b.is_zero() {
        return Err(RealError::DivisionByZero);
    }
    if a.is_zero() {
        return Ok(Real40::ZERO);
    }
    let top = u64::from(a.mantissa()) << 31;
    let below = u64::from(b.mantissa());
    let quotient = ((top / below) << 7) | (((top % below) << 7) / below);
    let exp = i32::from(a.exponent()) - i32::from(b.exponent()) + 129;
    normalise(a.is_negative() != b.is_negative(), exp, quotient << 1)
}

/// `SQR`: five Newton steps x = (a / x + x) / 2 from a seed with the same mantissa and half the
/// exponent. Up to 0.75 of a unit in the last place.
pub fn sqrt(a: Real40) -> Result<Real40, RealError> {
    if a.is_zero() {
        return Ok(Real40::ZERO);
    }
    if a.is_negative() {
        return Err(RealError::NegativeRoot);
    }
    let e = a.exponent();
    let mut x = Real40::from_parts(false, (e >> 1) + 0x40 + (e & 1), a.mantissa());
    for _ in 0..5 {
        let sum = add(div(a, x)?, x)?;
        x = pack(false, i32::from(sum.exponent()) - 1, sum.mantissa())?;
    }
    Ok(x)
}
