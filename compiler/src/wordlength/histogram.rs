//! Histograms of sensitivities by octave: what was asked of a node's values at all pixels that
//! were looked at, and how many fraction bits serve that best.

use crate::wordlength::adjoint::Asked;
use slowlight_routine::scale::{finest, fitting, most};

/// What values are expected to stay within, of the greatest seen.
const ROOM: f64 = 1.2;

/// How far a value is off where it is held with so many fraction bits, in its last places:
/// what routines may be off is more than what roundings are.
const OFF: f64 = 0.5;

/// What it may cost a pixel of so many bits to cut nothing more. What is estimated is several
/// times too much, and what is cut has to be compared where a sum would do.
const HARDLY: f64 = 1.5 / 1024.0;

/// The bits of a value for which that is.
pub const BRIEF: u8 = 16;

/// The same where values have more bits, each of which halves what roundings cost.
fn hardly(bits: u8) -> f64 {
    HARDLY * (f64::from(BRIEF) - f64::from(bits)).exp2()
}

/// What asks for more than such a part of a value gets it from no format: what is compared
/// with its equal, say.
const FINEST: f64 = 65536.0;

/// Magnitudes are counted by their octaves, the first of which ends at 2^-40.
const OCTAVES: usize = 96;
const FIRST: i32 = -40;

/// In an octave's middle.
const MIDDLE: f64 = 0.75;

/// What was asked of a node's values.
#[derive(Clone)]
pub struct Seen {
    /// The greatest magnitude, and the greatest that was asked for.
    most: f64,
    need: f64,
    /// What it costs to end below these magnitudes.
    lost: [f64; OCTAVES],
    /// How many values cost so much for each unit that they are off.
    gains: [f64; OCTAVES],
    /// The same of whole numbers, which fraction bits hold as they are.
    wholes: [f64; OCTAVES],
}

impl Default for Seen {
    fn default() -> Seen {
        Seen {
            most: 0.0,
            need: 0.0,
            lost: [0.0; OCTAVES],
            gains: [0.0; OCTAVES],
            wholes: [0.0; OCTAVES],
        }
    }
}

/// The octave that a magnitude is in: the least power of two that is not less, counted from
/// the first.
fn octave(x: f64) -> usize {
    let bits = x.to_bits();
    let whole = bits & ((1 << (f64::MANTISSA_DIGITS - 1)) - 1) == 0;
    let exponent = (bits >> (f64::MANTISSA_DIGITS - 1)) as i32 - (f64::MAX_EXP - 1);
    (exponent + i32::from(!whole) - FIRST).clamp(0, OCTAVES as i32 - 1) as usize
}

impl Seen {
    /// Counts a value so many times.
    pub fn see(&mut self, value: f64, asked: Asked, times: f64) {
        self.most = self.most.max(value.abs());
        let need = asked.need(value);
        self.need = self.need.max(need);
        if need > 0.0 {
            self.lost[octave(need)] += times * (need * asked.lost).min(1.0);
        }
        if asked.gain > 0.0 && asked.gain * value.abs() < FINEST {
            let counted = match value.fract() == 0.0 {
                true => &mut self.wholes,
                false => &mut self.gains,
            };
            counted[octave(asked.gain)] += times;
        }
    }

    /// Counts what another has counted.
    pub fn add(&mut self, other: &Seen) {
        self.most = self.most.max(other.most);
        self.need = self.need.max(other.need);
        for (mine, others) in [
            (&mut self.lost, &other.lost),
            (&mut self.gains, &other.gains),
            (&mut self.wholes, &other.wholes),
        ] {
            mine.iter_mut().zip(others).for_each(|(n, m)| *n += m);
        }
    }

    /// What leaves room for all that was seen.
    pub fn room(&self) -> f64 {
        self.most * ROOM
    }

    /// What it costs to hold the values with so many fraction bits.
    pub fn cost(&self, frac: i8, bits: u8) -> f64 {
        let place = (-f64::from(frac)).exp2();
        let end = most(bits) as f64 * place;
        let octave = |k: usize| f64::from(k as i32 + FIRST).exp2();
        let mut sum = 0.0;
        for k in 0..OCTAVES {
            if octave(k).min(self.need) > end {
                sum += self.lost[k];
            }
            let off = (octave(k) * MIDDLE * place * OFF).min(1.0);
            let rounded = if frac < 0 { self.wholes[k] } else { 0.0 };
            sum += off * (self.gains[k] + rounded);
        }
        sum
    }

    /// What the values are expected to stay within: all that was seen, or as much of it as
    /// costs hardly more in so many bits than what costs least, `cap` of them at most
    /// behind the point; in so many pixels. Nothing where nothing was asked.
    pub fn expected(&self, cap: i8, bits: u8, pixels: f64) -> Option<f64> {
        let any = |counted: &[f64]| counted.iter().any(|n| *n > 0.0);
        if !any(&self.lost) && !any(&self.gains) && !any(&self.wholes) {
            return None;
        }
        let all = fitting(self.room(), bits);
        let each = all..=cap.clamp(all, finest(bits));
        let costs: Vec<(i8, f64)> = each.map(|f| (f, self.cost(f, bits))).collect();
        let least = costs.iter().map(|c| c.1).fold(f64::INFINITY, f64::min);
        let (best, _) = costs
            .iter()
            .find(|c| c.1 <= least + hardly(bits) * pixels)?;
        Some(match *best == all {
            true => self.room(),
            false => most(bits) as f64 * (-f64::from(*best)).exp2(),
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::wordlength::adjoint::Bounds;

    /// How many fraction bits serve a thousand values beside 1, where one is 1024 of which
    /// so much is asked for.
    fn frac(need: f64, bits: u8) -> i8 {
        let asked = |gain: f64, lost: f64, lo: f64| Asked {
            gain,
            within: Bounds {
                lo,
                hi: f64::INFINITY,
            },
            lost,
        };
        let mut seen = Seen::default();
        seen.see(1.1, asked(4.0, 4.0, 1.1), 1000.0);
        seen.see(1024.0, asked(0.0, 1.0, need), 1.0);
        fitting(seen.expected(finest(bits), bits, 1001.0).unwrap(), bits)
    }

    #[test]
    fn octaves_end_at_powers_of_two() {
        for k in [-39, -1, 0, 1, 17, 54] {
            let end = f64::from(k).exp2();
            let at = (k - FIRST) as usize;
            assert_eq!([end, end * 0.75, end * 1.25].map(octave), [at, at, at + 1]);
        }
        assert_eq!(
            [1e-300, f64::MIN_POSITIVE / 4.0, 1e300].map(octave),
            [0, 0, OCTAVES - 1]
        );
    }

    /// What one pixel has is cut where it costs the others digits that they need, and has
    /// room where it does not. What is asked for by nobody has room nowhere.
    #[test]
    fn what_few_pixels_have_is_worth_its_room_where_digits_are_many() {
        assert_eq!(frac(1024.0, 24), 12);
        assert!(frac(1024.0, 16) > 4);
        assert!(frac(0.0, 24) > 12);
    }
}
