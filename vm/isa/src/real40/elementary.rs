//! `SIN COS TAN ATN ASN ACS EXP LN LOG` and `^`.
//!
//! Not yet bit-exact: each is double precision's value, rounded to 40 bits. BASIC II's own
//! series differ from these in the last digit or two (measured: ATN 1 and LN 2). The domains
//! and their errors are the ROM's.

use super::{Real40, RealError, arith};

/// Sine of radians. Angles of 2^23 turns or so and more are an error.
pub fn sin(x: Real40) -> Result<Real40, RealError> {
    Real40::from_f64(libm::sin(angle(x)?))
}

/// Cosine of radians.
pub fn cos(x: Real40) -> Result<Real40, RealError> {
    Real40::from_f64(libm::cos(angle(x)?))
}

/// Tangent of radians.
pub fn tan(x: Real40) -> Result<Real40, RealError> {
    arith::div(sin(x)?, cos(x)?)
}

fn angle(x: Real40) -> Result<f64, RealError> {
    // The ROM refuses exponent bytes of &98 and more.
    if x.exponent() >= 0x98 {
        Err(RealError::AccuracyLost)
    } else {
        Ok(x.to_f64())
    }
}

/// Arc tangent, in radians.
pub fn atn(x: Real40) -> Result<Real40, RealError> {
    Real40::from_f64(libm::atan(x.to_f64()))
}

/// Arc sine, in radians; outside -1..1 a "-ve root".
pub fn asn(x: Real40) -> Result<Real40, RealError> {
    if x.abs() > Real40::ONE {
        return Err(RealError::NegativeRoot);
    }
    Real40::from_f64(libm::asin(x.to_f64()))
}

/// Arc cosine, in radians; outside -1..1 a "-ve root".
pub fn acs(x: Real40) -> Result<Real40, RealError> {
    if x.abs() > Real40::ONE {
        return Err(RealError::NegativeRoot);
    }
    Real40::from_f64(libm::acos(x.to_f64()))
}

/// e^x. Above about 88 "Exp range", far below zero 0.
pub fn exp(x: Real40) -> Result<Real40, RealError> {
    Real40::from_f64(libm::exp(x.to_f64())).map_err(|_| RealError::ExpRange)
}

/// Natural logarithm.
pub fn ln(x: Real40) -> Result<Real40, RealError> {
    if x.signum() <= 0 {
        return Err(RealError::LogRange);
    }
    Real40::from_f64(libm::log(x.to_f64()))
}

/// Logarithm to base 10.
pub fn log10(x: Real40) -> Result<Real40, RealError> {
    if x.signum() <= 0 {
        return Err(RealError::LogRange);
    }
    Real40::from_f64(libm::log10(x.to_f64()))
}

/// x ^ y. A whole y within -63..63 is repeated multiplication (so a negative x is allowed);
/// any other goes through the logarithm, and is 0 for x = 0.
pub fn pow(x: Real40, y: Real40) -> Result<Real40, RealError> {
    if let Ok(n) = y.to_i32()
        && Real40::from_i32(n) == y
        && n.abs() < 64
    {
        let mut power = Real40::ONE;
        for _ in 0..n.abs() {
            power = arith::mul(power, x)?;
        }
        return if n < 0 {
            arith::div(Real40::ONE, power)
        } else {
            Ok(power)
        };
    }
    if x.is_zero() {
        return Ok(Real40::ZERO);
    }
    if x.is_negative() {
        return Err(RealError::LogRange);
    }
    Real40::from_f64(libm::exp(libm::log(x.to_f64()) * y.to_f64())).map_err(|_| RealError::ExpRange)
}
