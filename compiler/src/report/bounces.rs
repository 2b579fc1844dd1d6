//! How errors grow from turn to turn of a loop.
//!
//! A ray between two mirrors carries its errors along, and each curved mirror
//! spreads them: to first order what one bounce does to a small offset and a
//! small angle is a matrix, and after a few bounces the error grows by its
//! largest eigenvalue (see [`mirrors`]). The same holds of any loop whose next
//! turn begins where the last one ended. No format bears that for long: of
//! `b` bits, `b / log2(g)` turns use up all.
//!
//! The growth is measured: native values and the machine's are computed side by
//! side, on the native way, and after each turn the largest error of the reals
//! that the loop carries is noted, as a part of the largest of them where that
//! is above 1. A straight line through the logarithms gives
//! the factor of a turn. Errors that have grown beyond what matters no longer
//! grow; they are left out of the fit.

use super::shadow::{Pair, Shadow};
use crate::eval::heard::{Heard, Listener};
use crate::eval::run::Run;
use crate::ir::graph::*;
use crate::plan::Plan;
use crate::source::Diagnostic;
use slowlight_routine::Type;
use std::cell::RefCell;

/// About how many pixels are looked at.
const SAMPLE: u32 = 4096;

/// How many operations are run before the sample is called large enough.
const PATIENCE: u64 = 30_000_000;

/// How many turns are looked at: what grows has grown by then.
const TURNS: usize = 64;

/// How many errors of a turn are kept, for their median.
const KEPT: usize = 4096;

/// Growth that is worth a word: errors that only add up grow less.
const GROWS: f64 = 1.5;

/// Of the pixels looked at, one in so many must go on for longer than the
/// format bears: what is rarer is no more than rounding does.
const RARE: usize = 200;

/// The factor by which an error grows a bounce between two convex mirrors of
/// radius `radius`, `gap` apart, for rays near the axis.
///
/// From mirror to mirror an offset h and an angle a become h + gap a, and the
/// mirror turns the ray by 2 h / radius more: the matrix
/// (1, gap; 2/radius, 1 + 2 gap/radius) has determinant 1 and trace
/// 2 + 2 gap/radius, so its eigenvalues are g and 1/g with that sum. For
/// gap = radius, g is 2 + sqrt(3) = 3.73.
pub fn mirrors(gap: f64, radius: f64) -> f64 {
    let half = 1.0 + gap / radius;
    half + libm::sqrt(half * half - 1.0)
}

/// What the pixels looked at have after a turn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Turn {
    /// How many have come that far.
    pub pixels: usize,
    /// The median of their errors.
    pub median: f64,
    /// The largest of their errors.
    pub worst: f64,
}

/// How the errors of one loop grow.
#[derive(Clone, Debug, PartialEq)]
pub struct Growth {
    /// Which loop.
    pub of: LoopId,
    /// What its carried reals are off by: after the first turn, the second, ..
    pub turns: Vec<Turn>,
    /// The factor of a turn, if enough turns were seen to tell.
    pub factor: Option<f64>,
    /// How many turns the error stays below half a level of shade, by that
    /// factor; none where it does not grow.
    pub bears: Option<u32>,
}

/// What was measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measured {
    /// How many pixels were looked at.
    pub looked: usize,
    /// The loops that carry reals, in the graph's order.
    pub loops: Vec<Growth>,
}

/// Measures the growth of errors in a plan's loops, on a sample of its pixels.
/// What earlier pixels send is left out.
pub fn measure(plan: &Plan) -> Measured {
    let mut plan = plan.clone();
    plan.graph.part_pixels();
    let plan = &plan;
    let shadow = Shadow::new(plan);
    let heard = Heard {
        arithmetic: &shadow,
        listener: Turns {
            types: plan.graph.loops.iter().map(|l| l.types.clone()).collect(),
            errors: RefCell::new(vec![Vec::new(); plan.graph.loops.len()]),
        },
    };
    let mut run = Run::within(&plan.graph, &plan.tree, &heard, 2 * PATIENCE);
    shadow.keep();
    let mut looked = 0;
    for (x, y) in sample(plan) {
        if shadow.run() > PATIENCE {
            break;
        }
        // Rows come in any order, so each pixel is forgotten by itself.
        shadow.forget();
        run.pixel(x as i32, y as i32);
        shadow.seen();
        if run.spent() {
            break;
        }
        looked += 1;
    }
    drop(run);
    let most = half_a_level(plan);
    let errors = heard.listener.errors.into_inner();
    let loops = (0..).map(LoopId).zip(errors);
    Measured {
        looked,
        loops: loops.filter_map(|(of, e)| growth(of, e, most)).collect(),
    }
}

/// Half the step between two inks' shades.
fn half_a_level(plan: &Plan) -> f64 {
    0.5 / (plan.graph.image.palette.len().max(2) - 1) as f64
}

/// Pixels spread over the picture, from coarse to fine, so that any beginning
/// of them is a fair sample.
fn sample(plan: &Plan) -> Vec<(u32, u32)> {
    let side = |(first, last): (u32, u32)| u64::from(last - first + 1);
    let (width, height) = (side(plan.columns), side(plan.rows));
    let pixels = width * height;
    let step = pixels.div_ceil(u64::from(SAMPLE)).max(1);
    // An odd step that shares no factor with the width meets all columns.
    let step = (step..).find(|s| gcd(*s, width) == 1).unwrap_or(step);
    let mut places: Vec<(u64, u64)> = (0..).zip((0..pixels).step_by(step as usize)).collect();
    places.sort_by_key(|(k, _)| k.reverse_bits());
    let place = |(_, at): (u64, u64)| {
        let (x, y) = ((at % width) as u32, (at / width) as u32);
        (plan.columns.0 + x, plan.rows.0 + y)
    };
    places.into_iter().map(place).collect()
}

fn gcd(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// A loop's growth from the errors after each of its turns; none where it
/// carries no reals or no pixel takes a turn.
fn growth(of: LoopId, turns: Vec<Errors>, most: f64) -> Option<Growth> {
    let fit = fit(&turns, most);
    let turns: Vec<Turn> = turns.into_iter().map(Errors::into_turn).collect();
    turns.first()?;
    let bears = fit.filter(|f| f.factor > 1.0).map(|f| {
        let turns = libm::log(most / f.start) / libm::log(f.factor);
        turns.clamp(0.0, f64::from(u32::MAX)).floor() as u32
    });
    Some(Growth {
        of,
        turns,
        factor: fit.map(|f| f.factor),
        bears,
    })
}

/// An error of `start * factor^n` after turn n.
#[derive(Clone, Copy, Debug)]
struct Fit {
    start: f64,
    factor: f64,
}

/// The straight line nearest to the logarithms of the medians. It goes through
/// turns whose error is above 0 and below `most`, and at least three of them.
fn fit(turns: &[Errors], most: f64) -> Option<Fit> {
    let points: Vec<(f64, f64)> = (1..)
        .map(f64::from)
        .zip(turns.iter().map(Errors::median))
        .take_while(|(_, error)| *error < most)
        .filter(|(_, error)| *error > 0.0)
        .map(|(turn, error)| (turn, libm::log(error)))
        .collect();
    if points.len() < 3 {
        return None;
    }
    let count = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / count;
    let (middle, level) = (mean(|p| p.0), mean(|p| p.1));
    let square = |p: &(f64, f64)| (p.0 - middle) * (p.0 - middle);
    let product = |p: &(f64, f64)| (p.0 - middle) * (p.1 - level);
    let slope = points.iter().map(product).sum::<f64>() / points.iter().map(square).sum::<f64>();
    Some(Fit {
        start: libm::exp(level - slope * middle),
        factor: libm::exp(slope),
    })
}

/// Warnings for loops that go on for longer than the plan's format bears.
pub fn warnings(plan: &Plan, measured: &Measured) -> Vec<Diagnostic> {
    let each = measured.loops.iter().filter_map(|growth| {
        let turns = plan.graph.loops.get(growth.of.0 as usize)?;
        let (factor, bears) = (growth.factor?, growth.bears?);
        // The turn after must have been seen, and its error must be there.
        let beyond = growth.turns.get(bears as usize)?;
        let seen = beyond.median >= half_a_level(plan) / 2.0;
        let further = beyond.pixels;
        if factor < GROWS || bears >= turns.max || !seen || further * RARE < measured.looked {
            return None;
        }
        let format = plan.runtime.format;
        let share = 100.0 * further as f64 / measured.looked as f64;
        let message = format!(
            "in {format} this loop bears {bears} of its {} turns: errors grow {factor:.2} times a turn (measured)",
            turns.max
        );
        let label = format!("{share:.1} % of the pixels looked at go on for longer");
        let help = format!("`max {bears}`, or a finer `--format`; the rest of the turns show noise");
        Some(Diagnostic::warning(turns.span, message).label(label).help(help))
    });
    each.collect()
}

/// The errors of a turn.
#[derive(Clone, Debug, Default)]
struct Errors {
    pixels: usize,
    worst: f64,
    kept: Vec<f64>,
}

impl Errors {
    fn add(&mut self, error: f64) {
        self.pixels += 1;
        self.worst = self.worst.max(error);
        if self.kept.len() < KEPT {
            self.kept.push(error);
        }
    }

    fn median(&self) -> f64 {
        let mut all = self.kept.clone();
        all.sort_by(f64::total_cmp);
        all.get(all.len() / 2).copied().unwrap_or(0.0)
    }

    fn into_turn(self) -> Turn {
        Turn {
            pixels: self.pixels,
            median: self.median(),
            worst: self.worst,
        }
    }
}

/// Notes the errors of each turn, by loop.
struct Turns {
    types: Vec<Vec<Type>>,
    errors: RefCell<Vec<Vec<Errors>>>,
}

impl Listener<Pair> for Turns {
    fn turn(&self, of: LoopId, turn: u32, carried: &[Option<Pair>]) {
        let at = turn as usize;
        let types = self.types.get(of.0 as usize).map_or(&[][..], Vec::as_slice);
        let reals = carried
            .iter()
            .zip(types)
            .filter(|(_, ty)| **ty == Type::Real);
        let size = |pair: &Pair| pair.exact().real().abs();
        let largest = reals.clone().flat_map(|(pair, _)| pair.as_ref().map(size));
        let scale = largest.fold(1.0, f64::max);
        let off = |pair: &Pair| pair.off() / scale;
        let error = reals
            .filter_map(|(pair, _)| pair.as_ref().map(off))
            .reduce(f64::max);
        let mut errors = self.errors.borrow_mut();
        if let (Some(turns), Some(error)) = (errors.get_mut(of.0 as usize), error)
            && (1..=TURNS).contains(&at)
        {
            if turns.len() < at {
                turns.resize_with(at, Errors::default);
            }
            if let Some(turn) = turns.get_mut(at - 1) {
                turn.add(error);
            }
        }
    }
}
