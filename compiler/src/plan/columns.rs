//! Column scenes: pictures in which a column is a wall of some height about the middle row, found
//! by symbolic execution of the ink's slice over the rows.
//!
//! Of all that the ink hangs on, what changes with the picture may reach it in two ways only: as
//! an int or a bool of few values (the *kind*: which side of a wall, say), or as one number that
//! is compared with what hangs on the row alone (how *tall* the column is). Both are cut, and what
//! is left is run in the plan's own arithmetic for every row, every column, every kind, and a
//! tall of each side of every comparison: so what is found is what the model draws, whatever the
//! planner made of the formulas.

mod slice;
mod walls;

use crate::analysis::rate::{Dependence, Rates, rates};
use crate::eval::arithmetic::Arithmetic;
use crate::ir::graph::*;
use crate::ir::tree::*;
use crate::plan::Plan;
use crate::plan::model;
use crate::source::{Diagnostic, Span};
use slice::Slice;
use slowlight_routine::{Bits, Format, Op, Range, Type, scale};
use std::collections::BTreeSet;
use walls::Walls;

/// The most columns and rows of such a picture.
pub const MOST: (u32, u32) = (32, 32);

/// How many kinds of columns there may be.
const KINDS: i64 = 16;

/// A picture of columns.
#[derive(Clone, Debug, PartialEq)]
pub struct Columns {
    /// What says how tall a column is.
    pub tall: NodeId,
    /// Whether it is never below 0.
    pub unsigned: bool,
    /// From which of its values on the next step is reached, in its units, ascending.
    pub steps: Vec<i64>,
    /// How many rows of each half are wall where so many steps are reached; one more than those.
    pub heights: Vec<u8>,
    /// What says of which kind a column is, and between which values each is.
    pub kinds: Vec<(NodeId, i64, i64)>,
    /// The ink of each kind; the first of `kinds` counts fastest.
    pub inks: Vec<u8>,
    /// The ink above the walls, and below.
    pub backs: [u8; 2],
}

/// Why a picture is none of columns.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusal {
    /// What of `draw` is otherwise.
    pub span: Span,
    /// What is wrong with it.
    pub why: String,
}

impl Refusal {
    fn at(graph: &Graph, id: NodeId, why: impl Into<String>) -> Refusal {
        Refusal {
            span: graph.span(id),
            why: why.into(),
        }
    }

    /// As it is told.
    pub fn diagnostic(&self, target: &str) -> Diagnostic {
        let message = format!("{target} draws column scenes only, and this is none");
        Diagnostic::error(self.span, message).label(&self.why).help(
            "in a column scene every column is a wall of one ink about the middle row, whose \
                 height and ink hang on the column alone, before one ink above and one below: \
                 `draw` compares one number of the column with the row, as in `if abs(y - 15.5) \
                 >= tall then 0 else 1 - 0.5 * wall.side`",
        )
    }
}

/// What the ink hangs on, cut where the picture's state comes in.
struct Cut<'p> {
    plan: &'p Plan,
    rates: Rates,
    tall: Option<NodeId>,
    kinds: Vec<(NodeId, i64, i64)>,
    compared: BTreeSet<NodeId>,
    seen: BTreeSet<NodeId>,
}

/// What of a plan's picture is of the column.
///
/// # Errors
/// Where it is no picture of columns.
pub fn columns(plan: &Plan) -> Result<Columns, Refusal> {
    let graph = &plan.graph;
    let size = (graph.image.width, graph.image.height);
    if size.0 > MOST.0 || size.1 > MOST.1 || !size.1.is_multiple_of(2) || size.0 < 1 {
        let (width, height) = MOST;
        return Err(Refusal::at(
            graph,
            graph.ink,
            format!(
                "a picture of at most {width} columns and {height} rows, and an even number of these"
            ),
        ));
    }
    let mut cut = Cut {
        plan,
        rates: rates(graph),
        tall: None,
        kinds: Vec::new(),
        compared: BTreeSet::new(),
        seen: BTreeSet::new(),
    };
    cut.visit(graph.ink)?;
    let Some(tall) = cut.tall else {
        let why = "nothing of the column is compared with the row";
        return Err(Refusal::at(graph, graph.ink, why));
    };
    let all: i64 = cut.kinds.iter().map(|(_, lo, hi)| hi - lo + 1).product();
    if all > KINDS {
        let why = format!("columns are of {all} kinds; there may be {KINDS}");
        return Err(Refusal::at(graph, graph.ink, why));
    }
    cut.found(tall)
}

impl Cut<'_> {
    fn has(&self, id: NodeId, of: Dependence) -> bool {
        self.rates.rate(id).contains(&of)
    }

    /// Whether a value changes from picture to picture, or stands in a loop.
    fn changes(&self, id: NodeId) -> bool {
        let outside = |d: &Dependence| {
            matches!(
                d,
                Dependence::Frame | Dependence::Loop(_) | Dependence::Last(_)
            )
        };
        self.rates.rate(id).iter().any(outside)
    }

    /// A value's whole numbers, where they are few.
    fn few(&self, id: NodeId) -> Option<(i64, i64)> {
        let graph = &self.plan.graph;
        if graph.ty(id) == Type::Bool {
            return Some((0, 1));
        }
        let range = *self.plan.ranges.result.get(id.0 as usize)?;
        let few = graph.ty(id) == Type::Int && range.hi - range.lo < KINDS as f64;
        few.then_some((range.lo as i64, range.hi as i64))
    }

    /// What hangs on the column is read where it was worked out.
    fn origin(&self, id: NodeId) -> NodeId {
        match self.plan.graph.node(id) {
            Node::Tabulated(of) => self.origin(of),
            _ => id,
        }
    }

    fn visit(&mut self, id: NodeId) -> Result<(), Refusal> {
        if !self.seen.insert(id) || !self.changes(id) {
            return Ok(());
        }
        let graph = &self.plan.graph;
        let rows = self.has(id, Dependence::Row);
        if !rows && let Some((lo, hi)) = self.few(id) {
            let id = self.origin(id);
            if self.kinds.iter().all(|(known, _, _)| *known != id) {
                self.kinds.push((id, lo, hi));
            }
            return Ok(());
        }
        if rows && let Some((tall, row)) = self.comparison(id) {
            let tall = self.origin(tall);
            if self.changes(row) || self.has(row, Dependence::Column) {
                let why = "the column is compared with what does not hang on the row alone";
                return Err(Refusal::at(graph, row, why));
            }
            if self.tall.is_some_and(|known| known != tall) {
                let why = "a second number of the column is compared with the row";
                return Err(Refusal::at(graph, id, why));
            }
            self.tall = Some(tall);
            self.compared.insert(id);
            return Ok(());
        }
        match graph.node(id) {
            Node::Tabulated(of) => self.visit(of),
            Node::Apply(..) | Node::Select { .. } | Node::Lookup { .. } => {
                for operand in graph.node(id).operands().collect::<Vec<_>>() {
                    self.visit(operand)?;
                }
                Ok(())
            }
            _ => Err(Refusal::at(
                graph,
                id,
                "the ink takes this otherwise than in one comparison with the row, and it has \
                 more than a few values",
            )),
        }
    }

    /// The column's side and the row's of a comparison of numbers, where it is one.
    fn comparison(&self, id: NodeId) -> Option<(NodeId, NodeId)> {
        let Node::Apply(op, [a, b]) = self.plan.graph.node(id) else {
            return None;
        };
        let compares = matches!(
            op,
            Op::Less | Op::LessEqual | Op::IntLess | Op::IntLessEqual
        );
        let of_column = |id: NodeId| !self.has(id, Dependence::Row);
        match (compares, of_column(a), of_column(b)) {
            (true, true, false) => Some((a, b)),
            (true, false, true) => Some((b, a)),
            _ => None,
        }
    }

    /// The units that what is tall stays within.
    fn units(&self, tall: NodeId) -> (i64, i64) {
        let plan = self.plan;
        let range = plan.ranges.result.get(tall.0 as usize);
        let range = range.copied().unwrap_or(Range::ALL);
        let range = match (plan.points(), plan.graph.ty(tall)) {
            (Some(points), Type::Real) => {
                scale::in_units(range, points.place(Place::of(&plan.graph, tall)))
            }
            _ => range,
        };
        let most = f64::from(i16::MAX);
        let [lo, hi] = [range.lo.floor(), range.hi.ceil()].map(|x| x.clamp(-most, most) as i64);
        (lo, hi)
    }

    fn found(self, tall: NodeId) -> Result<Columns, Refusal> {
        let graph = &self.plan.graph;
        let (width, height) = (graph.image.width as i32, graph.image.height as i32);
        let mut slice = Slice::of(self.plan);
        let bits = |id: NodeId, value: i64| match self.plan.format(id) {
            Format::Bool => Bits::from(value != 0),
            _ => value as Bits,
        };
        // Where a comparison changes its mind.
        let (lo, hi) = self.units(tall);
        let mut steps = BTreeSet::new();
        for y in 0..height {
            for &id in &self.compared {
                let mut holds = |units: i64| {
                    slice.begin((0, y));
                    slice.given.insert(tall, units as Bits);
                    let value = slice.value(id)?;
                    Ok(slice.model.truth(value))
                };
                let least = holds(lo)?;
                if least == holds(hi)? {
                    continue;
                }
                let (mut below, mut above) = (lo, hi);
                while above - below > 1 {
                    let middle = below + (above - below) / 2;
                    match holds(middle)? == least {
                        true => below = middle,
                        false => above = middle,
                    }
                }
                steps.insert(above);
            }
        }
        let steps: Vec<i64> = steps.into_iter().collect();
        let talls: Vec<i64> = std::iter::once(lo).chain(steps.iter().copied()).collect();
        let kinds: i64 = self.kinds.iter().map(|(_, lo, hi)| hi - lo + 1).product();
        let mut walls = Walls::new(graph.image.height as usize);
        for kind in 0..kinds {
            let mut rest = kind;
            let mut chosen = Vec::new();
            for (id, lo, hi) in &self.kinds {
                let count = hi - lo + 1;
                chosen.push((*id, bits(*id, lo + rest % count)));
                rest /= count;
            }
            for (step, units) in talls.iter().enumerate() {
                for x in 0..width {
                    let mut seen = Vec::with_capacity(height as usize);
                    for y in 0..height {
                        slice.begin((x, y));
                        slice.given.insert(tall, *units as Bits);
                        slice.given.extend(chosen.iter().copied());
                        let value = slice.value(graph.ink)?;
                        seen.push(model::ink(self.plan, value));
                    }
                    walls.see((kind as usize, step), seen);
                }
            }
        }
        let (heights, inks, backs) = walls
            .read()
            .map_err(|why| Refusal::at(graph, graph.ink, why))?;
        let mut found = Columns {
            tall,
            unsigned: lo >= 0,
            steps,
            heights,
            kinds: self.kinds,
            inks,
            backs,
        };
        found.merge();
        Ok(found)
    }
}

impl Columns {
    /// Leaves steps out that change no height.
    fn merge(&mut self) {
        let mut k = 0;
        while k < self.steps.len() {
            match self.heights[k] == self.heights[k + 1] {
                true => {
                    self.steps.remove(k);
                    self.heights.remove(k + 1);
                }
                false => k += 1,
            }
        }
    }

    /// The inks of walls, without repetition.
    pub fn walls(&self) -> Vec<u8> {
        let all: BTreeSet<u8> = self.inks.iter().copied().collect();
        all.into_iter().collect()
    }
}
