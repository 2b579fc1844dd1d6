//! Sums and roots to the nearest, bit for bit as the Jack source computes them: with
//! [`Float::product`] and [`Float::ratio`] these are the arithmetic of `f316r`.

use super::{Float, power};

/// How sums and roots are rounded, for whatever is made of them.
pub trait Sums {
    fn add(a: Float, b: Float) -> Float;

    fn sub(a: Float, b: Float) -> Float {
        Self::add(a, b.neg())
    }

    fn root(a: Float) -> Float;
}

/// The arithmetic of `f316`: what does not fit is cut.
#[derive(Clone, Copy, Debug)]
pub struct Cut;

impl Sums for Cut {
    fn add(a: Float, b: Float) -> Float {
        a.add(b)
    }

    fn root(a: Float) -> Float {
        a.sqrt()
    }
}

/// The arithmetic of `f316r`: results are off by at most 2^-14 of themselves.
#[derive(Clone, Copy, Debug)]
pub struct Rounded;

impl Sums for Rounded {
    /// A sum goes to the nearest, halves up. A difference keeps one bit behind the
    /// mantissa's last: to the nearest, halves down, but for what lies within half a
    /// unit under a power of two, which may become that power.
    fn add(a: Float, b: Float) -> Float {
        let (large, small) = if a.e < b.e { (b, a) } else { (a, b) };
        if large.m == 0 {
            return small;
        }
        let apart = large.e - small.e;
        if apart > 14 {
            return large;
        }
        let unit = power(apart);
        let Float { s, e, m } = large;
        if s == small.s {
            let sum = m + (small.m + unit / 2) / unit;
            if sum < 16384 {
                return Float { s, e, m: sum };
            }
            let m = (m + small.m / unit + 1) / 2;
            return Float { s, e: e + 1, m }.ended();
        }
        // Twice the difference: the last bit is the guard.
        let twice = 2 * m - 2 * small.m / unit;
        if twice > 16383 {
            let m = twice / 2;
            return Float { s, e, m };
        }
        let e = e - 1;
        let rest = if apart > 1 {
            let half = unit / 2;
            let m = 2 * m - (small.m + half / 2) / half;
            Float { s, e, m }
        } else if twice == 0 {
            return Float::ZERO;
        } else {
            let s = if twice < 0 { 1 - s } else { s };
            let m = twice.abs();
            Float { s, e, m }.normal()
        };
        rest.ended()
    }

    fn root(a: Float) -> Float {
        Rounded::sqrt(a)
    }
}

impl Rounded {
    /// To the nearest; 0 for negatives.
    pub fn sqrt(a: Float) -> Float {
        if a.m == 0 || a.s == 1 {
            return Float::ZERO;
        }
        let square = i64::from(a.m) << if a.e & 1 == 0 { 14 } else { 13 };
        let root = square.isqrt();
        let m = root + i64::from(square - root * root > root);
        Float {
            s: 0,
            e: (a.e + 8127) / 2 - 4000,
            m: m as i32,
        }
    }
}
