//! The source that routines share; see `asm/`.

use slowlight_routine::{Part, Source};

use crate::model::{ARCTANGENT, LOGARITHM, POWER_OF_TWO, SINE};
use crate::{log, scaled};

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
    }
}

/// The terms of a polynomial, as bytes.
pub(crate) const fn terms(name: &'static str, make: fn() -> Vec<i32>, bytes: u32) -> Part {
    Part {
        name,
        source: Source::Table(make),
        needs: &[],
        bytes,
    }
}

/// In the order in which they stand in a program: what defines symbols for others first.
const USUAL: &[Part] = &[
    part("zero_page", include_str!("../asm/zero_page.asm"), &[], 0),
    part(
        "squares",
        concat!(
            include_str!("../asm/squares_at.asm"),
            include_str!("../asm/squares_pages.asm"),
            include_str!("../asm/squares.asm")
        ),
        &["zero_page"],
        2135,
    ),
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
    part(
        "series",
        include_str!("../asm/series.asm"),
        &["multiply"],
        132,
    ),
    terms("sine_terms", || SINE.table(), 22),
    part(
        "sine",
        include_str!("../asm/sine.asm"),
        &["sign", "series", "sine_terms"],
        140,
    ),
    part(
        "tangent",
        include_str!("../asm/tangent.asm"),
        &["sine", "fixed_divide"],
        110,
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
    part(
        "product",
        concat!(
            "; The product of two numbers of 16 bits, a in a and x (high), b in arg.\nproduct16:\n",
            include_str!("../asm/scaled/point.asm"),
            include_str!("../asm/scaled/upper_products.asm"),
            include_str!("../asm/scaled/product.asm")
        ),
        &["squares", "scaled_page"],
        140,
    ),
    part(
        "plus_product",
        concat!(
            "; The same of numbers that are not below 0.\nplus_product:\n",
            include_str!("../asm/scaled/point.asm"),
            include_str!("../asm/scaled/upper_products.asm"),
            include_str!("../asm/scaled/plus_product.asm")
        ),
        &["product"],
        99,
    ),
    part(
        "middle16",
        concat!(
            "; The same of numbers with eight bits more than their product is to have.\nmiddle16:\n",
            include_str!("../asm/scaled/point.asm"),
            include_str!("../asm/scaled/middle.asm")
        ),
        &["product"],
        107,
    ),
    part(
        "square16",
        include_str!("../asm/scaled/square.asm"),
        &["product"],
        71,
    ),
    part("up", include_str!("../asm/scaled/up.asm"), &["product"], 94),
    part(
        "lower24",
        include_str!("../asm/scaled/lower.asm"),
        &["product"],
        20,
    ),
    part(
        "right32",
        include_str!("../asm/scaled/right32.asm"),
        &["zero_page"],
        42,
    ),
    part(
        "narrow",
        include_str!("../asm/scaled/narrow.asm"),
        &["right32"],
        85,
    ),
    part(
        "narrow24",
        include_str!("../asm/scaled/narrow_product.asm"),
        &["narrow", "product"],
        22,
    ),
    part(
        "widen",
        include_str!("../asm/scaled/widen.asm"),
        &["right32", "sign"],
        59,
    ),
    part(
        "widen_both",
        include_str!("../asm/scaled/widen_both.asm"),
        &["widen", "scaled_page"],
        42,
    ),
    part(
        "product32",
        include_str!("../asm/scaled/product32.asm"),
        &["product"],
        31,
    ),
    part(
        "int_product",
        include_str!("../asm/scaled/int_product.asm"),
        &["product32"],
        24,
    ),
    terms(
        "reciprocals_low",
        || scaled::model::reciprocal_bytes(0),
        256,
    ),
    terms(
        "reciprocals_high",
        || scaled::model::reciprocal_bytes(1),
        256,
    ),
    terms(
        "reciprocals_step",
        || scaled::model::reciprocal_bytes(2),
        256,
    ),
    part(
        "reciprocal",
        include_str!("../asm/scaled/reciprocal.asm"),
        &[
            "squares",
            "scaled_page",
            "reciprocals_low",
            "reciprocals_high",
            "reciprocals_step",
        ],
        64,
    ),
    part(
        "one_over",
        include_str!("../asm/scaled/one_over.asm"),
        &["reciprocal"],
        107,
    ),
    part(
        "divide16",
        include_str!("../asm/scaled/divide.asm"),
        &["reciprocal", "product"],
        330,
    ),
    terms("roots_low", || scaled::model::root_bytes(0), 192),
    terms("roots_high", || scaled::model::root_bytes(1), 192),
    terms("roots_step", || scaled::model::root_bytes(2), 192),
    part(
        "root16",
        include_str!("../asm/scaled/root.asm"),
        &["squares", "roots_low", "roots_high", "roots_step"],
        110,
    ),
    part(
        "int_root",
        include_str!("../asm/scaled/int_root.asm"),
        &["root16"],
        95,
    ),
    part(
        "product8",
        include_str!("../asm/scaled8/product.asm"),
        &["squares"],
        37,
    ),
    part(
        "narrow8",
        include_str!("../asm/scaled8/hold.asm"),
        &["narrow", "widen"],
        44,
    ),
    terms("isqrt_root", || scaled::byte::root_bytes(0), 192),
    terms("isqrt_next", || scaled::byte::root_bytes(1), 192),
    part(
        "root8",
        include_str!("../asm/scaled8/root.asm"),
        &["zero_page", "isqrt_root", "isqrt_next"],
        79,
    ),
    terms("inverses", || scaled::byte::inverses().to_vec(), 256),
    part(
        "divide8",
        include_str!("../asm/scaled8/divide.asm"),
        &["squares", "inverses"],
        202,
    ),
    terms("sines_low", || scaled::sines::bytes(0), 257),
    terms("sines_high", || scaled::sines::bytes(1), 256),
    part(
        "sine16",
        include_str!("../asm/scaled/sine.asm"),
        &["squares", "sines_low", "sines_high"],
        270,
    ),
    terms("powers_low", || scaled::powers::bytes(0), 257),
    terms("powers_high", || scaled::powers::bytes(1), 256),
    part(
        "exponential16",
        include_str!("../asm/scaled/exponential.asm"),
        &["squares", "powers_low", "powers_high"],
        251,
    ),
    part(
        "squares24",
        include_str!("../asm/scaled24/squares.asm"),
        &["squares", "scaled24_page"],
        25,
    ),
    part(
        "product24",
        include_str!("../asm/scaled24/product.asm"),
        &["squares24"],
        245,
    ),
    part(
        "square24",
        include_str!("../asm/scaled24/square.asm"),
        &["squares24"],
        169,
    ),
    part(
        "up24",
        include_str!("../asm/scaled24/up.asm"),
        &["scaled24_page"],
        80,
    ),
    part(
        "lower32",
        include_str!("../asm/scaled24/lower.asm"),
        &["scaled24_page"],
        53,
    ),
    part(
        "hold24",
        include_str!("../asm/scaled24/narrow.asm"),
        &["right32"],
        94,
    ),
    part(
        "widen24",
        include_str!("../asm/scaled24/widen.asm"),
        &["widen_both"],
        51,
    ),
    part(
        "exact24",
        include_str!("../asm/scaled24/exact.asm"),
        &["multiply", "sign", "hold24"],
        156,
    ),
    terms("reciprocals24_0", || scaled::long::reciprocal_bytes(0), 256),
    terms("reciprocals24_1", || scaled::long::reciprocal_bytes(1), 256),
    terms("reciprocals24_2", || scaled::long::reciprocal_bytes(2), 256),
    terms(
        "reciprocals24_step0",
        || scaled::long::reciprocal_bytes(3),
        256,
    ),
    terms(
        "reciprocals24_step1",
        || scaled::long::reciprocal_bytes(4),
        256,
    ),
    terms("roots24_0", || scaled::long::root_bytes(0), 192),
    terms("roots24_1", || scaled::long::root_bytes(1), 192),
    terms("roots24_2", || scaled::long::root_bytes(2), 192),
    terms("roots24_step0", || scaled::long::root_bytes(3), 192),
    terms("roots24_step1", || scaled::long::root_bytes(4), 192),
    terms("roots24_inverse", scaled::long::inverse_bytes, 192),
    part(
        "refine24",
        include_str!("../asm/scaled24/refine.asm"),
        &["squares24"],
        302,
    ),
    part(
        "reciprocal24",
        include_str!("../asm/scaled24/reciprocal.asm"),
        &[
            "refine24",
            "reciprocals24_0",
            "reciprocals24_1",
            "reciprocals24_2",
            "reciprocals24_step0",
            "reciprocals24_step1",
        ],
        142,
    ),
    part(
        "one_over24",
        include_str!("../asm/scaled24/one_over.asm"),
        &["reciprocal24"],
        142,
    ),
    part(
        "divide24",
        include_str!("../asm/scaled24/divide.asm"),
        &["one_over24", "product24"],
        200,
    ),
    part(
        "root24",
        include_str!("../asm/scaled24/root.asm"),
        &[
            "refine24",
            "roots24_0",
            "roots24_1",
            "roots24_2",
            "roots24_step0",
            "roots24_step1",
            "roots24_inverse",
        ],
        216,
    ),
];

/// All of them, those of logarithms behind the others.
pub(crate) static ALL: &[Part] = &joined::<{ USUAL.len() + log::PARTS.len() }>(USUAL, log::PARTS);

const fn joined<const N: usize>(a: &[Part], b: &[Part]) -> [Part; N] {
    let mut all = [a[0]; N];
    let mut k = 0;
    while k < N {
        all[k] = if k < a.len() { a[k] } else { b[k - a.len()] };
        k += 1;
    }
    all
}
