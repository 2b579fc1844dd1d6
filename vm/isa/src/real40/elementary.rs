//! `SIN COS TAN ATN ASN ACS EXP LN LOG` and `^`, as BASIC II makes them.
//!
//! Each is a continued fraction of few constants ([`fraction`]) with the ROM's own rounding at
//! every step, after the argument is brought near zero. The forms and the constants were found
//! from results observed on the genuine ROM (some 130,000 of them), not from its code: of which
//! function, interval and error each fraction is the best one (the doc comments say), then the
//! last bits by trying which constants give the most results bit for bit. The innermost
//! constants hardly show in the results, so they need not be the ROM's; `curves_are_the_roms`
//! counts what is left.

use super::{Real40, RealError, arith};

/// A real from its 40 bits.
const fn bits(b: u64) -> Real40 {
    Real40::from_bits(b)
}

const HALF: Real40 = bits(0x80_0000_0000);
/// pi / 2, rounded.
const QUARTER: Real40 = bits(0x81_490f_daa2);
/// pi / 4, rounded.
const EIGHTH: Real40 = bits(0x80_490f_daa2);
/// pi / 2 in two parts: 3217 / 2048, short enough for exact products, and the rest (which the
/// ROM has 7.2e-15 too low; seen in sines of large angles).
const QUARTER_PARTS: [Real40; 2] = [bits(0x81_4910_0000), bits(0x6f_9577_7a61)];
/// e, truncated (rounded it would end in 59; the powers of e show it).
const E: Real40 = bits(0x82_2df8_5458);
/// The natural logarithm of 2, rounded.
const LN_2: Real40 = bits(0x80_3172_17f8);

/// From 89.5 on `EXP` is an error, from -89.5 down it is 0.
const EXP_LIMIT: Real40 = bits(0x87_3300_0000);
/// The first byte of the square root of a half: a mantissa below that is doubled before its
/// logarithm is taken.
const ROOT_HALF: u32 = 0xb500_0000;
/// Below 2^-14 the arc tangent is its argument.
const ATN_SMALL: u8 = 0x73;

/// SIN(x) / x in x^2, up to an eighth of a turn.
const SIN: [Real40; 6] = [
    bits(0x81_0000_0000),
    bits(0x83_c000_0005),
    bits(0x82_d555_5776),
    bits(0x84_3745_5c73),
    bits(0x84_1ac5_5134),
    bits(0x84_894b_f7bc),
];

/// ATN(x) / x in x - 1/2, for x from 0 to 1: least absolute error.
const ATN: [Real40; 10] = [
    bits(0x80_6d63_382c),
    bits(0x82_fb62_572f),
    bits(0x7f_7dad_90a1),
    bits(0x81_0ac7_6c52),
    bits(0x81_9596_06de),
    bits(0x84_8cbb_ca65),
    bits(0x80_ca9a_0e30),
    bits(0x80_57bb_77fd),
    bits(0x80_1c9d_06e9),
    bits(0x85_a359_dc68),
];

/// EXP(x) in x, for x from -1/2 to 1/2: least relative error.
const EXP: [Real40; 8] = [
    bits(0x81_0000_0000),
    bits(0x81_0000_0000),
    bits(0x82_8000_000c),
    bits(0x82_c000_0002),
    bits(0x82_0000_2163),
    bits(0x83_2000_06a2),
    bits(0x82_8053_93b9),
    bits(0x83_e020_87fa),
];

/// (LN(1 + z) - z) / z^2 in z, for 1 + z from SQR(1/2) to SQR(2): least absolute error.
const LN: [Real40; 7] = [
    bits(0x7f_ffff_ffff),
    bits(0x82_3fff_ffc1),
    bits(0x7f_638e_37ec),
    bits(0x86_3401_a2ae),
    bits(0x7c_2aac_41d2),
    bits(0x88_790e_6510),
    bits(0x7a_1237_1593),
];

/// c0 + t / (c1 + t / (c2 + ...)), from the innermost outwards.
fn fraction(constants: &[Real40], t: Real40) -> Result<Real40, RealError> {
    let mut inner = constants.iter().rev().copied();
    let last = inner.next().unwrap_or(Real40::ZERO);
    inner.try_fold(last, |r, c| arith::add(c, arith::div(t, r)?))
}

/// x multiplied n times, starting from 1; for n < 0 what is multiplied is 1 / x.
fn whole_power(x: Real40, n: i32) -> Result<Real40, RealError> {
    let factor = if n < 0 {
        arith::div(Real40::ONE, x)?
    } else {
        x
    };
    (0..n.abs()).try_fold(Real40::ONE, |power, _| arith::mul(power, factor))
}

/// An angle without whole quarter turns, between -1/8 and 1/8 of a turn, and how many they were.
fn reduced(x: Real40) -> Result<(Real40, i32), RealError> {
    // The ROM refuses exponent bytes of &98 and more.
    if x.exponent() >= 0x98 {
        return Err(RealError::AccuracyLost);
    }
    let turned = arith::div(arith::add(x, EIGHTH)?, QUARTER)?;
    let quarters = turned.int_floor()?;
    let mut rest = x;
    if quarters != 0 {
        for part in QUARTER_PARTS {
            rest = arith::sub(rest, arith::mul(Real40::from_i32(quarters), part)?)?;
        }
    }
    Ok((rest, quarters))
}

/// The sine of a reduced angle and some quarters. In odd ones it is the cosine, SQR(1 - s^2).
fn sine_of(rest: Real40, quarters: i32) -> Result<Real40, RealError> {
    let mut s = arith::mul(fraction(&SIN, arith::mul(rest, rest)?)?, rest)?;
    if quarters & 1 == 1 {
        s = arith::sqrt(arith::sub(Real40::ONE, arith::mul(s, s)?)?)?;
    }
    Ok(if quarters & 2 == 2 { s.negate() } else { s })
}

/// Sine of radians. Angles of 2^23 and more are an error.
pub fn sin(x: Real40) -> Result<Real40, RealError> {
    let (rest, quarters) = reduced(x.abs())?;
    let s = sine_of(rest, quarters)?;
    Ok(if x.is_negative() { s.negate() } else { s })
}

/// Cosine of radians: the sine a quarter on.
pub fn cos(x: Real40) -> Result<Real40, RealError> {
    let (rest, quarters) = reduced(x.abs())?;
    sine_of(rest, quarters + 1)
}

/// Tangent of radians.
pub fn tan(x: Real40) -> Result<Real40, RealError> {
    arith::div(sin(x)?, cos(x)?)
}

/// Arc tangent, in radians.
pub fn atn(x: Real40) -> Result<Real40, RealError> {
    let size = x.abs();
    let y = if size >= Real40::ONE {
        quarter_less(atn_below_one(arith::div(Real40::ONE, size)?)?)?
    } else {
        atn_below_one(size)?
    };
    Ok(if x.is_negative() { y.negate() } else { y })
}

/// pi / 2 - y.
fn quarter_less(y: Real40) -> Result<Real40, RealError> {
    arith::add(arith::sub(QUARTER_PARTS[0], y)?, QUARTER_PARTS[1])
}

/// Arc tangent of 0 to 1.
fn atn_below_one(x: Real40) -> Result<Real40, RealError> {
    if x.exponent() < ATN_SMALL {
        return Ok(x);
    }
    arith::mul(fraction(&ATN, arith::sub(x, HALF)?)?, x)
}

/// Arc sine, in radians; outside -1..1 a "-ve root".
pub fn asn(x: Real40) -> Result<Real40, RealError> {
    let cosine = arith::sqrt(arith::sub(Real40::ONE, arith::mul(x, x)?)?)?;
    if cosine.is_zero() {
        return Ok(if x.is_negative() {
            QUARTER.negate()
        } else {
            QUARTER
        });
    }
    atn(arith::div(x, cosine)?)
}

/// Arc cosine, in radians; outside -1..1 a "-ve root".
pub fn acs(x: Real40) -> Result<Real40, RealError> {
    quarter_less(asn(x)?)
}

/// e^x: the whole part as a power of e, the rest (-1/2 to 1/2) as a fraction.
pub fn exp(x: Real40) -> Result<Real40, RealError> {
    if x.abs() >= EXP_LIMIT {
        return if x.is_negative() {
            Ok(Real40::ZERO)
        } else {
            Err(RealError::ExpRange)
        };
    }
    let whole = nearest(x)?;
    let rest = fraction(&EXP, arith::sub(x, Real40::from_i32(whole))?)?;
    arith::mul(whole_power(E, whole)?, rest)
}

/// The nearest integer, a half going away from zero.
fn nearest(x: Real40) -> Result<i32, RealError> {
    let whole = x.to_i32()?;
    let rest = arith::sub(x, Real40::from_i32(whole))?;
    Ok(if rest.abs() >= HALF {
        whole + x.signum()
    } else {
        whole
    })
}

/// Natural logarithm: of x = m 2^k, k LN(2) + LN(m).
pub fn ln(x: Real40) -> Result<Real40, RealError> {
    if x.signum() <= 0 {
        return Err(RealError::LogRange);
    }
    let up = u8::from(x.mantissa() < ROOT_HALF);
    let k = i32::from(x.exponent()) - 128 - i32::from(up);
    let m = Real40::from_parts(false, 128 + up, x.mantissa());
    let z = arith::sub(m, Real40::ONE)?;
    let mut y = z;
    if !z.is_zero() {
        let r = arith::mul(fraction(&LN, z)?, z)?;
        y = arith::add(z, arith::mul(r, z)?)?;
    }
    arith::add(y, arith::mul(Real40::from_i32(k), LN_2)?)
}

/// 1 / LN(10), rounded.
const LOG_E: Real40 = bits(0x7f_5e5b_d8aa);

/// Logarithm to base 10.
pub fn log10(x: Real40) -> Result<Real40, RealError> {
    arith::mul(ln(x)?, LOG_E)
}

/// x ^ y. A whole y within -63..63 is repeated multiplication (so a negative x is allowed); any
/// other splits into that and e^(the rest of y x LN x), and is 0 for x = 0.
pub fn pow(x: Real40, y: Real40) -> Result<Real40, RealError> {
    let whole = nearest(y).ok().filter(|n| n.abs() < 64).unwrap_or(0);
    let rest = arith::sub(y, Real40::from_i32(whole))?;
    if rest.is_zero() {
        return whole_power(x, whole);
    }
    if x.is_zero() {
        return Ok(Real40::ZERO);
    }
    let power = whole_power(x, whole)?;
    arith::mul(power, exp(arith::mul(ln(x)?, rest)?)?)
}
