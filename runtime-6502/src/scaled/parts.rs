//! The source that routines for reals with points of their own share; see `asm/scaled`,
//! `asm/scaled8` and `asm/scaled24`.

use crate::parts::{part, terms};
use slowlight_routine::Part;

/// A text for 24 bits, of files one behind the other.
macro_rules! of24 {
    ($($name:literal),+) => {
        concat!($(include_str!(concat!("../../asm/scaled24/", $name, ".asm"))),+)
    };
}

/// In the order in which they stand in a program, behind those of all formats.
pub(crate) const ALL: &[Part] = &[
    part(
        "product",
        concat!(
            "; The product of two numbers of 16 bits, a in a and x (high), b in arg.\nproduct16:\n",
            include_str!("../../asm/scaled/point.asm"),
            include_str!("../../asm/scaled/upper_products.asm"),
            include_str!("../../asm/scaled/product.asm")
        ),
        &["squares", "scaled_page"],
        140,
    ),
    part(
        "plus_product",
        concat!(
            "; The same of numbers that are not below 0.\nplus_product:\n",
            include_str!("../../asm/scaled/point.asm"),
            include_str!("../../asm/scaled/upper_products.asm"),
            include_str!("../../asm/scaled/plus_product.asm")
        ),
        &["product"],
        99,
    ),
    part(
        "middle16",
        concat!(
            "; The same of numbers with eight bits more than their product is to have.\nmiddle16:\n",
            include_str!("../../asm/scaled/point.asm"),
            include_str!("../../asm/scaled/middle.asm")
        ),
        &["product"],
        107,
    ),
    part(
        "square16",
        include_str!("../../asm/scaled/square.asm"),
        &["product"],
        71,
    ),
    part(
        "up",
        include_str!("../../asm/scaled/up.asm"),
        &["product"],
        94,
    ),
    part(
        "saturate16",
        include_str!("../../asm/scaled/saturate.asm"),
        &[],
        27,
    ),
    part(
        "abs16",
        include_str!("../../asm/scaled/abs.asm"),
        &["zero_page"],
        19,
    ),
    part(
        "right16",
        include_str!("../../asm/scaled/right16.asm"),
        &["zero_page"],
        22,
    ),
    part(
        "lower24",
        include_str!("../../asm/scaled/lower.asm"),
        &["product"],
        20,
    ),
    part(
        "right32",
        include_str!("../../asm/scaled/right32.asm"),
        &["zero_page"],
        42,
    ),
    part(
        "narrow",
        include_str!("../../asm/scaled/narrow.asm"),
        &["right32"],
        85,
    ),
    part(
        "narrow24",
        include_str!("../../asm/scaled/narrow_product.asm"),
        &["narrow", "product"],
        22,
    ),
    part(
        "widen",
        include_str!("../../asm/scaled/widen.asm"),
        &["right32", "sign"],
        59,
    ),
    part(
        "widen_both",
        include_str!("../../asm/scaled/widen_both.asm"),
        &["widen", "scaled_page"],
        42,
    ),
    part(
        "modulo16",
        include_str!("../../asm/scaled/modulo.asm"),
        &["zero_page"],
        144,
    ),
    part(
        "product32",
        include_str!("../../asm/scaled/product32.asm"),
        &["product"],
        31,
    ),
    part(
        "int_product",
        include_str!("../../asm/scaled/int_product.asm"),
        &["product32"],
        24,
    ),
    terms("reciprocals_low", || super::model::reciprocal_bytes(0), 256),
    terms(
        "reciprocals_high",
        || super::model::reciprocal_bytes(1),
        256,
    ),
    terms(
        "reciprocals_step",
        || super::model::reciprocal_bytes(2),
        256,
    ),
    part(
        "reciprocal",
        include_str!("../../asm/scaled/reciprocal.asm"),
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
        include_str!("../../asm/scaled/one_over.asm"),
        &["reciprocal"],
        107,
    ),
    part(
        "divide16",
        include_str!("../../asm/scaled/divide.asm"),
        &["reciprocal", "product"],
        330,
    ),
    terms("roots_low", || super::model::root_bytes(0), 192),
    terms("roots_high", || super::model::root_bytes(1), 192),
    terms("roots_step", || super::model::root_bytes(2), 192),
    part(
        "root16",
        include_str!("../../asm/scaled/root.asm"),
        &["squares", "roots_low", "roots_high", "roots_step"],
        110,
    ),
    part(
        "int_root",
        include_str!("../../asm/scaled/int_root.asm"),
        &["root16"],
        95,
    ),
    terms(
        "reciprocal_roots_low",
        || super::model::reciprocal_root_bytes(0),
        192,
    ),
    terms(
        "reciprocal_roots_high",
        || super::model::reciprocal_root_bytes(1),
        192,
    ),
    terms(
        "reciprocal_roots_step",
        || super::model::reciprocal_root_bytes(2),
        192,
    ),
    part(
        "reciprocal_root",
        include_str!("../../asm/scaled/reciprocal_root.asm"),
        &[
            "squares",
            "scaled_page",
            "reciprocal_roots_low",
            "reciprocal_roots_high",
            "reciprocal_roots_step",
        ],
        127,
    ),
    part(
        "product8",
        include_str!("../../asm/scaled8/product.asm"),
        &["squares"],
        37,
    ),
    part(
        "narrow8",
        include_str!("../../asm/scaled8/hold.asm"),
        &["narrow", "widen"],
        44,
    ),
    terms("isqrt_root", || super::byte::root_bytes(0), 192),
    terms("isqrt_next", || super::byte::root_bytes(1), 192),
    part(
        "root8",
        include_str!("../../asm/scaled8/root.asm"),
        &["zero_page", "isqrt_root", "isqrt_next"],
        79,
    ),
    terms("inverses", || super::byte::inverses().to_vec(), 256),
    part(
        "divide8",
        include_str!("../../asm/scaled8/divide.asm"),
        &["squares", "inverses"],
        202,
    ),
    terms("sines_low", || super::sines::bytes(0), 257),
    terms("sines_high", || super::sines::bytes(1), 256),
    part(
        "sine16",
        include_str!("../../asm/scaled/sine.asm"),
        &["squares", "sines_low", "sines_high"],
        284,
    ),
    terms("powers_low", || super::powers::bytes(0), 257),
    terms("powers_high", || super::powers::bytes(1), 256),
    part(
        "exponential16",
        include_str!("../../asm/scaled/exponential.asm"),
        &["squares", "powers_low", "powers_high"],
        251,
    ),
    terms("logarithms_low", || super::logarithms::bytes(0), 257),
    terms("logarithms_middle", || super::logarithms::bytes(1), 257),
    terms("logarithms_high", || super::logarithms::bytes(2), 256),
    terms("shifts_low", || super::logarithms::shift_bytes(0), 32),
    terms("shifts_middle", || super::logarithms::shift_bytes(1), 32),
    terms("shifts_high", || super::logarithms::shift_bytes(2), 32),
    terms("shifts_whole", || super::logarithms::shift_bytes(3), 32),
    part(
        "table_logarithm",
        include_str!("../../asm/scaled/logarithm.asm"),
        &[
            "squares",
            "sign",
            "logarithms_low",
            "logarithms_middle",
            "logarithms_high",
            "shifts_low",
            "shifts_middle",
            "shifts_high",
            "shifts_whole",
        ],
        185,
    ),
    part(
        "squares24",
        of24!("squares"),
        &["squares", "scaled24_page"],
        25,
    ),
    part(
        "product24",
        concat!(
            "; The product of two numbers of 24 bits, a in a, x and y (high), b in arg: its upper 32 bits\n; in prod+2, prod+3, prod+4 and a (high). Of what is below only the upper bytes of a0 b1 and\n; a1 b0 are added, so it is a few of the 32 bits' units off.\nproduct24:\n",
            of24!("factor", "product")
        ),
        &["squares24"],
        245,
    ),
    part("square24", of24!("square"), &["squares24"], 169),
    part("up24", of24!("up"), &["scaled24_page"], 88),
    part(
        "whole24",
        concat!(
            "; The product of two numbers of 24 bits, a in a, x and y (high), b in arg: all of it but its\n; lowest byte, in prod+1 to prod+4 and a (high).\nwhole24:\n",
            of24!("factor", "whole")
        ),
        &["product24"],
        164,
    ),
    part("round40", of24!("round40"), &["up24"], 57),
    part("lower32", of24!("lower"), &["scaled24_page"], 53),
    part("hold24", of24!("narrow"), &["right32"], 94),
    part("widen24", of24!("widen"), &["widen_both"], 51),
    part("modulo24", of24!("modulo"), &["widen24", "modulo"], 8),
    part(
        "exact24",
        of24!("exact"),
        &["multiply", "sign", "hold24"],
        156,
    ),
    terms("reciprocals24_0", || super::long::reciprocal_bytes(0), 256),
    terms("reciprocals24_1", || super::long::reciprocal_bytes(1), 256),
    terms("reciprocals24_2", || super::long::reciprocal_bytes(2), 256),
    terms(
        "reciprocals24_step0",
        || super::long::reciprocal_bytes(3),
        256,
    ),
    terms(
        "reciprocals24_step1",
        || super::long::reciprocal_bytes(4),
        256,
    ),
    terms("roots24_0", || super::long::root_bytes(0), 192),
    terms("roots24_1", || super::long::root_bytes(1), 192),
    terms("roots24_2", || super::long::root_bytes(2), 192),
    terms("roots24_step0", || super::long::root_bytes(3), 192),
    terms("roots24_step1", || super::long::root_bytes(4), 192),
    terms("roots24_inverse", super::long::inverse_bytes, 192),
    part("refine24", of24!("refine"), &["squares24"], 302),
    part(
        "reciprocal24",
        of24!("reciprocal"),
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
    part("one_over24", of24!("one_over"), &["reciprocal24"], 142),
    part(
        "divide24",
        of24!("divide"),
        &["one_over24", "product24"],
        200,
    ),
    part(
        "root24",
        of24!("root"),
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
