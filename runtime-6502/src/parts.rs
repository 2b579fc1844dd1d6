//! The source that routines share; see `asm/`.

use slowlight_routine::{Part, Source};

const fn part(
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
    }
}

/// In the order in which they stand in a program: what defines symbols for others first.
pub(crate) static ALL: &[Part] = &[
    part("zero_page", include_str!("../asm/zero_page.asm"), &[], 0),
    part(
        "squares",
        include_str!("../asm/squares.asm"),
        &["zero_page"],
        2135,
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
        53,
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
        "int_divide",
        include_str!("../asm/int_divide.asm"),
        &["divide"],
        68,
    ),
    part(
        "modulo",
        include_str!("../asm/modulo.asm"),
        &["divide"],
        104,
    ),
    part("root", include_str!("../asm/root.asm"), &["zero_page"], 317),
    part("convert", include_str!("../asm/convert.asm"), &["sign"], 80),
];
