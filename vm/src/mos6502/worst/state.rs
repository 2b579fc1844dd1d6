//! What is known of the machine at a point of the program: each byte and flag, or nothing.

use std::collections::BTreeMap;

/// Registers, flags and memory; what is not known is absent.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub(super) struct State {
    pub a: Option<u8>,
    pub x: Option<u8>,
    pub y: Option<u8>,
    pub n: Option<bool>,
    pub z: Option<bool>,
    pub c: Option<bool>,
    pub v: Option<bool>,
    /// The bytes on the stack since the routine was entered: whether they are the flags.
    pub pushed: Vec<bool>,
    /// Bytes on the stack before that. Where the stack is apart from the rest of memory it is
    /// only known whether there are any.
    pub below: u8,
    pub memory: BTreeMap<u16, u8>,
}

fn both<T: PartialEq + Copy>(one: Option<T>, other: Option<T>) -> Option<T> {
    one.filter(|_| one == other)
}

impl State {
    /// What is known in both; nothing where their stacks differ.
    pub fn join(&self, other: &State) -> Option<State> {
        if self.pushed.len() != other.pushed.len() || self.below != other.below {
            return None;
        }
        let flags = self.pushed.iter().zip(&other.pushed);
        let same = |(at, value): (&u16, &u8)| {
            (other.memory.get(at) == Some(value)).then_some((*at, *value))
        };
        Some(State {
            a: both(self.a, other.a),
            x: both(self.x, other.x),
            y: both(self.y, other.y),
            n: both(self.n, other.n),
            z: both(self.z, other.z),
            c: both(self.c, other.c),
            v: both(self.v, other.v),
            pushed: flags.map(|(one, other)| *one && *other).collect(),
            below: self.below,
            memory: self.memory.iter().filter_map(same).collect(),
        })
    }

    /// Bytes on the stack.
    pub fn depth(&self) -> usize {
        usize::from(self.below) + self.pushed.len()
    }

    /// Sets the two flags that a value sets, and gives it on.
    pub fn flags(&mut self, value: Option<u8>) -> Option<u8> {
        self.n = value.map(|byte| byte & 0x80 != 0);
        self.z = value.map(|byte| byte == 0);
        value
    }

    /// The flags of a comparison.
    pub fn compare(&mut self, register: Option<u8>, value: Option<u8>) {
        let both = register.zip(value);
        self.c = both.map(|(register, value)| register >= value);
        self.flags(both.map(|(register, value)| register.wrapping_sub(value)));
    }

    /// Adds to the accumulator, in binary.
    pub fn add(&mut self, value: Option<u8>) {
        let known = self.a.zip(value).zip(self.c);
        let sum = known.map(|((a, value), c)| u16::from(a) + u16::from(value) + u16::from(c));
        let low = sum.map(|sum| sum.to_le_bytes()[0]);
        self.v = known
            .zip(low)
            .map(|(((a, value), _), low)| (a ^ low) & (value ^ low) & 0x80 != 0);
        self.c = sum.map(|sum| sum > 0xFF);
        self.a = self.flags(low);
    }

    /// A shift or rotation of a value: the carry comes in where `carried`, and goes out.
    pub fn shift(&mut self, value: Option<u8>, left: bool, carried: bool) -> Option<u8> {
        let into = if carried { self.c } else { Some(false) };
        let shifted = value.zip(into).map(|(value, into)| match left {
            true => value << 1 | u8::from(into),
            false => value >> 1 | u8::from(into) << 7,
        });
        let lost = if left { 0x80 } else { 1 };
        self.c = value.map(|value| value & lost != 0);
        self.flags(shifted)
    }
}
