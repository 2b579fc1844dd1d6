//! Target descriptions: what the planner has to know of each machine that scenes are compiled
//! for. What writes programs for them is [`crate::backend`].

pub mod bbc;
pub mod jack;
#[cfg(test)]
mod mode_tests;
pub mod mos6502;

use slowlight_routine::{Runtime, Type};
use std::cmp::Reverse;

/// The language of a target's programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    Jack,
    Basic,
    Assembly,
}

/// A machine with what programs find on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum System {
    /// The Hack computer of nand2tetris, with its operating system.
    Hack,
    /// A BBC Micro's BASIC II.
    BbcBasic,
    /// An Agon's BBC BASIC.
    Agon,
    /// BASIC V on a computer of today.
    BasicV,
    /// A 6502 with ports that draw.
    Plain6502,
    /// A BBC Micro in machine code.
    BbcCode,
    /// A Commodore 64 in machine code.
    C64,
    /// An Atari VCS.
    Vcs,
}

impl System {
    /// What its programs are written in.
    pub fn language(self) -> Language {
        match self {
            System::Hack => Language::Jack,
            System::BbcBasic | System::Agon | System::BasicV => Language::Basic,
            System::Plain6502 | System::BbcCode | System::C64 | System::Vcs => Language::Assembly,
        }
    }
}

/// A screen mode of a machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mode {
    /// What the machine calls it; empty where there is only one.
    pub name: &'static str,
    /// Pixels in a row; 0 for a screen that is as large as the picture.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Inks.
    pub inks: u32,
}

/// A machine that scenes are compiled for.
#[derive(Debug)]
pub struct Target {
    /// `jack`, `bbc:micro`, `6502:plain`.
    pub name: &'static str,
    /// What it is, whatever its name.
    pub system: System,
    /// One sentence on the machine.
    pub about: &'static str,
    /// Its routines.
    pub runtime: &'static Runtime,
    /// Its screen modes, in the machine's order.
    pub modes: &'static [Mode],
    /// The least distance along a ray that counts as in front, given the
    /// format's precision at the scenes' scale.
    pub offset: f64,
    /// Cycles a second, for estimates of the machine's time.
    pub hertz: f64,
    /// What statements take in its programs where memory is short.
    pub sizes: Sizes,
    /// Whether a sum of ints that leaves 32 bits silently loses what is above them.
    pub wraps: bool,
    /// The widest picture whose columns' values its programs keep in arrays; 0 where they
    /// do not.
    pub columns: u32,
    /// How many pixels of a mode stand in a byte that the program writes; 1 where
    /// it plots them one by one.
    pub pixels: fn(&Mode) -> u32,
    /// Cycles that a pixel takes by itself, about: the loop over columns, and its ink.
    pub drawing: u32,
    /// The share of all cycles in which the screen holds the processor up.
    pub stolen: f64,
    /// What a leaner style of its programs is.
    pub lean: Lean,
    /// Whether its format is exact and slow: one for goals that none of the machine's others keeps.
    pub last: bool,
    /// Whether its programs set up a screen no larger than the picture, whatever the mode.
    pub windows: bool,
    /// Whether its programs show scenes that move.
    pub moves: bool,
    /// Whether its pictures are of columns only ([`crate::plan::columns`]): it has no memory for
    /// one of pixels.
    pub columns_only: bool,
}

/// What [`crate::plan::Plan::lean`] makes of a machine's programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lean {
    /// The same.
    Nothing,
    /// What is written out is called: a few parts in a hundred slower.
    Calls,
    /// They are short, and slower for it.
    Short,
}

/// How many bytes (or words) statements take on a machine, about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sizes {
    /// An operation, beside its routine's own bytes.
    pub operation: u32,
    /// A copy of a bool.
    pub copy_bool: u32,
    /// A copy of an int or real.
    pub copy: u32,
    /// A home of a subroutine.
    pub home: u32,
    /// The test and jumps of an `If`.
    pub test: u32,
    /// The counting and jumps of a loop.
    pub turns: u32,
    /// A call.
    pub call: u32,
    /// What a subroutine has around its statements.
    pub around: u32,
    /// What a comparison has beside that ends a run of columns.
    pub ends: u32,
}

impl Sizes {
    /// A copy of a value of some type.
    pub fn copy_of(&self, ty: Type) -> u32 {
        match ty {
            Type::Bool => self.copy_bool,
            Type::Int | Type::Real => self.copy,
        }
    }
}

/// Every target that shows any scene.
pub static TARGETS: &[&Target] = &[
    &jack::JACK,
    &bbc::MICRO,
    &bbc::AGON,
    &bbc::BASIC_V,
    &mos6502::PLAIN,
    &mos6502::BBC,
    &mos6502::C64,
];

/// Those that show column scenes only ([`Target::columns_only`]).
pub static OF_COLUMNS: &[&Target] = &[&mos6502::VCS];

/// The same machines with other formats of reals.
pub static OTHER_FORMATS: &[&Target] = &[
    &jack::JACK_F316R,
    &jack::JACK_LOG10,
    &jack::JACK_FIXED16,
    &jack::JACK_F416,
    &mos6502::PLAIN_FIXED12,
    &mos6502::PLAIN_FIXED16,
    &mos6502::BBC_FIXED12,
    &mos6502::BBC_FIXED16,
    &mos6502::C64_FIXED12,
    &mos6502::C64_FIXED16,
    &mos6502::PLAIN_FIXED20,
    &mos6502::BBC_FIXED20,
    &mos6502::C64_FIXED20,
    &mos6502::PLAIN_FIXED24,
    &mos6502::BBC_FIXED24,
    &mos6502::C64_FIXED24,
    &mos6502::PLAIN_LOG10,
    &mos6502::BBC_LOG10,
    &mos6502::C64_LOG10,
    &mos6502::PLAIN_LOG11,
    &mos6502::BBC_LOG11,
    &mos6502::C64_LOG11,
    &mos6502::PLAIN_REAL40,
    &mos6502::BBC_REAL40,
    &mos6502::C64_REAL40,
];

/// Every target, whatever scenes it shows.
pub fn every() -> impl Iterator<Item = &'static Target> + Clone {
    TARGETS.iter().chain(OF_COLUMNS).copied()
}

/// Every target that shows any scene, in every format.
pub fn in_all_formats() -> impl Iterator<Item = &'static Target> {
    TARGETS.iter().chain(OTHER_FORMATS).copied()
}

/// The formats of reals that a target's machine has, its usual one first.
pub fn formats(target: &Target) -> impl Iterator<Item = &'static Target> {
    let name = target.name;
    let all = every().chain(OTHER_FORMATS.iter().copied());
    all.filter(move |t| t.name == name)
}

/// A target by its name; a family's name alone means its first.
pub fn find(name: &str) -> Option<&'static Target> {
    let family = |t: &&Target| t.name.split(':').next() == Some(name);
    every()
        .find(|t| t.name == name)
        .or_else(|| every().find(family))
}

/// The mode for a picture of as many inks as there are: of those that hold it whole the one
/// with most inks, else the one with most pixels.
pub fn default_mode(target: &Target, width: u32, height: u32) -> Option<Mode> {
    modes_for(target, width, height, u32::MAX).first().copied()
}

/// The modes for a picture, the best first: those that hold it whole by how many of its
/// inks they have, then the others by their pixels, too. Of equals the machine's order decides.
pub fn modes_for(target: &Target, width: u32, height: u32, inks: u32) -> Vec<Mode> {
    if let Some(any) = target.modes.iter().find(|m| m.width == 0) {
        return vec![Mode {
            width,
            height,
            ..*any
        }];
    }
    let holds = |m: &&Mode| m.width >= width && m.height >= height;
    let (mut whole, mut part): (Vec<&Mode>, Vec<&Mode>) = target.modes.iter().partition(holds);
    let shown = |m: &Mode| m.inks.min(inks);
    let pixels = |m: &Mode| u64::from(m.width) * u64::from(m.height);
    whole.sort_by_key(|m| Reverse(shown(m)));
    part.sort_by_key(|m| Reverse((pixels(m), shown(m))));
    let all = whole.into_iter().chain(part);
    all.map(|mode| shown_in(target, mode, width, height))
        .collect()
}

/// A mode as it shows a picture: no larger than that where the target's programs set up the
/// screen themselves, to whole bytes and rows of characters.
pub fn shown_in(target: &Target, mode: &Mode, width: u32, height: u32) -> Mode {
    if !target.windows {
        return *mode;
    }
    let pixels = 8 / mode.inks.ilog2().max(1);
    Mode {
        width: mode.width.min(width.next_multiple_of(pixels)),
        height: mode.height.min(height.next_multiple_of(8)),
        ..*mode
    }
}
