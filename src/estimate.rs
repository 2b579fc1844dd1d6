//! What the planner's figures say of a picture's time: what each statement is said to take,
//! times how often the model runs it, on a sample of the pixels; and what its target says that
//! a program takes to get ready, tables above all, which is most of what a coarse picture takes.
//!
//! A routine's cost is a mean over its arguments, and nothing is said of drawing: this
//! orders programs, and says how much dearer some rows are than others. What a picture takes
//! is measured ([`crate::forecast`]).
//!
//! The sample is a grid of pixels. What begins a run of columns is carried out where a run
//! begins, in the model at every pixel: so some rows are gone through for how many runs they
//! have.

use crate::draw::{Window, coarse_first};
use rayon::prelude::*;
use rustc_hash::FxHashMap;
use slowlight_compiler::analysis::rate::rates;
use slowlight_compiler::cost::statement::Costs;
use slowlight_compiler::eval::heard::{Heard, Listener};
use slowlight_compiler::eval::run::Run;
use slowlight_compiler::ir::graph::{Graph, NodeId};
use slowlight_compiler::ir::tree::{Statement, walk};
use slowlight_compiler::passes::loops::strip_mine::passes;
use slowlight_compiler::plan::Plan;
use slowlight_compiler::plan::model;
use slowlight_compiler::plan::model::Model;
use slowlight_compiler::schedule::constant_runs::{Inks, Still};
use slowlight_compiler::schedule::segment::bounds_segment;
use slowlight_routine::{Bits, Format};
use std::cell::Cell;

/// Rows and columns of the usual sample.
const GRID: u32 = 24;

/// How many statements may run for that: what is known by then stands for the rest.
const MOST: u64 = 50_000_000;

/// How many columns of a pass are looked at for where runs begin, at most.
const COLUMNS: u32 = 80;

/// When statements are carried out.
#[derive(Clone, Copy)]
enum When {
    Frame,
    Column,
    Row,
    Pass,
    Run,
    Pixel,
}

/// Adds up what statements cost, by when they are carried out.
struct Adding<'p> {
    costs: Costs<'p>,
    /// When each is carried out, those of subroutines apart; and its cycles.
    known: FxHashMap<*const Statement, (Option<When>, u64)>,
    now: Cell<When>,
    sums: [Cell<u64>; 6],
}

impl Adding<'_> {
    fn new(plan: &Plan) -> Adding<'_> {
        let tree = &plan.tree;
        let blocks = [
            (&tree.frame, When::Frame),
            (&tree.column, When::Column),
            (&tree.row, When::Row),
            (&tree.pass, When::Pass),
            (&tree.segment, When::Run),
            (&tree.pixel, When::Pixel),
        ];
        let costs = plan.costs();
        let mut known = FxHashMap::default();
        let subroutines = tree.subroutines.iter().map(|s| (&s.body, None));
        let blocks = blocks.into_iter().map(|(block, then)| (block, Some(then)));
        for (block, when) in blocks.chain(subroutines) {
            walk(block, &mut |s| {
                let cost = u64::from(costs.statement(s));
                known.insert(std::ptr::from_ref(s), (when, cost));
            });
        }
        Adding {
            costs,
            known,
            now: Cell::new(When::Frame),
            sums: Default::default(),
        }
    }

    fn sum(&self, when: When) -> f64 {
        self.sums[when as usize].get() as f64
    }
}

impl Listener<Bits> for Adding<'_> {
    fn step(&self, statement: &Statement) {
        let known = self.known.get(&std::ptr::from_ref(statement)).copied();
        let (when, cost) = known.unwrap_or_default();
        // Those of a subroutine are its caller's.
        self.now.set(when.unwrap_or(self.now.get()));
        let sum = &self.sums[self.now.get() as usize];
        sum.set(sum.get() + cost);
    }
}

type Adds<'t, 'p> = Run<'t, &'t Heard<Model<'p>, Adding<'p>>>;

/// A pixel: column, row, and ink.
pub type Inked = (u32, u32, u8);

/// What the model shows at a sample of a plan's pixels.
pub struct Sampled {
    /// The cycles before the first row: what makes a program ready, what is carried out once a
    /// picture, and once a column.
    pub before: f64,
    /// The cycles that the statements of all rows take together.
    pub rows: f64,
    pub inks: Vec<Inked>,
    /// How many pixels the whole sample has.
    pub of: usize,
}

impl Sampled {
    /// The cycles of all that is foreseen.
    pub fn cycles(&self) -> f64 {
        self.before + self.rows
    }
}

/// The cycles that a plan's program takes: to get ready, and for its statements, all rows and
/// columns together.
pub fn cycles(plan: &Plan) -> f64 {
    sampled(plan, GRID, MOST).cycles()
}

/// The same by a quarter of the pixels: for some rows of a picture.
pub fn cycles_roughly(plan: &Plan) -> f64 {
    sampled(plan, GRID / 2, MOST / 4).cycles()
}

/// The cycles that it takes to get ready alone, by what a single pixel runs.
pub fn before(plan: &Plan) -> f64 {
    sampled(plan, 1, MOST).before
}

/// The cycles of the statements of all rows alone.
pub fn rows(plan: &Plan) -> f64 {
    sampled(plan, GRID, MOST).rows
}

/// The same by all their pixels.
pub fn all_rows(plan: &Plan) -> f64 {
    let window = Window::of(plan);
    sampled(plan, window.width().max(window.height()), MOST).rows
}

/// The same, with the inks of a sample of so many rows and columns; of which only a part is
/// looked at once so many statements have run.
pub fn sampled(plan: &Plan, side: u32, most: u64) -> Sampled {
    let mut window = Window::of(plan);
    let mut graph = plan.graph.clone();
    let mut sends = 0.0;
    // Pixels are sampled as if nothing had been sent to them: else all those before had to be
    // run. What neighbours left is made up, and inks are of pixels that are traced; what it takes
    // to keep bytes of them and to find the rows is in no figure.
    graph.diffusion = None;
    window.columns = plan.computed_columns();
    window.rows = plan.computed_rows();
    if let Some(errors) = plan.error_rows() {
        let each = plan.gather().map_or(0, |routine| routine.cycles);
        sends = f64::from(each) * errors.shares.len() as f64;
    }
    let heard = Heard {
        arithmetic: Model::of(plan),
        listener: Adding::new(plan),
    };
    let added = &heard.listener;
    let mut run = Run::within(&graph, &plan.tree, &heard, most).alone();
    let still = plan.still.as_ref();
    let frame = added.sum(When::Frame);
    let rows = spread(window.rows, window.columns, side);
    let mut inks = Vec::new();
    let (mut pixels, mut begun, mut looked) = (0.0, 0, 0.0);
    let (mut traced, mut untraced) = (0, 0);
    'rows: for (y, columns) in &rows {
        begun += 1;
        for (x, y) in columns.iter().map(|&x| (x, *y)) {
            let before = added.sum(When::Pixel);
            let ink = model::ink(plan, run.pixel(x as i32, y as i32));
            if run.spent() {
                break 'rows;
            }
            looked += 1.0;
            match run.traced() > traced {
                true => inks.push((x, y, ink)),
                false => untraced += 1,
            }
            traced = run.traced();
            pixels += match still.filter(|still| holds(plan, still, &run)) {
                Some(still) => asked(still, &added.costs),
                None => added.sum(When::Pixel) - before,
            };
        }
    }
    let looked = f64::max(looked, 1.0);
    let row = added.sum(When::Row) / f64::from(begun.max(1));
    let pass = added.sum(When::Pass) / looked;
    // The model makes it anew at every pixel.
    let column = added.sum(When::Column) / looked;
    let runs = runs(plan, &graph, &mut run, added, window);
    let steps = added.costs.steps(&plan.tree.row) + added.costs.steps(&plan.tree.pass);
    let pixel = pixels / looked + steps + sends;
    let passes = f64::from(passes(&graph));
    let (width, height) = (f64::from(window.width()), f64::from(window.height()));
    Sampled {
        before: slowlight_compiler::backend::starts(plan) as f64 + frame + column * width,
        rows: (row + (pass + runs) * passes + pixel * width) * height,
        inks,
        of: rows.iter().map(|(_, columns)| columns.len()).sum::<usize>() - untraced,
    }
}

/// The inks of a sample of so many rows and columns alone, in parts at the same time of which
/// each may run so many statements; and how many pixels the whole sample has.
pub fn inks(plan: &Plan, side: u32, most: u64, parts: usize) -> (Vec<Inked>, usize) {
    let mut graph = plan.graph.clone();
    graph.part_pixels();
    let window = Window::of(plan);
    let rows = spread(window.rows, window.columns, side);
    let part = rows.len().div_ceil(parts).max(1);
    let all: Vec<Vec<Inked>> = rows
        .par_chunks(part)
        .map(|rows| {
            let mut run = Run::within(&graph, &plan.tree, Model::of(plan), most);
            let mut inks = Vec::new();
            for (y, columns) in rows {
                for (x, y) in columns.iter().map(|&x| (x, *y)) {
                    let ink = model::ink(plan, run.pixel(x as i32, y as i32));
                    if run.spent() {
                        return inks;
                    }
                    inks.push((x, y, ink));
                }
            }
            inks
        })
        .collect();
    let of = rows.iter().map(|(_, columns)| columns.len()).sum();
    (all.concat(), of)
}

/// What begins runs of columns, in a pass.
fn runs(
    plan: &Plan,
    graph: &Graph,
    run: &mut Adds<'_, '_>,
    added: &Adding<'_>,
    window: Window,
) -> f64 {
    if plan.tree.segment.is_empty() {
        return 0.0;
    }
    let bounds = bounds(plan, graph);
    let passes = passes(graph);
    let step = passes * window.width().div_ceil(passes * COLUMNS).max(1);
    let rows = sample(window.rows, GRID);
    let mut sum = 0.0;
    for &y in &rows {
        let mut before = None;
        let first = window.columns.0 + y % passes;
        for x in (first..=window.columns.1).step_by(step as usize) {
            let spent = added.sum(When::Run);
            let here = run.segment((x as i32, y as i32), before.is_none(), &bounds);
            if before.as_ref() != Some(&here) {
                sum += added.sum(When::Run) - spent;
                before = Some(here);
            }
        }
    }
    sum / rows.len().max(1) as f64
}

/// The comparisons that may end a run of columns.
fn bounds(plan: &Plan, graph: &Graph) -> Vec<NodeId> {
    let rates = rates(graph);
    let mut bounds = Vec::new();
    walk(&plan.tree.segment, &mut |s| match s {
        Statement::Let(id) if bounds_segment(graph, &rates, *id) => bounds.push(*id),
        _ => {}
    });
    bounds
}

/// Whether the last pixel was one of which nothing is computed.
fn holds(plan: &Plan, still: &Still, run: &Adds<'_, '_>) -> bool {
    let truth = |bits| (plan.runtime.decode)(bits, Format::Bool).truth();
    let mut all = still.conditions.iter();
    all.all(|(cond, holds)| run.last(*cond).map(truth) == Some(*holds))
}

/// What is asked at such a pixel.
fn asked(still: &Still, costs: &Costs<'_>) -> f64 {
    match still.inks {
        Inks::One(_) => 0.0,
        Inks::Either { cond, .. } => f64::from(costs.asked(cond)),
    }
}

/// A sample of so many rows and columns, coarse first: rows with their columns. A row of a picture
/// may be wrong as a whole, where numbers fall together; so those between two rows of the sample
/// share its columns among them.
fn spread(rows: (u32, u32), columns: (u32, u32), side: u32) -> Vec<(u32, Vec<u32>)> {
    let columns = sample(columns, side);
    let all = rows.1 - rows.0 + 1;
    let side = side.min(all);
    let starts = |k: u32| rows.0 + (u64::from(all) * u64::from(k) / u64::from(side)) as u32;
    let order = coarse_first((0..side).collect());
    let stretches = order.into_iter().map(|k| starts(k)..starts(k + 1));
    let shared = stretches.flat_map(|stretch| {
        let between = stretch.len().min(columns.len());
        let columns = &columns;
        stretch.take(between).enumerate().map(move |(k, y)| {
            let mine = columns.iter().skip(k).step_by(between);
            (y, mine.copied().collect())
        })
    });
    shared.collect()
}

/// Up to so many numbers spread evenly between two, both included.
fn sample((first, last): (u32, u32), most: u32) -> Vec<u32> {
    let span = last - first;
    let steps = span.min(most - 1);
    let at = |k: u32| first + (u64::from(span) * u64::from(k) / u64::from(steps.max(1))) as u32;
    (0..=steps).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_reach_both_ends() {
        assert_eq!(sample((5, 5), GRID), [5]);
        assert_eq!(sample((0, 3), GRID), [0, 1, 2, 3]);
        let wide = sample((9, 239), GRID);
        assert_eq!(wide.len(), GRID as usize);
        assert_eq!((wide.first(), wide.last()), (Some(&9), Some(&239)));
    }

    #[test]
    fn samples_are_not_of_whole_rows() {
        let of = spread((0, 119), (0, 159), 36);
        assert_eq!(
            of.iter().map(|(_, columns)| columns.len()).sum::<usize>(),
            36 * 36
        );
        assert!(
            of.iter()
                .all(|(_, columns)| (6..=18).contains(&columns.len()))
        );
        let rows: std::collections::BTreeSet<u32> = of.iter().map(|(y, _)| *y).collect();
        assert_eq!(rows.len(), 120);
        // Where there are no more rows than are asked for, each has all columns.
        assert!(
            spread((4, 9), (0, 9), 36)
                .iter()
                .all(|(_, columns)| columns.len() == 10)
        );
    }
}
