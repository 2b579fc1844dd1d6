//! Target descriptions of the Hack computer, by the format of its reals.

use super::{Lean, Mode, Sizes, System, Target};
use slowlight_runtime_jack::fixed::FIXED16;
use slowlight_runtime_jack::log::LOG10;
use slowlight_runtime_jack::wide::F416;
use slowlight_runtime_jack::{F316, F316R};

/// The Hack computer, programmed in Jack.
pub static JACK: Target = FLOATS;

/// The same with rounded reals.
pub static JACK_F316R: Target = Target {
    runtime: &F316R,
    ..FLOATS
};

/// The same with reals of twice as many bits, rounded. A hit is known as well as on machines
/// with 32 bits of mantissa, and so is how far it is from its own surface.
pub static JACK_F416: Target = Target {
    runtime: &F416,
    offset: 1e-5,
    last: true,
    ..FLOATS
};

/// The same with logarithmic reals.
pub static JACK_LOG10: Target = Target {
    runtime: &LOG10,
    ..FLOATS
};

/// The same with reals in fixed point, each with fraction bits of its own.
pub static JACK_FIXED16: Target = Target {
    runtime: &FIXED16,
    ..FLOATS
};

const FLOATS: Target = Target {
    name: "jack",
    system: System::Hack,
    about: "the Hack computer of nand2tetris, black and white, programmed in Jack",
    runtime: &F316,
    modes: &[Mode {
        name: "",
        width: 512,
        height: 256,
        inks: 2,
    }],
    // 1/64. Roots are off by up to 1/500 and quotients by 1/800 of themselves, so
    // a hit a few units away is known to a few thousandths, and its distance
    // from its own surface comes out as large; four times that is still far
    // below what a pixel sees.
    offset: 0.015_625,
    drawing: 29,
    stolen: 0.0,
    lean: Lean::Short,
    last: false,
    windows: false,
    moves: true,
    columns_only: false,
    // VM commands a second of the official VM emulator. Its calls of the operating
    // system take longer, about 10 microseconds each, which one rate cannot say.
    hertz: 12.6e6,
    // Words of the heap: code does not count there, values do.
    wraps: false,
    columns: 512,
    pixels: |_| 1,
    sizes: Sizes {
        operation: 4,
        copy_bool: 2,
        copy: 4,
        home: 6,
        test: 6,
        turns: 12,
        call: 3,
        around: 4,
        ends: 0,
    },
};
