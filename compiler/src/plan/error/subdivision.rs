//! Branch and bound: a sharper error bound over a wide box, by halving it where it is worst.
//!
//! A bound over a box takes the worst of each rounding and of each derivative wherever in the box
//! that is. Over the halves of a box they are worst at nearer places, so the greater of the two
//! bounds is no greater, and mostly less. The box with the greatest bound is halved until what
//! may be done is done: the greatest bound of those left holds for all.

use super::{Bound, Tile, bounds};
use crate::ir::graph::NodeId;
use crate::plan::Plan;
use slowlight_routine::Range;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// How many of the ways to halve a box are tried, what gained most before first.
const WAYS: usize = 3;

/// By how much a gain that is old counts for more with each halving since: it may be another now.
const AGED: f64 = 1.2;

/// How seldom the side that was halved least is halved whatever it gains: what gains by two
/// halvings together (of a side about 0, say) gains nothing by the first.
const WHATEVER: u32 = 3;

/// How often a side is halved at most.
const DEEP: u32 = 40;

/// Which boxes of params are looked at: what each param may be, and how far the machine's is off.
pub type Keep<'a> = dyn Fn(&[(Range, f64)]) -> bool + 'a;

/// What is proved of one value over a box of params.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proved {
    /// How far the machine's value may be from the native one; infinite where nothing is proved.
    pub error: f64,
    /// Whether a comparison or step on the way may give the machine another answer, somewhere.
    pub undecided: bool,
    /// In how many boxes.
    pub boxes: usize,
    /// How many statements were walked for it.
    pub walked: u64,
}

/// What is proved of a node over a tile's params, for so many statements and roundings. Boxes
/// that are not to be kept hold nothing that matters: `keep` has to hold of every box with a
/// point that does.
pub fn bound_within(plan: &Plan, tile: &Tile, of: NodeId, fuel: u64, keep: &Keep<'_>) -> Proved {
    let mut search = Search {
        plan,
        of,
        fuel,
        spent: 0,
        keep,
    };
    let mut open: BinaryHeap<Part> = search
        .part(tile.clone(), vec![0; tile.params.len()])
        .into_iter()
        .collect();
    let mut boxes = open.len();
    while search.spent < fuel
        && let Some(worst) = open.peek()
    {
        let Some(halves) = search.halves(worst) else {
            break;
        };
        open.pop();
        boxes += halves.len();
        boxes -= 1;
        open.extend(halves);
    }
    let worst = open.peek();
    Proved {
        error: worst.map_or(0.0, |part| part.error),
        undecided: worst.is_some_and(|part| part.undecided),
        boxes,
        walked: search.spent,
    }
}

/// A box and what is proved in it.
#[derive(Clone)]
struct Part {
    tile: Tile,
    /// How often each side was halved.
    depths: Vec<u32>,
    /// How many times as great the bound was before each side was halved last.
    gains: Vec<f64>,
    error: f64,
    undecided: bool,
}

impl PartialEq for Part {
    fn eq(&self, other: &Part) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Part {}

impl PartialOrd for Part {
    fn partial_cmp(&self, other: &Part) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Part {
    /// The worst is the greatest; of those without a bound the widest.
    fn cmp(&self, other: &Part) -> Ordering {
        let halved = |part: &Part| part.depths.iter().sum::<u32>();
        let wider = halved(other).cmp(&halved(self));
        self.error.total_cmp(&other.error).then(wider)
    }
}

struct Search<'a> {
    plan: &'a Plan,
    of: NodeId,
    fuel: u64,
    spent: u64,
    keep: &'a Keep<'a>,
}

impl Search<'_> {
    /// A box with its bound; nothing where it is not to be kept.
    fn part(&mut self, tile: Tile, depths: Vec<u32>) -> Option<Part> {
        if !(self.keep)(&tile.params) {
            return None;
        }
        let found = bounds(self.plan, &tile);
        self.spent += found.walked + u64::from(found.operations) + 1;
        let undecided = found.undecided.iter().any(|&id| id < self.of);
        let error = found.of(self.of).map(|Bound { error, .. }| error);
        Some(Part {
            gains: vec![f64::INFINITY; depths.len()],
            tile,
            depths,
            error: match error {
                Some(error) if !undecided => error,
                _ => f64::INFINITY,
            },
            undecided,
        })
    }

    /// The halves of a box by the side where that gains most; nothing where no side has halves.
    fn halves(&mut self, part: &Part) -> Option<Vec<Part>> {
        let mut sides: Vec<usize> = (0..part.depths.len())
            .filter(|&k| part.depths[k] < DEEP && middle(part.tile.params[k].0).is_some())
            .collect();
        sides.sort_by_key(|&k| part.depths[k]);
        // Without a bound nothing says which side is worth it.
        let whatever = part.depths.iter().sum::<u32>() % WHATEVER == WHATEVER - 1;
        if whatever || part.error.is_infinite() {
            return sides.first().map(|&k| self.halved(part, k));
        }
        sides.sort_by(|&a, &b| part.gains[b].total_cmp(&part.gains[a]));
        let mut gains: Vec<f64> = part.gains.iter().map(|gain| gain * AGED).collect();
        let mut best: Option<(f64, Vec<Part>)> = None;
        for k in sides.into_iter().take(WAYS) {
            if best.is_some() && self.spent >= self.fuel {
                break;
            }
            let made = self.halved(part, k);
            let worst = made.iter().map(|p| p.error).fold(0.0, f64::max);
            gains[k] = part.error / worst;
            if best.as_ref().is_none_or(|(least, _)| worst < *least) {
                best = Some((worst, made));
            }
        }
        let (_, mut made) = best?;
        for half in &mut made {
            half.gains.clone_from(&gains);
        }
        Some(made)
    }

    fn halved(&mut self, part: &Part, k: usize) -> Vec<Part> {
        let whole = part.tile.params[k].0;
        let Some(at) = middle(whole) else {
            return vec![part.clone()];
        };
        let mut depths = part.depths.clone();
        depths[k] += 1;
        let each = [Range::new(whole.lo, at), Range::new(at, whole.hi)].map(|half| {
            let mut tile = part.tile.clone();
            tile.params[k].0 = half;
            self.part(tile, depths.clone())
        });
        // What holds for the whole holds for its halves.
        let least = |mut half: Part| {
            half.error = half.error.min(part.error);
            half.gains.clone_from(&part.gains);
            half
        };
        each.into_iter().flatten().map(least).collect()
    }
}

/// Between the ends of a range, if there is something.
fn middle(range: Range) -> Option<f64> {
    let at = range.lo + (range.hi - range.lo) / 2.0;
    (range.lo < at && at < range.hi).then_some(at)
}
