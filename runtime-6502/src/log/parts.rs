//! The source that routines for logarithmic reals share; see `asm/log`.

use super::tables::Bytes;
use crate::parts::{OF_USUAL, part, terms, with};
use slowlight_routine::Part;

/// The text of a file.
macro_rules! asm {
    ($($name:literal),+) => {
        include_str!(concat!("../../asm/log/", $($name,)+ ".asm"))
    };
}

/// acc = log_z, in the last four octaves below 0, less what stands for it in the three tables of
/// such a name.
macro_rules! curve {
    ($frac:literal, $name:literal) => {
        concat!(
            asm!("curve_place", $frac),
            asm!("curve"),
            "        clc\n        lda ",
            $name,
            "_low,y\n        adc ",
            $name,
            "_steps,x\n",
            "        sta log_x\n        lda ",
            $name,
            "_high,y\n        adc #0\n",
            "        sta log_x+1\n        sec\n        lda log_z\n        sbc log_x\n",
            "        sta acc\n        lda log_z+1\n        sbc log_x+1\n        sta acc+1\n",
            "        rts\n"
        )
    };
}

/// In the order in which they stand in a program, for so many bits behind the point: what of
/// it hangs on these, and on what sums are looked up in, sizes of tables among it, is given.
macro_rules! parts {
    ($frac:literal, [$pages:literal, $sum_far:literal, $difference_far:literal],
     [$sums:expr, $lost:expr], $parts:literal, $octaves:literal,
     [$($far:expr),*], $rest:literal, [$sum:literal, $difference:literal, $whole:literal, $arc:literal, $sine:literal]) => {
        &[
            part("log_page", concat!(asm!("page"), asm!("octave", $frac), asm!($pages)), &["zero_page"], 0),
            terms("log_sums", $sums.0, $sums.1),
            terms("log_lost", $lost.0, $lost.1),
            terms("log_parts", Bytes::<$frac>::parts, $parts),
            terms("log_logs_low", Bytes::<$frac>::logs_low, 513),
            terms("log_logs_high", Bytes::<$frac>::logs_high, 513),
            $($far,)*
            part("log_sum", concat!(asm!("sum"), asm!($sum_far)), &[$rest, "log_sums"], $sum),
            part("log_difference", concat!(asm!("difference"), asm!($difference_far)), &[$rest, "log_lost"], $difference),
            part("log_keep", asm!("keep"), &["log_page"], 22),
            part("log_plus", asm!("plus"), &["log_sum"], 65),
            part("log_minus", asm!("minus"), &["log_plus", "log_difference", "log_keep"], 48),
            part("log_add", asm!("add"), &["log_minus", "log_keep"], 43),
            part("log_whole", concat!(asm!("whole"), $octaves, asm!("whole_part")), &["log_page", "log_parts"], $whole),
            part("log_is_whole", asm!("is_whole"), &["log_page", "log_logs_low", "log_logs_high"], 38),
            part("log_floor", asm!("floor"), &["log_whole", "log_is_whole"], 73),
            part("log_round", asm!("round"), &["log_floor"], 46),
            part("log_from_int", asm!("from_int"), &["log_is_whole", "log_plus", "log_keep"], 168),
            part("log_param", asm!("param"), &["log_from_int"], 57),
            part("log_curve", asm!("curve_less"), &["log_minus"], 12),
            terms("log_sine_low", Bytes::<$frac>::sine_low, 256),
            terms("log_sine_high", Bytes::<$frac>::sine_high, 256),
            terms("log_sine_steps", Bytes::<$frac>::sine_steps, 256),
            terms("log_sine_last_units", Bytes::<$frac>::sine_last, 256),
            part("log_sine", concat!(asm!("sine"), curve!($frac, "log_sine"), asm!("sine_last"), asm!("sine_end")), &["log_curve", "log_whole", "log_is_whole", "log_sine_low", "log_sine_high", "log_sine_steps", "log_sine_last_units"], $sine),
            part("log_tangent", asm!("tangent"), &["log_sine"], 50),
            terms("log_arc_low", Bytes::<$frac>::arc_low, 256),
            terms("log_arc_high", Bytes::<$frac>::arc_high, 256),
            terms("log_arc_steps", Bytes::<$frac>::arc_steps, 256),
            part("log_arc", concat!(asm!("arc"), curve!($frac, "log_arc"), asm!("arc_end")), &["log_curve", "log_arc_low", "log_arc_high", "log_arc_steps"], $arc),
            part("log_units", asm!("units"), &["log_whole", "log_is_whole"], 162),
            part("log_exponential", asm!("exponential"), &["log_units", "log_keep"], 46),
            part("log_natural", asm!("logarithm"), &["log_from_int"], 87),
            part("log_power", asm!("power"), &["log_exponential", "log_natural", "log_is_whole"], 266),
            part("log_modulo", asm!("modulo"), &["log_floor", "log_from_int", "log_add"], 197),
        ]
    };
}

/// What counts the steps behind six octaves, of ten bits.
#[rustfmt::skip]
macro_rules! ten {
    ($files:tt, $tables:tt, $bytes:tt) => {
        parts!(
            10, $files, $tables, 1024, "        lsr\n        lsr\n",
            [
                terms("log_rest_first", super::tables::rest_first, 23),
                terms("log_rest_low", super::tables::rest_low, 24),
                terms("log_rest_high", super::tables::rest_high, 24),
                part("log_rest", asm!("rest"), &["log_page", "log_rest_first", "log_rest_low", "log_rest_high"], 31)
            ],
            "log_rest", $bytes
        )
    };
}

#[rustfmt::skip]
macro_rules! eleven {
    ($files:tt, $tables:tt, $bytes:tt) => {
        parts!(
            11, $files, $tables, 2048, "        lsr\n        lsr\n        lsr\n",
            [part("log_sixteenth", asm!("sixteenth"), &["log_page"], 24)],
            "log_sixteenth", $bytes
        )
    };
}

const TEN: &[Part] = ten!(
    ["pages10", "sum_far10", "difference_far10"],
    [(Bytes::<10>::sums, 8705), (Bytes::<10>::lost, 8961)],
    [95, 108, 142, 284, 279]
);
const TEN_WHOLE: &[Part] = ten!(
    ["pages10_whole", "sum_far10", "difference_far10"],
    [
        (Bytes::<10>::whole_sums, 12_033),
        (Bytes::<10>::whole_lost, 12_033)
    ],
    [95, 108, 142, 284, 279]
);
const ELEVEN: &[Part] = eleven!(
    ["pages11", "sum_far11", "difference_far11"],
    [(Bytes::<11>::sums, 14_849), (Bytes::<11>::lost, 15_105)],
    [116, 122, 143, 286, 281]
);
const ELEVEN_WHOLE: &[Part] = eleven!(
    ["pages11_whole", "sum_far11_whole", "difference_far11_whole"],
    [
        (Bytes::<11>::whole_sums, 18_177),
        (Bytes::<11>::whole_lost, 18_689)
    ],
    [109, 115, 143, 286, 281]
);

/// Those of ten bits, and of eleven, behind the usual ones, which ints need.
pub(super) static WITH_TEN: [Part; OF_USUAL + TEN.len()] = with(TEN);
pub(super) static WITH_ELEVEN: [Part; OF_USUAL + ELEVEN.len()] = with(ELEVEN);
/// The same with whole tables.
pub(super) static WITH_TEN_WHOLE: [Part; OF_USUAL + TEN.len()] = with(TEN_WHOLE);
pub(super) static WITH_ELEVEN_WHOLE: [Part; OF_USUAL + ELEVEN.len()] = with(ELEVEN_WHOLE);
