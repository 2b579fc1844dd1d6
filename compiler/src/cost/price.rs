//! Profile-guided cost of a plan, in cycles a pixel: for choosing between plans of one scene.
//!
//! The statements are run in `f64` at pixels spread over the picture, with the
//! params as the scene has them, and each that runs is added up with the
//! cycles of the routine that the ranges allow. So what few pixels need weighs
//! little. Where that would take too long, either way of a choice is thought to be as
//! likely ([`crate::ir::often`]). Errors that others send are left out.

use super::magnitudes::seen;
use super::meter::Meter;
use super::pixels::{PATIENCE, Pixel, Pixels};
use crate::analysis::range::Ranges;
use crate::analysis::rate::rates;
use crate::analysis::region::Fact;
use crate::cost::size_budget::SizeBudget;
use crate::cost::statement::Beside;
use crate::eval::run::Run;
use crate::homes::single_use::folded;
use crate::ir::graph::*;
use crate::ir::often;
use crate::ir::tree::*;
use crate::passes::loops::licm::{Hoist, hoisted};
use crate::passes::loops::strip_mine::passes;
use crate::schedule::analysed::{Analysed, Cost};
use crate::schedule::constant_runs::{Inks, Still, still};
use crate::schedule::segment::bounds_segment;
use crate::selection::routines::{Chosen, choose};
use rustc_hash::FxHashSet;
use slowlight_routine::{Format, Runtime};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Rows in which runs of columns are looked at.
const ROWS: u32 = 12;

/// How many columns of a pass are looked at for where runs end, at most.
const COLUMNS_LOOKED_AT: u32 = 80;

/// How plans are priced.
pub struct Price {
    runtime: &'static Runtime,
    memory: f64,
    /// Whether loop-invariant code is moved in the end.
    hoists: bool,
    /// The pixels that are looked at.
    pixels: Arc<Pixels>,
}

impl Price {
    /// Prices for plans of a scene, by the pixels that stand for all.
    pub fn new(runtime: &'static Runtime, pixels: Arc<Pixels>, budget: SizeBudget) -> Price {
        Price {
            runtime,
            memory: budget.part(),
            hoists: true,
            pixels,
        }
    }

    /// The same where loop-invariant code stays where it is.
    pub fn without_hoisting(self) -> Price {
        Price {
            hoists: false,
            ..self
        }
    }

    /// Cycles a pixel once loop-invariant code is moved, and something for memory.
    pub fn of(&self, plan: &Analysed) -> f64 {
        let cost = self.known(plan);
        (cost.cycles - cost.hoisted) * (1.0 + self.memory * cost.statements)
    }

    /// The same with all code where it is.
    pub fn as_it_stands(&self, plan: &Analysed) -> f64 {
        let cost = self.known(plan);
        cost.cycles * (1.0 + self.memory * cost.statements)
    }

    /// Cycles a pixel.
    pub fn cycles_known(&self, plan: &Analysed) -> f64 {
        self.known(plan).cycles
    }

    /// Found once.
    fn known(&self, plan: &Analysed) -> Cost {
        *plan.cost.get_or_init(|| {
            let (cycles, hoisted) = self.cycles(plan);
            Cost {
                cycles,
                hoisted,
                statements: memory(plan),
            }
        })
    }

    /// How often a plan's values are computed; nothing where it cannot be run.
    pub(crate) fn profile(&self, plan: &Analysed) -> Option<super::profile::Profile> {
        let routines = self.routines(plan)?;
        Some(super::profile::Profile::new(
            plan,
            self.runtime,
            &routines,
            &self.pixels,
        ))
    }

    /// How often each statement of a plan ran at the pixels that are looked at; nothing where
    /// none are.
    pub(crate) fn counts<'p>(
        &self,
        plan: &'p Analysed,
    ) -> Option<impl Fn(&Statement) -> u64 + use<'p>> {
        let meter = Meter::new(&plan.graph, |_: &Statement| 0.0);
        self.run(plan, &meter, None)?;
        (!self.pixels.is_empty()).then_some(move |statement: &Statement| meter.count(statement))
    }

    /// About what a plan with so many cycles and values more than another is priced at, beside
    /// that: as [`Price::of`] has it, a value taken for a statement of pixels.
    pub(crate) fn beside(&self, plan: &Analysed, cycles: f64, more: f64) -> f64 {
        cycles * (1.0 + self.memory * (memory(plan) + more))
    }

    /// About which routines a plan would have; nothing where there is none for an operation.
    fn routines(&self, plan: &Analysed) -> Option<Chosen> {
        let by = |ranges: &Ranges| choose(&plan.graph, &plan.tree, ranges, self.runtime, None).ok();
        if !matches!(self.runtime.real, Format::Scaled { .. }) || self.pixels.is_empty() {
            return by(&plan.ranges);
        }
        let meter = Meter::new(&plan.graph, |_: &Statement| 0.0).watching();
        self.run(plan, &meter, None);
        by(&seen(&plan.graph, &plan.ranges, &meter))
    }

    /// Cycles a pixel, and what hoisting spares of them.
    fn cycles(&self, plan: &Analysed) -> (f64, f64) {
        let Some(routines) = self.routines(plan) else {
            return (f64::INFINITY, 0.0);
        };
        let runs = !plan.tree.segment.is_empty();
        let still = runs.then(|| still(&plan.graph)).flatten();
        let beside = Beside {
            graph: &plan.graph,
            runtime: self.runtime,
            // That ints are read as reals in place is a matter of writing, and left out.
            folded: folded(&plan.graph, &plan.tree, still.as_ref(), &[]),
            routines,
        };
        // What begins a pass or run of columns is not carried out at each of them.
        let mut runs = FxHashSet::default();
        for block in [&plan.tree.pass, &plan.tree.segment] {
            walk(block, &mut |s| {
                runs.insert(std::ptr::from_ref(s));
            });
        }
        let mut columns = FxHashSet::default();
        walk(&plan.tree.column, &mut |s| {
            columns.insert(std::ptr::from_ref(s));
        });
        let cost = |statement: &Statement| f64::from(beside.statement(statement));
        let height = f64::from(plan.graph.image.height.max(1));
        let by_pixel = |statement: &Statement| match std::ptr::from_ref(statement) {
            at if runs.contains(&at) => 0.0,
            // Carried out once a column, not in each of its pixels.
            at if columns.contains(&at) => cost(statement) / height,
            _ => cost(statement),
        };
        let width = f64::from(plan.graph.image.width.max(1));
        let guess = |block: &Block| guessed(block, &cost);
        let bounds = bounds(plan);
        let mut hoisted = 0.0;
        let pixel = match self.pixels.is_empty() {
            true => guess(&plan.tree.pixel) + guess(&plan.tree.column) / height,
            false => {
                let meter = Meter::new(&plan.graph, by_pixel);
                let still = still.as_ref().map(|still| match still.inks {
                    Inks::One(_) => (still, 0.0),
                    Inks::Either { cond, .. } => (still, f64::from(beside.asked(cond))),
                });
                let sum = self.run(plan, &meter, still);
                let weight = self.pixels.weight();
                // Of runs whose inks are known before, it is not computed at most pixels.
                if self.hoists && still.is_none() && sum.is_some() {
                    hoisted = spared(plan, &meter, &beside) / weight;
                }
                sum.map_or_else(|| guess(&plan.tree.pixel), |sum| sum / weight)
            }
        };
        let passes = f64::from(passes(&plan.graph));
        let pass = guess(&plan.tree.pass) + self.begun(plan, &bounds, &cost);
        let outside = guess(&plan.tree.row) + pass * passes;
        let steps = beside.steps(&plan.tree.row) + beside.steps(&plan.tree.pass);
        (outside / width + pixel + steps, hoisted)
    }

    /// The cheapest of some plans, the first of several.
    pub fn cheapest(&self, plans: impl Iterator<Item = Analysed>) -> Option<Analysed> {
        let mut all: Vec<Analysed> = plans.collect();
        match all.len() {
            0 | 1 => all.pop(),
            _ => all
                .into_iter()
                .min_by(|a, b| self.of(a).total_cmp(&self.of(b))),
        }
    }

    /// What it costs a pass to begin its runs of columns: some rows, a pass each,
    /// are gone through by what ends runs alone. Where that would take too long, runs
    /// are thought to be as many as there are comparisons.
    fn begun(&self, plan: &Analysed, bounds: &[NodeId], cost: &dyn Fn(&Statement) -> f64) -> f64 {
        if plan.tree.segment.is_empty() {
            return 0.0;
        }
        let guess = || guessed(&plan.tree.segment, cost) * (1.0 + bounds.len() as f64);
        if self.pixels.is_empty() {
            return guess();
        }
        let mut inside = FxHashSet::default();
        walk(&plan.tree.segment, &mut |s| {
            inside.insert(std::ptr::from_ref(s));
        });
        let meter = Meter::new(&plan.graph, |s: &Statement| {
            match inside.contains(&std::ptr::from_ref(s)) {
                true => cost(s),
                false => 0.0,
            }
        });
        let image = &plan.graph.image;
        let (width, passes) = (image.width, passes(&plan.graph));
        let step = passes * width.div_ceil(passes * COLUMNS_LOOKED_AT).max(1);
        let mut run = Run::within(&plan.graph, &plan.tree, &meter, PATIENCE + 1);
        let mut sum = 0.0;
        for row in 0..ROWS {
            let y = ((2 * row + 1) * image.height / (2 * ROWS)) as i32;
            let mut before = None;
            for x in (row % passes..width).step_by(step as usize) {
                meter.sum.set(0.0);
                let here = run.segment((x as i32, y), before.is_none(), bounds);
                if before.as_ref() != Some(&here) {
                    sum += meter.sum.get();
                    before = Some(here);
                }
                if meter.ran.get() > PATIENCE {
                    return guess();
                }
            }
        }
        sum / f64::from(ROWS)
    }

    /// Whether copies of a value are worth their memory: given how many times a
    /// pixel less it is computed, and how many copies there are more.
    pub fn worth<'p>(&self, plan: &'p Analysed) -> impl Fn(NodeId, f64, usize) -> bool + use<'p> {
        let routines = choose(&plan.graph, &plan.tree, &plan.ranges, self.runtime, None);
        let beside = Beside {
            graph: &plan.graph,
            runtime: self.runtime,
            // A copy has a variable.
            folded: Vec::new(),
            routines: routines.unwrap_or_default(),
        };
        let limit = self.memory * self.of(plan);
        move |id, less, copies| less * f64::from(beside.kept(id)) > limit * copies as f64
    }

    /// What the pixels cost together, by their weights; nothing where too many statements run.
    fn run(
        &self,
        plan: &Analysed,
        meter: &Meter<'_, impl Fn(&Statement) -> f64>,
        still: Option<(&Still, f64)>,
    ) -> Option<f64> {
        let patience = self.pixels.patience;
        let mut run = Run::within(&plan.graph, &plan.tree, meter, patience + 1).alone();
        let mut row = None;
        let mut sum = 0.0;
        for &Pixel { x, y, weight } in &self.pixels.all {
            meter.weight.set(weight);
            // The row's own statements are counted apart.
            if row.replace(y) != Some(y) {
                run.begin(x, y);
            }
            meter.sum.set(0.0);
            run.pixel(x, y);
            let holds = |(cond, holds): &Fact| match run.last(*cond) {
                Some(value) => value.truth() == *holds,
                None => false,
            };
            // Of a run whose inks are known before nothing is computed, or one bool.
            sum += match still {
                Some((still, asked)) if still.conditions.iter().all(holds) => asked * weight as f64,
                _ => meter.sum.get(),
            };
            if meter.ran.get() > patience {
                return None;
            }
        }
        Some(sum)
    }
}

/// How many times as often as its loop begins a value is computed for which that is sure: below,
/// what is found by few pixels is not true of all.
const SURELY: u64 = 4;

/// What loop-invariant code motion spares of what the pixels cost together.
fn spared(
    plan: &Analysed,
    meter: &Meter<'_, impl Fn(&Statement) -> f64>,
    beside: &Beside<'_>,
) -> f64 {
    if plan.graph.loops.is_empty() {
        return 0.0;
    }
    let ran = |statement: &Statement| meter.count(statement);
    let mut least: BTreeMap<NodeId, Hoist> = BTreeMap::new();
    for ((id, _), hoist) in hoisted(&plan.graph, &plan.tree.pixel, &ran) {
        let known = least.entry(id).or_insert(hoist);
        known.begun = known.begun.min(hoist.begun);
    }
    let spared = |(id, hoist): (NodeId, Hoist)| {
        let times = match hoist.times < SURELY * hoist.begun {
            true => 0,
            false => hoist.times - hoist.begun,
        };
        times as f64 * f64::from(beside.statement(&Statement::Let(id)))
    };
    least.into_iter().map(spared).sum()
}

/// The comparisons that may end a run of columns.
fn bounds(plan: &Analysed) -> Vec<NodeId> {
    let mut bounds = Vec::new();
    if plan.tree.segment.is_empty() {
        return bounds;
    }
    let rates = rates(&plan.graph);
    walk(&plan.tree.segment, &mut |s| {
        if let Statement::Let(id) = s
            && bounds_segment(&plan.graph, &rates, *id)
        {
            bounds.push(*id);
        }
    });
    bounds
}

/// Memory in statements, tables among them.
fn memory(plan: &Analysed) -> f64 {
    let mut statements = 0;
    for block in plan.tree.outer() {
        walk(block, &mut |_| statements += 1);
    }
    let entries = plan.graph.tables.iter().map(|t| match t.seed.is_empty() {
        true => t.entries.len() as f64 / 3.0,
        // The array, and how it is worked out.
        false => t.entries.len() as f64 / 2.0 + 4.0,
    });
    // An array's entries are as long as values are.
    let tabulated = (plan.graph.nodes.iter()).filter(|n| matches!(n, Node::Tabulated(_)));
    let arrays = tabulated.count() as f64 * f64::from(plan.graph.image.width) / 3.0;
    f64::from(statements) + entries.sum::<f64>() + arrays
}

/// Cycles of a block in a pixel of which nothing is known.
fn guessed(block: &Block, cost: &dyn Fn(&Statement) -> f64) -> f64 {
    let one = |statement: &Statement| {
        let inner = match statement {
            Statement::If { yes, no, .. } => {
                let likely = often::likely(yes, no);
                likely * guessed(yes, cost) + (1.0 - likely) * guessed(no, cost)
            }
            Statement::Loop(turns) => {
                let blocks = often::turns(turns);
                blocks.iter().map(|(b, n)| n * guessed(b, cost)).sum()
            }
            _ => 0.0,
        };
        cost(statement) + inner
    };
    block.iter().map(one).sum()
}
