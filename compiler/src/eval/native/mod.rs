//! The native evaluation: a graph in `f64`, by need, up to 64 pixels of a row
//! at once.
//!
//! A value is computed when it is first needed and remembered until something
//! that it depends on changes (its rate says what that is). So a value that a
//! path does not use is not computed on that path, and a value that depends on
//! the row alone is computed once a row. The operations computed are counted.
//!
//! The pixels of a block are lanes ([`lanes`]). What is needed is needed in a
//! set of lanes, a [`Mask`]; a node knows in which lanes it is known, and is
//! computed in the others that are asked for. A [`Node::Select`] asks for its
//! arms in the lanes that take them, a loop goes on with the lanes that have
//! not ended. So each lane computes exactly what that pixel by itself would,
//! while the work of finding out what to do next is shared by all.
//!
//! A value that cannot differ along the row is computed once, in lane 0, and
//! spread. Where a graph spreads errors, [`spread`] orders the work.
//!
//! The evaluation keeps a stack of its own: graphs may be deeper than the
//! host's stack ([`need`]). Only nested loops recurse.
//!
//! [`Node::Select`]: crate::ir::graph::Node

mod lanes;
mod need;
mod plan;
mod refined;
mod spread;

use crate::analysis::rate::Dependence;
use crate::ir::graph::*;
use lanes::{Lanes, Mask};
use plan::{Plan, Task};
use slowlight_routine::{Type, Value};
use std::ops::Range;

/// What a pixel comes to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pixel {
    /// The ink, in 0..inks-1.
    pub ink: u8,
    /// The shade before the dither; ink/(inks - 1) where there is none.
    pub shade: f64,
}

/// Pixels of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Block {
    x: i32,
    y: i32,
    /// From 1 to 64.
    count: usize,
}

impl Block {
    fn mask(self) -> Mask {
        ALL >> (Mask::BITS as usize - self.count)
    }
}

/// Evaluates one graph, in any order of pixels (row by row is cheapest). Where
/// a graph spreads its error, a pixel needs those before it in the picture: they
/// are evaluated too, each once if pixels are asked for in order.
pub struct Native<'g> {
    graph: &'g Graph,
    plan: Plan,
    lanes: Lanes,
    /// In which lanes each node is known, and behind the nodes in which each
    /// loop has been run.
    known: Vec<Mask>,
    /// In which lanes each loop was done when it was last run.
    done: Vec<Mask>,
    /// What is to be computed next, last first, and in which lanes.
    stack: Vec<(u32, Mask)>,
    block: Option<Block>,
    /// Each lane's column.
    columns: [i32; Mask::BITS as usize],
    operations: u64,
    /// How many may be computed before loops end.
    most: u64,
    spreading: Option<spread::Spreading>,
    refining: Option<refined::Refining>,
}

/// Every lane.
const ALL: Mask = !0;

impl<'g> Native<'g> {
    /// Prepares a graph that [`crate::analysis::verify`] accepts.
    pub fn new(graph: &'g Graph) -> Native<'g> {
        let plan = Plan::new(graph);
        let mut lanes = Lanes::new(plan.count);
        let mut known = vec![0; plan.ran(plan.loops.len() as u32)];
        for (at, step) in plan.steps.iter().enumerate() {
            if matches!(step.task, Task::Given) {
                known[at] = ALL;
            }
        }
        for (id, step) in graph.ids().zip(&plan.steps) {
            let value = match graph.node(id) {
                Node::Const(c) => c.value(),
                Node::Param(p) => param_value(graph, p),
                // Of a graph by itself no neighbours are drawn.
                Node::Neighbour(which) => Value::Int(which.alone()),
                _ => continue,
            };
            // Slot 0 is what no output reaches.
            if step.slot != 0 {
                lanes.fill(step.ty, step.slot, value);
            }
        }
        Native {
            done: vec![0; plan.loops.len()],
            stack: Vec::new(),
            block: None,
            columns: [0; Mask::BITS as usize],
            operations: 0,
            most: u64::MAX,
            spreading: spread::Spreading::new(graph),
            refining: refined::Refining::new(graph),
            graph,
            plan,
            lanes,
            known,
        }
    }

    /// The same where no more than so many operations are worth computing: once they have
    /// been, loops end as if they had no turns left ([`Native::spent`]).
    pub fn within(graph: &'g Graph, most: u64) -> Native<'g> {
        Native {
            most,
            ..Native::new(graph)
        }
    }

    /// Whether all operations that were allowed have been computed: what the last pixel came
    /// to is of no use then.
    pub fn spent(&self) -> bool {
        self.operations >= self.most
    }

    /// How many operations, selects, lookups and loop turns were computed so
    /// far, each lane's by itself.
    pub fn operations(&self) -> u64 {
        self.operations
    }

    /// The picture's ink and shade at column `x`, row `y`.
    pub fn pixel(&mut self, x: i32, y: i32) -> Pixel {
        let mut out = Vec::with_capacity(1);
        self.pixels(x..x.saturating_add(1), y, &mut out);
        out.first().copied().unwrap_or(Pixel { ink: 0, shade: 0.0 })
    }

    /// Appends the pixels of some columns of row `y`.
    pub fn pixels(&mut self, columns: Range<i32>, y: i32, out: &mut Vec<Pixel>) {
        if self.spreading.is_some() {
            return self.spread(columns, y, out);
        }
        if self.refining.is_some() {
            return self.refine(columns, y, out);
        }
        for block in blocks(columns, y, self.lanes.lanes()) {
            self.enter(block, block.x..);
            self.shown(block.mask());
            out.extend((0..block.count).map(|lane| self.look(lane)));
        }
    }

    /// The pixels at any columns of row `y`, in their order; those to the left of others first
    /// where the graph spreads its error.
    pub fn scattered(&mut self, columns: &[i32], y: i32, out: &mut Vec<Pixel>) {
        if self.spreading.is_some() || self.refining.is_some() {
            out.extend(columns.iter().map(|x| self.pixel(*x, y)));
            return;
        }
        for columns in columns.chunks(self.lanes.lanes()) {
            let block = Block {
                x: columns[0],
                y,
                count: columns.len(),
            };
            // Lanes without a pixel have a column, too.
            let rest = std::iter::repeat(columns[0]);
            self.enter(block, columns.iter().copied().chain(rest));
            self.shown(block.mask());
            out.extend((0..block.count).map(|lane| self.look(lane)));
        }
    }

    /// The values that the graph reports, of the first pixel of the block that
    /// was last asked for.
    pub fn reports(&mut self) -> Vec<Value> {
        let graph = self.graph;
        let mut all = Vec::with_capacity(graph.reports.len());
        for &id in &graph.reports {
            self.need(id.0, 1);
            all.push(self.get(id, 0));
        }
        all
    }

    /// Comes to other pixels, at these columns: forgets what depends on where they are.
    fn enter(&mut self, block: Block, columns: impl Iterator<Item = i32>) {
        let was = self.block.replace(block);
        if was.is_none_or(|was| was.y != block.y) {
            self.forget(Dependence::Row, ALL);
        }
        // The same column again keeps what depends on it alone.
        let same = |was: Block| was.count == 1 && block.count == 1 && was.x == block.x;
        if !was.is_some_and(same) {
            self.forget(Dependence::Column, ALL);
        }
        for (known, column) in self.columns.iter_mut().zip(columns) {
            *known = column;
        }
        let columns = self.columns.iter().copied();
        for &(axis, slot) in &self.plan.axes {
            match axis {
                Axis::X | Axis::Run => self.lanes.each(slot, columns.clone()),
                Axis::Y => self.lanes.fill(Type::Int, slot, Value::Int(block.y)),
                Axis::Pass(n) => {
                    let pass = |x: i32| x.rem_euclid(n.max(1) as i32);
                    self.lanes.each(slot, columns.clone().map(pass));
                }
            }
        }
    }

    /// Computes what is looked at.
    fn shown(&mut self, mask: Mask) {
        self.need(self.graph.ink.0, mask);
        if let Some(shade) = self.graph.shade {
            self.need(shade.0, mask);
        }
    }

    /// A lane's pixel.
    fn look(&self, lane: usize) -> Pixel {
        let top = self.graph.image.palette.len().saturating_sub(1) as i32;
        let ink = self.get(self.graph.ink, lane).int().clamp(0, top);
        let shade = match self.graph.shade {
            Some(shade) => self.get(shade, lane).real(),
            None => f64::from(ink) / f64::from(top.max(1)),
        };
        Pixel {
            ink: ink as u8,
            shade,
        }
    }

    fn get(&self, id: NodeId, lane: usize) -> Value {
        let step = self.plan.steps.get(id.0 as usize);
        step.map_or(Value::Int(0), |s| self.lanes.get(s.ty, s.slot, lane))
    }

    fn forget(&mut self, what: Dependence, mask: Mask) {
        for at in self.plan.dependents(what) {
            self.known[at as usize] &= !mask;
        }
    }
}

/// Columns of a row in blocks.
fn blocks(columns: Range<i32>, y: i32, lanes: usize) -> impl Iterator<Item = Block> {
    let (from, to) = (i64::from(columns.start), i64::from(columns.end));
    (from..to).step_by(lanes).map(move |x| Block {
        x: x as i32,
        y,
        count: (to - x).min(lanes as i64) as usize,
    })
}

/// A param's value as the graph's type has it.
pub fn param_value(graph: &Graph, id: ParamId) -> Value {
    graph
        .params
        .get(id.0 as usize)
        .map_or(Value::Real(0.0), |p| match p.ty {
            Type::Bool => Value::Bool(p.value != 0.0),
            Type::Int => Value::Int(p.value as i32),
            Type::Real => Value::Real(p.value),
        })
}
