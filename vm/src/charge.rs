//! Where a program's time goes, place by place, with routines charged to who calls them.
//!
//! A place is what a machine counts by: a line of BASIC, an address of the 6502,
//! a command of the Hack VM. Some places are *routines'*: what is carried out
//! there on behalf of a place that is not is charged to that caller, however
//! deep the routines call each other, so that a multiplication costs the line that
//! multiplies. Nothing is counted twice or lost: all charges together are the run.

use std::collections::{BTreeMap, HashMap};

/// What a machine's places are to who counts.
#[derive(Clone, Copy)]
pub struct Roles<'r> {
    /// Whether a place is a routine's.
    pub routine: &'r dyn Fn(u32) -> bool,
    /// The group whose stretches a place's cycles are part of, if any.
    pub group: &'r dyn Fn(u32) -> Option<u16>,
    /// Whether stretches end where a place begins: between two pixels, say.
    pub cuts: &'r dyn Fn(u32) -> bool,
}

impl<'r> Roles<'r> {
    /// Some places are routines', and no stretches are told.
    pub fn routines(routine: &'r dyn Fn(u32) -> bool) -> Roles<'r> {
        Roles {
            routine,
            group: &|_| None,
            cuts: &|_| false,
        }
    }
}

/// What was counted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Charges {
    /// By place and routine.
    pub places: Vec<Charge>,
    /// By group: the cycles of each stretch from one cut to the next in which there were any.
    pub stretches: BTreeMap<u16, Vec<u64>>,
    /// How often a cut came after something else: how many stretches there were at most.
    pub cuts: u64,
}

impl Charges {
    /// With a machine's own share added to all counts, as `shown` adds it to a sum.
    pub(crate) fn shared(mut self, start: u64, shown: impl Fn(u64) -> u64) -> Charges {
        let mut before = start;
        for charge in &mut self.places {
            let from = shown(before);
            before += charge.cycles;
            charge.cycles = shown(before) - from;
        }
        for cycles in self.stretches.values_mut().flatten() {
            *cycles = shown(start + *cycles) - shown(start);
        }
        self
    }
}

/// What one place of a program took.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Charge {
    /// The place.
    pub place: u32,
    /// The routine called from there, by its first place; none for what the place does itself.
    pub routine: Option<u32>,
    /// How often the place was begun, or the routine called from it.
    pub times: u64,
    /// The machine's cycles.
    pub cycles: u64,
}

/// Stretches under way.
#[derive(Clone, Debug, Default)]
struct Stretches {
    group: Vec<Option<u16>>,
    cuts: Vec<bool>,
    /// The groups that had any cycles since the last cut.
    now: BTreeMap<u16, u64>,
    done: BTreeMap<u16, Vec<u64>>,
    /// Whether what began last cuts, and how often that came after what does not.
    cutting: bool,
    count: u64,
}

impl Stretches {
    /// Cycles that a place is charged with.
    #[inline]
    fn add(&mut self, place: u32, cycles: u64) {
        if let Some(Some(group)) = self.group.get(place as usize) {
            *self.now.entry(*group).or_default() += cycles;
        }
    }

    /// A place begins.
    #[inline]
    fn begin(&mut self, place: u32) {
        let cuts = self.cuts.get(place as usize) == Some(&true);
        if cuts && !self.cutting {
            self.count += 1;
            self.cut();
        }
        self.cutting = cuts;
    }

    fn cut(&mut self) {
        for (group, cycles) in std::mem::take(&mut self.now) {
            self.done.entry(group).or_default().push(cycles);
        }
    }
}

#[derive(Clone, Copy, Debug, Default)]
struct Taken {
    times: u64,
    cycles: u64,
}

/// A place that is charged itself, and what it calls now.
#[derive(Clone, Copy, Debug)]
struct Caller {
    /// How deep in calls it is.
    depth: u32,
    place: u32,
    /// The first place of the routine that it has called, and that one's cycles so far.
    called: Option<(u32, u64)>,
}

/// Charges under way.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ledger {
    routine: Vec<bool>,
    own: Vec<Taken>,
    called: HashMap<(u32, u32), Taken>,
    /// Who is charged, each deeper than the one before.
    callers: Vec<Caller>,
    stretches: Stretches,
}

impl Ledger {
    /// For `places` places, numbered from 0.
    pub fn new(places: usize, roles: Roles<'_>) -> Ledger {
        let all = 0..places as u32;
        Ledger {
            routine: all.clone().map(roles.routine).collect(),
            own: vec![Taken::default(); places],
            stretches: Stretches {
                group: all.clone().map(roles.group).collect(),
                cuts: all.map(roles.cuts).collect(),
                ..Stretches::default()
            },
            ..Ledger::default()
        }
    }

    /// Charges a step at a place, `depth` calls deep; `begins` where the place begins with it.
    #[inline]
    pub fn step(&mut self, place: u32, depth: u32, cycles: u64, begins: bool) {
        let routine = self.routine.get(place as usize) == Some(&true);
        while let Some(last) = self.callers.last_mut() {
            if routine && last.depth < depth {
                last.called.get_or_insert((place, 0)).1 += cycles;
                self.stretches.add(last.place, cycles);
                return;
            }
            if last.depth < depth {
                break;
            }
            self.leave();
        }
        self.callers.push(Caller {
            depth,
            place,
            called: None,
        });
        if let Some(own) = self.own.get_mut(place as usize) {
            own.times += u64::from(begins);
            own.cycles += cycles;
        }
        if begins {
            self.stretches.begin(place);
        }
        self.stretches.add(place, cycles);
    }

    /// The last caller's routine is done.
    fn leave(&mut self) {
        if let Some(caller) = self.callers.pop()
            && let Some((entry, cycles)) = caller.called
        {
            let taken = self.called.entry((caller.place, entry)).or_default();
            taken.times += 1;
            taken.cycles += cycles;
        }
    }

    /// All charges.
    pub fn finish(mut self) -> Charges {
        while !self.callers.is_empty() {
            self.leave();
        }
        let charge = |place, routine, taken: &Taken| Charge {
            place,
            routine,
            times: taken.times,
            cycles: taken.cycles,
        };
        let own = (0..).zip(&self.own);
        let own = own.map(|(place, taken)| charge(place, None, taken));
        let called = self.called.iter();
        let called = called.map(|((place, entry), taken)| charge(*place, Some(*entry), taken));
        let mut all: Vec<Charge> = own.chain(called).collect();
        all.retain(|charge| (charge.times, charge.cycles) != (0, 0));
        all.sort_unstable();
        self.stretches.cut();
        Charges {
            places: all,
            stretches: self.stretches.done,
            cuts: self.stretches.count,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Places from 10 on are routines'.
    fn charged(steps: &[(u32, u32, u64)]) -> Vec<(u32, Option<u32>, u64, u64)> {
        let mut ledger = Ledger::new(20, Roles::routines(&|place| place >= 10));
        for (place, depth, cycles) in steps {
            ledger.step(*place, *depth, *cycles, true);
        }
        let all = ledger.finish().places;
        let total: u64 = all.iter().map(|c| c.cycles).sum();
        assert_eq!(total, steps.iter().map(|s| s.2).sum::<u64>());
        let each = all.iter();
        each.map(|c| (c.place, c.routine, c.times, c.cycles))
            .collect()
    }

    #[test]
    fn routines_are_charged_to_their_callers() {
        // 1 calls 10, which calls 12; then 1 goes on, 2 calls 12.
        let steps = [
            (1, 0, 1),
            (10, 1, 2),
            (12, 2, 4),
            (10, 1, 8),
            (1, 0, 16),
            (2, 0, 32),
            (12, 1, 64),
        ];
        let expected = [
            (1, None, 2, 17),
            (1, Some(10), 1, 14),
            (2, None, 1, 32),
            (2, Some(12), 1, 64),
        ];
        assert_eq!(charged(&steps), expected);
    }

    #[test]
    fn what_nobody_calls_is_charged_itself() {
        assert_eq!(
            charged(&[(11, 0, 3), (12, 1, 5)]),
            [(11, None, 1, 3), (11, Some(12), 1, 5)]
        );
    }

    #[test]
    fn a_called_place_that_is_no_routine_is_charged_itself() {
        let steps = [(1, 0, 1), (5, 1, 2), (11, 2, 4), (5, 1, 8)];
        assert_eq!(
            charged(&steps),
            [(1, None, 1, 1), (5, None, 2, 10), (5, Some(11), 1, 4)]
        );
    }

    #[test]
    fn a_routine_may_call_what_is_charged_itself() {
        // 1 calls 10, which calls 5, which calls 12; then 10 goes on.
        let steps = [
            (1, 0, 1),
            (10, 1, 2),
            (5, 2, 4),
            (12, 3, 8),
            (5, 2, 16),
            (10, 1, 32),
        ];
        let expected = [
            (1, None, 1, 1),
            (1, Some(10), 1, 34),
            (5, None, 2, 20),
            (5, Some(12), 1, 8),
        ];
        assert_eq!(charged(&steps), expected);
    }

    #[test]
    fn stretches_go_from_cut_to_cut_with_their_routines() {
        // 1 and 2 are a group, 3 another, 4 cuts; from 10 on are routines.
        let roles = Roles {
            routine: &|place| place >= 10,
            group: &|place| {
                [None, Some(7), Some(7), Some(8)]
                    .get(place as usize)
                    .copied()?
            },
            cuts: &|place| place == 4,
        };
        let mut ledger = Ledger::new(20, roles);
        let steps = [
            (1, 0, 1),
            (10, 1, 2),
            (0, 0, 4),
            (2, 0, 8),
            (4, 0, 16),
            (4, 0, 32),
            (3, 0, 64),
            (1, 0, 128),
        ];
        for (place, depth, cycles) in steps {
            ledger.step(place, depth, cycles, true);
        }
        let found = ledger.finish();
        let expected = BTreeMap::from([(7, vec![11, 128]), (8, vec![64])]);
        assert_eq!((&found.stretches, found.cuts), (&expected, 1));
        let twice = found.shared(0, |sum| 2 * sum);
        assert_eq!(twice.stretches[&7], [22, 256]);
        assert_eq!(twice.places.iter().map(|c| c.cycles).sum::<u64>(), 510);
    }
}
