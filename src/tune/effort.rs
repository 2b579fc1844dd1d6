//! A budget of counted work, and what of a search is worth it: a ranking by dominance of what is
//! expected, taken from the front while the budget lasts.
//!
//! Work is counted ([`super::work`]), never timed, so that what is found hangs neither on the
//! machine nor on its threads.

use super::rows::Look;
use crate::target_args::Among;

/// What settings may take where they are drawn natively, in operations.
const DRAFTS: f64 = 2e9;

/// What may be spent on plans and on first looks at them, beside whole pictures in each format.
const LOOKS: f64 = 1.5e10;

/// What may be spent on whole pictures.
const WHOLES: f64 = 3.5e10;

/// What may be done for one choice's plan: of all choices by far the most need no tenth of it.
const PLAN: Among = Among {
    fit: 200_000_000,
    modelled: 50_000_000,
};

/// How much work may be done: so many times the usual, which is to take less than a minute on
/// two processors; or all there is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort(Option<u16>);

impl Effort {
    /// Whatever it takes.
    pub const ALL: Effort = Effort(None);

    /// So many times the usual.
    pub fn times(usual: u16) -> Effort {
        Effort(Some(usual))
    }

    fn of(self, work: f64) -> f64 {
        self.0
            .map_or(f64::INFINITY, |times| f64::from(times) * work)
    }

    /// Operations that settings may take.
    pub fn drafts(self) -> f64 {
        self.of(DRAFTS)
    }

    /// Work for plans and first looks.
    pub fn looks(self) -> f64 {
        self.of(LOOKS)
    }

    /// Work for whole pictures.
    pub fn wholes(self) -> f64 {
        self.of(WHOLES)
    }

    /// What may be done for a choice's plan; none is as much as `build` does.
    pub fn plan(self) -> Option<Among> {
        self.0.map(|times| Among {
            fit: PLAN.fit * u64::from(times),
            modelled: PLAN.modelled * u64::from(times),
        })
    }
}

/// What is spent at most on what something else is as good as: one part in so many.
const SECOND: f64 = 3.0;

/// By how much another is cheaper and better at once: a factor above 1, and 1 where it is the
/// same and comes before; below 1 where nothing is as good.
fn behind(at: usize, all: &[Option<Look>]) -> f64 {
    let Some(Some(own)) = all.get(at) else {
        return 0.0;
    };
    let pixel = 1.0 / own.pixels.max(1.0);
    let others = all.iter().enumerate().filter(|(k, _)| *k != at);
    let factors = others.filter_map(|(k, other)| {
        let other = other.as_ref()?;
        let cheaper = own.cycles / other.cycles.max(1.0);
        let better = (own.error + pixel) / (other.error + pixel);
        let same = cheaper == 1.0 && better == 1.0;
        Some(cheaper.min(better)).filter(|_| !same || k < at)
    });
    factors.fold(0.0, f64::max)
}

/// Items in the order of their worth, by what is expected of each and of what is there already:
/// first those that nothing is as good as, the slowest, which is the best, and then from the
/// quickest on; then the others, the less behind the sooner. With each, whether it is of the
/// first, as is what nothing is known of.
pub fn by_worth<T>(
    items: Vec<T>,
    look: impl Fn(&T) -> Option<Look>,
    there: &[Look],
) -> Vec<(bool, T)> {
    let mut looks: Vec<Option<Look>> = items.iter().map(look).collect();
    let count = looks.len();
    looks.extend(there.iter().copied().map(Some));
    let key = |k: usize| {
        let behind = behind(k, &looks);
        let cycles = looks.get(k).copied().flatten().map_or(0.0, |l| l.cycles);
        (if behind < 1.0 { 0.0 } else { behind }, cycles)
    };
    let keys: Vec<(f64, f64)> = (0..count).map(key).collect();
    let mut all: Vec<((f64, f64), T)> = keys.into_iter().zip(items).collect();
    all.sort_by(|((a, c), _), ((b, d), _)| a.total_cmp(b).then(c.total_cmp(d)));
    let first = |(behind, _): (f64, f64)| behind < 1.0;
    let ends = all.iter().take_while(|(key, _)| first(*key)).count();
    if let Some(front) = all.get_mut(..ends).filter(|front| !front.is_empty()) {
        front.rotate_right(1);
    }
    all.into_iter()
        .map(|(key, item)| (first(key), item))
        .collect()
}

/// Those of some items that a budget allows, in their order, and the others: what is too dear
/// leaves the budget to those behind it. Of what something else is as good as, as far as can be
/// expected, only so much is taken as a part of the budget allows.
pub fn within<T>(items: Vec<(bool, T)>, cost: impl Fn(&T) -> f64, most: f64) -> (Vec<T>, Vec<T>) {
    let mut spent = 0.0;
    let (mut taken, mut left) = (Vec::new(), Vec::new());
    for (first, item) in items {
        let cost = cost(&item);
        match spent + cost <= if first { most } else { most / SECOND } {
            true => {
                spent += cost;
                taken.push(item);
            }
            false => left.push(item),
        }
    }
    (taken, left)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn look(cycles: f64, error: f64) -> Look {
        Look {
            cycles,
            before: 0.0,
            error,
            pixels: 1e4,
        }
    }

    #[test]
    fn what_is_on_the_frontier_comes_first_and_what_is_too_dear_is_left_out() {
        let all = vec![
            ("dear", look(9e9, 0.0)),
            ("twice as dear and no better", look(4e8, 0.1)),
            ("quick", look(1e8, 0.3)),
            ("a little behind", look(2.2e8, 0.1)),
            ("middling", look(2e8, 0.1)),
            ("the same", look(2e8, 0.1)),
            ("as one that is there, and dearer", look(1.2e7, 0.4)),
        ];
        let there = [look(1e7, 0.4)];
        let sorted = by_worth(all, |(_, look)| Some(*look), &there);
        let cost = |(_, look): &(&str, Look)| look.cycles;
        let names = |all: Vec<(&'static str, Look)>| -> Vec<&'static str> {
            all.into_iter().map(|(name, _)| name).collect()
        };
        let (taken, left) = within(sorted.clone(), cost, 4e9);
        assert_eq!(
            names(taken),
            [
                "quick",
                "middling",
                "as one that is there, and dearer",
                "the same",
                "a little behind",
                "twice as dear and no better",
            ]
        );
        assert_eq!(names(left), ["dear"]);
        // The best comes first, if it can be had at all.
        let (taken, _) = within(sorted.clone(), cost, 9.05e9);
        assert_eq!(names(taken), ["dear"]);
        // Of what is behind, only as much as a third of the budget pays for.
        let (taken, _) = within(sorted, cost, 1.6e9);
        assert_eq!(
            names(taken),
            [
                "quick",
                "middling",
                "as one that is there, and dearer",
                "the same"
            ]
        );
    }

    #[test]
    fn more_effort_is_more_of_everything() {
        let (one, two) = (Effort::times(1), Effort::times(2));
        assert!(two.drafts() > one.drafts() && two.looks() > one.looks());
        assert!(
            two.wholes() > one.wholes() && two.plan().map(|p| p.fit) > one.plan().map(|p| p.fit)
        );
        assert_eq!(Effort::ALL.wholes(), f64::INFINITY);
        assert!(Effort::ALL.plan().is_none());
    }
}
