//! A machine's own colours for a scene's inks: an assignment that keeps the order of
//! lightness, with the least distance in the OKLab colour space.

use crate::sema::Image;
use crate::sema::colours::colour;
use crate::source::Diagnostic;
use crate::targets::{System, Target};
use palette::{FromColor, Oklab, Srgb};
use slowlight_isa::c64;
use std::collections::BTreeMap;

/// A colour of a machine's.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Own {
    /// What it is called.
    pub name: String,
    /// Red, green and blue.
    pub rgb: [u8; 3],
}

/// The BBC Micro's physical colours, by their numbers: bits for red, green and blue.
const MICRO: [&str; 8] = [
    "black", "red", "green", "yellow", "blue", "magenta", "cyan", "white",
];

/// Red, green and blue of a physical colour of a BBC Micro's (0 to 7).
pub fn physical(colour: u8) -> [u8; 3] {
    [1, 2, 4].map(|bit| if colour & bit != 0 { 255 } else { 0 })
}

/// The Micro's eight.
pub fn micro() -> Vec<Own> {
    let one = |(number, name): (u8, &&str)| Own {
        name: (*name).to_owned(),
        rgb: physical(number),
    };
    (0..).zip(&MICRO).map(one).collect()
}

/// The Commodore 64's sixteen.
pub fn commodore() -> Vec<Own> {
    let all = c64::NAMES.iter().zip(c64::COLOURS);
    let one = |(name, rgb): (&&str, [u8; 3])| Own {
        name: (*name).to_owned(),
        rgb,
    };
    all.map(one).collect()
}

/// The Agon's 64: two bits each of red, green and blue.
pub fn agon() -> Vec<Own> {
    let level = |n: u8| (n & 3) * 85;
    let one = |n: u8| {
        let [r, g, b] = [level(n >> 4), level(n >> 2), level(n)];
        Own {
            name: format!("#{r:02x}{g:02x}{b:02x}"),
            rgb: [r, g, b],
        }
    };
    (0..64).map(one).collect()
}

/// A colour in OKLab: its lightness, from 0 to 1, and how green or red, blue or yellow it is.
///
/// Source: Björn Ottosson, "A perceptual color space for image processing" (2020).
#[derive(Clone, Copy, Debug, PartialEq)]
struct Seen {
    lightness: f64,
    a: f64,
    b: f64,
}

impl Seen {
    fn of([r, g, b]: [u8; 3]) -> Seen {
        let lab = Oklab::<f64>::from_color(Srgb::new(r, g, b).into_format::<f64>());
        Seen {
            lightness: lab.l,
            a: lab.a,
            b: lab.b,
        }
    }

    /// The square of how different two colours look, ΔE OK2: differences of `a` and `b` count
    /// double, as lightness is the coarser scale.
    ///
    /// Source: Color.js, `deltaE(..., "OK2")`.
    fn off(self, other: Seen) -> f64 {
        let [l, a, b] = self.minus(other);
        l * l + 4.0 * (a * a + b * b)
    }

    fn minus(self, other: Seen) -> [f64; 3] {
        let lightness = self.lightness - other.lightness;
        [lightness, self.a - other.a, self.b - other.b]
    }

    /// Whether a colour that is shown as this one is no paler or stronger version of it, but
    /// another colour: of another hue where the two have one, coloured where it was grey, or
    /// far darker or lighter.
    fn is_another(self, wanted: Seen) -> bool {
        let [lightness, ..] = self.minus(wanted);
        let squared = wanted.a * wanted.a + wanted.b * wanted.b;
        let along = self.a * wanted.a + self.b * wanted.b;
        // The colour wanted, paled as far as is nearest.
        let t = match squared > 0.0 {
            true => (along / squared).clamp(0.0, 1.0),
            false => 0.0,
        };
        let hue = (self.a - t * wanted.a).hypot(self.b - t * wanted.b);
        hue > ANOTHER_HUE || lightness.abs() > ANOTHER_LIGHTNESS
    }
}

/// How far in OKLab's a and b a colour is another one: less than the Micro's palest, cyan, is
/// from grey (0.154).
const ANOTHER_HUE: f64 = 0.1;
/// How far its lightness may be off.
const ANOTHER_LIGHTNESS: f64 = 0.3;

/// What an assignment costs; the first that differs decides.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
struct Cost {
    /// Inks that look like the one before.
    alike: u32,
    /// Inks that are a colour of the machine's and become another.
    moved: u32,
    /// The sum of [`Seen::off`].
    off: f64,
}

/// The colours, by their numbers, that stand for a palette: those of least [`Cost`] of all
/// that keep the order of the inks' lightness. `own` has the machine's, 255 at most. Equal
/// inks have equal colours. An ink of a colour's name is that colour, so its lightness is
/// that colour's.
pub fn assign(palette: &[[u8; 3]], own: &[Own]) -> Vec<u8> {
    let named = |rgb: [u8; 3]| {
        own.iter()
            .position(|o| o.rgb == rgb || colour(&o.name) == Some(rgb))
    };
    let mut inks: Vec<([u8; 3], Option<usize>, Seen)> = Vec::new();
    for &rgb in palette {
        if inks.iter().all(|ink| ink.0 != rgb) {
            let exact = named(rgb);
            let shown = exact.and_then(|k| own.get(k)).map_or(rgb, |o| o.rgb);
            inks.push((rgb, exact, Seen::of(shown)));
        }
    }
    inks.sort_by(|p, q| p.2.lightness.total_cmp(&q.2.lightness).then(p.0.cmp(&q.0)));
    let mut order: Vec<(usize, Seen)> = own.iter().map(|o| Seen::of(o.rgb)).enumerate().collect();
    order.sort_by(|p, q| p.1.lightness.total_cmp(&q.1.lightness));
    // Ink by ink and for each colour it may have, the least cost so far, and the place in
    // `order` of the colour of the ink before.
    let mut rows: Vec<Vec<(Cost, usize)>> = Vec::new();
    for (_, exact, ink) in &inks {
        let mut row = Vec::new();
        for (place, (number, seen)) in order.iter().enumerate() {
            let mut best = (
                Cost {
                    alike: 0,
                    moved: 0,
                    off: 0.0,
                },
                0,
            );
            if let Some(before) = rows.last() {
                let to = |(from, (cost, _)): (usize, &(Cost, usize))| {
                    let alike = cost.alike + u32::from(from == place);
                    (Cost { alike, ..*cost }, from)
                };
                let ways = before.iter().take(place + 1).enumerate().map(to);
                best = ways.fold(
                    to((0, &before[0])),
                    |best, way| if way.0 < best.0 { way } else { best },
                );
            }
            best.0.moved += u32::from(exact.is_some_and(|exact| exact != *number));
            best.0.off += ink.off(*seen);
            row.push(best);
        }
        rows.push(row);
    }
    let ends = rows.last().into_iter().flatten().enumerate();
    let least = ends.min_by(|p, q| {
        p.1.0
            .partial_cmp(&q.1.0)
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    let mut place = least.map_or(0, |(place, _)| place);
    let mut given: BTreeMap<[u8; 3], u8> = BTreeMap::new();
    for (row, ink) in rows.iter().zip(&inks).rev() {
        if let (Some((number, _)), Some((_, before))) = (order.get(place), row.get(place)) {
            given.insert(ink.0, *number as u8);
            place = *before;
        }
    }
    palette
        .iter()
        .filter_map(|rgb| given.get(rgb).copied())
        .collect()
}

/// The colours that a target has, and its name; none where it shows every colour.
fn machine(target: &Target) -> Option<(&'static str, Vec<Own>)> {
    Some(match target.system {
        System::BbcBasic | System::BbcCode => ("a BBC Micro", micro()),
        System::Agon => ("an Agon", agon()),
        System::C64 => ("a Commodore 64", commodore()),
        _ => return None,
    })
}

/// A warning of inks that a target shows in colours that are others, or two alike; none where
/// there are none. It names them, says what there is, and what else one may do.
pub fn remark(image: &Image, target: &Target) -> Option<Diagnostic> {
    let (name, own) = machine(target)?;
    let given = assign(&image.palette, &own);
    let mut all: Vec<([u8; 3], &Own)> = Vec::new();
    for (rgb, number) in image.palette.iter().zip(&given) {
        let shown = own.get(usize::from(*number))?;
        if all.iter().all(|(seen, _)| seen != rgb) {
            all.push((*rgb, shown));
        }
    }
    let others = all.iter().enumerate().filter(|(k, (rgb, shown))| {
        let exact = colour(&shown.name) == Some(*rgb);
        let alike = all.iter().take(*k).any(|(_, other)| other == shown);
        alike || !exact && Seen::of(shown.rgb).is_another(Seen::of(*rgb))
    });
    let said: Vec<String> = others
        .map(|(_, ([r, g, b], shown))| format!("#{r:02x}{g:02x}{b:02x} as {}", shown.name))
        .collect();
    if said.is_empty() {
        return None;
    }
    let grey = |o: &Own| {
        let seen = Seen::of(o.rgb);
        seen.a.hypot(seen.b) < 0.01 && (0.1..0.95).contains(&seen.lightness)
    };
    let count = own.len();
    let has = match own.iter().any(grey) {
        true => format!("it has {count} colours"),
        false => format!("it has {count} colours, and no greys"),
    };
    let names: Vec<&str> = own.iter().map(|o| o.name.as_str()).collect();
    let choose = match count {
        0..=16 => format!("choose among {}", names.join(", ")),
        _ => "choose among those whose red, green and blue are 00, 55, aa or ff".to_owned(),
    };
    let warning = format!("{name} shows ink {}: {has}", listed(&said));
    let help = format!("{choose}, or dither between two of them, black and white say");
    Some(Diagnostic::warning(image.span, warning).help(help))
}

/// `a, b and c`.
fn listed(all: &[String]) -> String {
    match all {
        [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        _ => all.concat(),
    }
}

#[cfg(test)]
#[path = "colours_tests.rs"]
mod tests;
