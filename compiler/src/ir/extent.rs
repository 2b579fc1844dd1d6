//! Bounding boxes by branch and bound: the least axis-aligned box found outside of which a
//! formula is proved to stay above a level.
//!
//! A signed distance, or any implicit function, is above 0 where its shape is not. Interval
//! evaluation ([`Enclosure`]) proves that of half-spaces at first, which need no other bound:
//! a plane ends so in one direction, a field of columns in two. Where no half-space will do,
//! since what turns a shape mixes coordinates, of the six slabs around ever smaller cubes.
//! Then each face is moved inward as long as the slab that it leaves is proved empty, by halves
//! where need be (Duff, Interval Arithmetic and Recursive Subdivision for Implicit Functions and
//! Constructive Solid Geometry, SIGGRAPH 1992).

use super::enclosure::Enclosure;
use slowlight_routine::Range;

/// A box; faces that are not known lie at infinity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// The least coordinates.
    pub low: [f64; 3],
    /// The greatest.
    pub high: [f64; 3],
}

/// How far out half-spaces are tried, as a power of 2. In cubes, what is farther than twice that
/// is not looked for.
const FAR: i32 = 16;

/// How near to 0, as a power of 2.
const NEAR: i32 = -5;

/// How often a slab is halved: before its box is known, and after.
const COARSE: u32 = 12;
const FINE: u32 = 9;

/// The parts of a width below which faces are not moved, round by round.
const ROUNDS: [f64; 3] = [1.0 / 32.0, 1.0 / 128.0, 1.0 / 512.0];

impl Extent {
    /// Everything.
    pub const ALL: Extent = Extent {
        low: [f64::NEG_INFINITY; 3],
        high: [f64::INFINITY; 3],
    };

    /// Whether all faces are known.
    pub fn is_finite(&self) -> bool {
        let both = self.low.iter().chain(&self.high);
        both.into_iter().all(|face| face.is_finite())
    }

    /// What it covers of each axis.
    pub fn ranges(&self) -> [Range; 3] {
        [0, 1, 2].map(|k| Range::new(self.low[k], self.high[k]))
    }

    /// What both hold.
    pub fn meet(self, other: Extent) -> Extent {
        let of = |k: usize| {
            (
                self.low[k].max(other.low[k]),
                self.high[k].min(other.high[k]),
            )
        };
        match [0, 1, 2].map(of) {
            faces if faces.iter().any(|(low, high)| low > high) => self,
            faces => Extent {
                low: faces.map(|(low, _)| low),
                high: faces.map(|(_, high)| high),
            },
        }
    }

    /// The least that holds both.
    pub fn join(self, other: Extent) -> Extent {
        Extent {
            low: [0, 1, 2].map(|k| self.low[k].min(other.low[k])),
            high: [0, 1, 2].map(|k| self.high[k].max(other.high[k])),
        }
    }

    /// The same with faces farther out by so much along each axis.
    pub fn grown_by(&self, more: [f64; 3]) -> Extent {
        Extent {
            low: [0, 1, 2].map(|k| self.low[k] - more[k]),
            high: [0, 1, 2].map(|k| self.high[k] + more[k]),
        }
    }

    /// The same with faces farther out: by a part of its greatest width and of each face's own
    /// place, which roundings of a ray's way there hang on, and by so much.
    pub fn grown(self, part: f64, by: f64) -> Extent {
        let widths = [0, 1, 2].map(|k| self.high[k] - self.low[k]);
        let most = widths.into_iter().filter(|w| w.is_finite());
        let more = part * most.fold(0.0, f64::max) + by;
        Extent {
            low: self.low.map(|face| face - more - face.abs() * part / 16.0),
            high: self.high.map(|face| face + more + face.abs() * part / 16.0),
        }
    }
}

/// One of a box's faces.
#[derive(Clone, Copy)]
struct Face {
    axis: usize,
    is_high: bool,
}

struct Search<'e, 'b> {
    of: &'e mut Enclosure<'b>,
    level: f64,
    now: Extent,
}

/// The box outside of which the formula is above the level.
pub fn extent(of: &mut Enclosure<'_>, level: f64) -> Extent {
    let mut search = Search {
        of,
        level,
        now: Extent::ALL,
    };
    let faces = [0, 1, 2].into_iter();
    let faces = faces.flat_map(|axis| [true, false].map(|is_high| Face { axis, is_high }));
    let faces: Vec<Face> = faces.collect();
    for &face in &faces {
        search.beyond(face);
    }
    if !search.now.is_finite() {
        search.cubes();
    }
    for least in ROUNDS {
        for &face in &faces {
            search.move_inward(face, least);
        }
    }
    search.now
}

impl Search<'_, '_> {
    /// A face's place, outward.
    fn place(&self, face: Face) -> f64 {
        match face.is_high {
            true => self.now.high[face.axis],
            false => -self.now.low[face.axis],
        }
    }

    fn put(&mut self, face: Face, place: f64) {
        match face.is_high {
            true => self.now.high[face.axis] = place,
            false => self.now.low[face.axis] = -place,
        }
    }

    /// What lies behind a place, as far as another one, within the box's other faces.
    fn region(&self, face: Face, from: f64, to: f64) -> [Range; 3] {
        let mut region = [0, 1, 2].map(|k| Range::new(self.now.low[k], self.now.high[k]));
        region[face.axis] = match face.is_high {
            true => Range::new(from, to),
            false => Range::new(-to, -from),
        };
        region
    }

    /// Whether the formula is proved to be above the level everywhere in a region.
    fn is_empty(&mut self, region: [Range; 3], deep: u32) -> bool {
        if self.of.left() == 0 {
            return false;
        }
        if self.of.of(region).lo > self.level {
            return true;
        }
        let width = |k: usize| region[k].hi - region[k].lo;
        let finite = (0..3).filter(|k| width(*k).is_finite());
        let Some(axis) = finite.max_by(|a, b| width(*a).total_cmp(&width(*b))) else {
            return false;
        };
        let middle = |range: Range| (range.lo + range.hi) / 2.0;
        let at = region.map(|range| Range::point(middle(range)));
        let is_whole = at.iter().all(|range| range.lo.is_finite());
        if deep == 0 || (is_whole && self.of.of(at).hi <= self.level) {
            return false;
        }
        let mut halves = [region; 2];
        halves[0][axis] = Range::new(region[axis].lo, at[axis].lo);
        halves[1][axis] = Range::new(at[axis].lo, region[axis].hi);
        halves.into_iter().all(|half| self.is_empty(half, deep - 1))
    }

    /// Finds a face by half-spaces.
    fn beyond(&mut self, face: Face) {
        let opposite = Face {
            is_high: !face.is_high,
            ..face
        };
        let least = -self.place(opposite);
        let power = |k: i32| f64::from(k).exp2();
        let outward = (NEAR..=FAR).rev().map(power);
        let inward = (NEAR..=FAR).map(|k| -power(k));
        let mut found = None;
        for place in outward.chain([0.0]).chain(inward) {
            if place < least || !self.is_empty(self.region(face, place, f64::INFINITY), 0) {
                break;
            }
            found = Some(place);
        }
        if let Some(place) = found {
            self.put(face, place);
        }
    }

    /// Finds all faces by cubes, each half of the one before.
    fn cubes(&mut self) {
        for k in (NEAR..=FAR).rev() {
            let half = f64::from(k).exp2();
            let around = Range::new(-2.0 * half, 2.0 * half);
            let known = self.now;
            let is_empty = (0..6).all(|k| {
                let mut region = [0, 1, 2].map(|k| {
                    let faces = Range::new(known.low[k], known.high[k]);
                    faces.meet(around)
                });
                let side = match k % 2 {
                    0 => Range::new(half, 2.0 * half),
                    _ => Range::new(-2.0 * half, -half),
                };
                let all = region[k / 2];
                region[k / 2] = side.meet(all);
                side.lo >= all.hi || side.hi <= all.lo || self.is_empty(region, COARSE)
            });
            if !is_empty {
                return;
            }
            self.now = known.meet(Extent {
                low: [-half; 3],
                high: [half; 3],
            });
        }
    }

    /// Moves a face inward as long as nothing is left behind: by steps that double where they
    /// may, and are halved where not.
    fn move_inward(&mut self, face: Face, least: f64) {
        if !self.place(face).is_finite() {
            return;
        }
        let mut part = least;
        let mut is_growing = true;
        loop {
            let place = self.place(face);
            let width = self.now.high[face.axis] - self.now.low[face.axis];
            let width = if width.is_finite() {
                width
            } else {
                place.abs().max(1.0)
            };
            let to = place - part * width;
            if self.is_empty(self.region(face, to, place), FINE) {
                self.put(face, to);
                part = if is_growing { 2.0 * part } else { part };
                if part < 1.0 {
                    continue;
                }
            }
            is_growing = false;
            part /= 2.0;
            if part < least || self.of.left() == 0 {
                return;
            }
        }
    }
}
