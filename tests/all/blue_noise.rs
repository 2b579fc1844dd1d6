//! The library's tables of noise: where the ranks of the blue-noise mask come
//! from, that they are blue, and the shuffle that the hash is made of.
//!
//! The ranks are Ulichney's void-and-cluster (The void-and-cluster method for
//! dither array generation, 1993) on a torus of 16 x 16, so that the mask tiles
//! and a rank fits a byte. A pattern of few points is first evened out: the
//! point in the tightest cluster moves to the largest void until it would move
//! back. Taking points away from there, tightest cluster first, gives the lower
//! ranks backwards; adding points, largest void first, gives the others. How
//! tight a place is, is the sum of a Gaussian (sigma 1.5) round every point; in
//! whole numbers, so that every host finds the same ranks. (Ulichney's third
//! phase, the tightest cluster of empty places, is the largest void again, since
//! the sums round points and round empty places add up to a constant.)
//!
//! Where the ranks in `compiler/prelude/noise.scn` are others, the test prints
//! those that should stand there.

use slowlight_compiler::eval::native::Native;
use slowlight_compiler::scene;
use slowlight_compiler::sema::Options;
use std::f64::consts::TAU;

const SIDE: usize = 16;
const PLACES: usize = SIDE * SIDE;
/// Points of the first pattern: one in ten.
const FIRST: usize = PLACES / 10;
const SIGMA: f64 = 1.5;

/// A pattern of points, and how tight each place is.
#[derive(Clone)]
struct Pattern {
    points: [bool; PLACES],
    tight: [i64; PLACES],
}

impl Pattern {
    /// Adds or takes away a point.
    fn turn(&mut self, at: usize) {
        self.points[at] = !self.points[at];
        let sign = if self.points[at] { 1 } else { -1 };
        for (place, tight) in self.tight.iter_mut().enumerate() {
            *tight += sign * weight(at, place);
        }
    }

    /// The point with the most points round it; the first of equals.
    fn cluster(&self) -> usize {
        let points = (0..PLACES).filter(|&p| self.points[p]);
        let found = points.max_by_key(|&p| (self.tight[p], PLACES - p));
        found.expect("a point")
    }

    /// The empty place with the fewest points round it; the first of equals.
    fn void(&self) -> usize {
        let empty = (0..PLACES).filter(|&p| !self.points[p]);
        empty
            .min_by_key(|&p| (self.tight[p], p))
            .expect("an empty place")
    }
}

/// What a point at `a` adds at `b`, in units of 2^-30.
fn weight(a: usize, b: usize) -> i64 {
    let gap = |a: usize, b: usize| {
        let d = a.abs_diff(b);
        d.min(SIDE - d) as f64
    };
    let (dx, dy) = (gap(a % SIDE, b % SIDE), gap(a / SIDE, b / SIDE));
    let gauss = (-(dx * dx + dy * dy) / (2.0 * SIGMA * SIGMA)).exp();
    (gauss * f64::from(1 << 30)).round() as i64
}

/// An even pattern of few points.
fn first() -> Pattern {
    let mut pattern = Pattern {
        points: [false; PLACES],
        tight: [0; PLACES],
    };
    // Any points will do: a linear congruential generator (Numerical Recipes).
    let mut seed: u32 = 1;
    while pattern.points.iter().filter(|p| **p).count() < FIRST {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let at = (seed >> 24) as usize;
        if !pattern.points[at] {
            pattern.turn(at);
        }
    }
    loop {
        let from = pattern.cluster();
        pattern.turn(from);
        let to = pattern.void();
        pattern.turn(to);
        if from == to {
            return pattern;
        }
    }
}

fn ranks() -> [usize; PLACES] {
    let even = first();
    let mut ranks = [0; PLACES];
    let mut fewer = even.clone();
    for rank in (0..FIRST).rev() {
        let at = fewer.cluster();
        fewer.turn(at);
        ranks[at] = rank;
    }
    let mut more = even;
    for rank in FIRST..PLACES {
        let at = more.void();
        more.turn(at);
        ranks[at] = rank;
    }
    ranks
}

/// 0 to 255 as `hash` shuffles them (Fisher and Yates; the generator is that of [`first`]).
fn shuffled() -> [usize; PLACES] {
    let mut all = std::array::from_fn(|k| k);
    let mut seed: u32 = 1;
    for k in (1..PLACES).rev() {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        all.swap(k, ((seed >> 16) as usize * (k + 1)) >> 16);
    }
    all
}

/// The ranks as the library's file holds them.
fn shown(ranks: &[usize]) -> String {
    let row = |row: &[usize]| {
        let row: Vec<String> = row.iter().map(usize::to_string).collect();
        row.join(", ")
    };
    let rows: Vec<String> = ranks.chunks(SIDE).map(row).collect();
    format!("const blue_ranks = [\n  {}\n];", rows.join(";\n  "))
}

/// What a mask of the library is on the first 16 x 16 pixels, in 1/256.
fn mask(name: &str) -> Vec<usize> {
    inks(&format!("floor(256 * {name}(x, y))"))
}

/// The ints of an expression over x and y, 0 to 255, on 16 x 16 pixels.
fn inks(number: &str) -> Vec<usize> {
    let palette = vec!["black"; 256].join(", ");
    let text = format!("image 16 x 16 inks {palette};\ndraw (x, y) = ink({number});");
    let scene = scene::check(number, &text);
    let graph = scene.lower(&Options::default()).expect("a graph");
    let mut native = Native::new(&graph);
    let pixels = (0..PLACES as i32).map(|p| (p % SIDE as i32, p / SIDE as i32));
    pixels
        .map(|(x, y)| usize::from(native.pixel(x, y).ink))
        .collect()
}

/// The mean power of the waves that are at least 4 pixels long, in that of all:
/// 1 for white noise, give or take.
fn low(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / PLACES as f64;
    let side = SIDE as i32;
    let (mut low, mut lows, mut all) = (0.0, 0, 0.0);
    for (u, v) in (0..side).flat_map(|v| (0..side).map(move |u| (u, v))) {
        if (u, v) == (0, 0) {
            continue;
        }
        let (mut re, mut im) = (0.0, 0.0);
        for (place, value) in values.iter().enumerate() {
            let (x, y) = (place as i32 % side, place as i32 / side);
            let turn = TAU * f64::from(u * x + v * y) / f64::from(side);
            re += (value - mean) * turn.cos();
            im += (value - mean) * turn.sin();
        }
        let power = re * re + im * im;
        all += power;
        let (u, v) = (u.min(side - u), v.min(side - v));
        if u * u + v * v <= 4 * 4 {
            low += power;
            lows += 1;
        }
    }
    low / f64::from(lows) / (all / (PLACES - 1) as f64)
}

#[test]
fn blue_noise_is_void_and_cluster() {
    let ranks = ranks();
    assert!(
        mask("blue_noise") == ranks,
        "the library should say:\n{}",
        shown(&ranks)
    );
    let mut sorted = ranks;
    sorted.sort_unstable();
    assert!(sorted.iter().copied().eq(0..PLACES));
}

#[test]
fn the_hash_is_made_of_a_shuffle() {
    assert_eq!(inks("shuffled[16 * y + x]"), shuffled());
    // So is every column of the hash.
    for line in ["hash(3, 16 * y + x)", "hash(-70, 16 * y + x, 9)"] {
        let mut all = inks(line);
        all.sort_unstable();
        assert!(all.into_iter().eq(0..PLACES), "{line}");
    }
}

#[test]
fn blue_noise_has_no_long_waves() {
    let real = |mask: &[usize]| mask.iter().map(|&v| v as f64).collect::<Vec<f64>>();
    let (blue, white) = (mask("blue_noise"), mask("white_noise"));
    let (ours, theirs) = (low(&real(&blue)), low(&real(&white)));
    assert!(ours < 0.05, "{ours}");
    assert!((0.5..2.0).contains(&theirs), "{theirs}");
    // As a picture too: the pixels that a flat grey sets.
    for grey in [32, 64, 96, 128, 160, 192, 224] {
        let set = |mask: &[usize]| {
            let set = mask.iter().map(|&v| f64::from(u8::from(v < grey)));
            low(&set.collect::<Vec<f64>>())
        };
        let (ours, theirs) = (set(&blue), set(&white));
        assert!(ours < theirs / 3.0, "at {grey}: {ours} of {theirs}");
    }
}
