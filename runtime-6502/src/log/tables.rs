//! The tables of logarithms as bytes.

use slowlight_routine::log::model::{LEAST, MOST, OCTAVE, STEPS, WHOLE};
use slowlight_routine::log::tables::tables;

/// Pages of upper bytes of what sums add: from there on it is a byte.
pub const SUM_PAGES: usize = 10;
/// The same of what differences add: from there on the upper byte is 255.
pub const LOST_PAGES: usize = 11;

fn low(n: &i32) -> i32 {
    n & 0xFF
}

fn high(n: &i32) -> i32 {
    n >> 8 & 0xFF
}

/// All lower bytes, then so many pages of upper ones.
fn planes(list: &[i32], pages: usize) -> Vec<i32> {
    let upper = list.iter().take(pages * 256).map(high);
    list.iter().map(low).chain(upper).collect()
}

/// What sums add.
pub fn sums() -> Vec<i32> {
    planes(&tables().sums, SUM_PAGES)
}

/// What differences add; that of 0 brings the greatest logarithm down to the least.
pub fn lost() -> Vec<i32> {
    let mut all: Vec<i32> = tables().differences.iter().map(|k| -k).collect();
    if let Some(none) = all.first_mut() {
        *none = LEAST - MOST;
    }
    planes(&all, LOST_PAGES)
}

/// 256 x 2^(k/1024) less 256, the whole part, as logarithms of whole numbers have it.
pub fn parts() -> Vec<i32> {
    let logs = &tables().logs;
    let of = |k: i32| logs.partition_point(|entry| *entry <= 8 * OCTAVE + k) as i32 - 1;
    (0..OCTAVE).map(|k| of(k) - WHOLE / 2).collect()
}

pub fn logs_low() -> Vec<i32> {
    tables().logs.iter().map(low).collect()
}

pub fn logs_high() -> Vec<i32> {
    tables().logs.iter().map(high).collect()
}

/// The first page that has steps, and the first that has none.
const FAR: [i32; 2] = [24, 47];

/// How many steps lie in further pages than each.
pub fn rest_first() -> Vec<i32> {
    let further = |page: i32| STEPS.iter().filter(|step| **step >> 8 > page).count() as i32;
    (FAR[0]..FAR[1]).map(further).collect()
}

/// The steps, and one that no distance comes to.
pub fn rest_low() -> Vec<i32> {
    STEPS.iter().map(low).chain([0]).collect()
}

pub fn rest_high() -> Vec<i32> {
    STEPS.iter().map(high).chain([0]).collect()
}
