//! The tables that sums are looked up in, made as a program in Jack makes them: with 16-bit
//! sums alone, from a geometric sequence by its differences.

use super::model::{LEAST, NEAR, OCTAVE, WHOLE};
use std::sync::LazyLock;

/// What a runtime knows.
pub struct Tables {
    /// 1024 log2(1 + 2^(-d/1024)) for d below [`NEAR`].
    pub sums: Vec<i32>,
    /// -1024 log2(1 - 2^(-d/1024)) for d below [`NEAR`]; 0 for d = 0, which is never asked.
    pub differences: Vec<i32>,
    /// 1024 log2(n) for n to [`WHOLE`]; [`LEAST`] for 0.
    pub logs: Vec<i32>,
}

/// The tables, made once.
pub fn tables() -> &'static Tables {
    static TABLES: LazyLock<Tables> = LazyLock::new(|| {
        let powers = powers();
        let logs = logs(&powers);
        Tables {
            sums: sums(&powers),
            differences: differences(&powers, &logs),
            logs,
        }
    });
    &TABLES
}

/// A number of three words: whole, and twice 14 bits behind the point.
#[derive(Clone, Copy)]
struct Long([i32; 3]);

impl Long {
    fn add(self, Long(b): Long) -> Long {
        let Long([mut e, mut f, mut g]) = self;
        g += b[2];
        f += b[1];
        e += b[0];
        if g > 16383 {
            g -= 16384;
            f += 1;
        }
        if f > 16383 {
            f -= 16384;
            e += 1;
        }
        Long([e, f, g])
    }
}

/// 16384 x 2^(j/2048) for j below 2048, to within 0.61: the sequence's first and
/// second differences are added up; its third, 1/96.04 of it in the last place,
/// is counted up with it.
fn powers() -> Vec<i32> {
    let mut power = Long([16384, 0, 0]);
    let mut first = Long([5, 8947, 9232]);
    let mut second = Long([0, 30, 12442]);
    let mut third = 171;
    let mut last = 16374;
    let mut all = Vec::with_capacity(2048);
    for _ in 0..2048 {
        all.push(power.0[0] + i32::from(power.0[1] > 8191));
        power = power.add(first);
        first = first.add(second);
        second = second.add(Long([0, 0, third]));
        if power.0[0] - last > 95 {
            third += 1;
            last += 96;
        }
    }
    all
}

fn at(list: &[i32], index: i32) -> i32 {
    list.get(index as usize).copied().unwrap_or_default()
}

/// Whole numbers' logarithms: those of the last octave by going up in the powers
/// half a unit at a time, each other from its double's.
fn logs(powers: &[i32]) -> Vec<i32> {
    let mut logs = vec![LEAST; WHOLE as usize + 1];
    let mut k = 0;
    for n in WHOLE / 2..WHOLE {
        while k < OCTAVE && at(powers, k + k + 1) <= 64 * n {
            k += 1;
        }
        logs[n as usize] = 8 * OCTAVE + k;
    }
    logs[WHOLE as usize] = 9 * OCTAVE;
    for n in (1..WHOLE / 2).rev() {
        logs[n as usize] = at(&logs, 2 * n) - OCTAVE;
    }
    logs
}

/// 32768 x 2^(-r/1024), 32767 for r = 0.
fn less(powers: &[i32], r: i32) -> i32 {
    match r {
        0 => 32767,
        _ => at(powers, 2048 - r - r),
    }
}

/// A table that falls from `k`: its entry for each d from `d` on is the greatest k for
/// which `above` does not hold.
fn falling(table: &mut [i32], mut d: i32, mut k: i32, above: impl Fn(i32, i32) -> bool) {
    while d < table.len() as i32 {
        while k > 0 && above(k, d) {
            k -= 1;
        }
        table[d as usize] = k;
        d += 1;
    }
}

/// Whether a x 2^times > y, where that fits 16 bits nearly.
fn doubled_above(mut a: i32, times: i32, y: i32) -> bool {
    for _ in 1..times {
        a += a;
    }
    if times > 0 { a > y - a } else { a > y }
}

/// k is right while 2^((k - 1/2)/1024) - 1 is at most 2^(-d/1024): both sides are
/// compared times 32768 x 2^octave.
fn sums(powers: &[i32]) -> Vec<i32> {
    let mut sums = vec![0; NEAR as usize];
    falling(&mut sums, 0, OCTAVE, |k, d| {
        let over = at(powers, k + k - 1) - 16384;
        doubled_above(over, d / OCTAVE + 1, less(powers, d % OCTAVE))
    });
    sums
}

/// Below 256 by the series of log2((1 - e^-x)/x), else as [`sums`] does: k is right while
/// 1 - 2^-((k - 1/2)/1024) is at most 2^(-d/1024).
fn differences(powers: &[i32], logs: &[i32]) -> Vec<i32> {
    let mut all = vec![0; NEAR as usize];
    let (mut squares, mut cut, mut k) = (8866, 0, 10783);
    for d in 1..256 {
        squares += d + d - 1;
        if squares > 17731 {
            squares -= 17731;
            cut += 1;
        }
        let twice = 21563 - at(logs, d) - at(logs, d) + d - cut;
        while k + k - 1 > twice {
            k -= 1;
        }
        all[d as usize] = k;
    }
    near_differences(powers, &mut all);
    falling(&mut all, OCTAVE, OCTAVE, |k, d| {
        let over = 32767 - at(powers, 2049 - k - k) + 1;
        doubled_above(over, d / OCTAVE, less(powers, d % OCTAVE))
    });
    all
}

/// Entries from 256 to 1023: 1 - 2^(-d/1024) is below 1/2 and is doubled first.
fn near_differences(powers: &[i32], all: &mut [i32]) {
    let (mut octaves, mut k) = (9, OCTAVE);
    for d in 256..OCTAVE {
        let mut left = 32767 - less(powers, d) + 1;
        let mut doubled = 0;
        while left < 16384 {
            left += left;
            doubled += 1;
        }
        if doubled < octaves {
            octaves = doubled;
            k = OCTAVE;
        }
        while k > 0 && left > at(powers, 2049 - k - k) {
            k -= 1;
        }
        all[d as usize] = OCTAVE * octaves + k;
    }
}
