//! Screens that are memory: where their pixels stand.

use crate::plan::Plan;
use crate::targets::System;

/// How a byte's pixels lie in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Lie {
    /// One bit each, the left one in front.
    Bits,
    /// The BBC's: the bits of an ink as far apart as there are pixels, and the first of
    /// all pixels in front; a pixel shifts the others by one bit.
    Spread,
    /// Side by side, two bits each.
    Pairs,
}

/// A screen in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Layout {
    pub lie: Lie,
    /// Pixels of a byte.
    pub pixels: u32,
    /// Its first byte.
    pub start: u16,
    /// Bytes of a row of characters.
    pub row: u32,
}

impl Layout {
    /// The screen of a plan's mode; none where it is no memory.
    pub fn of(plan: &Plan) -> Option<Layout> {
        let layout = |lie, pixels, start, row| {
            Some(Layout {
                lie,
                pixels,
                start,
                row,
            })
        };
        match (plan.target.system, plan.mode.name) {
            (System::BbcCode, "0") => layout(Lie::Bits, 8, 0x3000, 640),
            (System::BbcCode, "1") => layout(Lie::Spread, 4, 0x3000, 640),
            (System::BbcCode, "2") => layout(Lie::Spread, 2, 0x3000, 640),
            (System::BbcCode, "4") => layout(Lie::Bits, 8, 0x5800, 320),
            (System::BbcCode, "5") => layout(Lie::Spread, 4, 0x5800, 320),
            (System::C64, "hires") => layout(Lie::Bits, 8, 0xE000, 320),
            (System::C64, "multicolour") => layout(Lie::Pairs, 4, 0xE000, 320),
            _ => None,
        }
    }

    /// What stands in a byte when so many pixels are in it, all ink 0: the mark.
    pub fn mark(&self, pixels: u32) -> u32 {
        match self.lie {
            Lie::Pairs => 1 << (2 * pixels),
            Lie::Bits | Lie::Spread => 1 << (8 - self.pixels + pixels),
        }
    }

    /// An ink's bits where the last pixel of a byte is.
    pub fn pattern(&self, ink: u32) -> u32 {
        let bits = 8 / self.pixels;
        (0..bits).map(|k| (ink >> k & 1) << (k * self.pixels)).sum()
    }
}
