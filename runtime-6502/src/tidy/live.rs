//! What is read later: of each block's end, the places whose contents something behind it
//! reads before it changes them.

use super::effects::{Effects, Place};
use super::flow::{End, Flow};

/// A set of places.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Places {
    words: Vec<u64>,
}

impl Places {
    pub fn none(count: usize) -> Places {
        Places {
            words: vec![0; count.div_ceil(64)],
        }
    }

    pub fn all(count: usize) -> Places {
        Places {
            words: vec![u64::MAX; count.div_ceil(64)],
        }
    }

    pub fn has(&self, place: Place) -> bool {
        (self.words.get(place / 64)).is_some_and(|word| word >> (place % 64) & 1 == 1)
    }

    /// In their order.
    pub fn iter(&self) -> impl Iterator<Item = Place> + '_ {
        bits(self.words.iter().copied())
    }

    /// All that are not among them, in their order; and some behind all places there are.
    pub fn others(&self) -> impl Iterator<Item = Place> + '_ {
        bits(self.words.iter().map(|word| !word))
    }

    pub fn insert(&mut self, place: Place) {
        self.set(place, true);
    }

    fn set(&mut self, place: Place, on: bool) {
        if let Some(word) = self.words.get_mut(place / 64) {
            let bit = 1 << (place % 64);
            *word = if on { *word | bit } else { *word & !bit };
        }
    }

    fn add(&mut self, other: &Places) {
        let words = self.words.iter_mut().zip(&other.words);
        words.for_each(|(word, more)| *word |= more);
    }

    /// From behind an instruction to before it.
    pub fn back(&mut self, effects: &Effects) {
        if effects.unknown {
            self.words.fill(u64::MAX);
            return;
        }
        effects
            .writes
            .iter()
            .for_each(|place| self.set(*place, false));
        effects
            .reads
            .iter()
            .for_each(|place| self.set(*place, true));
    }
}

/// The bits of words, by their numbers.
fn bits(words: impl Iterator<Item = u64>) -> impl Iterator<Item = usize> {
    words.enumerate().flat_map(|(k, word)| {
        let rest = std::iter::successors(Some(word), |word| Some(word & word.wrapping_sub(1)));
        let rest = rest.take_while(|word| *word != 0);
        rest.map(move |word| k * 64 + word.trailing_zeros() as usize)
    })
}

/// What is alive before and behind each block.
pub(super) struct Alive {
    pub ahead: Vec<Places>,
    pub behind: Vec<Places>,
}

pub(super) fn alive(flow: &Flow) -> Alive {
    // What subroutines read of what they are given: nobody reads anything behind them.
    let blocks: Vec<Whole> = (flow.blocks.iter())
        .map(|block| whole(flow, block.lines.clone()))
        .collect();
    let given = solve(flow, &blocks, None).ahead;
    solve(flow, &blocks, Some(&given))
}

/// What a block makes of what is alive behind it.
struct Whole {
    /// What it reads before it writes it.
    reads: Places,
    /// What it writes, and nothing behind it can have been there before.
    writes: Places,
}

fn whole(flow: &Flow, lines: std::ops::Range<usize>) -> Whole {
    let count = flow.space.len();
    let (mut reads, mut passed) = (Places::none(count), Places::all(count));
    for k in lines.rev() {
        if let Some(effects) = flow.effects.get(k) {
            reads.back(effects);
            passed.back(effects);
        }
    }
    // What is alive before it only because it was alive behind it passes through.
    passed.words.iter_mut().for_each(|word| *word = !*word);
    Whole {
        reads,
        writes: passed,
    }
}

impl Whole {
    /// What is alive before the block.
    fn before(&self, behind: &Places) -> Places {
        let words = behind
            .words
            .iter()
            .zip(&self.writes.words)
            .zip(&self.reads.words);
        Places {
            words: words
                .map(|((behind, writes), reads)| behind & !writes | reads)
                .collect(),
        }
    }
}

/// Goes round until nothing is added. `given` has what subroutines read; without it what
/// stands behind a return is left out, and a call reads what is known of it so far.
fn solve(flow: &Flow, blocks: &[Whole], given: Option<&[Places]>) -> Alive {
    let count = flow.space.len();
    let mut behind = vec![Places::none(count); blocks.len()];
    let mut ahead: Vec<Places> = (blocks.iter().zip(&behind))
        .map(|(block, behind)| block.before(behind))
        .collect();
    loop {
        let mut changed = false;
        let mut returned = Places::none(count);
        if given.is_some() {
            (flow.returns.iter().filter_map(|b| ahead.get(*b))).for_each(|a| returned.add(a));
        }
        for &b in flow.order.iter().rev() {
            let Some(block) = flow.blocks.get(b) else {
                continue;
            };
            let mut alive = Places::none(count);
            for next in &block.next {
                ahead.get(*next).iter().for_each(|a| alive.add(a));
            }
            match block.end {
                End::Unknown => alive = Places::all(count),
                End::Return => alive.add(&returned),
                End::Call(to) => {
                    let reads = given.map_or_else(|| ahead.get(to), |given| given.get(to));
                    reads.iter().for_each(|a| alive.add(a));
                }
                End::On | End::Branch(_) | End::Jump => {}
            }
            if let (Some(now), Some(whole), Some(before)) =
                (behind.get_mut(b), blocks.get(b), ahead.get_mut(b))
                && *now != alive
            {
                changed = true;
                *before = whole.before(&alive);
                *now = alive;
            }
        }
        if !changed {
            return Alive { ahead, behind };
        }
    }
}
