//! Target descriptions of BBC BASIC: on a BBC Micro, on an Agon, on a computer of today.

use super::{Lean, Mode, Sizes, System, Target};
use slowlight_runtime_bbc::RUNTIME;

const fn mode(name: &'static str, width: u32, height: u32, inks: u32) -> Mode {
    Mode {
        name,
        width,
        height,
        inks,
    }
}

/// A BBC Micro's modes for pictures, by their numbers.
pub(super) const MODE_0: Mode = mode("0", 640, 256, 2);
pub(super) const MODE_1: Mode = mode("1", 320, 256, 4);
pub(super) const MODE_2: Mode = mode("2", 160, 256, 16);
pub(super) const MODE_4: Mode = mode("4", 320, 256, 2);
pub(super) const MODE_5: Mode = mode("5", 160, 256, 4);

/// By the memory that the screen takes from the program: 10K in modes 4 and 5, 20K in the others.
static MICRO_MODES: &[Mode] = &[MODE_5, MODE_4, MODE_2, MODE_1, MODE_0];

static AGON_MODES: &[Mode] = &[
    mode("9", 320, 240, 16),
    mode("10", 320, 240, 4),
    mode("11", 320, 240, 2),
    mode("4", 640, 240, 16),
    mode("5", 640, 240, 4),
    mode("0", 640, 480, 16),
    mode("1", 640, 480, 4),
    mode("2", 640, 480, 2),
];

static BASIC_V_MODES: &[Mode] = &[
    mode("9", 320, 256, 16),
    mode("1", 320, 256, 4),
    mode("4", 320, 256, 2),
    mode("2", 160, 256, 16),
    mode("12", 640, 256, 16),
    mode("8", 640, 256, 4),
    mode("0", 640, 256, 2),
    mode("20", 640, 512, 16),
];

/// The least distance along a ray that counts as in front: reals of 32 bits are good to 1E-9
/// at the scenes' scale, a pixel to 1E-3.
pub(super) const OFFSET: f64 = 1e-5;

/// Bytes of tokens in a tight program.
const SIZES: Sizes = Sizes {
    operation: 5,
    copy_bool: 6,
    copy: 6,
    home: 8,
    test: 14,
    turns: 40,
    call: 4,
    around: 20,
    ends: 25,
};

/// A BBC Micro with BASIC II.
pub static MICRO: Target = Target {
    name: "bbc:micro",
    system: System::BbcBasic,
    about: "a BBC Micro with BASIC II and a disc drive (PAGE &1900)",
    runtime: &RUNTIME,
    modes: MICRO_MODES,
    offset: OFFSET,
    drawing: 3_400,
    stolen: 0.0,
    lean: Lean::Short,
    last: false,
    windows: false,
    moves: true,
    columns_only: false,
    hertz: 2_000_000.0,
    sizes: SIZES,
    wraps: true,
    columns: 1024,
    pixels: |mode| match mode.inks {
        2 => 8,
        4 => 4,
        _ => 2,
    },
};

/// An Agon Light with BBC BASIC.
pub static AGON: Target = Target {
    name: "bbc:agon",
    system: System::Agon,
    about: "an Agon Light with BBC BASIC; times are from a comparison of one program",
    runtime: &RUNTIME,
    modes: AGON_MODES,
    offset: OFFSET,
    drawing: 6_600,
    stolen: 0.0,
    lean: Lean::Short,
    last: false,
    windows: false,
    moves: true,
    columns_only: false,
    // Measured: the two mirrors in 11.6 minutes for BASIC II's 17.8e9 cycles.
    hertz: 25_500_000.0,
    sizes: SIZES,
    wraps: false,
    columns: 1024,
    pixels: |_| 1,
};

/// Matrix Brandy on a computer of today.
pub static BASIC_V: Target = Target {
    name: "bbc:basicv",
    system: System::BasicV,
    about: "Matrix Brandy (BASIC V) on a computer of today; its reals are doubles",
    runtime: &RUNTIME,
    modes: BASIC_V_MODES,
    offset: OFFSET,
    drawing: 6_600,
    stolen: 0.0,
    lean: Lean::Short,
    last: false,
    windows: false,
    moves: true,
    columns_only: false,
    // Measured: 0.15 seconds for the same program.
    hertz: 1.2e11,
    sizes: SIZES,
    wraps: false,
    columns: 1024,
    pixels: |_| 1,
};
