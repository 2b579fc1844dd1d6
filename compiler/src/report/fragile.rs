//! Where a scene is numerically fragile in a format.
//!
//! The plan's statements are run for a sample of the pixels with, for each
//! value, the native one and the machine's side by side, on the native way
//! through the program. Where a comparison or a step comes out otherwise for
//! the machine, although the native values lie clear of the border, an error
//! has grown on the way there; it is followed back to the operation that made
//! it grow (as Herbgrind does: Sanchez-Stern, Panchekha, Lerner and Tatlock,
//! Finding Root Causes of Floating Point Error, PLDI 2018). Shades that are off
//! by more than an eighth of a level are followed back likewise.
//!
//! A border that the native values themselves sit on is a tie: any format may
//! go either way, and nothing can be done but to know it. So it counts where only the ink
//! comes out otherwise, too: a dither's own border. Where they lie beside
//! it by less than the format can tell, a finer format would do: on a few pixels
//! that is an outline, on many a margin that the scene chose too small.

use super::shadow::{Event, Shadow, What};
use crate::analysis::rate::{Dependence, rates};
use crate::eval::native::Native;
use crate::eval::run::Run;
use crate::ir::graph::*;
use crate::plan::Plan;
use crate::plan::model::ModelRun;
use std::collections::{BTreeMap, BTreeSet};

/// About how many pixels are looked at: some of each row.
const SAMPLE: u32 = 4096;

/// How many operations are run before the sample is called large enough.
const PATIENCE: u64 = 10_000_000;

/// How many statements an evaluation may run, since one pixel's loops may go on for long:
/// what patience allows, and as much again for the row at which it ends.
const MOST: u64 = 2 * PATIENCE;

/// An operation is to blame where its result is off by so many times more
/// units in the last place than its arguments.
const TIMES: f64 = 16.0;

/// What is weak about a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Weakness {
    /// The operation makes the error of its arguments grow.
    Grows,
    /// An error grows little by little; the operation is the last one.
    Gradual,
    /// 0/0 natively: the quotient has no meaning.
    NoMeaning,
    /// A step of `floor` is not much more than the format's last place.
    Coarse,
    /// A comparison or step that lies on its border natively.
    Tie,
    /// One that natively lies beside its border, by less than the format can tell.
    Close,
}

/// A weak place of a scene, seen in one format.
#[derive(Clone, Debug, PartialEq)]
pub struct Fragile {
    /// The operation.
    pub node: NodeId,
    /// What is weak about it.
    pub weakness: Weakness,
    /// On how many of the pixels looked at it mattered.
    pub pixels: usize,
    /// By how many units in the last place its result is off at most; where a
    /// step is coarse, how large the last place is; where a border is close, by
    /// how many units natively it is missed at most.
    pub units: f64,
    /// What came out otherwise because of it, a comparison or a step; none
    /// where it is the shade itself.
    pub flips: Option<NodeId>,
    /// Rows on which most of the pixels looked at are concerned.
    pub rows: Vec<u32>,
}

/// What was looked at, and what was found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Found {
    /// How many pixels were looked at.
    pub looked: usize,
    /// By node and weakness.
    pub fragile: Vec<Fragile>,
}

/// Looks at a sample of a plan's pixels. What earlier pixels send is left out.
///
/// What is weak without changing a pixel's shade by an eighth of a level is no fault.
pub fn fragile(plan: &Plan) -> Found {
    let mut plan = plan.clone();
    plan.graph.part_pixels();
    let plan = &plan;
    let shadow = Shadow::new(plan);
    let mut run = Run::within(&plan.graph, &plan.tree, &shadow, MOST);
    let mut pictures = Pictures::new(plan);
    shadow.keep();
    let frame = shadow.seen();
    let (columns, rows) = sample(plan);
    let mut tally = Tally::new(plan);
    let mut looked = 0;
    'rows: for &y in &rows {
        if shadow.run() > PATIENCE {
            break;
        }
        shadow.forget();
        for &x in &columns {
            run.pixel(x as i32, y as i32);
            let differs = pictures.differ(x as i32, y as i32);
            if run.spent() || pictures.spent() {
                break 'rows;
            }
            if let Some(pair) = plan.graph.shade.and_then(|id| run.last(id)) {
                shadow.shade(pair, pictures.most);
            }
            for what in shadow.seen() {
                tally.add(&shadow, what, (x, y), differs);
            }
            for &what in &frame {
                tally.add(&shadow, what, (x, y), differs);
            }
            looked += 1;
        }
        tally.end_of_row(&columns, y);
    }
    tally.found(columns.len(), looked)
}

/// The native picture and the machine's, each on its own way.
struct Pictures<'p> {
    native: Native<'p>,
    model: ModelRun<'p>,
    /// An eighth of a level: the least difference of shades that is a fault. On one pixel in
    /// eight or so an ink is then another.
    most: f64,
}

impl<'p> Pictures<'p> {
    fn new(plan: &'p Plan) -> Pictures<'p> {
        Pictures {
            native: Native::within(&plan.graph, MOST),
            model: ModelRun::within(plan, MOST),
            most: 0.125 / plan.graph.image.palette.len().max(2) as f64,
        }
    }

    fn spent(&self) -> bool {
        self.native.spent() || self.model.spent()
    }

    fn differ(&mut self, x: i32, y: i32) -> Differs {
        let (native, model) = (self.native.pixel(x, y), self.model.pixel(x, y));
        let shade = (native.shade - model.shade).abs() > self.most;
        Differs {
            shade,
            ink: shade || native.ink != model.ink,
        }
    }
}

/// What of a pixel the machine has otherwise: the shade, by more than an eighth of a level, or
/// at least the ink.
#[derive(Clone, Copy)]
struct Differs {
    shade: bool,
    ink: bool,
}

/// The columns and rows that are looked at: all rows of a picture that is not
/// very high, because what is the same along a row is often weak along it. The
/// rows come from coarse to fine, so that any beginning of them is a fair sample.
fn sample(plan: &Plan) -> (Vec<u32>, Vec<u32>) {
    let every = |(first, last): (u32, u32), most: u32| {
        let step = (last - first + 1).div_ceil(most.max(1)).max(1);
        (first..=last).step_by(step as usize).collect::<Vec<u32>>()
    };
    let rows = every(plan.rows, 512);
    let columns = every(plan.columns, (SAMPLE / rows.len().max(1) as u32).max(8));
    let mut fine: Vec<(u32, u32)> = (0..).zip(rows).collect();
    fine.sort_by_key(|(k, _)| k.reverse_bits());
    (columns, fine.into_iter().map(|(_, y)| y).collect())
}

/// What was seen, by place.
struct Tally {
    places: BTreeMap<(NodeId, Weakness), Place>,
    /// What changes along a row.
    columns: Vec<bool>,
}

#[derive(Default)]
struct Place {
    pixels: BTreeSet<(u32, u32)>,
    units: f64,
    flips: Option<NodeId>,
}

impl Tally {
    fn new(plan: &Plan) -> Tally {
        let rates = rates(&plan.graph);
        let along = |id| {
            let mut all = rates.rate(id).iter();
            all.any(|d| !matches!(d, Dependence::Frame | Dependence::Row))
        };
        Tally {
            places: BTreeMap::new(),
            columns: plan.graph.ids().map(along).collect(),
        }
    }

    fn add(&mut self, shadow: &Shadow<'_>, what: What, (x, y): (u32, u32), differs: Differs) {
        let (node, weakness, units, flips) = match what {
            What::Tie(node) if differs.ink => (node, Weakness::Tie, 0.0, Some(node)),
            What::NoMeaning(node) => (node, Weakness::NoMeaning, 0.0, None),
            What::Coarse { node, place } if differs.shade => {
                (node, Weakness::Coarse, place, Some(node))
            }
            What::Close { node, units } if differs.shade => {
                (node, Weakness::Close, units, Some(node))
            }
            What::Off { event, flips } if differs.shade => {
                let (culprit, weakness) = blame(shadow, event);
                (culprit.node, weakness, culprit.units, flips)
            }
            _ => return,
        };
        let place = self.places.entry((node, weakness)).or_default();
        place.pixels.insert((y, x));
        place.units = place.units.max(units);
        place.flips = flips;
    }

    /// What does not change along a row was run once, and concerns all of it.
    fn end_of_row(&mut self, columns: &[u32], y: u32) {
        for ((node, _), place) in &mut self.places {
            let along = self.columns.get(node.0 as usize) == Some(&true);
            if !along && place.pixels.range((y, 0)..=(y, u32::MAX)).next().is_some() {
                place.pixels.extend(columns.iter().map(|&x| (y, x)));
            }
        }
    }

    fn found(self, columns: usize, looked: usize) -> Found {
        let each = self.places.into_iter().map(|((node, weakness), place)| {
            let mut counts: BTreeMap<u32, usize> = BTreeMap::new();
            for (y, _) in &place.pixels {
                *counts.entry(*y).or_default() += 1;
            }
            let most = counts.into_iter().filter(|(_, n)| n * 2 >= columns);
            Fragile {
                node,
                weakness,
                pixels: place.pixels.len(),
                units: place.units,
                flips: place.flips,
                rows: most.map(|(y, _)| y).collect(),
            }
        });
        Found {
            looked,
            fragile: each.collect(),
        }
    }
}

/// The operation on the way to an event at which the error grew most.
fn blame(shadow: &Shadow<'_>, from: u32) -> (Event, Weakness) {
    let mut at = shadow.event(from);
    let first = at;
    let (mut worst, mut most) = (at, 0.0);
    loop {
        let args = at.args.into_iter().flatten().map(|k| shadow.event(k));
        let next = args.max_by(|a, b| a.units.total_cmp(&b.units));
        let before = next.map_or(1.0, |e| e.units.max(1.0));
        let grown = at.units / before;
        if grown > most {
            (worst, most) = (at, grown);
        }
        match next {
            Some(next) if next.units > 1.0 => at = next,
            _ => break,
        }
    }
    match most >= TIMES {
        true => (worst, Weakness::Grows),
        false => (first, Weakness::Gradual),
    }
}
