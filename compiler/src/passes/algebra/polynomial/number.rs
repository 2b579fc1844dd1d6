//! Coefficients: rational where they can be, else the nearest `f64`.
//!
//! A scene's 0.1 is a tenth here, as its author meant; that is as near to the
//! `f64` as any two formulas for one value are to each other.

/// A coefficient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Number {
    /// A fraction in lowest terms, the denominator above 0.
    Exact(i128, i128),
    /// What is no short fraction.
    Near(f64),
}

/// The greatest common divisor, at least 1.
pub fn common(mut a: i128, mut b: i128) -> i128 {
    // Words divide several times as fast.
    if let (Ok(mut x), Ok(mut y)) = (
        u64::try_from(a.unsigned_abs()),
        u64::try_from(b.unsigned_abs()),
    ) {
        while y != 0 {
            (x, y) = (y, x % y);
        }
        return i128::from(x.max(1));
    }
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a.saturating_abs().max(1)
}

/// Decimal digits, and powers of ten, that a fraction may have.
const DIGITS: i32 = 12;

impl Number {
    pub const ZERO: Number = Number::Exact(0, 1);
    pub const ONE: Number = Number::Exact(1, 1);

    /// A whole number.
    pub fn whole(n: i128) -> Number {
        Number::Exact(n, 1)
    }

    /// The shortest decimal that stands for an `f64`, if it is short.
    pub fn of(x: f64) -> Number {
        let text = format!("{x:e}");
        let short = || {
            let (digits, power) = text.split_once('e')?;
            let power: i32 = power.parse().ok()?;
            let places = digits.split_once('.').map_or(0, |(_, rest)| rest.len()) as i32;
            let whole: i128 = digits.replace('.', "").parse().ok()?;
            let down = places - power;
            let small = places <= DIGITS && (-DIGITS..=DIGITS + 4).contains(&down);
            let ten = 10i128.checked_pow(down.unsigned_abs())?;
            small.then(|| match down >= 0 {
                true => Number::ratio(whole, ten),
                false => Number::ratio(whole.saturating_mul(ten), 1),
            })
        };
        short().unwrap_or(Number::Near(x))
    }

    fn ratio(num: i128, den: i128) -> Number {
        if den == 1 {
            return Number::Exact(num, 1);
        }
        let by = common(num, den) * den.signum();
        Number::Exact(num / by, den / by)
    }

    /// The nearest `f64`.
    pub fn real(self) -> f64 {
        match self {
            Number::Exact(n, d) => n as f64 / d as f64,
            Number::Near(x) => x,
        }
    }

    pub fn is_zero(self) -> bool {
        matches!(self, Number::Exact(0, _)) || self == Number::Near(0.0)
    }

    pub fn add(self, other: Number) -> Number {
        let exact = || match (self, other) {
            (Number::Exact(a, b), Number::Exact(c, d)) => {
                let top = a.checked_mul(d)?.checked_add(c.checked_mul(b)?)?;
                Some(Number::ratio(top, b.checked_mul(d)?))
            }
            _ => None,
        };
        exact().unwrap_or_else(|| Number::Near(self.real() + other.real()))
    }

    pub fn mul(self, other: Number) -> Number {
        let exact = || match (self, other) {
            (Number::Exact(a, b), Number::Exact(c, d)) => {
                Some(Number::ratio(a.checked_mul(c)?, b.checked_mul(d)?))
            }
            _ => None,
        };
        exact().unwrap_or_else(|| Number::Near(self.real() * other.real()))
    }

    pub fn neg(self) -> Number {
        self.mul(Number::whole(-1))
    }

    /// 1 divided by it; nothing for 0.
    pub fn inverse(self) -> Option<Number> {
        match self {
            _ if self.is_zero() => None,
            Number::Exact(n, d) => Some(Number::ratio(d, n)),
            Number::Near(x) => Some(Number::Near(1.0 / x)),
        }
    }
}

/// The root of a square of a whole number.
pub(super) fn isqrt(n: i128) -> Option<i128> {
    let root = (n as f64).sqrt().round() as i128;
    (root * root == n).then_some(root)
}
