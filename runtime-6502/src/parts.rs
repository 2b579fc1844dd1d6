//! The source that routines share; see `asm/`.

use slowlight_routine::{Part, Source};

use crate::model::{ARCTANGENT, LOGARITHM, POWER_OF_TWO, SINE, wide_sines};
use crate::scaled;

pub(crate) const fn part(
    name: &'static str,
    text: &'static str,
    needs: &'static [&'static str],
    bytes: u32,
) -> Part {
    Part {
        name,
        source: Source::Text(text),
        needs,
        bytes,
        starts: 0,
    }
}

/// The terms of a polynomial, as bytes.
pub(crate) const fn terms(name: &'static str, make: fn() -> Vec<i32>, bytes: u32) -> Part {
    Part {
        name,
        source: Source::Table(make),
        needs: &[],
        bytes,
        starts: 0,
    }
}

/// In the order in which they stand in a program: what defines symbols for others first.
const USUAL: &[Part] = &[
    part("zero_page", include_str!("../asm/zero_page.asm"), &[], 0),
    Part {
        // Where a program does not have them in its file.
        starts: 25_124,
        ..part(
            "squares",
            concat!(
                include_str!("../asm/squares_at.asm"),
                include_str!("../asm/squares_pages.asm"),
                include_str!("../asm/squares.asm")
            ),
            &["zero_page"],
            2135,
        )
    },
    part(
        "scaled_page",
        include_str!("../asm/scaled/page.asm"),
        &["zero_page"],
        0,
    ),
    part(
        "scaled24_page",
        include_str!("../asm/scaled24/page.asm"),
        &["scaled_page"],
        0,
    ),
    part("sign", include_str!("../asm/sign.asm"), &["zero_page"], 92),
    part(
        "multiply",
        include_str!("../asm/multiply.asm"),
        &["squares"],
        225,
    ),
    part(
        "fixed_multiply",
        include_str!("../asm/fixed_multiply.asm"),
        &["sign", "multiply"],
        282,
    ),
    part(
        "fixed_square",
        include_str!("../asm/fixed_square.asm"),
        &["sign", "multiply"],
        201,
    ),
    part(
        "int_multiply",
        include_str!("../asm/int_multiply.asm"),
        &["sign", "multiply"],
        40,
    ),
    part("divide", include_str!("../asm/divide.asm"), &["sign"], 223),
    part(
        "fixed_divide",
        include_str!("../asm/fixed_divide.asm"),
        &["divide"],
        113,
    ),
    part(
        "divide_signed",
        include_str!("../asm/divide_signed.asm"),
        &["divide"],
        130,
    ),
    part(
        "int_divide",
        include_str!("../asm/int_divide.asm"),
        &["divide_signed"],
        55,
    ),
    part(
        "modulo",
        include_str!("../asm/modulo.asm"),
        &["divide_signed"],
        91,
    ),
    part(
        "word_divide",
        include_str!("../asm/word_divide.asm"),
        &["zero_page"],
        49,
    ),
    part("root", include_str!("../asm/root.asm"), &["zero_page"], 317),
    part("convert", include_str!("../asm/convert.asm"), &["sign"], 80),
    part(
        "series",
        include_str!("../asm/series.asm"),
        &["multiply"],
        132,
    ),
    terms("sine_terms", || SINE.table(), 22),
    part(
        "quadrant_sine",
        include_str!("../asm/quadrant_sine.asm"),
        &["sign", "series", "sine_terms"],
        69,
    ),
    part(
        "tangent",
        include_str!("../asm/tangent.asm"),
        &["quadrant_sine", "fixed_divide"],
        110,
    ),
    terms("wide_sines_low", || wide_sines(0), 257),
    terms("wide_sines_middle", || wide_sines(1), 257),
    terms("wide_sines_high", || wide_sines(2), 256),
    part(
        "sine",
        include_str!("../asm/sine.asm"),
        &[
            "squares",
            "sign",
            "wide_sines_low",
            "wide_sines_middle",
            "wide_sines_high",
        ],
        368,
    ),
    terms("arctangent_terms", || ARCTANGENT.table(), 30),
    part(
        "arctangent",
        include_str!("../asm/arctangent.asm"),
        &["divide", "series", "arctangent_terms"],
        262,
    ),
    part(
        "arccosine",
        include_str!("../asm/arccosine.asm"),
        &["root", "arctangent"],
        205,
    ),
    terms("power_of_two_terms", || POWER_OF_TWO.table(), 34),
    part(
        "power_of_two",
        include_str!("../asm/power_of_two.asm"),
        &["series", "power_of_two_terms"],
        127,
    ),
    part(
        "exponential",
        include_str!("../asm/exponential.asm"),
        &["sign", "power_of_two"],
        88,
    ),
    terms("logarithm_terms", || LOGARITHM.table(), 26),
    part(
        "logarithm",
        include_str!("../asm/logarithm.asm"),
        &["divide", "series", "logarithm_terms"],
        323,
    ),
    part(
        "power",
        include_str!("../asm/power.asm"),
        &["logarithm", "power_of_two"],
        195,
    ),
];

/// All of them but those of logarithms.
pub(crate) static ALL: &[Part] =
    &joined::<{ USUAL.len() + scaled::PARTS.len() }>(USUAL, scaled::PARTS);

/// The usual ones, and others behind them.
pub(crate) const fn with<const N: usize>(others: &[Part]) -> [Part; N] {
    joined(USUAL, others)
}

pub(crate) const OF_USUAL: usize = USUAL.len();

const fn joined<const N: usize>(a: &[Part], b: &[Part]) -> [Part; N] {
    let mut all = [a[0]; N];
    let mut k = 0;
    while k < N {
        all[k] = if k < a.len() { a[k] } else { b[k - a.len()] };
        k += 1;
    }
    all
}
