//! The source that routines for floating-point reals share; see `asm/float`.

use super::functions::{ARCTANGENT, EXPONENTIAL, LOGARITHM, SINE};
use crate::parts::{OF_USUAL, part, terms, with};
use slowlight_routine::{Part, Source};

/// The text of a file.
macro_rules! asm {
    ($name:literal) => {
        include_str!(concat!("../../asm/float/", $name, ".asm"))
    };
}

/// One shift, of the first operand's mantissa or of the second's.
const fn shift(name: &'static str, write: fn() -> String) -> Part {
    Part {
        source: Source::Made(write),
        ..part(name, "", &["float_page"], 65)
    }
}

/// In the order in which they stand in a program.
#[rustfmt::skip]
const FLOATS: &[Part] = &[
    part("float_page", asm!("page"), &["zero_page"], 0),
    part("float_core", asm!("core"), &["float_page"], 214),
    shift("float_shift_first", || asm!("shift").replace('@', "fa")),
    shift("float_shift_second", || asm!("shift").replace('@', "fb")),
    part("float_add", asm!("add"), &["float_core", "float_shift_first", "float_shift_second"], 275),
    part("float_product", asm!("product"), &["float_page", "squares"], 408),
    part("float_multiply", asm!("multiply"), &["float_core", "float_product"], 98),
    part("float_divide", asm!("divide"), &["float_core"], 206),
    part("float_root", asm!("root"), &["float_core"], 427),
    part("float_modulo", asm!("modulo"), &["float_add"], 169),
    part("float_convert", asm!("convert"), &["float_core"], 109),
    part("float_floor", asm!("floor"), &["float_page"], 262),
    part("float_ratio", asm!("ratio"), &["float_convert", "float_divide"], 33),
    part("float_series", asm!("series"), &["float_product", "float_core", "float_shift_second"], 174),
    terms("float_sine_terms", || SINE.table(), 26),
    part("float_sine", asm!("sine"), &["float_series", "float_sine_terms", "float_shift_first"], 183),
    part("float_tangent", asm!("tangent"), &["float_sine", "float_divide"], 50),
    terms("float_arctangent_terms", || ARCTANGENT.table(), 46),
    part("float_arctangent", asm!("arctangent"), &["float_series", "float_arctangent_terms", "float_divide", "float_add"], 135),
    part("float_arccosine", asm!("arccosine"), &["float_arctangent", "float_multiply", "float_root"], 126),
    terms("float_exponential_terms", || EXPONENTIAL.table(), 34),
    part("float_exponential", asm!("exponential"), &["float_series", "float_exponential_terms"], 177),
    terms("float_logarithm_terms", || LOGARITHM.table(), 22),
    part("float_logarithm", asm!("logarithm"), &["float_series", "float_logarithm_terms", "float_divide", "float_multiply", "float_add", "float_convert"], 197),
    part("float_power", asm!("power"), &["float_logarithm", "float_exponential"], 142),
];

/// Those of floats behind the usual ones, which ints need.
pub(super) static ALL: [Part; OF_USUAL + FLOATS.len()] = with(FLOATS);
