//! Frontiers: of ways to do something, those than which none is both cheaper and better.
//!
//! A way has a cost and an error, both to be small. One *dominates* another where it is no
//! worse in either and better in one; what nothing dominates is the (Pareto) frontier, and
//! a person chooses from it alone, since every other way gives something up for nothing.

use std::cmp::Ordering;

/// What a way costs and how far off it is, in any units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Way {
    /// What it costs.
    pub cost: f64,
    /// How far off it is.
    pub error: f64,
}

impl Way {
    /// Whether it makes another pointless.
    pub fn dominates(self, other: Way) -> bool {
        let no_worse = self.cost <= other.cost && self.error <= other.error;
        no_worse && (self.cost < other.cost || self.error < other.error)
    }
}

/// For each way, the place of one that dominates it, itself dominated by none; nothing for
/// those on the frontier. Of ways that are alike in both, only the first is on it.
pub fn dominated(ways: &[Way]) -> Vec<Option<usize>> {
    let mut order: Vec<usize> = (0..ways.len()).collect();
    let at = |k: usize| (ways[k].cost, ways[k].error);
    order.sort_by(|&a, &b| {
        let ((cost_a, error_a), (cost_b, error_b)) = (at(a), at(b));
        cost_a
            .total_cmp(&cost_b)
            .then(error_a.total_cmp(&error_b))
            .then(a.cmp(&b))
    });
    let mut found = vec![None; ways.len()];
    // From the cheapest on: whatever is not better than the best so far is dominated by it.
    let mut best: Option<usize> = None;
    for k in order {
        match best {
            Some(b) if ways[b].error <= ways[k].error => found[k] = Some(b),
            _ => best = Some(k),
        }
    }
    found
}

/// How well two lists agree on what is more: Spearman's rank correlation, from -1 to 1.
/// Equal values share the mean of their ranks. Nothing for fewer than two pairs, or where
/// a list has one value only.
pub fn rank_correlation(pairs: &[(f64, f64)]) -> Option<f64> {
    let (a, b): (Vec<f64>, Vec<f64>) = pairs.iter().copied().unzip();
    let (a, b) = (ranks(&a), ranks(&b));
    let mean = (a.len() as f64 + 1.0) / 2.0;
    let sum = |x: &[f64], y: &[f64]| -> f64 {
        x.iter().zip(y).map(|(x, y)| (x - mean) * (y - mean)).sum()
    };
    let spread = sum(&a, &a) * sum(&b, &b);
    (spread > 0.0).then(|| sum(&a, &b) / spread.sqrt())
}

/// Each value's rank, from 1; equal values share the mean of theirs.
fn ranks(values: &[f64]) -> Vec<f64> {
    let less = |v: f64| {
        values
            .iter()
            .filter(|w| w.total_cmp(&v) == Ordering::Less)
            .count()
    };
    let same = |v: f64| {
        values
            .iter()
            .filter(|w| w.total_cmp(&v) == Ordering::Equal)
            .count()
    };
    values
        .iter()
        .map(|&v| less(v) as f64 + (same(v) as f64 + 1.0) / 2.0)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ways(list: &[(f64, f64)]) -> Vec<Way> {
        list.iter()
            .map(|&(cost, error)| Way { cost, error })
            .collect()
    }

    #[test]
    fn what_is_dominated_is_known_by_what_dominates_it() {
        let all = ways(&[
            (1.0, 9.0),
            (4.0, 4.0),
            (5.0, 4.0),
            (9.0, 0.0),
            (6.0, 5.0),
            (1.0, 9.0),
        ]);
        assert_eq!(
            dominated(&all),
            [None, None, Some(1), None, Some(1), Some(0)]
        );
        assert!(dominated(&[]).is_empty());
    }

    #[test]
    fn the_frontier_is_what_nothing_dominates() {
        // All pairs of residues: held against the definition.
        let all: Vec<Way> = (0..60u32)
            .map(|k| Way {
                cost: f64::from(k * 37 % 11),
                error: f64::from(k * 53 % 13),
            })
            .collect();
        let found = dominated(&all);
        for (k, way) in all.iter().enumerate() {
            let worse = all.iter().any(|other| other.dominates(*way));
            let twin = all[..k].contains(way);
            assert_eq!(found[k].is_some(), worse || twin, "{way:?}");
            if let Some(by) = found[k] {
                assert!(all[by].dominates(*way) || all[by] == *way);
                assert_eq!(found[by], None);
            }
        }
    }

    #[test]
    fn ranks_agree_or_do_not() {
        let up: Vec<(f64, f64)> = (0..9).map(|k| (f64::from(k), f64::from(k * k))).collect();
        let down: Vec<(f64, f64)> = up.iter().map(|(a, b)| (*a, -b)).collect();
        assert_eq!(rank_correlation(&up), Some(1.0));
        assert_eq!(rank_correlation(&down), Some(-1.0));
        // By hand: ranks 1 2 3 4 against 1.5 1.5 4 3.
        let tied = [(1.0, 5.0), (2.0, 5.0), (3.0, 9.0), (4.0, 7.0)];
        let by_hand = 3.5 / (5.0f64 * 4.5).sqrt();
        assert!((rank_correlation(&tied).unwrap_or(0.0) - by_hand).abs() < 1e-12);
        assert_eq!(rank_correlation(&[(1.0, 1.0)]), None);
        assert_eq!(rank_correlation(&[(1.0, 1.0), (1.0, 2.0)]), None);
    }
}
