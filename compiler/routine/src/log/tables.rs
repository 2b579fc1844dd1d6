//! The tables that sums are looked up in. Those of ten bits are made as a program in Jack makes
//! them: with 16-bit sums alone, from a geometric sequence by its differences.

use super::model::{LEAST, Logarithm, NEAR, OCTAVE, WHOLE};
use std::sync::LazyLock;

/// What a runtime knows.
pub struct Tables {
    /// OCTAVE log2(1 + 2^(-d/OCTAVE)) by the distance d.
    pub sums: ByDistance,
    /// -OCTAVE log2(1 - 2^(-d/OCTAVE)); 0 for d = 0, which is never asked.
    pub differences: ByDistance,
    /// OCTAVE log2(n) for n to [`WHOLE`]; the least for 0.
    pub logs: Vec<i32>,
    /// Of the angle of a tangent of at most 1, and of the sine of at most a quarter turn.
    pub arc: Curve,
    pub sine: Curve,
}

/// How far the logarithm of a function is below that of its argument, where the function is the
/// argument for small ones: for each of 256 parts of the last [`CURVE_OCTAVES`] octaves up to
/// `top`, and what it grows by in a part, which is taken to be linear in each sixteenth of the
/// octaves. Counted from what is 1 above the argument's distance from the top.
pub struct Curve {
    /// The logarithm of the greatest argument.
    pub top: i32,
    pub entries: Vec<i32>,
    /// By which sixteenth, and by the first four bits of a place in a part.
    pub steps: Vec<i32>,
    /// The function itself for each two of the last 512 units.
    pub last: Vec<i32>,
}

/// Further down it is less than 3 units of ten bits.
pub const CURVE_OCTAVES: i32 = 4;

impl Curve {
    /// Hangs on no last place of `f64`: none of those here is nearer to a half than 1/3,000.
    fn new(frac: u8, top: i32, of: fn(f64) -> f64) -> Curve {
        let octave = 1i32 << frac;
        let (first, part) = (-CURVE_OCTAVES * octave, CURVE_OCTAVES * octave / 256);
        let less = |x: i32| {
            let argument = (f64::from(x + top + 1) / f64::from(octave)).exp2();
            f64::from(x) - f64::from(octave) * of(argument).log2()
        };
        // By places in a part that have the same first four bits, in all parts of a sixteenth.
        let wide = (part / 16).max(1);
        let steps = (0..256).map(|at| {
            let from = first + at / 16 * 16 * part;
            let grown = |nth: i32| {
                let start = from + nth / wide * part;
                less(start + at % 16 * wide + nth % wide) - less(start)
            };
            let all = 16 * wide;
            ((0..all).map(grown).sum::<f64>() / f64::from(all)).round() as i32
        });
        let steps: Vec<i32> = steps.collect();
        let entries = (0..256).map(|at| {
            let step = |k: i32| steps[(at / 16 * 16 + k * 16 / part) as usize];
            let left = |k: i32| less(first + at * part + k) - f64::from(step(k));
            let all = (0..part).map(left);
            let (least, most) = (f64::INFINITY, f64::NEG_INFINITY);
            let (least, most) = all.fold((least, most), |(l, m), x| (l.min(x), m.max(x)));
            ((least + most) / 2.0).round() as i32
        });
        let last = (0..256).map(|at| {
            let below = (at - 256) * 2;
            let of = |k: i32| f64::from(below + k) - less(below + k);
            ((of(0) + of(1)) / 2.0).round() as i32
        });
        Curve {
            top,
            entries: entries.collect(),
            steps,
            last: last.collect(),
        }
    }

    /// The same where the function is flat at its end, as a sine is: that is read off by itself.
    pub fn flat_at(&self, x: i32, octave: i32) -> i32 {
        let below = (x - self.top - 1).min(-1);
        let at = 256 + below.div_euclid(2);
        match self.last.get(at as usize) {
            Some(last) => *last,
            None => self.at(x, octave),
        }
    }

    /// The logarithm of the function of an argument. In the octave below the entries it is a unit
    /// of ten bits less, and below that the argument.
    pub fn at(&self, x: i32, octave: i32) -> i32 {
        let below = (x - self.top - 1).min(-1);
        let at = below + CURVE_OCTAVES * octave;
        if at < 0 {
            return if at < -octave { x } else { x - octave / 1024 };
        }
        let part = CURVE_OCTAVES * octave / 256;
        let entry = at / part;
        let step = entry / 16 * 16 + at % part * 16 / part;
        below - self.entries[entry as usize] - self.steps[step as usize]
    }
}

/// What hangs on how far apart two logarithms are: an entry for each distance up to where a
/// stretch begins that has one for so many.
pub struct ByDistance {
    pub entries: Vec<i32>,
    /// From which distance on there is an entry for each 2^k distances.
    stretches: &'static [(i32, u32)],
    /// Behind the last entry: the distances beyond which it is less than one half more.
    steps: &'static [i32],
}

impl ByDistance {
    /// The first distance that an entry is for.
    pub fn first_of(&self, entry: i32) -> i32 {
        let (mut first, mut from, mut shift) = (0, 0, 0);
        for &(next, by) in self.stretches {
            let count = (next - from) >> shift;
            if entry - first < count {
                break;
            }
            first += count;
            (from, shift) = (next, by);
        }
        from + ((entry - first) << shift)
    }

    /// What stands there.
    pub fn at(&self, apart: i32) -> i32 {
        let mut first = 0;
        let (mut from, mut shift) = (0, 0);
        for &(next, by) in self.stretches {
            if apart < next {
                break;
            }
            first += (next - from) >> shift;
            (from, shift) = (next, by);
        }
        let entry = first + ((apart - from) >> shift);
        let beyond = || self.steps.iter().filter(|step| apart <= **step).count() as i32;
        let entry = self.entries.get(entry as usize).copied();
        entry.unwrap_or_else(beyond)
    }
}

/// The tables of logarithms of so many bits behind the point, made once.
pub fn tables(frac: u8) -> &'static Tables {
    static TEN: LazyLock<Tables> = LazyLock::new(ten);
    static ELEVEN: LazyLock<Tables> = LazyLock::new(eleven);
    if frac == 10 { &TEN } else { &ELEVEN }
}

/// The logarithm of a quarter turn.
fn quarter<const FRAC: u8>() -> i32 {
    Logarithm::<FRAC, true>::CONSTANTS.quarter
}

/// As a program in Jack makes them.
fn ten() -> Tables {
    let powers = powers();
    let logs = logs(&powers);
    let by_distance = |entries| ByDistance {
        entries,
        stretches: &[],
        steps: &STEPS,
    };
    Tables {
        sums: by_distance(sums(&powers)),
        differences: by_distance(differences(&powers, &logs)),
        logs,
        arc: Curve::new(10, 0, f64::atan),
        sine: Curve::new(10, quarter::<10>(), f64::sin),
    }
}

/// Beyond which distances a far smaller summand adds less than 1/2, 3/2, ... units.
pub const STEPS: [i32; 23] = [
    11805, 10182, 9427, 8930, 8559, 8263, 8016, 7804, 7619, 7455, 7307, 7173, 7050, 6936, 6830,
    6732, 6640, 6553, 6471, 6393, 6319, 6249, 6182,
];

/// Where an octave is 2048: how far there is an entry for each distance, for each two, and
/// where there is nothing any more.
pub const STRETCHES: [(i32, u32); 2] = [(2 * 2048, 1), (6 * 2048, 4)];
pub const NOTHING: i32 = 25_600;

/// To the nearest, in the middle of what an entry is for: none is so near to a half that the
/// last place of a logarithm in `f64` would count.
fn eleven() -> Tables {
    type Log = Logarithm<11, true>;
    let octave = f64::from(Log::OCTAVE);
    let by_distance = |of: fn(f64) -> f64| {
        let middle = |from: i32, shift: u32| f64::from(from) + f64::from((1 << shift) - 1) / 2.0;
        let mut entries = Vec::new();
        let ends = STRETCHES.iter().map(|(end, _)| *end).chain([NOTHING]);
        let stretches = [(0, 0)].into_iter().chain(STRETCHES);
        for ((from, shift), end) in stretches.zip(ends) {
            let all = (from..end).step_by(1 << shift);
            let ratio = |d: i32| (-middle(d, shift) / octave).exp2();
            entries.extend(all.map(|d| (octave * of(ratio(d))).round() as i32));
        }
        ByDistance {
            entries,
            stretches: &STRETCHES,
            steps: &[],
        }
    };
    let mut differences = by_distance(|ratio| -(1.0 - ratio).log2());
    if let Some(none) = differences.entries.first_mut() {
        *none = 0;
    }
    let log = |n: i32| (octave * f64::from(n).log2()).round() as i32;
    Tables {
        sums: by_distance(|ratio| (1.0 + ratio).log2()),
        differences,
        logs: [Log::LEAST]
            .into_iter()
            .chain((1..=WHOLE).map(log))
            .collect(),
        arc: Curve::new(11, 0, f64::atan),
        sine: Curve::new(11, quarter::<11>(), f64::sin),
    }
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
