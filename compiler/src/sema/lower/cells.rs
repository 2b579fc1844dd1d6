//! Cells of space, or of a picture of it, and which of a group's boxes have something in which.

use super::Lower;
use super::value::{Lists, Table, Val};
use super::ways::Instancing;
use crate::ir::graph::NodeId;
use crate::source::Span;
use slowlight_routine::Range;
use std::rc::Rc;

/// Cells along a side, cells in all, and entries of all cells' lists for each shape, at most.
pub(super) struct Most {
    along: usize,
    cells: usize,
    entries: usize,
}

impl Most {
    pub(super) const fn new(along: usize, cells: usize, entries: usize) -> Most {
        Most {
            along,
            cells,
            entries,
        }
    }

    /// Of limits for many cells, fewer and few those that are asked for; none where there are to
    /// be no cells.
    pub(super) fn asked(all: [Most; 3], instancing: Instancing) -> Option<Most> {
        let [many, fewer, few] = all;
        match instancing {
            Instancing::Cells | Instancing::Seen => Some(many),
            Instancing::FewerCells => Some(fewer),
            Instancing::FewCells => Some(few),
            Instancing::Rows | Instancing::Separate => None,
        }
    }
}

/// By what part of a cell boxes are made larger, for the roundings of rays' ways.
const ROOM: f64 = 1.0 / 32.0;

/// Boxes of `N` dimensions in so many cells along each.
pub(super) struct Cells<'e, const N: usize> {
    boxes: &'e [[Range; N]],
    whole: [Range; N],
    pub(super) along: [usize; N],
    /// By how much boxes are made larger whatever the cells.
    room: [f64; N],
}

impl<'e, const N: usize> Cells<'e, N> {
    /// Boxes in so many cells.
    pub(super) fn new(
        boxes: &'e [[Range; N]],
        whole: [Range; N],
        room: [f64; N],
        along: [usize; N],
    ) -> Self {
        Cells {
            boxes,
            whole,
            along,
            room,
        }
    }

    /// The cells that cost least, and what they do: as near to cubes as may be.
    pub(super) fn cheapest(
        boxes: &'e [[Range; N]],
        whole: [Range; N],
        room: [f64; N],
        most: &Most,
        cost: impl Fn(&Self) -> f64,
    ) -> Option<(f64, Self)> {
        let widths = whole.map(width);
        let widest = widths.iter().copied().fold(0.0, f64::max);
        let mut best: Option<(f64, Self)> = None;
        for along in 1..=most.along {
            let along = widths.map(|w| ((w / widest * along as f64).round() as usize).max(1));
            let cells = Cells::new(boxes, whole, room, along);
            if cells.count() > most.cells || cells.entries() > most.entries * boxes.len() {
                break;
            }
            let cost = cost(&cells);
            if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                best = Some((cost, cells));
            }
        }
        best
    }

    /// How many cells there are.
    pub(super) fn count(&self) -> usize {
        self.along.iter().product()
    }

    /// A cell's widths.
    pub(super) fn side(&self) -> [f64; N] {
        std::array::from_fn(|k| width(self.whole[k]) / self.along[k] as f64)
    }

    /// The first and last cell along each side that a box has something in.
    fn reach(&self, of: &[Range; N]) -> [(usize, usize); N] {
        let side = self.side();
        std::array::from_fn(|k| {
            let room = self.room[k] + ROOM * side[k];
            let cell = |at: f64| {
                let at = ((at - self.whole[k].lo) / side[k]).floor();
                at.clamp(0.0, self.along[k] as f64 - 1.0) as usize
            };
            (cell(of[k].lo - room), cell(of[k].hi + room))
        })
    }

    /// How many boxes all cells hold together.
    pub(super) fn entries(&self) -> usize {
        let of = |reach: [(usize, usize); N]| -> usize {
            reach.iter().map(|(low, high)| high - low + 1).product()
        };
        self.boxes.iter().map(|b| of(self.reach(b))).sum()
    }

    /// How many boxes are in the cell of a place that is in some box: the mean over them all.
    pub(super) fn crowd(&self) -> f64 {
        let lists = self.lists(|_, _| false);
        let counts = lists.iter().map(|list| list.len() as f64);
        let (all, squares) =
            counts.fold((0.0, 0.0), |(all, squares), n| (all + n, squares + n * n));
        squares / all
    }

    /// What is in a cell, or near by.
    fn region(&self, cell: [usize; N]) -> [Range; N] {
        let side = self.side();
        std::array::from_fn(|k| {
            let low = self.whole[k].lo + side[k] * cell[k] as f64;
            let room = self.room[k] + ROOM * side[k];
            Range::new(low - room, low + side[k] + room)
        })
    }

    /// Each cell's boxes, but those of whose shapes nothing is there. The first side's cells are
    /// next to each other.
    pub(super) fn lists(
        &self,
        mut is_empty: impl FnMut(usize, [Range; N]) -> bool,
    ) -> Vec<Vec<i32>> {
        let mut lists = vec![Vec::new(); self.count()];
        for (k, of) in self.boxes.iter().enumerate() {
            let reach = self.reach(of);
            let mut cell = reach.map(|(low, _)| low);
            loop {
                let sides = cell.iter().zip(&self.along).rev();
                let at = sides.fold(0, |at, (cell, along)| at * along + cell);
                if !is_empty(k, self.region(cell)) {
                    lists[at].push(k as i32);
                }
                // The next one, as an odometer counts.
                let Some(side) = (0..N).find(|&side| cell[side] < reach[side].1) else {
                    break;
                };
                cell[side] += 1;
                for before in 0..side {
                    cell[before] = reach[before].0;
                }
            }
        }
        lists
    }
}

fn width(of: Range) -> f64 {
    of.hi - of.lo
}

impl Lower<'_> {
    /// Lists as tables: all entries one after the other, and where each list begins.
    pub(super) fn lists_of(&mut self, lists: &[Vec<i32>], span: Span) -> Lists {
        let ends = lists.iter().scan(0, |at, list| {
            *at += list.len() as i32;
            Some(*at)
        });
        let first = std::iter::once(0).chain(ends).collect();
        let mut flat: Vec<i32> = lists.iter().flatten().copied().collect();
        if flat.is_empty() {
            // A table has an entry.
            flat.push(0);
        }
        Lists {
            most: lists.iter().map(Vec::len).max().unwrap_or(0),
            first: self.ints("first", first, span),
            list: self.ints("list", flat, span),
        }
    }

    fn ints(&mut self, name: &str, values: Vec<i32>, span: Span) -> Rc<Table> {
        let entries = values.into_iter().map(|v| self.int(v, span));
        column(name, entries.collect())
    }

    pub(super) fn reals(&mut self, name: &str, values: &[f64], span: Span) -> Rc<Table> {
        let entries = values.iter().map(|&v| self.real(v, span));
        column(name, entries.collect())
    }
}

/// A table of one row.
fn column(name: &str, entries: Vec<NodeId>) -> Rc<Table> {
    Rc::new(Table {
        name: name.to_owned(),
        width: entries.len(),
        entries: entries.into_iter().map(Val::Node).collect(),
    })
}
