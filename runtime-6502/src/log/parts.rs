//! The source that routines for logarithmic reals share; see `asm/log`.

use super::tables;
use crate::parts::{part, terms};
use slowlight_routine::Part;

/// The text of a file.
macro_rules! asm {
    ($name:literal) => {
        include_str!(concat!("../../asm/log/", $name, ".asm"))
    };
}

/// In the order in which they stand in a program.
#[rustfmt::skip]
pub(crate) const ALL: &[Part] = &[
    part("log_page", asm!("page"), &["zero_page"], 0),
    terms("log_sums", tables::sums, 8704),
    terms("log_lost", tables::lost, 8960),
    terms("log_parts", tables::parts, 1024),
    terms("log_logs_low", tables::logs_low, 513),
    terms("log_logs_high", tables::logs_high, 513),
    terms("log_rest_first", tables::rest_first, 23),
    terms("log_rest_low", tables::rest_low, 24),
    terms("log_rest_high", tables::rest_high, 24),
    part("log_rest", asm!("rest"), &["log_page", "log_rest_first", "log_rest_low", "log_rest_high"], 40),
    part("log_sum", asm!("sum"), &["log_rest", "log_sums"], 41),
    part("log_difference", asm!("difference"), &["log_rest", "log_lost"], 50),
    part("log_keep", asm!("keep"), &["log_page"], 30),
    part("log_plus", asm!("plus"), &["log_sum"], 61),
    part("log_minus", asm!("minus"), &["log_plus", "log_difference", "log_keep"], 35),
    part("log_add", asm!("add"), &["log_minus"], 39),
    part("log_whole", asm!("whole"), &["log_page", "log_parts"], 92),
    part("log_is_whole", asm!("is_whole"), &["log_page", "log_logs_low", "log_logs_high"], 38),
    part("log_floor", asm!("floor"), &["log_whole", "log_is_whole"], 67),
    part("log_round", asm!("round"), &["log_floor", "log_add"], 16),
    part("log_from_int", asm!("from_int"), &["log_is_whole", "log_plus", "log_keep"], 136),
    part("log_param", asm!("param"), &["log_from_int"], 57),
    part("log_series", asm!("series"), &["log_minus"], 104),
    part("log_sine", asm!("sine"), &["log_series", "log_whole", "log_is_whole"], 164),
    part("log_tangent", asm!("tangent"), &["log_sine"], 50),
    part("log_arc", asm!("arc"), &["log_series"], 276),
    part("log_units", asm!("units"), &["log_whole", "log_is_whole"], 162),
    part("log_exponential", asm!("exponential"), &["log_units", "log_keep"], 49),
    part("log_natural", asm!("logarithm"), &["log_from_int"], 85),
    part("log_power", asm!("power"), &["log_exponential", "log_natural", "log_is_whole"], 266),
    part("log_modulo", asm!("modulo"), &["log_floor", "log_from_int", "log_add"], 155),
];
