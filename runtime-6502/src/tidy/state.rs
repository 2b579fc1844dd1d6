//! What places hold in a block, and what of it is handed from block to block.

use super::effects::{NZ, Place, REGISTERS};
use super::live::Places;
use rustc_hash::{FxHashMap, FxHashSet};
use std::ops::Range;

/// A value: a byte that is known, or a number for what is not, the same for the same value.
///
/// A number means what was computed the last time that its instruction was carried out, or what
/// a place had the last time that its block was entered. So where either happens again, whatever
/// else still holds the number is given another.
pub(super) type Value = u64;

/// Values below this are bytes that are known.
pub(super) const BYTES: Value = 256;

/// No value: what a place holds was not told.
pub(super) const UNTOLD: Value = Value::MAX;

/// No value: ways that meet differ in it.
const MIXED: Value = Value::MAX - 1;

/// Where a value comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum From {
    /// A line gave it to a place.
    #[default]
    Line,
    /// A place lost what it had at a line.
    Lost,
    /// A place had it where a block began.
    Block,
    /// The flags after `bit`, or where nothing is known of them: zero may be of one byte and
    /// the sign of another.
    Two,
}

const FROM: [From; 4] = [From::Line, From::Lost, From::Block, From::Two];

/// The value that is told apart by where it comes from, by that line or block, and by a place.
pub(super) fn fresh(from: From, at: usize, place: Place) -> Value {
    BYTES + (((from as u64) << 60) | ((at as u64) << 24) | place as u64)
}

/// A value of which nothing is known but where: of the flags, not even that they tell of a byte.
pub(super) fn unknown(from: From, at: usize, place: Place) -> Value {
    fresh(if place == NZ { From::Two } else { from }, at, place)
}

/// Whether values come from these lines: given or lost there.
pub(super) fn of_lines(lines: &Range<usize>) -> impl Fn(Value) -> bool {
    let [from, to] = [lines.start, lines.end].map(|line| fresh(From::Line, line, 0));
    // What is lost at a line has one bit more than what is given there.
    let bit = fresh(From::Lost, 0, 0) - fresh(From::Line, 0, 0);
    move |value| (from..to).contains(&(BYTES + (value.wrapping_sub(BYTES) & !bit)))
}

/// Where a value comes from that is no byte: and the line or block.
pub(super) fn origin(value: Value) -> Option<(From, usize)> {
    let number = value.checked_sub(BYTES)?;
    let from = FROM.get((number >> 60) as usize)?;
    Some((*from, (number >> 24 & 0xF_FFFF_FFFF) as usize))
}

/// Whether flags may tell of more than one byte.
pub(super) fn is_two(value: Value) -> bool {
    origin(value).is_some_and(|(from, _)| from == From::Two)
}

/// The place that a value which is no byte was made in.
pub(super) fn made_in(value: Value) -> Place {
    (value.saturating_sub(BYTES) & 0xFF_FFFF) as Place
}

/// What places hold where a block begins, of each place: of registers, of what is read later,
/// and what else could stand for that. Of others nothing is told but that they were there.
///
/// All places are in it, for nearly all are read later: what goes from block to block is then
/// copied and compared as a whole.
pub(super) type Kept = Vec<Value>;

/// What places hold somewhere in a block.
#[derive(Default)]
pub(super) struct State {
    /// Those whose values are not told have what they had there.
    values: Kept,
    since: (From, usize),
    /// Whether a place that is read later may not be told.
    gaps: bool,
}

impl State {
    /// Has so many places.
    pub fn resize(&mut self, cells: usize) {
        self.values.resize(cells, UNTOLD);
    }

    /// Goes to where a block begins.
    pub fn enter(&mut self, b: usize, kept: &Kept) {
        self.since = (From::Block, b);
        self.values.clone_from(kept);
        self.gaps = true;
    }

    /// Goes to where a block begins that several ways come to. What all agree on is held there,
    /// and where they do not, one value by all places that hold the same on each way. `again`
    /// says that the block was begun before, so that its own values may have come round.
    pub fn join(&mut self, b: usize, ways: &[&State], again: bool) {
        self.since = (From::Block, b);
        self.gaps = ways.is_empty() || ways.iter().any(|way| way.gaps);
        let Some((first, rest)) = ways.split_first() else {
            return self.values.fill(UNTOLD);
        };
        self.values.clone_from(&first.values);
        for way in rest {
            let both = self.values.iter_mut().zip(way.values.iter());
            both.filter(|(at, other)| at != other)
                .for_each(|(at, _)| *at = MIXED);
        }
        if rest.is_empty() && !again {
            return;
        }
        let from_here = fresh(From::Block, b, 0)..fresh(From::Block, b + 1, 0);
        let mut classes = Classes::default();
        for (place, at) in self.values.iter_mut().enumerate() {
            if *at != MIXED && !from_here.contains(at) {
                continue;
            }
            let on_each = || ways.iter().filter_map(|way| way.values.get(place).copied());
            *at = if on_each().any(|value| value == UNTOLD) {
                UNTOLD
            } else if place == NZ && on_each().any(is_two) {
                unknown(From::Block, b, place)
            } else {
                classes.of(on_each(), fresh(From::Block, b, place))
            };
        }
    }

    /// What is handed on.
    pub fn values(&self) -> &Kept {
        &self.values
    }

    /// Nothing is told.
    pub fn clear(&mut self) {
        self.values.fill(UNTOLD);
        self.gaps = true;
    }

    /// All that is read from here on is told.
    fn fill_gaps(&mut self, alive: &Places) {
        let cells = self.values.len();
        let asked = alive.iter().take_while(|place| *place < cells);
        for place in (0..REGISTERS).chain(asked) {
            let value = self.held(place);
            self.put(place, value);
        }
        self.gaps = false;
    }

    fn has_no_gap(&self, alive: &Places) -> bool {
        let told = self.values.iter().enumerate();
        told.filter(|(place, _)| alive.has(*place))
            .all(|(_, value)| *value != UNTOLD)
    }

    /// Becomes what another is.
    pub fn copy(&mut self, other: &State) {
        self.values.clone_from(&other.values);
        (self.since, self.gaps) = (other.since, other.gaps);
    }

    pub fn held(&self, place: Place) -> Value {
        match self.values.get(place) {
            Some(&value) if value != UNTOLD => value,
            _ => unknown(self.since.0, self.since.1, place),
        }
    }

    pub fn put(&mut self, place: Place, value: Value) {
        if let Some(at) = self.values.get_mut(place) {
            *at = value;
        }
    }

    /// From a line on nothing is known.
    pub fn forget(&mut self, line: usize) {
        self.clear();
        self.since = (From::Line, line);
    }

    /// What places hold of which more is known than where.
    pub fn told(&self) -> impl Iterator<Item = (Place, Value)> + '_ {
        let all = self.values.iter().copied().enumerate();
        all.filter(|(_, value)| *value != UNTOLD)
    }

    /// Gives places other values.
    pub fn change(&mut self, other: impl Fn(Place, Value) -> Option<Value>) {
        for (place, at) in self.values.iter_mut().enumerate() {
            if *at != UNTOLD
                && let Some(value) = other(place, *at)
            {
                *at = value;
            }
        }
    }

    /// The bytes of memory that hold a value.
    pub fn holders(&self, value: Value) -> impl Iterator<Item = Place> + '_ {
        let bytes = self.values.iter().enumerate().skip(REGISTERS);
        bytes
            .filter(move |(_, held)| **held == value)
            .map(|(place, _)| place)
    }

    /// Leaves what is handed to a block of which these places are read.
    pub fn keep(&mut self, alive: &Places) {
        // What is read behind a block is read before it, or given in it: once told, all is told.
        if self.gaps {
            self.fill_gaps(alive);
        }
        debug_assert!(self.has_no_gap(alive));
        let mut others = Vec::new();
        for place in alive.others().skip_while(|place| *place < REGISTERS) {
            let Some(at) = self.values.get_mut(place) else {
                break;
            };
            if *at >= BYTES && *at != UNTOLD {
                others.push((place, *at));
                *at = UNTOLD;
            }
        }
        if others.is_empty() {
            return;
        }
        // There are few others: what they hold is looked for in what is kept.
        let mut sought = Sieve::new(others.len());
        others.iter().for_each(|(_, value)| sought.insert(*value));
        let found = self.values.iter().filter(|value| sought.may_have(**value));
        let met: FxHashSet<Value> = found.copied().collect();
        for (place, value) in others.into_iter().filter(|(_, value)| met.contains(value)) {
            self.put(place, value);
        }
    }
}

/// A set of values that may have some more, and is quick to ask.
pub(super) struct Sieve {
    bits: Places,
    shift: u32,
}

impl Sieve {
    /// For so many values.
    pub fn new(count: usize) -> Sieve {
        let size = (32 * count).next_power_of_two().max(64);
        Sieve {
            bits: Places::none(size),
            shift: 64 - size.trailing_zeros(),
        }
    }

    fn bit(&self, value: Value) -> usize {
        (value.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> self.shift) as usize
    }

    pub fn insert(&mut self, value: Value) {
        self.bits.insert(self.bit(value));
    }

    pub fn may_have(&self, value: Value) -> bool {
        self.bits.has(self.bit(value))
    }
}

/// Values that stand for what several ways have in a place.
#[derive(Default)]
struct Classes {
    /// A number for what the first ways have, with what the next has.
    numbers: FxHashMap<(Value, Value), Value>,
    values: FxHashMap<Value, Value>,
}

impl Classes {
    /// The value for a place that has these on each way; its own for the first of them.
    fn of(&mut self, mut on_each: impl Iterator<Item = Value>, own: Value) -> Value {
        let first = on_each.next().unwrap_or(UNTOLD);
        let class = on_each.fold(first, |class, value| {
            // Numbers that no value has.
            let next = MIXED - 1 - self.numbers.len() as Value;
            *self.numbers.entry((class, value)).or_insert(next)
        });
        *self.values.entry(class).or_insert(own)
    }
}
