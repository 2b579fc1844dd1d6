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

    pub fn name(&self, kind: Kind, slot: Slot) -> &[u8] {
        self.by_kind[kind as usize]
            .get(slot as usize)
            .map_or(&[], |n| n)
    }
}
