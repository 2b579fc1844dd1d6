//! Numbers with 400 bits, to judge results of 53 against decimals of 30 digits.

use dashu_float::{DBig, FBig};
use std::str::FromStr;

/// Bits of precision. Results are binary with at most 53 bits and wanted values
/// have 30 digits, so what is compared is known to far less than a bound.
const BITS: usize = 400;

/// A number.
#[derive(Clone, Debug)]
pub struct Exact(FBig);

impl Exact {
    /// A finite `f64`, exactly; what is not finite counts as 0.
    pub fn new(x: f64) -> Exact {
        let found = FBig::try_from(x).unwrap_or(FBig::ZERO);
        Exact(found.with_precision(BITS).value())
    }

    /// A decimal, to 400 bits.
    pub fn parse(text: &str) -> Option<Exact> {
        let decimal = DBig::from_str(text).ok()?;
        let rounded = decimal.with_rounding::<dashu_float::round::mode::Zero>();
        let binary = rounded.with_base_and_precision::<2>(BITS).value();
        Some(Exact(binary))
    }

    /// The nearest `f64`, or the next one to it.
    pub fn near(&self) -> f64 {
        self.0.to_f64().value()
    }

    pub fn plus(&self, other: &Exact) -> Exact {
        Exact(&self.0 + &other.0)
    }

    pub fn minus(&self, other: &Exact) -> Exact {
        Exact(&self.0 - &other.0)
    }

    pub fn times(&self, other: &Exact) -> Exact {
        Exact(&self.0 * &other.0)
    }

    /// |self - other|.
    pub fn distance(&self, other: &Exact) -> f64 {
        self.minus(other).near().abs()
    }

    /// -1, 0 or 1.
    pub fn sign(&self) -> i32 {
        let zero: FBig = FBig::ZERO;
        i32::from(self.0 > zero) - i32::from(self.0 < zero)
    }
}

/// The sum of products of two vectors.
pub fn dot(a: &[Exact], b: &[Exact]) -> Exact {
    let products = a.iter().zip(b).map(|(x, y)| x.times(y));
    products.fold(Exact::new(0.0), |sum, p| sum.plus(&p))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn what_an_f64_cannot_tell_apart_is_told_apart() {
        let third = Exact::parse("0.333333333333333333333333333333").unwrap();
        let off = Exact::new(1.0 / 3.0).distance(&third);
        assert!((1e-17..2e-17).contains(&off), "{off}");
        let small = Exact::parse("1.40625e-445").unwrap();
        assert_eq!(small.sign(), 1);
        assert_eq!(Exact::new(2.0).distance(&Exact::parse("2").unwrap()), 0.0);
        assert!(Exact::parse("one").is_none());
    }
}
