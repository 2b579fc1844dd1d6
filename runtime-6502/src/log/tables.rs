//! The tables of logarithms as bytes.

use slowlight_routine::log::model::WHOLE;
use slowlight_routine::log::tables::{ByDistance, STEPS, tables};

/// Pages of entries of one table of distances, and of upper bytes: behind these a sum's entry
/// is a byte, and the upper one of a difference's is 255.
pub const fn pages(frac: u8) -> (usize, usize, usize) {
    if frac == 10 {
        (24, 10, 11)
    } else {
        (36, 22, 23)
    }
}

fn low(n: &i32) -> i32 {
    n & 0xFF
}

fn high(n: &i32) -> i32 {
    n >> 8 & 0xFF
}

/// All lower bytes, to the end of a page, then so many pages of upper ones, and one more: it
/// may be met from the entry before it.
fn planes(list: &[i32], pages: usize, upper: usize) -> Vec<i32> {
    let mut all: Vec<i32> = list.iter().map(low).collect();
    all.resize(pages * 256, 0);
    all.extend(list.iter().take(upper * 256 + 1).map(high));
    all
}

/// The same of tables that have an entry for each distance as long as entries have two bytes.
const fn whole_pages(frac: u8) -> (usize, usize, usize) {
    if frac == 10 {
        (24, 23, 23)
    } else {
        (43, 28, 30)
    }
}

/// All entries of such a table: those of stretches that have one for several distances are
/// repeated, up to the last page with upper bytes.
fn whole(table: &ByDistance, upper: usize) -> Vec<i32> {
    let end = upper as i32 * 256;
    let own = table.entries.iter().zip(0..);
    let behind = own.filter(|(_, entry)| table.first_of(*entry) >= end);
    let each = (0..end).map(|apart| table.at(apart));
    each.chain(behind.map(|(value, _)| *value)).collect()
}

/// That of 0 is told by its upper byte: no other one is above 0.
fn lost(entries: &[i32]) -> Vec<i32> {
    let mut lost: Vec<i32> = entries.iter().map(|k| -k).collect();
    if let Some(none) = lost.first_mut() {
        *none = 256;
    }
    lost
}

/// Those of so many bits behind the point.
pub struct Bytes<const FRAC: u8>;

impl<const FRAC: u8> Bytes<FRAC> {
    /// What sums add.
    pub fn sums() -> Vec<i32> {
        let (all, upper, _) = pages(FRAC);
        planes(&tables(FRAC).sums.entries, all, upper)
    }

    /// The same in whole.
    pub fn whole_sums() -> Vec<i32> {
        let (all, upper, _) = whole_pages(FRAC);
        planes(&whole(&tables(FRAC).sums, upper), all, upper)
    }

    /// What differences add.
    pub fn lost() -> Vec<i32> {
        let (all, _, upper) = pages(FRAC);
        planes(&lost(&tables(FRAC).differences.entries), all, upper)
    }

    /// The same in whole.
    pub fn whole_lost() -> Vec<i32> {
        let (all, _, upper) = whole_pages(FRAC);
        planes(&lost(&whole(&tables(FRAC).differences, upper)), all, upper)
    }

    /// 256 x 2^(k/OCTAVE) less 256, the whole part, as logarithms of whole numbers have it.
    pub fn parts() -> Vec<i32> {
        let (logs, octave) = (&tables(FRAC).logs, 1 << FRAC);
        let of = |k: i32| logs.partition_point(|entry| *entry <= 8 * octave + k) as i32 - 1;
        (0..octave).map(|k| of(k) - WHOLE / 2).collect()
    }

    pub fn logs_low() -> Vec<i32> {
        Self::logs().iter().map(low).collect()
    }

    pub fn logs_high() -> Vec<i32> {
        Self::logs().iter().map(high).collect()
    }

    /// That of 0 is the least.
    fn logs() -> Vec<i32> {
        let mut logs = tables(FRAC).logs.clone();
        if let Some(none) = logs.first_mut() {
            *none = i32::from(i16::MIN);
        }
        logs
    }

    /// What an arc is less than its tangent by, and a sine than its angle.
    pub fn arc_low() -> Vec<i32> {
        tables(FRAC).arc.entries.iter().map(low).collect()
    }

    pub fn arc_high() -> Vec<i32> {
        tables(FRAC).arc.entries.iter().map(high).collect()
    }

    pub fn arc_steps() -> Vec<i32> {
        tables(FRAC).arc.steps.clone()
    }

    pub fn sine_low() -> Vec<i32> {
        tables(FRAC).sine.entries.iter().map(low).collect()
    }

    pub fn sine_high() -> Vec<i32> {
        tables(FRAC).sine.entries.iter().map(high).collect()
    }

    pub fn sine_last() -> Vec<i32> {
        tables(FRAC).sine.last.iter().map(low).collect()
    }

    pub fn sine_steps() -> Vec<i32> {
        tables(FRAC).sine.steps.clone()
    }
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
