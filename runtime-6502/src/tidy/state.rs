//! What places hold in a block, and what of it is handed from block to block.

use super::effects::{NZ, Place, REGISTERS};
use super::live::Places;
use rustc_hash::{FxHashMap, FxHashSet};

/// A value: a byte that is known, or a number for what is not, the same for the same value.
///
/// A number means what was computed the last time that its instruction was carried out, or what
/// a place had the last time that its block was entered. So where either happens again, whatever
/// else still holds the number is given another.
pub(super) type Value = u64;

/// Values below this are bytes that are known.
pub(super) const BYTES: Value = 256;

/// No value: what a place holds was not told.
const UNTOLD: Value = Value::MAX;

/// Where a value comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum From {
    /// A line gave it to a place.
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

/// Whether a value was computed in a place.
pub(super) fn made_in(value: Value, place: Place) -> bool {
    value >= BYTES && ((value - BYTES) & 0xFF_FFFF) as Place == place
}

/// What places hold where a block begins, by place: of registers, of what is read later, and
/// what else could stand for that. Of others nothing is known but that they were there.
pub(super) type Kept = Vec<(Place, Value)>;

/// What places hold somewhere in a block.
#[derive(Clone)]
pub(super) struct State {
    values: Vec<Value>,
    /// The places whose values are told; the others have what they had there.
    told: Vec<Place>,
    since: (From, usize),
}

impl State {
    /// Of so many places nothing is told.
    pub fn new(cells: usize) -> State {
        State {
            values: vec![UNTOLD; cells],
            told: Vec::new(),
            since: (From::Block, 0),
        }
    }

    /// Goes to where a block begins.
    pub fn enter(&mut self, b: usize, kept: &Kept) {
        self.untell();
        self.since = (From::Block, b);
        kept.iter()
            .for_each(|(place, value)| self.put(*place, *value));
    }

    fn untell(&mut self) {
        for place in self.told.drain(..) {
            if let Some(at) = self.values.get_mut(place) {
                *at = UNTOLD;
            }
        }
    }

    pub fn held(&self, place: Place) -> Value {
        match self.values.get(place) {
            Some(&value) if value != UNTOLD => value,
            _ => unknown(self.since.0, self.since.1, place),
        }
    }

    pub fn put(&mut self, place: Place, value: Value) {
        if let Some(at) = self.values.get_mut(place) {
            if *at == UNTOLD {
                self.told.push(place);
            }
            *at = value;
        }
    }

    /// From a line on nothing is known.
    pub fn forget(&mut self, line: usize) {
        self.untell();
        self.since = (From::Line, line);
    }

    /// What places hold of which more is known than where.
    pub fn told(&self) -> impl Iterator<Item = (Place, Value)> + '_ {
        self.told.iter().map(|place| (*place, self.held(*place)))
    }

    /// Gives places other values.
    pub fn change(&mut self, other: impl Fn(Place, Value) -> Option<Value>) {
        for &place in &self.told {
            if let Some(at) = self.values.get_mut(place)
                && let Some(value) = other(place, *at)
            {
                *at = value;
            }
        }
    }

    /// The bytes of memory that hold a value.
    pub fn holders(&self, value: Value) -> impl Iterator<Item = Place> + '_ {
        let told = self
            .told()
            .filter(move |(place, v)| *place >= REGISTERS && *v == value);
        told.map(|(place, _)| place)
    }

    /// What is handed to a block of which these places are read.
    pub fn kept(&self, alive: &Places) -> Kept {
        let cells = self.values.len();
        let mut kept = Kept::with_capacity(REGISTERS + alive.len());
        let asked = alive.iter().take_while(|place| *place < cells);
        (0..REGISTERS)
            .chain(asked.filter(|place| *place >= REGISTERS))
            .for_each(|place| kept.push((place, self.held(place))));
        let other = |(place, _): &(Place, Value)| *place >= REGISTERS && !alive.has(*place);
        let others: Vec<(Place, Value)> = self.told().filter(other).collect();
        if others.is_empty() {
            return kept;
        }
        // There are few others: what they hold is looked for, not all that is kept.
        let sought: FxHashSet<Value> = others.iter().map(|(_, value)| *value).collect();
        let met: FxHashSet<Value> = (kept.iter().map(|(_, value)| *value))
            .filter(|value| sought.contains(value))
            .collect();
        let also = |(_, value): &(Place, Value)| *value < BYTES || met.contains(value);
        kept.extend(others.into_iter().filter(also));
        // Two runs in order, or nearly.
        kept.sort();
        kept
    }
}

/// What is held where a block begins that several ways come to: what all agree on, and where
/// they do not, one value for all places that hold the same on each way.
pub(super) fn joined(b: usize, ways: &[&Kept]) -> Kept {
    let Some((first, rest)) = ways.split_first() else {
        return Kept::new();
    };
    let mut seen: FxHashMap<Vec<Value>, Value> = FxHashMap::default();
    let mut rest: Vec<_> = rest.iter().map(|way| way.iter().peekable()).collect();
    let mut on_each = Vec::with_capacity(ways.len());
    let mut join = |&(place, value): &(Place, Value)| {
        on_each.clear();
        on_each.push(value);
        for way in &mut rest {
            while way.next_if(|(other, _)| *other < place).is_some() {}
            on_each.push(way.next_if(|(other, _)| *other == place)?.1);
        }
        let from_here = origin(value) == Some((From::Block, b));
        if !from_here && on_each.iter().all(|other| *other == value) {
            return Some((place, value));
        }
        if place == NZ && on_each.iter().any(|value| is_two(*value)) {
            return Some((place, unknown(From::Block, b, place)));
        }
        if let Some(same) = seen.get(on_each.as_slice()) {
            return Some((place, *same));
        }
        let own = fresh(From::Block, b, place);
        seen.insert(on_each.clone(), own);
        Some((place, own))
    };
    first.iter().filter_map(&mut join).collect()
}
