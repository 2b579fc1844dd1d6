//! Uniform grids: which of a group's boxes have something in which cell of space.

use super::derive::Formula;
use super::value::{Grid, Shape, Table, Val};
use super::ways::Instancing;
use super::{Found, Lower};
use crate::ir::enclosure::Enclosure;
use crate::ir::extent::Extent;
use crate::source::Span;
use slowlight_routine::Range;
use std::rc::Rc;

/// How many shapes a grid is worth.
const FEW: usize = 8;

/// Cells along a side, cells in all, and entries of all cells' lists, at most.
struct Most {
    along: usize,
    cells: usize,
    /// Entries for each shape.
    entries: usize,
}
const MANY: Most = Most {
    along: 16,
    cells: 256,
    entries: 20,
};
const SOME: Most = Most {
    along: 5,
    cells: 50,
    entries: 4,
};

/// What it costs to go on to the next cell, in parts of what a ray costs against a shape.
const STEP: f64 = 0.25;

/// By what part of a cell boxes are made larger, for the roundings of rays' ways.
const ROOM: f64 = 1.0 / 32.0;

/// How many nodes are evaluated for each shape at most, to leave it out of cells.
const WORK: u64 = 20_000;

/// Boxes in so many cells along each side.
struct Cells<'e> {
    boxes: &'e [Extent],
    whole: Extent,
    along: [usize; 3],
    /// By how much boxes are made larger whatever the cells.
    room: f64,
}

impl Cells<'_> {
    fn side(&self) -> [f64; 3] {
        let width = |k: usize| self.whole.high[k] - self.whole.low[k];
        [0, 1, 2].map(|k| width(k) / self.along[k] as f64)
    }

    /// The first and last cell along each side that a box has something in.
    fn reach(&self, of: &Extent) -> [(usize, usize); 3] {
        let side = self.side();
        [0, 1, 2].map(|k| {
            let room = self.room + ROOM * side[k];
            let cell = |at: f64| {
                let at = ((at - self.whole.low[k]) / side[k]).floor();
                at.clamp(0.0, self.along[k] as f64 - 1.0) as usize
            };
            (cell(of.low[k] - room), cell(of.high[k] + room))
        })
    }

    fn entries(&self) -> usize {
        let of = |reach: [(usize, usize); 3]| -> usize {
            reach.iter().map(|(low, high)| high - low + 1).product()
        };
        self.boxes.iter().map(|b| of(self.reach(b))).sum()
    }

    /// What a ray that meets the box costs, by the chance that it meets a cell: its surface by the
    /// whole's (MacDonald and Booth, Heuristics for Ray Tracing Using Space Subdivision, 1990).
    fn cost(&self) -> f64 {
        let surface = |[x, y, z]: [f64; 3]| x * y + y * z + z * x;
        let whole = [0, 1, 2].map(|k| self.whole.high[k] - self.whole.low[k]);
        let count: usize = self.along.iter().product();
        surface(self.side()) / surface(whole) * (STEP * count as f64 + self.entries() as f64)
    }

    /// What is in a cell, or near by.
    fn region(&self, cell: [usize; 3]) -> [Range; 3] {
        let side = self.side();
        [0, 1, 2].map(|k| {
            let low = self.whole.low[k] + side[k] * cell[k] as f64;
            let room = self.room + ROOM * side[k];
            Range::new(low - room, low + side[k] + room)
        })
    }

    /// Each cell's boxes, but those of whose shapes nothing is there.
    fn lists(&self, mut is_empty: impl FnMut(usize, [Range; 3]) -> bool) -> Vec<Vec<i32>> {
        let [nx, ny, nz] = self.along;
        let mut lists = vec![Vec::new(); nx * ny * nz];
        for (k, of) in self.boxes.iter().enumerate() {
            let [x, y, z] = self.reach(of);
            for layer in z.0..=z.1 {
                for row in y.0..=y.1 {
                    for column in x.0..=x.1 {
                        if !is_empty(k, self.region([column, row, layer])) {
                            lists[column + nx * (row + ny * layer)].push(k as i32);
                        }
                    }
                }
            }
        }
        lists
    }
}

impl Lower<'_> {
    /// The grid in which rays meet shapes at least cost; none where that is no less than to ask
    /// them all, or one of them has no box.
    pub(super) fn grid_of(&mut self, shapes: &[Rc<Shape>], span: Span) -> Found<Option<Grid>> {
        let most = match self.options.ways.instancing {
            Instancing::Cells => MANY,
            Instancing::FewCells => SOME,
            Instancing::Rows | Instancing::Separate => return Ok(None),
        };
        if shapes.len() < FEW {
            return Ok(None);
        }
        let mut boxes = Vec::new();
        for shape in shapes {
            match self.extent_of(shape, 0.0, span)? {
                Some(of) if of.is_finite() => boxes.push(of),
                _ => return Ok(None),
            }
        }
        let all = boxes.iter().copied().reduce(Extent::join);
        let Some(all) = all.map(|all| all.grown(1.0 / 64.0, 0.0)) else {
            return Ok(None);
        };
        let widths = [0, 1, 2].map(|k| all.high[k] - all.low[k]);
        let room = 4.0 * self.options.epsilon * widths.iter().sum::<f64>();
        let mut best: Option<(f64, Cells<'_>)> = None;
        let widest = widths.iter().copied().fold(0.0, f64::max);
        for along in 1..=most.along {
            let along = widths.map(|w| ((w / widest * along as f64).round() as usize).max(1));
            let cells = Cells {
                boxes: &boxes,
                whole: all,
                along,
                room,
            };
            let fits = along.iter().product::<usize>() <= most.cells;
            if !fits || cells.entries() > most.entries * shapes.len() {
                break;
            }
            let cost = cells.cost();
            if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                best = Some((cost, cells));
            }
        }
        let Some((cost, cells)) = best else {
            return Ok(None);
        };
        if cost > shapes.len() as f64 / 2.0 {
            return Ok(None);
        }
        let level = self.level(0.0);
        let formulas: Vec<Option<Formula>> =
            shapes.iter().map(|s| self.outside_of(s, span)).collect();
        let enclosure = |formula: &Option<Formula>| {
            let formula = formula.as_ref()?;
            Some(Enclosure::new(&self.b, formula.markers, formula.root, WORK))
        };
        let mut enclosures: Vec<Option<Enclosure<'_>>> = formulas.iter().map(enclosure).collect();
        let lists = cells.lists(|k, region| match &mut enclosures[k] {
            Some(of) => of.of(region).lo > level && of.left() > 0,
            None => false,
        });
        drop(enclosures);
        let ends = lists.iter().scan(0, |at, list| {
            *at += list.len() as i32;
            Some(*at)
        });
        let last: Vec<i32> = ends.collect();
        let first = std::iter::once(0).chain(last.iter().copied());
        let first: Vec<i32> = first.take(last.len()).collect();
        let flat: Vec<i32> = lists.iter().flatten().copied().collect();
        Ok(Some(Grid {
            whole: all,
            side: cells.side(),
            along: cells.along,
            most: lists.iter().map(Vec::len).max().unwrap_or(0),
            first: self.ints("first", first, span),
            last: self.ints("last", last, span),
            list: self.ints("list", flat, span),
        }))
    }

    fn ints(&mut self, name: &str, values: Vec<i32>, span: Span) -> Rc<Table> {
        let entries = values.into_iter().map(|v| Val::Node(self.int(v, span)));
        let entries: Vec<Val> = entries.collect();
        Rc::new(Table {
            name: name.to_owned(),
            width: entries.len(),
            entries,
        })
    }

    /// A grid as the library's `cells`, with its tables.
    pub(super) fn grid_values(&mut self, grid: &Grid, span: Span) -> [Val; 4] {
        let mut point =
            |of: [f64; 3]| Val::parts(of.map(|v| Val::Node(self.real(v, span))).to_vec());
        let (low, high, side) = (
            point(grid.whole.low),
            point(grid.whole.high),
            point(grid.side),
        );
        let [nx, ny, nz] = grid.along;
        let counts = [nx, ny, nz, grid.most].map(|n| Val::Node(self.int(n as i32, span)));
        let cells = [low, high, side].into_iter().chain(counts).collect();
        [
            Val::parts(cells),
            Val::Table(grid.first.clone()),
            Val::Table(grid.last.clone()),
            Val::Table(grid.list.clone()),
        ]
    }
}
