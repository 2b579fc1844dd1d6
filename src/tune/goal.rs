//! Goals: as good as can be within a time, as quick as can be within an error or a memory.

use super::point::{Measured, Point};
use crate::failure::{Failure, Outcome};
use crate::format::{count, duration};
use crate::measure::Errors;
use clap::ValueEnum;
use serde::{Deserialize, Serialize};

/// The error that decides.
#[derive(ValueEnum, Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Measure {
    /// The share of pixels whose ink is not the native one
    #[default]
    Pixels,
    /// The root mean square error of shades before the dither
    Rmse,
    /// That of inks after it, seen from afar: under a Gaussian of 3 pixels
    Lowpass,
}

impl Measure {
    /// The error of this kind; a share of 1.
    pub fn of(self, errors: &Errors) -> f64 {
        match self {
            Measure::Pixels => errors.pixels as f64 / errors.count.max(1) as f64,
            Measure::Rmse => errors.rmse,
            Measure::Lowpass => errors.low_pass,
        }
    }

    /// What it is, for an axis.
    pub fn caption(self) -> &'static str {
        match self {
            Measure::Pixels => "pixels whose ink is not the native one, % of all",
            Measure::Rmse => "root mean square error of shades before the dither, % of white",
            Measure::Lowpass => {
                "root mean square error of the picture seen from afar (under a Gaussian of 3 pixels), % of white"
            }
        }
    }

    /// The same in the middle of a sentence, behind a figure in per cent.
    pub fn phrase(self) -> &'static str {
        match self {
            Measure::Pixels => "of the pixels in another ink",
            Measure::Rmse => "root mean square error of shades",
            Measure::Lowpass => "error as seen from afar",
        }
    }
}

/// A share as per cent with three digits that count: `0.0145 %`.
pub fn percent(share: f64) -> String {
    if share == 0.0 {
        return "0 %".to_owned();
    }
    let size = (100.0 * share).abs().log10().floor() as i32;
    let places = (2 - size).clamp(0, 12) as usize;
    format!("{:.places$} %", 100.0 * share)
}

/// What must hold of the program that is built.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Goals {
    /// Seconds of the machine's time at most.
    pub within: Option<f64>,
    /// The error at most, a share of 1.
    pub error: Option<f64>,
    /// Bytes at most.
    pub memory: Option<u64>,
}

/// Reads `--within`: `20m`, `1.5h`, `90s`, `1h30m`, `250ms`.
///
/// # Errors
/// Where it is no time.
pub fn time(text: &str) -> Result<f64, String> {
    let wrong = || "write a time as in 90s, 20m, 1h30m or 250ms".to_owned();
    let units = [
        ("ms", 1e-3),
        ("us", 1e-6),
        ("s", 1.0),
        ("m", 60.0),
        ("h", 3600.0),
        ("d", 86400.0),
    ];
    let mut rest = text.trim();
    let mut sum = 0.0;
    if rest.is_empty() {
        return Err(wrong());
    }
    while !rest.is_empty() {
        let digits = rest
            .find(|c: char| !c.is_ascii_digit() && c != '.')
            .ok_or_else(wrong)?;
        let (number, behind) = rest.split_at(digits);
        let letters = behind
            .find(|c: char| !c.is_ascii_alphabetic())
            .unwrap_or(behind.len());
        let (unit, left) = behind.split_at(letters);
        let number: f64 = number.parse().map_err(|_| wrong())?;
        let (_, size) = units
            .iter()
            .find(|(name, _)| *name == unit)
            .ok_or_else(wrong)?;
        sum += number * size;
        rest = left.trim_start();
    }
    match sum > 0.0 && sum.is_finite() {
        true => Ok(sum),
        false => Err(wrong()),
    }
}

/// Reads `--memory`: `8K`, `32768`.
///
/// # Errors
/// Where it is no number of bytes.
pub fn bytes(text: &str) -> Result<u64, String> {
    let text = text.trim().to_ascii_uppercase();
    let text = text.strip_suffix('B').unwrap_or(&text);
    let (number, size) = match (text.strip_suffix('K'), text.strip_suffix('M')) {
        (Some(number), _) => (number, 1024.0),
        (_, Some(number)) => (number, 1024.0 * 1024.0),
        _ => (text, 1.0),
    };
    match number.parse::<f64>() {
        Ok(n) if n > 0.0 && n.is_finite() => Ok((n * size) as u64),
        _ => Err("write bytes as in 8K or 32768".to_owned()),
    }
}

impl Goals {
    /// Whether there is any.
    pub fn any(&self) -> bool {
        *self != Goals::default()
    }

    fn reached(&self, at: &Measured, error: f64) -> bool {
        self.within.is_none_or(|most| at.seconds <= most)
            && self.error.is_none_or(|most| error <= most)
            && self.memory.is_none_or(|most| at.memory() <= most)
    }

    /// The point that is wanted: the quickest within an error, else the most accurate.
    ///
    /// # Errors
    /// Where none reaches the goals: how close one comes.
    pub fn choose<'p>(&self, points: &'p [Point], measure: Measure) -> Outcome<&'p Point> {
        let off = |p: &Point| measure.of(&p.measured.errors);
        let right = points.iter().filter(|p| self.reached(&p.measured, off(p)));
        let key = |p: &Point| match self.error {
            Some(_) => (p.measured.seconds, off(p)),
            None => (off(p), p.measured.seconds),
        };
        let order = |a: &&Point, b: &&Point| {
            let (a, b) = (key(a), key(b));
            a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
        };
        right
            .min_by(order)
            .ok_or_else(|| self.missed(points, measure))
    }

    /// How close one can get: to each goal, among what reaches the others.
    fn missed(&self, points: &[Point], measure: Measure) -> Failure {
        let off = |p: &Point| measure.of(&p.measured.errors);
        let least = |others: Goals, key: &dyn Fn(&Point) -> f64| {
            let right = |p: &&Point| others.reached(&p.measured, off(p));
            let best = points.iter().filter(right).map(key).min_by(f64::total_cmp);
            match best {
                Some(best) => Some(("", best)),
                None => {
                    let all = points.iter().map(key).min_by(f64::total_cmp);
                    all.map(|best| (", the other goals aside,", best))
                }
            }
        };
        let mut said = "nothing that was tried reaches the goal".to_owned();
        let within = Goals {
            within: None,
            ..*self
        };
        if let (Some(most), Some((alone, best))) =
            (self.within, least(within, &|p| p.measured.seconds))
        {
            let (best, most) = (duration(best), duration(most));
            said.push_str(&format!(
                "\n  the quickest{alone} takes {best}, and {most} is wanted"
            ));
        }
        let error = Goals {
            error: None,
            ..*self
        };
        if let (Some(most), Some((alone, best))) = (self.error, least(error, &off)) {
            let (best, most) = (percent(best), percent(most));
            let phrase = measure.phrase();
            said.push_str(&format!(
                "\n  the best{alone} has {best} {phrase}, and {most} is wanted"
            ));
        }
        let memory = Goals {
            memory: None,
            ..*self
        };
        if let (Some(most), Some((alone, best))) =
            (self.memory, least(memory, &|p| p.measured.memory() as f64))
        {
            let (best, most) = (count(best as u64), count(most));
            said.push_str(&format!(
                "\n  the smallest{alone} takes {best} bytes, and {most} are wanted"
            ));
        }
        let wanted = [
            self.within.is_some(),
            self.error.is_some(),
            self.memory.is_some(),
        ];
        if wanted.iter().filter(|w| **w).count() > 1 {
            said.push_str("\n  each among what reaches the other goals");
        }
        Failure::Wrong(said)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::target_args::share;

    #[test]
    fn goals_are_read() {
        assert_eq!(time("20m"), Ok(1200.0));
        assert_eq!(time("1h30m"), Ok(5400.0));
        assert_eq!(time("250ms"), Ok(0.25));
        assert_eq!(share("0.5%"), Ok(0.005));
        assert_eq!(share("0.25"), Ok(0.25));
        assert_eq!(bytes("8K"), Ok(8192));
        assert_eq!(bytes("1.5kb"), Ok(1536));
        for wrong in ["", "20", "m", "1x", "-3s", "0s", "1e9999s"] {
            assert!(time(wrong).is_err(), "{wrong}");
        }
        for wrong in ["", "x", "-1", "101%", "2"] {
            assert!(share(wrong).is_err(), "{wrong}");
        }
        for wrong in ["", "K", "0", "-8K", "8G"] {
            assert!(bytes(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn shares_keep_three_digits() {
        assert_eq!(percent(0.000145), "0.0145 %");
        assert_eq!(percent(0.269), "26.9 %");
        assert_eq!(percent(0.0), "0 %");
        assert_eq!(percent(1.0), "100 %");
    }
}
