//! The 40-bit real of BBC BASIC II.
//!
//! Five bytes: an exponent with bias 128, then a mantissa of 32 bits, big-endian, whose top
//! bit (always 1) gives its place to the sign. The value is 0.1mmm... x 2^(exponent - 128);
//! exponent 0 is zero. There are no infinities and no NaN: a result of 2^127 or more is an
//! error, a result under 2^-128 is zero.
//!
//! Arithmetic happens in an accumulator of 32 mantissa bits and 8 guard bits. [`arith`]
//! follows the ROM's routines bit by bit for `+ - * /` and `SQR`, because a picture whose
//! pixels hang on a comparison shows every last bit; and so do the elementary functions
//! ([`elementary`]), built on them.
//!
//! Measured on the genuine ROM: see each function. (The ROM can also hold numbers from 2^-129
//! to 2^-128, with exponent byte 0 and a mantissa that is not zero; here they are zero.)

pub mod arith;
mod decimal;
pub mod elementary;
pub mod text;

use std::cmp::Ordering;

/// Why an operation on reals has no result. The texts are those of BASIC II.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RealError {
    /// 2^127 or more.
    TooBig,
    /// Division by zero.
    DivisionByZero,
    /// The square root (or arc sine, arc cosine) of a value outside its domain.
    NegativeRoot,
    /// The logarithm of zero or less.
    LogRange,
    /// The sine, cosine or tangent of an angle too large to reduce.
    AccuracyLost,
    /// `EXP` of more than 87.3 or so.
    ExpRange,
}

impl RealError {
    /// BASIC II's message.
    pub fn message(self) -> &'static str {
        match self {
            Self::TooBig => "Too big",
            Self::DivisionByZero => "Division by zero",
            Self::NegativeRoot => "-ve root",
            Self::LogRange => "Log range",
            Self::AccuracyLost => "Accuracy lost",
            Self::ExpRange => "Exp range",
        }
    }
}

/// A 40-bit real: five bytes in the machine, eight here.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Real40 {
    /// Exponent + 128, under 256; 0 for zero. As wide as the mantissa, so that no copy of a number
    /// is made in pieces: reading back together what was written apart holds a processor up.
    exp: u32,
    /// The mantissa with its top bit replaced by the sign; 0 for zero.
    man: u32,
}

const SIGN: u32 = 0x8000_0000;

impl Real40 {
    /// Zero, which has no sign.
    pub const ZERO: Self = Self { exp: 0, man: 0 };
    /// One.
    pub const ONE: Self = Self { exp: 129, man: 0 };
    /// The largest value, a little under 2^127.
    pub const MAX: Self = Self {
        exp: 255,
        man: 0x7fff_ffff,
    };

    /// From the 40 bits: exponent byte in bits 32 to 39, then sign and mantissa. Exponent 0 is zero.
    pub const fn from_bits(bits: u64) -> Self {
        let exp = (bits >> 32) as u32 & 0xff;
        if exp == 0 {
            return Self::ZERO;
        }
        Self {
            exp,
            man: bits as u32,
        }
    }

    /// The 40 bits, as [`Real40::from_bits`] takes them.
    pub const fn to_bits(self) -> u64 {
        (self.exp as u64) << 32 | self.man as u64
    }

    /// From the five bytes of a variable: exponent, then the mantissa from its top byte down.
    pub fn from_bytes(b: [u8; 5]) -> Self {
        Self::from_bits(
            u64::from(b[0]) << 32 | u64::from(u32::from_be_bytes([b[1], b[2], b[3], b[4]])),
        )
    }

    /// The five bytes of a variable.
    pub fn to_bytes(self) -> [u8; 5] {
        let m = self.man.to_be_bytes();
        [self.exponent(), m[0], m[1], m[2], m[3]]
    }

    /// From its parts: the mantissa has its top bit set; the exponent has its bias.
    pub(crate) const fn from_parts(negative: bool, exp: u8, mantissa: u32) -> Self {
        let man = (mantissa & !SIGN) | if negative { SIGN } else { 0 };
        let exp = exp as u32;
        Self { exp, man }
    }

    /// The biased exponent; 0 for zero.
    pub const fn exponent(self) -> u8 {
        self.exp as u8
    }

    /// The mantissa with its top bit set; 0 for zero.
    pub const fn mantissa(self) -> u32 {
        if self.exp == 0 { 0 } else { self.man | SIGN }
    }

    /// Below zero?
    pub const fn is_negative(self) -> bool {
        self.man & SIGN != 0
    }

    /// Zero?
    pub const fn is_zero(self) -> bool {
        self.exp == 0
    }

    /// -x; zero stays zero.
    pub const fn negate(self) -> Self {
        if self.exp == 0 {
            self
        } else {
            Self {
                exp: self.exp,
                man: self.man ^ SIGN,
            }
        }
    }

    /// |x|.
    pub const fn abs(self) -> Self {
        Self {
            exp: self.exp,
            man: self.man & !SIGN,
        }
    }

    /// -1, 0 or 1.
    pub const fn signum(self) -> i32 {
        if self.exp == 0 {
            0
        } else if self.is_negative() {
            -1
        } else {
            1
        }
    }

    /// The nearest real to a double, ties away from zero. NaN is zero, too large an error.
    pub fn from_f64(x: f64) -> Result<Self, RealError> {
        if x == 0.0 || x.is_nan() {
            return Ok(Self::ZERO);
        }
        if x.is_infinite() {
            return Err(RealError::TooBig);
        }
        let bits = x.to_bits();
        let e = (bits >> 52 & 0x7ff) as i32;
        if e < 1023 - 200 {
            return Ok(Self::ZERO);
        }
        // 53 bits of 1.mmm, so 0.1mmm x 2^(e - 1022).
        let m = (bits & ((1 << 52) - 1)) | 1 << 52;
        let rounded = (m + (1 << 20)) >> 21;
        let (m, carry) = if rounded >> 32 != 0 {
            (rounded >> 1, 1)
        } else {
            (rounded, 0)
        };
        arith::pack(x < 0.0, e - 1022 + 128 + carry, m as u32)
    }

    /// The same value as a double, exactly.
    pub fn to_f64(self) -> f64 {
        if self.exp == 0 {
            return 0.0;
        }
        // mantissa / 2^32 x 2^(exp - 128): a power of two well inside the double's range.
        let power = f64::from_bits(((i64::from(self.exp) - 160 + 1023) as u64) << 52);
        let size = f64::from(self.mantissa()) * power;
        if self.is_negative() { -size } else { size }
    }

    /// An integer, exactly.
    pub fn from_i32(n: i32) -> Self {
        if n == 0 {
            return Self::ZERO;
        }
        let size = n.unsigned_abs();
        let shift = size.leading_zeros();
        Self::from_parts(n < 0, (160 - shift) as u8, size << shift)
    }

    /// Toward zero, as an assignment to an integer variable does. 2^31 or more in size is an
    /// error, and so is -2^31 itself (measured: the ROM looks at the exponent alone).
    pub fn to_i32(self) -> Result<i32, RealError> {
        if self.exp <= 128 {
            return Ok(0);
        }
        if self.exp >= 160 {
            return Err(RealError::TooBig);
        }
        let size = (self.mantissa() >> (160 - self.exp)) as i32;
        Ok(if self.is_negative() { -size } else { size })
    }

    /// BASIC's `INT`: the largest integer not above.
    pub fn int_floor(self) -> Result<i32, RealError> {
        let n = self.to_i32()?;
        if self.is_negative() && Self::from_i32(n) != self {
            // At least -2^31 + 1 before, so this cannot wrap.
            return Ok(n - 1);
        }
        Ok(n)
    }

    /// Orders two reals exactly.
    pub fn compare(self, other: Self) -> Ordering {
        fn key(x: Real40) -> i64 {
            let size = i64::from(x.exp) << 32 | i64::from(x.man & !SIGN);
            if x.is_negative() { -size } else { size }
        }
        key(self).cmp(&key(other))
    }
}

impl PartialOrd for Real40 {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Real40 {
    fn cmp(&self, other: &Self) -> Ordering {
        self.compare(*other)
    }
}

#[cfg(test)]
mod tests;
