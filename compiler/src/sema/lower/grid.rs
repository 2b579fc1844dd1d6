//! Uniform grids: which of a group's boxes have something in which cell of space.

use super::cells::{Cells, Most};
use super::derive::Formula;
use super::value::{Grid, Shape, Val};
use super::{Found, Lower};
use crate::ir::enclosure::Enclosure;
use crate::ir::extent::Extent;
use crate::source::Span;
use slowlight_routine::Range;
use std::rc::Rc;

/// Many cells, fewer, few.
const MOST: [Most; 3] = [
    Most::new(16, 256, 20),
    Most::new(10, 128, 8),
    Most::new(5, 50, 4),
];

/// What it costs to go on to the next cell, in parts of what a ray costs against a shape.
const STEP: f64 = 0.25;

/// How many nodes are evaluated for each shape at most, to leave it out of cells.
const WORK: u64 = 20_000;

/// What a ray that meets the box costs, by the chance that it meets a cell: its surface by the
/// whole's (MacDonald and Booth, Heuristics for Ray Tracing Using Space Subdivision, 1990).
fn cost(cells: &Cells<'_, 3>, widths: [f64; 3]) -> f64 {
    let surface = |[x, y, z]: [f64; 3]| x * y + y * z + z * x;
    let met = STEP * cells.count() as f64 + cells.entries() as f64;
    surface(cells.side()) / surface(widths) * met
}

impl Lower<'_> {
    /// The boxes of shapes, if each has one.
    pub(super) fn boxes_of(
        &mut self,
        shapes: &[Rc<Shape>],
        span: Span,
    ) -> Found<Option<Vec<Extent>>> {
        let mut boxes = Vec::new();
        for shape in shapes {
            match self.extent_of(shape, 0.0, span)? {
                Some(of) if of.is_finite() => boxes.push(of),
                _ => return Ok(None),
            }
        }
        Ok(Some(boxes))
    }

    /// The grid in which rays meet shapes at least cost; none where that is no less than to ask
    /// them all.
    pub(super) fn grid_of(
        &mut self,
        shapes: &[Rc<Shape>],
        boxes: &[Extent],
        span: Span,
    ) -> Found<Option<Grid>> {
        let Some(most) = Most::asked(MOST, self.options.ways.instancing) else {
            return Ok(None);
        };
        let all = boxes.iter().copied().reduce(Extent::join);
        let Some(all) = all.map(|all| all.grown(1.0 / 64.0, 0.0)) else {
            return Ok(None);
        };
        let widths = [0, 1, 2].map(|k| all.high[k] - all.low[k]);
        let room = [4.0 * self.options.epsilon * widths.iter().sum::<f64>(); 3];
        let boxes: Vec<[Range; 3]> = boxes.iter().map(Extent::ranges).collect();
        let cells = Cells::cheapest(&boxes, all.ranges(), room, &most, |c| cost(c, widths));
        let Some((_, cells)) = cells.filter(|(cost, _)| *cost <= shapes.len() as f64 / 2.0) else {
            return Ok(None);
        };
        let lists = self.without_empty(shapes, &cells, |region, _| vec![region], span);
        Ok(Some(Grid {
            whole: all,
            side: cells.side(),
            along: cells.along,
            lists: self.lists_of(&lists, span),
        }))
    }

    /// The lists of cells, without shapes that have nothing in the boxes that a cell's region is of.
    pub(super) fn without_empty<const N: usize>(
        &mut self,
        shapes: &[Rc<Shape>],
        cells: &Cells<'_, N>,
        boxes: impl Fn([Range; N], usize) -> Vec<[Range; 3]>,
        span: Span,
    ) -> Vec<Vec<i32>> {
        let level = self.level(0.0);
        let formulas: Vec<Option<Formula>> =
            shapes.iter().map(|s| self.outside_of(s, span)).collect();
        let enclosure = |formula: &Option<Formula>| {
            let formula = formula.as_ref()?;
            Some(Enclosure::new(&self.b, formula.markers, formula.root, WORK))
        };
        let mut enclosures: Vec<Option<Enclosure<'_>>> = formulas.iter().map(enclosure).collect();
        cells.lists(|k, region| match &mut enclosures[k] {
            Some(of) => {
                let mut all = boxes(region, k).into_iter();
                all.all(|part| of.of(part).lo > level && of.left() > 0)
            }
            None => false,
        })
    }

    /// A grid as the library's `cells`, with its tables.
    pub(super) fn grid_values(&mut self, grid: &Grid, span: Span) -> [Val; 3] {
        let mut point =
            |of: [f64; 3]| Val::parts(of.map(|v| Val::Node(self.real(v, span))).to_vec());
        let (low, high, side) = (
            point(grid.whole.low),
            point(grid.whole.high),
            point(grid.side),
        );
        let [nx, ny, nz] = grid.along;
        let counts = [nx, ny, nz, grid.lists.most].map(|n| Val::Node(self.int(n as i32, span)));
        let cells = [low, high, side].into_iter().chain(counts).collect();
        let [first, list] = grid.lists.values();
        [Val::parts(cells), first, list]
    }
}
