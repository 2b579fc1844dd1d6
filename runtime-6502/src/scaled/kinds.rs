//! The formats of reals with points of their own, as tests go through them.

#![allow(clippy::unwrap_used)]

use super::{FIXED12, FIXED16, FIXED24, byte, long, model};
use crate::tests::bench::{Random, Setting};
use slowlight_routine::Routine;
use slowlight_routine::scale::most;

/// A format, and what it has for some operations.
pub(super) struct Kind {
    pub setting: Setting,
    pub bits: u8,
    /// Fraction bits of sines and of angles.
    pub sine: i32,
    pub angle: i32,
    pub divide: fn(i32, i32, i32) -> i32,
}

pub(super) const SHORT: Kind = Kind {
    setting: Setting {
        runtime: &FIXED16,
        sizes: 2,
    },
    bits: 16,
    sine: 14,
    angle: 13,
    divide: model::divide,
};

pub(super) const LONG: Kind = Kind {
    setting: Setting {
        runtime: &FIXED24,
        sizes: 3,
    },
    bits: 24,
    sine: 16,
    angle: 16,
    divide: long::one_over,
};

/// Of reading alone: its routines have tests of their own ([`super::byte_tests`]).
pub(super) const BYTE: Kind = Kind {
    setting: Setting {
        runtime: &FIXED12,
        sizes: 1,
    },
    bits: 8,
    sine: 6,
    angle: 5,
    divide: byte::divide,
};

/// Those of 16 bits.
pub(super) fn edges() -> Vec<i32> {
    SHORT.edges()
}

impl Kind {
    pub fn most(&self) -> i32 {
        most(self.bits) as i32
    }

    pub fn routine(&self, name: &str) -> &'static Routine {
        let mut all = self.setting.runtime.routines.iter();
        all.find(|r| r.name == name).unwrap()
    }

    pub fn edges(&self) -> Vec<i32> {
        let mut all = vec![0, 3, 10, 100, 255, 257, 1000, 12345, 0x5555];
        all.retain(|n| *n < self.most());
        all.push(self.most());
        if self.bits > 16 {
            all.extend([0x0055_5555, 0x007F_FF7F, 0x0040_0001, 0x0012_3456]);
        }
        for k in 0..self.bits - 1 {
            all.extend([1 << k, (1 << k) - 1]);
        }
        all.extend(all.clone().iter().map(|n| -n));
        all.sort_unstable();
        all.dedup();
        all
    }

    /// An operand: half of them edges, the others of all magnitudes.
    pub fn draw(&self, random: &mut Random, edges: &[i32]) -> i32 {
        let bits = u32::from(self.bits);
        match random.next() & 1 {
            0 => edges[random.next() as usize % edges.len()],
            _ => {
                ((random.next() as i32 >> (32 - bits)) >> (random.next() % bits)).max(-self.most())
            }
        }
    }

    /// A result as the bytes of one have it.
    pub fn read(&self, found: i32) -> i64 {
        i64::from(found << (32 - self.bits) >> (32 - self.bits))
    }
}
