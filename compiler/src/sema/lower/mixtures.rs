//! Mixtures of two inks that stand for colours: a palette's own ordered dither, by tables over a
//! lattice of colours (after J. Yliluoma, "Joel Yliluoma's arbitrary-palette positional dithering
//! algorithm", 2011).

use super::value::{Table, Val};
use super::{Found, Lower};
use crate::sema::builtins::Mixture;
use crate::sema::program::*;
use crate::source::{Diagnostic, Span};
use std::rc::Rc;

/// The lattice's points along red, green and blue.
const SIDES: std::ops::RangeInclusive<i32> = 2..=6;

/// The shares of the second ink are so many parts of one.
const PARTS: u32 = 16;

/// What counts of red, green and blue, and of how light a colour is (Rec. 601).
const WEIGHTS: [f64; 3] = [0.299, 0.587, 0.114];

/// How much less two inks may be apart from each other than their mixture from the colour.
const APART: f64 = 0.01;

/// Two inks, and how many parts of the second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Pair {
    inks: [usize; 2],
    parts: u32,
}

type Colour = [f64; 3];

fn light(of: Colour) -> f64 {
    of.iter()
        .zip(WEIGHTS)
        .map(|(part, weight)| part * weight)
        .sum()
}

/// How far two colours are from each other.
fn apart(a: Colour, b: Colour) -> f64 {
    let parts = a.iter().zip(b).zip(WEIGHTS);
    let parts: f64 = parts
        .map(|((a, b), weight)| (a - b) * (a - b) * weight)
        .sum();
    let lighter = light(a) - light(b);
    0.75 * parts + lighter * lighter
}

/// The share of the second colour with which the two are nearest to a third.
fn share(of: Colour, a: Colour, b: Colour) -> f64 {
    let (mut along, mut length) = (0.0, 0.0);
    for k in 0..3 {
        along += (of[k] - a[k]) * (b[k] - a[k]) * WEIGHTS[k];
        length += (b[k] - a[k]) * (b[k] - a[k]) * WEIGHTS[k];
    }
    match length > 0.0 {
        true => (along / length).clamp(0.0, 1.0),
        false => 0.0,
    }
}

/// The two inks that make a colour best.
fn best(of: Colour, palette: &[Colour]) -> Pair {
    let mut best = (
        f64::INFINITY,
        Pair {
            inks: [0; 2],
            parts: 0,
        },
    );
    for (first, &a) in palette.iter().enumerate() {
        for (second, &b) in palette.iter().enumerate().skip(first) {
            let parts = (share(of, a, b) * f64::from(PARTS)).round();
            let part = parts / f64::from(PARTS);
            let mixed = std::array::from_fn(|k| a[k] + (b[k] - a[k]) * part);
            // One ink alone has no grain.
            let grain = match part > 0.0 && part < 1.0 {
                true => APART * apart(a, b) * ((part - 0.5).abs() + 0.5),
                false => 0.0,
            };
            let error = apart(of, mixed) + grain;
            if error < best.0 {
                let inks = [first, second];
                best = (
                    error,
                    Pair {
                        inks,
                        parts: parts as u32,
                    },
                );
            }
        }
    }
    best.1
}

/// The mixtures of all points of a lattice, red first.
fn mixtures(palette: &[[u8; 3]], side: u32) -> Vec<Pair> {
    let colour = |rgb: &[u8; 3]| rgb.map(|part| f64::from(part) / 255.0);
    let palette: Vec<Colour> = palette.iter().map(colour).collect();
    let at = |k: u32| f64::from(k) / f64::from(side - 1);
    let points =
        (0..side).flat_map(|z| (0..side).flat_map(move |y| (0..side).map(move |x| [x, y, z])));
    points.map(|point| best(point.map(at), &palette)).collect()
}

impl<'a> Lower<'a> {
    /// A table over a lattice with so many points along each side.
    pub(super) fn mixture(&mut self, which: Mixture, side: &'a Expr, span: Span) -> Found<Val> {
        let points = self.known_int(side, "the lattice's side")?;
        if !SIDES.contains(&points) {
            let message = format!("no lattice of colours has {points} points a side");
            let error: Diagnostic = self.error(side.span, message);
            let (least, most) = (SIDES.start(), SIDES.end());
            return Err(Box::new(error.help(format!("it has {least} to {most}"))));
        }
        if let Some(found) = self.tables.mixtures.get(&(which, points)) {
            return Ok(Val::Table(found.clone()));
        }
        let found = mixtures(&self.image.palette, points.unsigned_abs());
        let entry = |pair: &Pair| match which {
            Mixture::First => Val::Node(self.int(pair.inks[0] as i32, span)),
            Mixture::Second => Val::Node(self.int(pair.inks[1] as i32, span)),
            Mixture::Share => {
                let share = f64::from(pair.parts) / f64::from(PARTS);
                Val::Node(self.real(share, span))
            }
        };
        let entries: Vec<Val> = found.iter().map(entry).collect();
        let table = Rc::new(Table {
            name: which.name().to_owned(),
            width: entries.len(),
            entries,
        });
        self.tables.mixtures.insert((which, points), table.clone());
        Ok(Val::Table(table))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BLACK: [u8; 3] = [0; 3];
    const WHITE: [u8; 3] = [255; 3];
    const RED: [u8; 3] = [255, 0, 0];
    const GREEN: [u8; 3] = [0, 255, 0];

    fn mixed(palette: &[[u8; 3]], pair: Pair) -> Colour {
        let share = f64::from(pair.parts) / f64::from(PARTS);
        let [a, b] = pair
            .inks
            .map(|ink| palette[ink].map(|part| f64::from(part) / 255.0));
        std::array::from_fn(|k| a[k] + (b[k] - a[k]) * share)
    }

    #[test]
    fn what_is_an_ink_is_that_ink() {
        let palette = [BLACK, RED, GREEN, WHITE];
        for side in [2, 5, 6] {
            let all = mixtures(&palette, side);
            let last = (side - 1) as usize;
            let at =
                |x: usize, y: usize, z: usize| all[x + side as usize * (y + side as usize * z)];
            for (point, colour) in [
                (at(0, 0, 0), BLACK),
                (at(last, 0, 0), RED),
                (at(0, last, 0), GREEN),
                (at(last, last, last), WHITE),
            ] {
                assert_eq!(mixed(&palette, point), colour.map(|c| f64::from(c) / 255.0));
            }
        }
    }

    #[test]
    fn greys_and_dark_reds_are_mixed_of_two() {
        let palette = [BLACK, RED, WHITE];
        let all = mixtures(&palette, 5);
        // A quarter of red, half of white.
        assert_eq!(
            all[1],
            Pair {
                inks: [0, 1],
                parts: 4
            }
        );
        assert_eq!(
            all[2 + 5 * (2 + 5 * 2)],
            Pair {
                inks: [0, 2],
                parts: 8
            }
        );
        // No ink has blue: the nearest mixtures of what there is are no worse than black.
        let blue = [0.0, 0.0, 1.0];
        let made = mixed(&palette, all[5 * 5 * 4]);
        assert!(apart(made, blue) <= apart([0.0; 3], blue));
    }
}
