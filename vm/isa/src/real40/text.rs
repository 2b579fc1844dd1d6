//! Decimal text to reals and back, as BASIC II reads and prints numbers.

use super::decimal::{self, Wide};
use super::{Real40, RealError};

/// How numbers are printed: the fields of `@%`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NumberFormat {
    /// Byte 2 of `@%`.
    pub style: Style,
    /// Byte 1: significant digits (general, exponent) or places after the point (fixed).
    pub digits: u8,
    /// Byte 0: the width of a field in which `PRINT` right-justifies.
    pub width: u8,
}

/// The three layouts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// Integers and decimals as short as they go, else an exponent.
    General,
    /// Always an exponent.
    Exponent,
    /// A fixed number of places.
    Fixed,
}

impl NumberFormat {
    /// From the value of `@%`, as the ROM takes it: 0 digits, or more than 10, mean 10 in the
    /// general style.
    pub fn from_at_percent(at: i32) -> Self {
        let [width, digits, style, _] = at.to_le_bytes();
        let style = match style {
            1 => Style::Exponent,
            2 => Style::Fixed,
            _ => Style::General,
        };
        let digits = match style {
            Style::Fixed => digits.min(10),
            _ if digits == 0 || digits > 10 => 10,
            _ => digits,
        };
        Self {
            style,
            digits,
            width,
        }
    }

    /// What `STR$` uses unless the top byte of `@%` is set: ten digits, general.
    pub const STR: Self = Self {
        style: Style::General,
        digits: 10,
        width: 0,
    };
}

/// The size of a real as decimal digits, exactly: first digit and power of ten of it, then
/// the rest. A 32-bit mantissa down to 2^-160 has fewer than 120 of them.
fn exact_digits(x: Real40) -> (Vec<u8>, i32) {
    let text = format!("{:.160e}", x.abs().to_f64());
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let digits = mantissa.bytes().filter(u8::is_ascii_digit).collect();
    (digits, exponent.parse().unwrap_or(0))
}

/// A number as `PRINT` and `STR$` write it, without padding.
pub fn to_text(x: Real40, format: NumberFormat) -> String {
    let mut out = String::new();
    if x.is_negative() {
        out.push('-');
    }
    match format.style {
        Style::Fixed => fixed(x, format.digits, &mut out),
        _ if x.is_zero() && format.style == Style::General => out.push('0'),
        _ => floating(x, format, &mut out),
    }
    out
}

/// General and exponent styles.
fn floating(x: Real40, format: NumberFormat, out: &mut String) {
    let keep = usize::from(format.digits.max(1));
    let (mut digits, power) = decimal::digits(x, keep);
    let general = format.style == Style::General;
    if general {
        while digits.len() > 1 && digits.last() == Some(&b'0') {
            digits.pop();
        }
    }
    if general && (-1..keep as i32).contains(&power) {
        // Measured: 0.1 is written so, .05 is 5E-2.
        if power < 0 {
            out.push_str("0.");
        }
        for (i, d) in digits.iter().enumerate() {
            if i as i32 == power + 1 && power >= 0 {
                out.push('.');
            }
            out.push(char::from(*d));
        }
        for _ in digits.len() as i32..=power {
            out.push('0');
        }
        return;
    }
    for (i, d) in digits.iter().enumerate() {
        out.push(char::from(*d));
        // Measured: in the exponent style also after a digit that stands alone.
        if i == 0 && (digits.len() > 1 || !general) {
            out.push('.');
        }
    }
    out.push('E');
    out.push_str(&power.to_string());
    if !general {
        // The exponent's field is three wide.
        let used = power.to_string().len();
        out.extend(std::iter::repeat_n(' ', 3usize.saturating_sub(used)));
    }
}

/// Fixed style: `places` digits after the point. Where that is more than ten significant
/// digits, the ROM falls back to the general style with ten.
fn fixed(x: Real40, places: u8, out: &mut String) {
    let places = usize::from(places);
    let (digits, power) = exact_digits(x);
    let whole = if x.is_zero() { 0 } else { power + 1 };
    let keep = whole + places as i32;
    if keep > 10 {
        return floating(x, NumberFormat::STR, out);
    }
    let rounded = if keep < 0 || x.is_zero() {
        vec![b'0'; places + 1]
    } else {
        let mut rounded = if keep == 0 {
            // Half of the last place or more shows as a 1 there.
            match digits.first() {
                Some(b'5'..) => vec![b'1'],
                _ => Vec::new(),
            }
        } else {
            let (mut rounded, grown) = decimal::digits(x, keep as usize);
            if grown > power {
                rounded.push(b'0');
            }
            rounded
        };
        let wanted = places + 1;
        while rounded.len() < wanted {
            rounded.insert(0, b'0');
        }
        rounded
    };
    let point = rounded.len() - places;
    for (i, d) in rounded.iter().enumerate() {
        if i == point {
            out.push('.');
        }
        out.push(char::from(*d));
    }
    if places == 0 {
        out.push('.');
    }
}

/// A decimal number at the start of `text`: digits, a point, digits, `E` and a signed power,
/// all but one digit (or the point) optional.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parsed {
    /// A whole number that fits 31 bits.
    Int(i32),
    /// Any other.
    Real(Real40),
}

/// Reads a number; answers it and how many bytes it took, `None` where no number starts.
/// Rounded as the ROM does, which is not always to the nearest.
pub fn parse(text: &[u8]) -> Result<Option<(Parsed, usize)>, RealError> {
    let digits_at = |from: usize| {
        text.get(from..)
            .unwrap_or(&[])
            .iter()
            .take_while(|c| c.is_ascii_digit())
            .count()
    };
    let whole = digits_at(0);
    let mut end = whole;
    let mut point = false;
    if text.get(end) == Some(&b'.') {
        point = true;
        end += 1;
        end += digits_at(end);
    }
    if whole == 0 && !point {
        return Ok(None);
    }
    let mut power = 0i32;
    let mut has_power = false;
    if text.get(end) == Some(&b'E') {
        let sign = usize::from(matches!(text.get(end + 1), Some(b'-' | b'+')));
        let count = digits_at(end + 1 + sign);
        has_power = true;
        for d in text.iter().skip(end + 1 + sign).take(count) {
            power = (power * 10 + i32::from(d - b'0')).min(9999);
        }
        if text.get(end + 1) == Some(&b'-') {
            power = -power;
        }
        end += 1 + sign + count;
    }
    let number = text.get(..end).unwrap_or(&[]);
    if !point && !has_power {
        let small = number.iter().try_fold(0i32, |n, d| {
            n.checked_mul(10)?.checked_add(i32::from(d - b'0'))
        });
        if let Some(n) = small {
            return Ok(Some((Parsed::Int(n), end)));
        }
    }
    let mantissa_end = number.iter().position(|c| *c == b'E').unwrap_or(end);
    let mantissa = number.get(..mantissa_end).unwrap_or(&[]);
    let x = round_decimal(mantissa, power)?;
    Ok(Some((Parsed::Real(x), end)))
}

/// Digits with a point x 10^power. The accumulator takes as many digits as fit 40 bits, the rest
/// count by their places alone.
fn round_decimal(mantissa: &[u8], power: i32) -> Result<Real40, RealError> {
    /// With this or more, ten times as much may not fit.
    const FULL: u64 = 24 << 32;
    let (mut digits, mut power) = (0u64, power);
    let mut after_point = false;
    for c in mantissa {
        match c {
            b'.' => after_point = true,
            _ if digits >= FULL => power += i32::from(!after_point),
            _ => {
                digits = digits * 10 + u64::from(c.wrapping_sub(b'0'));
                power -= i32::from(after_point);
            }
        }
    }
    Wide::new(digits).scaled(power).real()
}
