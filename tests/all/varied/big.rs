//! Numbers with 400 bits, in which the formulas of a case are evaluated.

use dashu_float::{DBig, FBig, ops::SquareRoot};
use std::cmp::Ordering;
use std::str::FromStr;

/// Results have 53 bits and are judged against 30 decimal digits; what cancels on the
/// way takes at most twice the first.
const BITS: usize = 400;

#[derive(Clone, Debug)]
pub struct Big(FBig);

impl Big {
    pub fn new(x: f64) -> Big {
        let found = FBig::try_from(x).expect("it is finite");
        Big(found.with_precision(BITS).value())
    }

    pub fn parse(decimal: &str) -> Big {
        let decimal = DBig::from_str(decimal).expect("a decimal");
        let rounded = decimal.with_rounding::<dashu_float::round::mode::Zero>();
        Big(rounded.with_base_and_precision::<2>(BITS).value())
    }

    /// 2^n.
    pub fn power(n: i32) -> Big {
        let half = Big::new(2f64.powi(n / 2));
        half.times(&Big::new(2f64.powi(n - n / 2)))
    }

    pub fn near(&self) -> f64 {
        self.0.to_f64().value()
    }

    pub fn plus(&self, b: &Big) -> Big {
        Big(&self.0 + &b.0)
    }

    pub fn minus(&self, b: &Big) -> Big {
        Big(&self.0 - &b.0)
    }

    pub fn times(&self, b: &Big) -> Big {
        Big(&self.0 * &b.0)
    }

    pub fn over(&self, b: &Big) -> Big {
        Big(&self.0 / &b.0)
    }

    pub fn negated(&self) -> Big {
        Big(-self.0.clone())
    }

    pub fn magnitude(&self) -> Big {
        if self.sign() == Ordering::Less {
            self.negated()
        } else {
            self.clone()
        }
    }

    pub fn sign(&self) -> Ordering {
        self.compare(&Big::new(0.0))
    }

    pub fn is_zero(&self) -> bool {
        self.sign() == Ordering::Equal
    }

    pub fn compare(&self, b: &Big) -> Ordering {
        self.0.partial_cmp(&b.0).expect("numbers are in order")
    }

    pub fn floor(&self) -> Big {
        Big(self.0.floor().with_precision(BITS).value())
    }

    /// The exponent of the power of two that is not above it; of 0 none.
    pub fn exponent(&self) -> Option<i32> {
        if self.is_zero() {
            return None;
        }
        let repr = self.0.repr();
        let digits = i32::try_from(repr.digits()).expect("digits are few");
        Some(i32::try_from(repr.exponent()).expect("an exponent") + digits - 1)
    }

    pub fn sqrt(&self) -> Big {
        if self.is_zero() {
            self.clone()
        } else {
            Big(self.0.sqrt())
        }
    }

    pub fn exp(&self) -> Big {
        Big(self.0.exp())
    }

    pub fn log(&self) -> Big {
        Big(self.0.ln())
    }

    /// By the series, of a small part of the angle, which is doubled again: cos x - 1
    /// keeps its digits.
    pub fn sin(&self) -> Big {
        self.sine_and_versine().0
    }

    pub fn cos(&self) -> Big {
        Big::new(1.0).minus(&self.sine_and_versine().1)
    }

    fn sine_and_versine(&self) -> (Big, Big) {
        const HALVINGS: i32 = 12;
        let part = self.times(&Big::power(-HALVINGS));
        let square = part.times(&part);
        let (mut sine, mut versine) = (Big::new(0.0), Big::new(0.0));
        let mut term = part;
        for n in 1..30u32 {
            // The term is x^(2n-1)/(2n-1)!, with its sign.
            sine = sine.plus(&term);
            let next = term.times(&square).over(&Big::new(f64::from(2 * n)));
            term = next.over(&Big::new(f64::from(2 * n + 1))).negated();
        }
        let mut term = square.over(&Big::new(2.0));
        for n in 1..30u32 {
            versine = versine.plus(&term);
            let below = f64::from((2 * n + 1) * (2 * n + 2));
            term = term.times(&square).over(&Big::new(below)).negated();
        }
        for _ in 0..HALVINGS {
            // cos 2x = 1 - 2 sin^2 x, sin 2x = 2 sin x (1 - versin x).
            let cosine = Big::new(1.0).minus(&versine);
            versine = Big::new(2.0).times(&sine.times(&sine));
            sine = Big::new(2.0).times(&sine.times(&cosine));
        }
        (sine, versine)
    }

    /// By halving the angle, then the series.
    pub fn atan(&self) -> Big {
        const HALVINGS: i32 = 10;
        let one = Big::new(1.0);
        let mut x = self.clone();
        for _ in 0..HALVINGS {
            let root = one.plus(&x.times(&x)).sqrt();
            x = x.over(&one.plus(&root));
        }
        let square = x.times(&x).negated();
        let (mut sum, mut power) = (Big::new(0.0), x);
        for n in 0..30u32 {
            sum = sum.plus(&power.over(&Big::new(f64::from(2 * n + 1))));
            power = power.times(&square);
        }
        sum.times(&Big::power(HALVINGS))
    }

    /// Of -1 to 1.
    pub fn acos(&self) -> Big {
        let one = Big::new(1.0);
        let below = one.plus(self);
        if below.is_zero() {
            return Big::new(4.0).times(&one.atan());
        }
        let tangent = one.minus(self).over(&below).sqrt();
        Big::new(2.0).times(&tangent.atan())
    }

    /// 30 decimal digits, as a file of cases writes them.
    pub fn digits(&self) -> String {
        let decimal = self.0.to_decimal().value();
        format!("{:e}", decimal.with_precision(30).value())
    }
}

#[test]
fn functions_agree_with_those_of_f64() {
    for x in [-2.5f64, -0.75, 1e-9, 0.3, 0.9, 7.0] {
        let big = Big::new(x);
        let pairs = [
            (big.sin(), x.sin()),
            (big.cos(), x.cos()),
            (big.atan(), x.atan()),
            (big.exp(), x.exp()),
            (big.magnitude().log(), x.abs().ln()),
            (big.magnitude().sqrt(), x.abs().sqrt()),
        ];
        for (got, wanted) in pairs {
            let off = (got.near() - wanted).abs();
            assert!(off <= 4e-16 * wanted.abs(), "{x}: {} {wanted}", got.near());
        }
        if x.abs() <= 1.0 {
            assert!((big.acos().near() - x.acos()).abs() < 1e-15, "{x}");
        }
        assert_eq!(big.exponent(), Some(x.abs().log2().floor() as i32));
    }
    assert!((Big::new(-1.0).acos().near() - std::f64::consts::PI).abs() < 1e-15);
}
