//! Adaptive sampling by rows: pictures of which a part of the pixels is traced, and the others
//! are what lies between those around them.
//!
//! Every `step`th row is a **key row**, and all of its pixels are traced. Between two of those
//! the rows come by halves: the one in the middle, then the middles of what is left, and so on
//! (Warnock, A Hidden Surface Algorithm for Computer Generated Halftone Pictures, 1969, halves
//! what is not plain yet in the same way). A pixel between has one above and one below it, as
//! many rows away as its own row's number can be halved, and the pixel to its left; what these
//! came to says whether it has to be traced ([`crate::passes::refine`]).

#[cfg(doc)]
use super::node::Node;
use super::node::{Neighbour, NodeId};

/// What a pixel leaves to those that are drawn after it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Refinement {
    /// Rows from one key row to the next: a power of two, at least 2.
    pub step: u32,
    /// By how much neighbours may differ for a pixel not to be traced, of [`LEVELS`].
    pub tolerance: i32,
    /// How many of sixteen pixels between key rows are expected to be traced: for prices.
    pub often: u8,
    /// An int of [`LEVELS`] that others read as [`Node::Neighbour`].
    pub kept: NodeId,
}

/// The greatest int that is kept of a pixel: a byte.
pub const LEVELS: i32 = 255;

impl Refinement {
    /// How many rows above and below a row its pixels' neighbours are; none where it is traced
    /// as a whole, as it is a key row or what would be below it is not in the picture.
    pub fn reach(&self, y: u32, height: u32) -> Option<u32> {
        let reach = 1 << y.trailing_zeros().min(31);
        let between = !y.is_multiple_of(self.step.max(1)) && y + reach < height;
        between.then_some(reach)
    }

    /// Whether a pixel is traced, by what its neighbours above, below and to the left left.
    pub fn traces(&self, y: u32, height: u32, [above, below, left]: [i32; 3]) -> bool {
        let differ = |a: i32, b: i32| (a - b).abs() > self.tolerance;
        self.reach(y, height).is_none() || differ(above, below) || differ((above + below) / 2, left)
    }

    /// What the neighbours of a pixel of a sample may have left: as often the same that as many
    /// pixels are traced as are expected to be.
    pub fn sampled(&self, x: i32, y: i32) -> [i32; 3] {
        let number = x.wrapping_mul(5).wrapping_add(y.wrapping_mul(3));
        match number.rem_euclid(16) < self.often.into() {
            true => Neighbour::ALL.map(Neighbour::alone),
            false => [number.rem_euclid(LEVELS + 1); 3],
        }
    }

    /// The rows that a row hangs on, in an order in which each comes behind those that it
    /// hangs on itself; the row is the last.
    pub fn before(&self, y: u32, height: u32) -> Vec<u32> {
        let mut all = vec![y];
        let mut at = 0;
        while let Some(&y) = all.get(at) {
            if let Some(reach) = self.reach(y, height) {
                for other in [y - reach, y + reach] {
                    if !all.contains(&other) {
                        all.push(other);
                    }
                }
            }
            at += 1;
        }
        // Those with the longest reach first: what they hang on reaches further yet.
        all.sort_by_key(|&y| std::cmp::Reverse(self.reach(y, height).unwrap_or(u32::MAX)));
        all
    }

    /// The first and the last row that have to be computed for some rows: whole bands.
    pub fn computed(&self, (first, last): (u32, u32), height: u32) -> (u32, u32) {
        let step = self.step.max(1);
        let below = last.div_ceil(step) * step;
        (first / step * step, below.min(height.saturating_sub(1)))
    }
}

impl Neighbour {
    /// What a pixel by itself takes for one: no two agree, so it is traced.
    pub fn alone(self) -> i32 {
        match self {
            Neighbour::Above | Neighbour::Left => 0,
            Neighbour::Below => LEVELS,
        }
    }

    /// Its name in a graph's text.
    pub fn name(self) -> &'static str {
        match self {
            Neighbour::Above => "above",
            Neighbour::Below => "below",
            Neighbour::Left => "left",
        }
    }

    /// All of them.
    pub const ALL: [Neighbour; 3] = [Neighbour::Above, Neighbour::Below, Neighbour::Left];
}

#[cfg(test)]
mod tests {
    use super::*;

    const EIGHT: Refinement = Refinement {
        step: 8,
        tolerance: 8,
        often: 6,
        kept: NodeId(0),
    };

    #[test]
    fn rows_between_have_neighbours_at_the_same_distance() {
        let reach: Vec<Option<u32>> = (0..9).map(|y| EIGHT.reach(y, 40)).collect();
        let none = None;
        let some = [1, 2, 1, 4, 1, 2, 1].map(Some);
        assert_eq!(reach, [&[none][..], &some, &[none]].concat());
        // Below the last key row some have none below.
        assert_eq!(
            [33, 34, 36, 39].map(|y| EIGHT.reach(y, 40)),
            [Some(1), Some(2), none, none]
        );
    }

    #[test]
    fn a_row_comes_behind_those_that_it_hangs_on() {
        assert_eq!(EIGHT.before(16, 40), [16]);
        assert_eq!(EIGHT.before(5, 40), [0, 8, 4, 6, 5]);
        for y in 0..40 {
            let order = EIGHT.before(y, 40);
            for (at, &row) in order.iter().enumerate() {
                let reach = EIGHT.reach(row, 40);
                let has = |other: u32| order[..at].contains(&other);
                assert!(
                    reach.is_none_or(|r| has(row - r) && has(row + r)),
                    "{y}: {order:?}"
                );
            }
        }
    }

    #[test]
    fn whole_bands_are_computed() {
        assert_eq!(EIGHT.computed((9, 30), 40), (8, 32));
        assert_eq!(EIGHT.computed((8, 8), 40), (8, 8));
        assert_eq!(EIGHT.computed((0, 39), 40), (0, 39));
    }
}
