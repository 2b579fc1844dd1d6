//! Sampling of a picture's pixels with probabilities proportional to size: few pixels stand for
//! all where plans are priced.
//!
//! Pixels spread over the picture are run once. Where they take few statements, all of them are
//! looked at. Else some are chosen: in an order in which those that run the same statements
//! stand together, the cheaper before the dearer, so that each kind of pixel has its share; and
//! in steps of what they take, so that those that take long are well represented. Each then
//! weighs as many pixels as it stands for. (Systematic sampling with probability proportional
//! to size: Madow, Annals of Mathematical Statistics 20, 1949.)

use super::meter::Meter;
use crate::eval::run::Run;
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::schedule::analysed::Analysed;
use rustc_hash::{FxHashMap, FxHasher};
use slowlight_routine::Runtime;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::hash::{Hash, Hasher};

/// Rows and columns that are looked at.
const ROWS: u32 = 12;
const COLUMNS: u32 = 13;

/// How many statements may run to price a plan; and to choose pixels.
pub(crate) const PATIENCE: u64 = 40_000;
const LONG: u64 = 2_000_000;

/// How many pixels are chosen at least.
const LEAST: usize = 24;

/// How often plans may run as many statements as the one by which pixels were chosen.
const MORE: u64 = 4;

/// In which part of a pixel weights are counted.
const PART: f64 = 16.0;

/// What a statement is thought to take that is no operation, in cycles.
const PLAIN: f64 = 10.0;

/// The order in which pixels are tried: a step that has no factor in common with their number,
/// so that the first of them are spread over the picture too.
const STEP: usize = 61;

/// A pixel and its weight.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Pixel {
    pub y: i32,
    pub x: i32,
    pub weight: u64,
}

/// Pixels that stand for a picture, by rows; none where they take too long.
#[derive(Debug, Default)]
pub(crate) struct Pixels {
    pub all: Vec<Pixel>,
    /// How many statements may run there.
    pub patience: u64,
}

/// What a pixel takes, and what it ran.
struct Tried {
    at: (i32, i32),
    cycles: f64,
    statements: u64,
    kind: u64,
}

impl Tried {
    /// How probable it is to be chosen first of so many that take so much: by half for what
    /// it takes.
    fn size(&self, count: usize, total: f64) -> f64 {
        0.5 / count as f64 + 0.5 * self.cycles / total.max(1.0)
    }
}

impl Pixels {
    /// Those by which plans of a scene are priced, of which this is one.
    pub fn of(plan: &Analysed, runtime: &Runtime) -> Pixels {
        let graph = &plan.graph;
        let places = spread(&graph.image);
        let (tried, ran) = tried(plan, runtime, &places);
        if tried.len() == places.len() && ran <= PATIENCE {
            let one = |(x, y)| Pixel { y, x, weight: 1 };
            return Pixels {
                all: places.into_iter().map(one).collect(),
                patience: PATIENCE.max(MORE * ran),
            };
        }
        if tried.len() < LEAST {
            return Pixels::default();
        }
        // As many as may run with what one of them runs that is chosen by size.
        let total: f64 = tried.iter().map(|pixel| pixel.cycles).sum();
        let sizes = tried.iter().map(|pixel| {
            let size = pixel.size(tried.len(), total);
            size * pixel.statements as f64
        });
        let each = sizes.sum::<f64>().max(1.0) as u64;
        let few = ((2 * PATIENCE / each) as usize).clamp(LEAST, places.len());
        Pixels {
            all: chosen(tried, few),
            patience: PATIENCE.max(MORE * few as u64 * each),
        }
    }

    /// What all of them weigh.
    pub fn weight(&self) -> f64 {
        self.all.iter().map(|pixel| pixel.weight as f64).sum()
    }

    /// Whether there are any.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }
}

/// What pixels take, as many as may be tried, and how many statements ran.
fn tried(plan: &Analysed, runtime: &Runtime, places: &[(i32, i32)]) -> (Vec<Tried>, u64) {
    let (graph, tree) = (&plan.graph, &plan.tree);
    let mut numbers: FxHashMap<*const Statement, u64> = FxHashMap::default();
    for block in [&tree.segment, &tree.pixel] {
        walk(block, &mut |s| {
            let number = numbers.len() as u64 + 1;
            numbers.insert(std::ptr::from_ref(s), number);
        });
    }
    // Each statement is asked for what it takes once a pixel.
    let kind = Cell::new(0_u64);
    let meter = Meter::new(graph, |s: &Statement| {
        let Some(number) = numbers.get(&std::ptr::from_ref(s)) else {
            return 0.0;
        };
        let mut hasher = FxHasher::default();
        number.hash(&mut hasher);
        kind.set(kind.get().wrapping_add(hasher.finish()));
        let op = match s {
            Statement::Let(id) => match graph.node(*id) {
                Node::Apply(op, _) => Some(op),
                _ => None,
            },
            _ => None,
        };
        let usual = op.and_then(|op| runtime.usual(op));
        usual.map_or(PLAIN, |routine| f64::from(routine.cycles))
    });
    let mut run = Run::within(graph, tree, &meter, LONG + 1).alone();
    let mut all = Vec::new();
    let mut ran = 0;
    for k in 0..places.len() {
        let (x, y) = places[k * STEP % places.len()];
        run.begin(x, y);
        meter.forget();
        kind.set(0);
        let before = meter.ran.get();
        run.pixel(x, y);
        if meter.ran.get() > LONG {
            break;
        }
        ran += meter.ran.get() - before;
        all.push(Tried {
            at: (x, y),
            cycles: meter.sum.get(),
            statements: meter.ran.get() - before,
            kind: kind.get(),
        });
    }
    (all, ran)
}

/// So many of some pixels, with their weights.
fn chosen(mut tried: Vec<Tried>, few: usize) -> Vec<Pixel> {
    // Kinds are in the order of their first pixels.
    let mut first: FxHashMap<u64, usize> = FxHashMap::default();
    for (k, pixel) in tried.iter().enumerate() {
        first.entry(pixel.kind).or_insert(k);
    }
    tried.sort_by(|a, b| {
        let kind = |pixel: &Tried| first.get(&pixel.kind).copied();
        kind(a).cmp(&kind(b)).then(a.cycles.total_cmp(&b.cycles))
    });
    let count = tried.len();
    let total: f64 = tried.iter().map(|pixel| pixel.cycles).sum();
    let mut all: BTreeMap<(i32, i32), f64> = BTreeMap::new();
    let mut before = 0.0;
    let mut next = 0.5;
    for pixel in &tried {
        let size = pixel.size(count, total);
        before += size * few as f64;
        let mut times = 0.0;
        while next < before {
            times += 1.0;
            next += 1.0;
        }
        if times > 0.0 {
            let (x, y) = pixel.at;
            // It stands for times / (few * size) of the pixels' number.
            // Of a small picture several may be the same.
            *all.entry((y, x)).or_default() += PART * times / (few as f64 * size);
        }
    }
    let one = |((y, x), weight): ((i32, i32), f64)| Pixel {
        y,
        x,
        weight: weight.round().max(1.0) as u64,
    };
    all.into_iter().map(one).collect()
}

/// Pixels spread over a picture, none above another.
pub(crate) fn spread(image: &Image) -> Vec<(i32, i32)> {
    let at = |k: u32, of: u32, long: u32| {
        ((u64::from(k) * 2 + 1) * u64::from(long) / 2 / u64::from(of)) as i32
    };
    let mut all = Vec::new();
    for row in 0..ROWS {
        let y = at(row, ROWS, image.height);
        for column in 0..COLUMNS {
            // Later rows a little further to the right.
            let x = at(column * ROWS + row, COLUMNS * ROWS, image.width);
            all.push((x, y));
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What pixels take in the mean, by those that are chosen.
    fn estimate(cycles: &[f64], few: usize) -> f64 {
        let tried = cycles.iter().zip(0..).map(|(cycles, x)| Tried {
            at: (x, 0),
            cycles: *cycles,
            statements: *cycles as u64,
            kind: u64::from(*cycles > 500.0),
        });
        let all = chosen(tried.collect(), few);
        assert!(all.len() <= few, "{all:?}");
        let weight: f64 = all.iter().map(|pixel| pixel.weight as f64).sum();
        let of = |pixel: &Pixel| cycles[pixel.x as usize] * pixel.weight as f64;
        all.iter().map(of).sum::<f64>() / weight
    }

    #[test]
    fn few_pixels_stand_for_all() {
        // One in ten takes a hundred times as long, and those between 5,000 and 15,000.
        let all: Vec<f64> = (0..156)
            .map(|k| match k % 10 {
                3 => 5000.0 + 64.0 * f64::from(k),
                _ => 100.0 + f64::from(k % 7),
            })
            .collect();
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        let found = estimate(&all, 24);
        assert!((found / mean - 1.0).abs() < 0.1, "{found} for {mean}");
        // Pixels that are all alike weigh alike.
        assert!((estimate(&[100.0; 156], 24) - 100.0).abs() < 1e-9);
    }

    #[test]
    fn pixels_that_are_one_weigh_what_they_do_together() {
        let tried = |x| Tried {
            at: (x, 0),
            cycles: 100.0,
            statements: 100,
            kind: 0,
        };
        let all = chosen((0..100).map(|k| tried(i32::from(k >= 75))).collect(), 40);
        let [first, second] = all[..] else {
            panic!("{all:?}");
        };
        assert_eq!(first.weight, 3 * second.weight);
    }
}
