//! Screens that are memory: where their pixels stand.

use crate::plan::Plan;
use crate::targets::{Mode, System};

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

/// The largest screen that there are two of, in bytes.
const SECOND: u16 = 0x800;

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
            (System::BbcCode, _) => {
                let pixels = 8 / plan.mode.inks.ilog2().max(1);
                let row = plan.mode.width / pixels * 8;
                let lie = match pixels {
                    8 => Lie::Bits,
                    _ => Lie::Spread,
                };
                layout(lie, pixels, micro_start(&plan.mode), row)
            }
            (System::C64, "hires") => layout(Lie::Bits, 8, 0xE000, 320),
            (System::C64, "multicolour") => layout(Lie::Pairs, 4, 0xE000, 320),
            _ => None,
        }
    }

    /// Where a second screen stands, which a picture is drawn on while the first is shown: on a
    /// BBC Micro, where what moves is small.
    pub fn second(&self, plan: &Plan) -> Option<u16> {
        let turns = plan.target.system == System::BbcCode && plan.plot && plan.graph.is_moving();
        let bytes = 0x8000u16.checked_sub(self.start).filter(|_| turns)?;
        (bytes <= SECOND).then(|| self.start - bytes)
    }

    /// The first byte of all screens.
    pub fn lowest(&self, plan: &Plan) -> u16 {
        self.second(plan).unwrap_or(self.start)
    }

    /// How many bytes stand side by side.
    pub fn characters(&self) -> u32 {
        self.row / 8
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

/// Where a screen of a BBC Micro begins that is as large as a mode says: it ends where RAM does.
fn micro_start(mode: &Mode) -> u16 {
    let bytes = mode.width * mode.height / 8 * mode.inks.ilog2();
    u16::try_from(0x8000 - bytes.min(0x5000)).unwrap_or(0x3000)
}
