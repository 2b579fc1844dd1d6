//! The arithmetics that cases are tried in, and what an input becomes there.

use slowlight_compiler::targets::Target;
use slowlight_routine::log::model::{Log, WHOLE};
use slowlight_routine::scale::{fitting, most};
use slowlight_routine::{Bits, Format, Value};

/// A number format, as cases see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Arithmetic {
    /// `f64`.
    Native,
    /// A runtime's.
    Of(Format),
}

/// The overlay that a format asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Key {
    /// Significant bits.
    Bits(&'static str),
    /// A fixed-point format.
    Quantum(&'static str),
    /// The format's own name.
    Name,
}

impl Arithmetic {
    /// That of a target's plans: of two widths the smaller one, which values have that no
    /// pixel needs more of.
    pub fn of(target: &Target) -> Arithmetic {
        match target.runtime.narrow {
            Some(narrow) => Arithmetic::Of(Format::Scaled { bits: narrow.bits }),
            None => Arithmetic::Of(target.runtime.real),
        }
    }

    /// Its unit roundoff, or last place.
    pub fn epsilon(self) -> f64 {
        match self {
            Arithmetic::Native => f64::EPSILON / 2.0,
            Arithmetic::Of(format) => format.epsilon(),
        }
    }

    /// Whether it is fixed point.
    pub fn is_fixed(self) -> bool {
        matches!(self, Arithmetic::Of(format) if format.is_fixed())
    }

    /// Whether its values have points of their own, which the plan places.
    pub fn is_planned(self) -> bool {
        matches!(self, Arithmetic::Of(Format::Scaled { .. }))
    }

    /// Greatest and least exponent, where values have them: below 2^emax, at least 2^emin.
    fn exponents(self) -> Option<(i32, i32)> {
        match self {
            Arithmetic::Native => Some((1024, -1074)),
            Arithmetic::Of(Format::Real40) => Some((127, -128)),
            Arithmetic::Of(format @ Format::Log { .. }) => {
                let (least, most, octave) = ends(format);
                Some(((most + 1) / octave, least / octave))
            }
            Arithmetic::Of(_) => None,
        }
    }

    /// The least magnitude; 0 where there is none or where every bound is in last places.
    pub fn tiny(self) -> f64 {
        // 2^-1074 is no normal number: powi would pass through infinity.
        self.exponents().map_or(0.0, |(_, emin)| {
            2f64.powi(emin / 2) * 2f64.powi(emin - emin / 2)
        })
    }

    /// Whether it cannot hold 2^(hi-1) or 2^lo. The least logarithm is 0, so it holds no
    /// other number; where values have places of their own, each ends where its place does.
    pub fn cannot_hold(self, hi: i32, lo: i32) -> bool {
        match (self, self.exponents()) {
            (Arithmetic::Of(Format::Scaled { .. }), _) => true,
            (Arithmetic::Of(Format::Log { .. }), Some((emax, emin))) => hi > emax || lo <= emin,
            (Arithmetic::Of(Format::Fixed { bits, frac }), _) => {
                hi > i32::from(bits) - i32::from(frac) - 1 || lo < -i32::from(frac)
            }
            (_, Some((emax, emin))) => hi > emax || lo < emin,
            _ => false,
        }
    }

    /// Which overlay of a case counts.
    pub fn key(self) -> Key {
        match self {
            Arithmetic::Native => Key::Bits("53"),
            Arithmetic::Of(Format::Real40) => Key::Bits("32"),
            Arithmetic::Of(Format::Float316 { .. }) => Key::Bits("14"),
            Arithmetic::Of(Format::Float416) => Key::Bits("28"),
            Arithmetic::Of(Format::Fixed { bits: 32, frac: 16 }) => Key::Quantum("16.16"),
            Arithmetic::Of(Format::Fixed { bits: 16, frac: 8 }) => Key::Quantum("8.8"),
            Arithmetic::Of(_) => Key::Name,
        }
    }

    /// An input, rounded to nearest, halves to even; `None` where it does not fit.
    pub fn round(self, x: f64) -> Option<f64> {
        let rounded = match self {
            Arithmetic::Native => x,
            Arithmetic::Of(Format::Real40) => significant(x, 32),
            Arithmetic::Of(Format::Float316 { .. }) => significant(x, 14),
            Arithmetic::Of(Format::Float416) => significant(x, 28),
            Arithmetic::Of(Format::Fixed { bits, frac }) => {
                let scale = 2f64.powi(i32::from(frac));
                let n = (x * scale).round_ties_even();
                let end = 2f64.powi(i32::from(bits) - 1);
                return (-end..end).contains(&n).then_some(n / scale);
            }
            Arithmetic::Of(format @ Format::Log { .. }) => return logarithm(format, x),
            // Where its point stands says its param's range: [`placed`].
            Arithmetic::Of(Format::Scaled { .. }) => return None,
            Arithmetic::Of(_) => return None,
        };
        let fits = match self.exponents() {
            _ if rounded == 0.0 => x == 0.0,
            Some((emax, emin)) => {
                let exponent = rounded.abs().log2();
                rounded.is_finite() && exponent < f64::from(emax) && exponent >= f64::from(emin)
            }
            None => rounded.is_finite(),
        };
        fits.then_some(rounded)
    }
}

/// `x` with so many significant bits, to nearest, halves to even.
fn significant(x: f64, bits: i32) -> f64 {
    if x == 0.0 || !x.is_finite() {
        return x;
    }
    let exponent = x.abs().log2().floor() as i32;
    // In two steps, each a power of two, so that nothing over- or underflows.
    let scale = bits - 1 - exponent;
    let (half, rest) = (scale / 2, scale - scale / 2);
    let grown = x * 2f64.powi(half) * 2f64.powi(rest);
    grown.round_ties_even() / 2f64.powi(half) / 2f64.powi(rest)
}

/// The least and the greatest logarithm that a format holds, and its units in an octave: where
/// not all of a word counts, Jack's.
fn ends(format: Format) -> (i32, i32, i32) {
    let Format::Log { frac, octaves } = format else {
        return (Log::LEAST, Log::MOST, Log::OCTAVE);
    };
    let octave = 1 << frac;
    let most = i32::from(octaves) * octave - 1;
    let whole = most == i32::from(i16::MAX);
    (if whole { -most - 1 } else { Log::LEAST }, most, octave)
}

/// `x` with the nearest logarithm; none where it is beyond the ends. The least magnitude
/// is 0 there, so nothing else is held as that. The logarithm nearest to a whole number is
/// that number, as the format's floors have it.
fn logarithm(format: Format, x: f64) -> Option<f64> {
    if x == 0.0 || x.fract() == 0.0 && x.abs() < f64::from(WHOLE) {
        return Some(x);
    }
    let (least, most, octave) = ends(format);
    let log = (x.abs().log2() * f64::from(octave)).round();
    let fits = log > f64::from(least) && log <= f64::from(most);
    fits.then(|| (log / f64::from(octave)).exp2().copysign(x))
}

/// `x` with as many fraction bits as numbers up to `greatest` leave room for in so many
/// bits, to nearest, halves to even: what a param of such a range may be. None where it does
/// not fit, or would be 0 and is not.
pub fn placed(x: f64, greatest: f64, bits: u8) -> Option<f64> {
    let scale = f64::from(fitting(greatest, bits)).exp2();
    let n = (x * scale).round_ties_even();
    let fits = n.abs() <= most(bits) as f64 && (n != 0.0 || x == 0.0);
    fits.then_some(n / scale)
}

/// What a format's number is worth: the least logarithm, and what is smaller for a while,
/// stands for 0.
pub fn worth(format: Format, value: f64) -> f64 {
    match format {
        Format::Log { .. } => {
            let (least, _, octave) = ends(format);
            let held = (value.abs().log2() * f64::from(octave)).round() > f64::from(least);
            if held { value } else { 0.0 }
        }
        _ => value,
    }
}

/// The 40 bits of a real that BBC BASIC has: the exponent with bias 128, then a
/// mantissa from 1/2 to 1 whose first bit gives its place to the sign.
fn real40(x: f64) -> Bits {
    if x == 0.0 {
        return 0;
    }
    let exponent = x.abs().log2().floor() as i32 + 1;
    let (half, rest) = ((32 - exponent) / 2, (32 - exponent) - (32 - exponent) / 2);
    let mantissa = (x.abs() * 2f64.powi(half) * 2f64.powi(rest)) as u32 & 0x7FFF_FFFF;
    let sign = u32::from(x < 0.0) << 31;
    Bits::from((exponent + 128).clamp(0, 255) as u8) << 32 | Bits::from(mantissa | sign)
}

/// The bits of a value in its place's format, which holds it exactly, or with fewer fraction
/// bits than it might have where the plan has no use for these.
pub fn bits(target: &Target, value: Value, format: Format) -> Bits {
    match (format, value) {
        // What BASIC reads from ten digits would be another value.
        (Format::Real40, Value::Real(x)) => real40(x),
        _ => (target.runtime.encode)(value, format),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inputs_are_rounded_to_the_format() {
        let jack = Arithmetic::Of(Format::Float316 { rounded: false });
        assert_eq!(jack.round(1.0 + 0.5f64.powi(14)), Some(1.0));
        assert_eq!(
            jack.round(1.0 + 1.5 * 0.5f64.powi(13)),
            Some(1.0 + 2.0 * 0.5f64.powi(13))
        );
        assert_eq!(jack.round(1e300).map(|x| x > 9.9e299), Some(true));
        let bbc = Arithmetic::Of(Format::Real40);
        assert_eq!(bbc.round(2f64.powi(127)), None);
        assert_eq!(bbc.round(1.0 - 0.5f64.powi(33)), Some(1.0));
        let fixed = Arithmetic::Of(Format::Fixed { bits: 32, frac: 16 });
        assert_eq!(fixed.round(0.5f64.powi(17)), Some(0.0));
        assert_eq!(fixed.round(3.0 * 0.5f64.powi(17)), Some(0.5f64.powi(15)));
        assert_eq!(
            (fixed.round(32768.0), fixed.round(-32768.0)),
            (None, Some(-32768.0))
        );
        let log = Arithmetic::Of(Format::Log {
            frac: 10,
            octaves: 16,
        });
        assert_eq!((log.round(0.0), log.round(-4.0)), (Some(0.0), Some(-4.0)));
        assert_eq!(log.round(3.0), Some(3.0));
        assert_eq!(log.round(1.5), Some((599.0f64 / 1024.0).exp2()));
        assert_eq!(
            (log.round(65536.0), log.round(0.5f64.powi(13))),
            (None, None)
        );
        assert_eq!(
            (log.tiny(), log.cannot_hold(16, -12)),
            (0.5f64.powi(13), false)
        );
        assert!(log.cannot_hold(17, 0) && log.cannot_hold(0, -13));
        assert_eq!(placed(0.3, 1.5, 16), Some(4915.0 / 16384.0));
        assert_eq!(
            (placed(-0.25, 3e4, 16), placed(0.0, 0.0, 16)),
            (None, Some(0.0))
        );
        assert_eq!(
            worth(
                Format::Log {
                    frac: 10,
                    octaves: 16,
                },
                -0.5f64.powi(14)
            ),
            0.0
        );
        assert_eq!(Arithmetic::Native.tiny(), f64::from_bits(1));
        assert_eq!(Arithmetic::Native.round(f64::INFINITY), None);
    }
}
