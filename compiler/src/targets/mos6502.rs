//! Target descriptions of 6502 machines, by the format of their reals.

use super::bbc::{MODE_0, MODE_1, MODE_2, MODE_4, MODE_5, OFFSET};
use super::{Lean, Mode, Sizes, System, Target};
use slowlight_runtime_6502::FIXED16_16;
use slowlight_runtime_6502::float::REAL40;
use slowlight_runtime_6502::log::{LOG10, LOG10_IN_RUNS, LOG11, LOG11_IN_RUNS};
use slowlight_runtime_6502::scaled::{FIXED12, FIXED12_IN_RUNS, FIXED16, FIXED16_IN_RUNS};
use slowlight_runtime_6502::scaled::{FIXED20, FIXED20_IN_RUNS, FIXED24, FIXED24_IN_RUNS};

/// Its bitmaps.
const C64_MODES: &[Mode] = &[
    Mode {
        name: "hires",
        width: 320,
        height: 200,
        inks: 2,
    },
    Mode {
        name: "multicolour",
        width: 160,
        height: 200,
        inks: 4,
    },
];

/// The plain machine: 64K of RAM and a port that takes ink by ink.
pub static PLAIN: Target = USUAL;

/// The same with reals of 8 bits or 16, each with fraction bits of its own.
pub static PLAIN_FIXED12: Target = Target {
    runtime: &FIXED12_IN_RUNS,
    ..USUAL
};

/// The same with reals of 16 bits, each with fraction bits of its own.
pub static PLAIN_FIXED16: Target = Target {
    runtime: &FIXED16_IN_RUNS,
    ..USUAL
};

/// The same with reals of 16 bits or 24.
pub static PLAIN_FIXED20: Target = Target {
    runtime: &FIXED20_IN_RUNS,
    ..USUAL
};

/// The same with reals of 24 bits.
pub static PLAIN_FIXED24: Target = Target {
    runtime: &FIXED24_IN_RUNS,
    ..USUAL
};

/// The same with logarithmic reals.
pub static PLAIN_LOG10: Target = Target {
    runtime: &LOG10_IN_RUNS,
    offset: LOG_OFFSET,
    lean: Lean::Calls,
    ..USUAL
};

/// The same with a bit more.
pub static PLAIN_LOG11: Target = Target {
    runtime: &LOG11_IN_RUNS,
    offset: LOG_OFFSET / 2.0,
    lean: Lean::Calls,
    ..USUAL
};

/// The same with floating-point reals.
pub static PLAIN_REAL40: Target = Target {
    runtime: &REAL40,
    offset: OFFSET,
    last: true,
    ..USUAL
};

/// Of ten bits, numbers are known to 1/2000 of themselves, so a point's distance from its own surface, a
/// few units away, comes out as a few thousandths.
const LOG_OFFSET: f64 = 0.015_625;

/// The modes of a BBC Micro, whose screens are as large as the picture: of equal inks those with
/// square pixels first.
static BBC_MODES: &[Mode] = &[MODE_4, MODE_1, MODE_2, MODE_0, MODE_5];

/// A BBC Micro, model B.
pub static BBC: Target = Target {
    name: "6502:bbc",
    system: System::BbcCode,
    about: "a BBC Micro in machine code, with a disc drive",
    modes: BBC_MODES,
    windows: true,
    moves: true,
    drawing: 55,
    ..USUAL
};

/// The same with reals of 8 bits or 16.
pub static BBC_FIXED12: Target = Target {
    runtime: &FIXED12,
    ..BBC
};

/// The same with reals of 16 bits.
pub static BBC_FIXED16: Target = Target {
    runtime: &FIXED16,
    ..BBC
};

/// The same with reals of 16 bits or 24.
pub static BBC_FIXED20: Target = Target {
    runtime: &FIXED20,
    ..BBC
};

/// The same with reals of 24 bits.
pub static BBC_FIXED24: Target = Target {
    runtime: &FIXED24,
    ..BBC
};

/// The same with logarithmic reals.
pub static BBC_LOG10: Target = Target {
    runtime: &LOG10,
    offset: LOG_OFFSET,
    lean: Lean::Calls,
    ..BBC
};

/// The same with a bit more.
pub static BBC_LOG11: Target = Target {
    runtime: &LOG11,
    offset: LOG_OFFSET / 2.0,
    lean: Lean::Calls,
    ..BBC
};

/// The same with floating-point reals.
pub static BBC_REAL40: Target = Target {
    runtime: &REAL40,
    offset: OFFSET,
    last: true,
    ..BBC
};

/// A Commodore 64, for PAL.
pub static C64: Target = Target {
    name: "6502:c64",
    system: System::C64,
    moves: true,
    about: "a Commodore 64 (PAL) in machine code",
    modes: C64_MODES,
    drawing: 90,
    // 25 lines of 312 take some 42 of their 63 cycles.
    stolen: 0.053,
    hertz: 985_248.0,
    ..USUAL
};

/// The same with reals of 8 bits or 16.
pub static C64_FIXED12: Target = Target {
    runtime: &FIXED12,
    ..C64
};

/// The same with reals of 16 bits.
pub static C64_FIXED16: Target = Target {
    runtime: &FIXED16,
    ..C64
};

/// The same with logarithmic reals.
pub static C64_LOG10: Target = Target {
    runtime: &LOG10,
    offset: LOG_OFFSET,
    lean: Lean::Calls,
    ..C64
};

/// The same with a bit more.
pub static C64_LOG11: Target = Target {
    runtime: &LOG11,
    offset: LOG_OFFSET / 2.0,
    lean: Lean::Calls,
    ..C64
};

/// The same with reals of 16 bits or 24.
pub static C64_FIXED20: Target = Target {
    runtime: &FIXED20,
    ..C64
};

/// The same with reals of 24 bits.
pub static C64_FIXED24: Target = Target {
    runtime: &FIXED24,
    ..C64
};

/// The same with floating-point reals.
pub static C64_REAL40: Target = Target {
    runtime: &REAL40,
    offset: OFFSET,
    last: true,
    ..C64
};

/// An Atari VCS, for PAL: a picture is columns, whose heights are found between its frames.
pub static VCS: Target = Target {
    name: "6502:vcs",
    system: System::Vcs,
    about: "an Atari VCS (PAL) with a cartridge: column scenes only",
    runtime: &FIXED16,
    moves: true,
    columns_only: true,
    hertz: 1_182_298.0,
    ..USUAL
};

const USUAL: Target = Target {
    name: "6502:plain",
    system: System::Plain6502,
    about: "a 6502 with 64K of RAM and a page of ports that draw",
    runtime: &FIXED16_16,
    // As large as the picture.
    modes: &[Mode {
        name: "",
        width: 0,
        height: 0,
        inks: 256,
    }],
    // 1/256: far above the last place (1/65536), far below what a pixel sees.
    offset: 0.003_906_25,
    drawing: 38,
    stolen: 0.0,
    lean: Lean::Nothing,
    last: false,
    windows: false,
    moves: true,
    columns_only: false,
    hertz: 2_000_000.0,
    wraps: false,
    columns: 512,
    pixels: |_| 1,
    sizes: Sizes {
        operation: 0,
        copy_bool: 4,
        copy: 20,
        home: 4,
        test: 9,
        turns: 30,
        call: 3,
        around: 1,
        ends: 0,
    },
};
