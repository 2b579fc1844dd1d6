//! Names of variables and procedures, interned to slots by kind.

use std::collections::HashMap;

use super::ast::{Kind, Slot};

/// The 27 resident integers `@%` and `A%` to `Z%` are the first int slots.
pub(crate) const RESIDENT: usize = 27;

#[derive(Clone, Debug)]
pub(crate) struct Names {
    slots: HashMap<(Kind, Box<[u8]>), Slot>,
    by_kind: [Vec<Box<[u8]>>; 8],
}

impl Names {
    pub fn new() -> Self {
        let mut names = Self {
            slots: HashMap::new(),
            by_kind: Default::default(),
        };
        for c in b'@'..=b'Z' {
            names.slot(Kind::Int, &[c]);
        }
        names
    }

    /// The slot of a name (without `%`, `$` and `(`), made if new.
    pub fn slot(&mut self, kind: Kind, name: &[u8]) -> Slot {
        let key = (kind, name.into());
        if let Some(slot) = self.slots.get(&key) {
            return *slot;
        }
        let list = &mut self.by_kind[kind as usize];
        let slot = list.len() as Slot;
        list.push(name.into());
        self.slots.insert(key, slot);
        slot
    }

    pub fn count(&self, kind: Kind) -> usize {
        self.by_kind[kind as usize].len()
    }

    /// Bytes that a name's entry in its list takes: link, rest of the name, zero, value.
    pub fn entry_bytes(&self, kind: Kind, slot: Slot) -> u32 {
        let suffix = match kind {
            Kind::Int | Kind::Str | Kind::Reals => 1,
            Kind::Ints | Kind::Strs => 2,
            _ => 0,
        };
        let value = match kind {
            Kind::Int | Kind::Str => 4,
            Kind::Real => 5,
            _ => 2,
        };
        2 + (self.name(kind, slot).len() as u32).saturating_sub(1) + suffix + 1 + value
    }

    /// Bytes of the entries of all names but the resident ones.
    pub fn all_bytes(&self) -> u32 {
        use Kind::*;
        let kinds = [Int, Real, Str, Ints, Reals, Strs, Fn, Proc];
        let of = |kind: Kind| {
            let first = if kind == Int { RESIDENT } else { 0 };
            (first..self.count(kind)).map(move |slot| self.entry_bytes(kind, slot as Slot))
        };
        kinds.into_iter().flat_map(of).sum()
    }

    /// The name with what marks its kind, as it stands in its list.
    pub fn spelt(&self, kind: Kind, slot: Slot) -> Vec<u8> {
        let mark: &[u8] = match kind {
            Kind::Int => b"%",
            Kind::Str => b"$",
            Kind::Ints => b"%(",
            Kind::Reals => b"(",
            Kind::Strs => b"$(",
            Kind::Real | Kind::Fn | Kind::Proc => b"",
        };
        [self.name(kind, slot), mark].concat()
    }

    pub fn name(&self, kind: Kind, slot: Slot) -> &[u8] {
        self.by_kind[kind as usize]
            .get(slot as usize)
            .map_or(&[], |n| n)
    }
}
