//! Pencils of rays, and projections: where boxes are seen from a point, or along a direction.
//!
//! A point is seen by what its line has of two axes for each unit of a third. So lines are told
//! apart and not their two directions: of what lies behind the point is seen where the same line
//! meets it.

use crate::ir::extent::Extent;
use slowlight_routine::Range;

/// What the rays of one place have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Pencil {
    /// They pass a point, beside it by at most so much along each axis.
    Through {
        point: [f64; 3],
        beside: [f64; 3],
        /// Whether they start at it.
        starts: bool,
    },
    /// They lead along one direction, forwards or backwards.
    Along([f64; 3]),
}

impl Pencil {
    /// Rays that start at a point.
    pub(super) fn from(point: [f64; 3]) -> Pencil {
        Pencil::Through {
            point,
            beside: [0.0; 3],
            starts: true,
        }
    }
}

/// In which order a cell's shapes are asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Order {
    /// As they stand in the scene.
    Given,
    /// What is nearest to the point first.
    Nearest,
    /// What is seen largest first, which most lines meet.
    Largest,
}

/// How near a box may be to a point, in parts of how far its own far side is, to be seen from it.
const NEAR: f64 = 1.0 / 64.0;

/// By what part lengths are other than they should, by roundings, in any format.
pub(super) const SLACK: f64 = 1.0 / 64.0;

/// How many slices of what is seen in a cell are asked whether a shape is there.
const SLICES: usize = 8;

/// By how many units of rounding a ray is elsewhere than it should.
const ROUNDINGS: f64 = 8.0;

/// How places are seen: by what of two axes, for each unit of the third.
#[derive(Clone, Copy)]
pub(super) struct Projection {
    pub(super) pencil: Pencil,
    pub(super) ahead: usize,
}

impl Projection {
    /// The axes across, and the one ahead.
    pub(super) fn axes(self) -> [usize; 3] {
        [(self.ahead + 1) % 3, (self.ahead + 2) % 3, self.ahead]
    }

    /// Where a box is seen; none where the point is not before or behind it.
    pub(super) fn seen(self, of: &Extent) -> Option<[Range; 2]> {
        let [u, v, w] = self.axes();
        let seen = |axis: usize| match self.pencil {
            Pencil::Through { point, beside, .. } => {
                let of = of.grown_by(beside);
                let [near, far] = [of.low[w], of.high[w]].map(|face| face - point[w]);
                let (least, most) = (near.abs().min(far.abs()), near.abs().max(far.abs()));
                if near * far <= 0.0 || least < NEAR * most {
                    return None;
                }
                let faces = [of.low[axis], of.high[axis]].map(|face| face - point[axis]);
                Some(hull(faces, |face| [face / near, face / far]))
            }
            Pencil::Along(dir) => {
                let slope = dir[axis] / dir[w];
                let faces = [of.low[axis], of.high[axis]];
                Some(hull(faces, |face| {
                    [face - slope * of.low[w], face - slope * of.high[w]]
                }))
            }
        };
        Some([seen(u)?, seen(v)?])
    }

    /// How far a box is from the point at least, with room for roundings.
    pub(super) fn distance(self, of: &Extent) -> f64 {
        let Pencil::Through { point, .. } = self.pencil else {
            return 0.0;
        };
        let outside = |k: usize| (of.low[k] - point[k]).max(point[k] - of.high[k]).max(0.0);
        let [x, y, z] = [0, 1, 2].map(outside);
        (1.0 - SLACK) * (x * x + y * y + z * z).sqrt()
    }

    /// What of a box is seen in a part of the picture, in slices.
    pub(super) fn slices(self, [u, v]: [Range; 2], of: &Extent) -> Vec<[Range; 3]> {
        let [a, b, w] = self.axes();
        let at = |k: usize| of.low[w] + (of.high[w] - of.low[w]) * k as f64 / SLICES as f64;
        let slice = |k: usize| {
            let ends = [at(k), at(k + 1)];
            let across = |axis: usize, seen: Range| match self.pencil {
                Pencil::Through { point, beside, .. } => {
                    // A line beside the point is there by that much sooner or later.
                    let ends = [ends[0] - beside[w], ends[1] + beside[w]];
                    let there = hull(ends, |end| {
                        [seen.lo, seen.hi].map(|seen| point[axis] + seen * (end - point[w]))
                    });
                    Range::new(there.lo - beside[axis], there.hi + beside[axis])
                }
                Pencil::Along(dir) => hull(ends, |end| {
                    [seen.lo, seen.hi].map(|seen| seen + dir[axis] / dir[w] * end)
                }),
            };
            let mut all = of.ranges();
            (all[a], all[b]) = (across(a, u), across(b, v));
            all[w] = Range::new(ends[0], ends[1]);
            all
        };
        (0..SLICES).map(slice).collect()
    }

    /// By how much roundings move what is seen in a window, and how much of a direction of length 1
    /// is ahead at least. Parallel rays that start far behind the shapes are off by more, and so
    /// are their hits.
    pub(super) fn room(self, window: [Range; 2], of: &Extent, epsilon: f64) -> (f64, f64) {
        let [u, v, w] = self.axes();
        let [a, b] = window.map(|side| side.lo.abs().max(side.hi.abs()));
        let ahead = 1.0 / (1.0 + a * a + b * b).sqrt();
        let size = match self.pencil {
            Pencil::Through { .. } => (1.0 + a.max(b)) / ahead,
            Pencil::Along(dir) => {
                let faces = of.low.iter().chain(&of.high);
                let farthest = faces.fold(0.0, |most: f64, face| most.max(face.abs()));
                let slope = (dir[u] / dir[w]).abs().max((dir[v] / dir[w]).abs());
                2.0 * farthest * (1.0 + slope)
            }
        };
        (ROUNDINGS * epsilon * size, ahead)
    }
}

/// What two faces are mapped to.
fn hull(faces: [f64; 2], to: impl Fn(f64) -> [f64; 2]) -> Range {
    let all = faces.into_iter().flat_map(to);
    let (lo, hi) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), at| {
        (lo.min(at), hi.max(at))
    });
    Range::new(lo, hi)
}

pub(super) fn joined(a: Range, b: Range) -> Range {
    Range::new(a.lo.min(b.lo), a.hi.max(b.hi))
}
