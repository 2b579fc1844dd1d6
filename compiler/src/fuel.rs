//! Fuel: a budget of counted work, for searches that could go on for too long.
//!
//! Work is counted in units of some nanoseconds of one processor: a statement walked with
//! intervals is a few of them, one that is written as machine code some thousand. Units are
//! counted, never timed, so that what is found is the same on every machine and whatever
//! threads do: searches that run at the same time have a share each, and what is kept from
//! before is charged as if it were made anew.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// How much work may be done yet. Who does some [`Fuel::burn`]s its units; who could go on
/// searching asks [`Fuel::spent`] before each try.
#[derive(Debug)]
pub struct Fuel {
    given: u64,
    /// Perhaps more than was given: work is not broken off in the middle.
    burnt: AtomicU64,
    /// Whether a search ended because nothing was left.
    cut: AtomicBool,
}

impl Fuel {
    /// So many units.
    pub fn new(units: u64) -> Fuel {
        Fuel {
            given: units,
            burnt: AtomicU64::new(0),
            cut: AtomicBool::new(false),
        }
    }

    /// Units that there were at first.
    pub fn given(&self) -> u64 {
        self.given
    }

    /// Work was done.
    pub fn burn(&self, units: u64) {
        self.burnt.fetch_add(units, Ordering::Relaxed);
    }

    /// Whether nothing is left, which is noted: a search ends here.
    pub fn spent(&self) -> bool {
        let spent = self.left() == 0;
        if spent {
            self.note_cut();
        }
        spent
    }

    /// Notes that a search was ended, or made shorter, for want of fuel.
    pub fn note_cut(&self) {
        self.cut.store(true, Ordering::Relaxed);
    }

    /// Units left.
    pub fn left(&self) -> u64 {
        self.given.saturating_sub(self.burnt())
    }

    /// Units burnt.
    pub fn burnt(&self) -> u64 {
        self.burnt.load(Ordering::Relaxed)
    }

    /// Whether a search ended because nothing was left.
    pub fn was_cut(&self) -> bool {
        self.cut.load(Ordering::Relaxed)
    }

    /// As much as is left, for a search of its own, one of two at the same time perhaps: what
    /// it burns is charged once it has ended ([`Fuel::settle`]).
    pub fn share(&self) -> Fuel {
        Fuel::new(self.left())
    }

    /// Burns what a search with fuel of its own has burnt, and notes whether it was cut.
    pub fn settle(&self, share: &Fuel) {
        self.burn(share.burnt());
        self.cut.fetch_or(share.was_cut(), Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_charged_to_the_whole() {
        let fuel = Fuel::new(1000);
        fuel.burn(200);
        let shares = [fuel.share(), fuel.share()];
        assert_eq!(shares.each_ref().map(Fuel::left), [800, 800]);
        shares[0].burn(100);
        shares[1].burn(850);
        assert!(!shares[0].spent() && shares[1].spent());
        shares.iter().for_each(|share| fuel.settle(share));
        assert_eq!((fuel.left(), fuel.burnt()), (0, 1150));
        assert!(fuel.was_cut() && fuel.spent());
    }
}
