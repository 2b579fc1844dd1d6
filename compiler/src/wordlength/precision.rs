//! Precision tuning (mixed word lengths by measured error): which reals are held in fewer bits
//! than others, in formats that have two widths ([`slowlight_routine::Runtime::narrow`]): as many
//! as the picture allows.
//!
//! How far roundings move a pixel's ink is measured, not reckoned: bounds of many values
//! together are far above what pixels show, and one value alone hardly ever counts, since what
//! it is made of and what is made of it round as well. So plans are made in which groups of
//! values are narrow, and run in the routines' models at the pixels whose inks are at stake:
//! those that come out otherwise than in `f64` where all values are narrow. Of these only a
//! part may stay wrong ([`Narrow::wrong`]).
//!
//! Groups are found by halving. Values stand in the graph in the order in which they are made
//! of each other, so halves of it are mostly chains of values. A group is taken if the plan
//! becomes cheaper by it and the inks stay within the limit; else its halves are looked at.
//! At the end the whole picture is looked at; what came out wrong elsewhere is at stake from
//! there on, and groups are looked for once more.
//!
//! Where pixels depend on each other, none can be looked at alone, and all values are wide;
//! so they are in programs with subroutines and in scenes that move. Live params have the scene's
//! own values here.

use crate::analysis::points::widths::Widths;
use crate::cost::meter::Meter;
use crate::eval::run::Run;
use crate::ir::graph::*;
use crate::ir::tree::Statement;
use crate::plan::Plan;
use crate::plan::model::ModelRun;
use crate::plan::params::params;
use crate::wordlength::{placed, sample};
use slowlight_routine::{Format, Narrow, Type};
use std::cell::{Cell, RefCell};

/// How far narrow values are looked for.
struct Effort {
    /// How often groups are.
    rounds: u32,
    /// How many nodes may be planned in a round, all plans together.
    work: usize,
    /// How many statements may run in `f64`.
    patience: u64,
}

/// Where wide values have two bytes.
const SHORT: Effort = Effort {
    rounds: 4,
    work: 60_000,
    patience: 24_000_000,
};

/// Where they have more: a plan whose graph has long numbers takes as long, and its format is
/// tried unasked.
const LONG: Effort = Effort {
    rounds: 2,
    work: 15_000,
    patience: 8_000_000,
};

fn effort(bits: u8) -> &'static Effort {
    if bits > 16 { &LONG } else { &SHORT }
}

/// How many pixels at stake are looked at, at most.
const AT_STAKE: usize = 500;

/// Rows are gone through in steps of so many, so that something of every part of the picture is
/// seen where patience ends before its rows do.
const APART: i32 = 8;

/// How many statements may run in the routines' models, all plans together, before no more
/// groups are looked at.
pub(crate) const MODELLED: u64 = 400_000_000;

/// A plan with as many values narrow as its picture allows, where its format knows two
/// widths. Where fewer statements than usual may run in the models and are not enough, it is
/// noted that the search was cut. With it, how many statements ran.
pub(crate) fn narrowed(mut plan: Plan, modelled: u64) -> (Plan, u64) {
    let (Some(narrow), Format::Scaled { bits }) = (plan.runtime.narrow, plan.runtime.real) else {
        return (plan, 0);
    };
    // Of what states become, no pixel of the picture says how exact it must be.
    if plan.graph.diffusion.is_some() || plan.graph.is_moving() {
        return (plan, 0);
    }
    if modelled == 0 {
        plan.note_cut();
        return (plan, 0);
    }
    // Whatever they are set to: an edited program keeps its plan.
    let Ok(usual) = params(&as_usual(&plan.graph), plan.runtime) else {
        return (plan, 0);
    };
    // Each pixel by itself: what others leave moves a shade, and asks for no more bits.
    let refinement = plan.graph.refinement.take();
    let own = std::mem::replace(&mut plan.params, usual);
    plan.hold();
    let sample = sample::seen(&plan.graph, &plan.tree, bits, sample::PATIENCE);
    let (pixels, often) = looked_at(&plan, effort(bits).patience);
    let mut search = Search {
        plan,
        sample,
        bits,
        narrow,
        pixels,
        often,
        left: Cell::new(modelled),
        few: modelled < MODELLED,
    };
    search.find();
    let ran = modelled - search.left.get();
    let cut = search.is_cut();
    let mut plan = search.plan;
    if cut {
        plan.note_cut();
    }
    plan.params = own;
    plan.graph.refinement = refinement;
    plan.hold();
    (plan, ran)
}

/// A graph whose params have the values that the scene gives them.
fn as_usual(graph: &Graph) -> Graph {
    let mut graph = graph.clone();
    for param in &mut graph.params {
        param.value = param.usual;
    }
    graph
}

/// A pixel's column, row, and ink in `f64`.
type Pixel = (i32, i32, u8);

/// The pixels that are looked at, and how often each of them computes each node.
fn looked_at(plan: &Plan, patience: u64) -> (Vec<Pixel>, Vec<f64>) {
    let graph = &plan.graph;
    let often = RefCell::new(vec![0.0; graph.nodes.len()]);
    let count = Meter::new(graph, |statement: &Statement| {
        if let Statement::Let(id) = statement
            && let Some(often) = often.borrow_mut().get_mut(id.0 as usize)
        {
            *often += 1.0;
        }
        0.0
    });
    let mut run = Run::within(graph, &plan.tree, &count, 2 * patience);
    let top = graph.image.palette.len().saturating_sub(1) as i32;
    let (width, height) = (graph.image.width as i32, graph.image.height as i32);
    let mut pixels = Vec::new();
    let rows = (0..APART).flat_map(|first| (first..height).step_by(APART as usize));
    for y in rows.take_while(|_| count.ran.get() < patience) {
        for x in 0..width {
            let ink = run.pixel(x, y).int().clamp(0, top);
            if run.spent() {
                break;
            }
            pixels.push((x, y, ink as u8));
        }
    }
    let all = pixels.len().max(1) as f64;
    let often = often.take().into_iter().map(|n: f64| n / all).collect();
    (pixels, often)
}

/// A plan whose values are made narrower.
struct Search {
    plan: Plan,
    sample: sample::Sample,
    /// Of wide values.
    bits: u8,
    narrow: Narrow,
    pixels: Vec<Pixel>,
    /// How often a pixel computes each node.
    often: Vec<f64>,
    /// How many statements may run yet.
    left: Cell<u64>,
    /// Whether it is less than usual: where that is not enough, nothing is wanted.
    few: bool,
}

impl Search {
    /// Makes values of the plan narrow.
    fn find(&mut self) {
        let graph = &self.plan.graph;
        let varies = |id: &NodeId| graph.ty(*id) == Type::Real && graph.constant(*id).is_none();
        let reals: Vec<NodeId> = graph.ids().filter(varies).collect();
        let wide = vec![false; graph.nodes.len()];
        let mut at_stake = self.wrong(&self.pixels);
        let least = at_stake.len();
        if !self.hold(&vec![true; wide.len()]) {
            self.hold(&wide);
            return;
        }
        let most = self.wrong(&self.pixels);
        if self.is_cut() {
            return;
        }
        let limit = least + most.len().saturating_sub(least) / self.narrow.wrong.max(1);
        at_stake.extend(most);
        let mut best = (usize::MAX, wide);
        for _ in 0..effort(self.bits).rounds {
            at_stake.sort_unstable();
            at_stake.dedup();
            let narrow = self.halved(&reals, &at_stake, limit);
            self.hold(&narrow);
            if self.is_cut() {
                return;
            }
            let wrong = self.wrong(&self.pixels);
            if wrong.len() < best.0 {
                best = (wrong.len(), narrow);
            }
            if wrong.len() <= limit || self.left.get() == 0 {
                break;
            }
            at_stake.extend(wrong);
        }
        self.hold(&best.1);
    }

    /// Whether less than usual may be done, and was not enough.
    fn is_cut(&self) -> bool {
        self.few && self.left.get() == 0
    }

    /// The nodes that may be narrow so that no more than so many pixels are wrong of those
    /// at stake.
    fn halved(&mut self, reals: &[NodeId], at_stake: &[Pixel], limit: usize) -> Vec<bool> {
        let step = at_stake.len().div_ceil(AT_STAKE).max(1);
        let (some, limit) = (every(at_stake, step), limit / step);
        let mut narrow = vec![false; self.plan.graph.nodes.len()];
        self.hold(&narrow);
        let mut cost = self.cost();
        let mut groups = vec![reals];
        let mut left = effort(self.bits).work / narrow.len().max(1);
        while let Some(group) = groups.pop().filter(|_| left > 0 && self.left.get() > 0) {
            left -= 1;
            let mut tried = narrow.clone();
            group.iter().for_each(|id| tried[id.0 as usize] = true);
            if self.hold(&tried) && self.cost() < cost && self.wrong(&some).len() <= limit {
                (narrow, cost) = (tried, self.cost());
            } else if group.len() > 1 {
                let (first, second) = group.split_at(group.len() / 2);
                groups.extend([second, first]);
            }
        }
        narrow
    }

    /// Plans some nodes narrow and the others wide; whether there are routines for that. If
    /// not, the plan stays as it was.
    fn hold(&mut self, narrow: &[bool]) -> bool {
        let plan = &mut self.plan;
        let (graph, tree, runtime) = (&plan.graph, &plan.tree, plan.runtime);
        let widths = Widths::mixed(graph, (self.bits, self.narrow.bits), narrow);
        let (points, ranges) = placed((graph, tree), runtime, &self.sample, &widths);
        plan.take_points(points, ranges)
    }

    /// Those of some pixels whose inks are wrong.
    fn wrong(&self, pixels: &[Pixel]) -> Vec<Pixel> {
        // In fewer bits a loop may go on for longer: what does not end in time is wrong.
        let most = match self.few {
            true => self.left.get().min(4 * effort(self.bits).patience),
            false => 4 * effort(self.bits).patience,
        };
        let mut run = ModelRun::within(&self.plan, most);
        let mut all = pixels.to_vec();
        all.retain(|(x, y, ink)| run.spent() || run.pixel(*x, *y).ink != *ink || run.spent());
        let ran = most - run.left();
        self.left.set(self.left.get().saturating_sub(ran));
        all
    }

    /// Cycles a pixel of operations and of what they read at other scales and widths.
    fn cost(&self) -> f64 {
        let each = self.plan.graph.ids().zip(&self.often);
        let computed = each.filter(|(_, often)| **often > 0.0);
        computed.map(|(id, often)| often * self.cycles(id)).sum()
    }

    fn cycles(&self, id: NodeId) -> f64 {
        let (graph, plan) = (&self.plan.graph, &self.plan);
        let (Node::Apply(op, args), Some(points), Some(routine)) =
            (graph.node(id), plan.points(), plan.routine(id))
        else {
            return 0.0;
        };
        let (widths, to) = (points.widths(), points.scales(id).args);
        let bytes = f64::from(widths.operands(id) / 8);
        let read = |k: usize| {
            let arg = args[k];
            let by = to[k] - points.own(arg);
            let same = by == 0 && widths.value(arg) <= widths.operands(id);
            match graph.constant(arg).is_some() || op.args()[k] != Type::Real || same {
                true => 0.0,
                false => {
                    let cut = match widths.value(arg) > widths.operands(id) || by < 0 {
                        true => CUT,
                        false => 0.0,
                    };
                    MOVED * bytes + f64::from(left_to_shift(by)) * (SHIFTED * bytes + 2.0) + cut
                }
            }
        };
        f64::from(routine.cycles) + (0..op.arity()).map(read).sum::<f64>()
    }
}

/// Cycles to copy a byte, and to shift one by a bit.
const MOVED: f64 = 8.0;
const SHIFTED: f64 = 5.0;

/// Cycles to round what is cut, and to ask whether it fits.
const CUT: f64 = 12.0;

/// Bits that are left when whole bytes are moved, in the nearer direction.
fn left_to_shift(by: i8) -> i8 {
    by.rem_euclid(8).min((-by).rem_euclid(8))
}

/// Every so manyth.
fn every(pixels: &[Pixel], step: usize) -> Vec<Pixel> {
    pixels.iter().step_by(step).copied().collect()
}
