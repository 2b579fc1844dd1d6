//! Walks through maps that no ray leaves: which cells one may look at is found by a flood fill
//! from where it may begin, and these are numbered in one dimension. A step then changes one
//! number by what is the same at every step (strength reduction of a subscript), and nothing is
//! kept inside the map's borders.

use super::value::{Table, Val};
use super::{Found, Lower};
use crate::ir::enclosure::Enclosure;
use crate::ir::graph::NodeId;
use crate::sema::program::{Function, Map};
use crate::sema::ty::Ty;
use crate::source::Span;
use rustc_hash::{FxHashMap, FxHashSet};
use slowlight_routine::Op;
use std::ops::RangeInclusive;
use std::rc::Rc;

/// Cells of which it is asked whether a walk comes there, at most.
const CELLS: i64 = 65_536;

/// How many nodes are evaluated to know where a walk may begin, at most.
const WORK: u64 = 20_000;

/// Numbers up to here fit into a byte.
const BYTE: i32 = 256;

/// What the numbers have that no walk looks at: a wall.
const NOBODYS: i32 = 1;

/// Cells of a map and of its surroundings, numbered.
struct Numbered {
    /// Columns and rows in which a walk may begin.
    begins: [RangeInclusive<i32>; 2],
    /// By how much the numbers of cells below each other differ; those beside each other by 1.
    stride: i32,
    /// What number column 0 of row 0 has.
    zero: i32,
    /// What of a number is left: all of it, or a byte.
    mask: i32,
    /// By number.
    cells: Vec<i32>,
    /// How many steps a walk takes at most.
    steps: i32,
}

/// A map's cell; beyond its borders that at the border.
fn cell(map: &Map, [column, row]: [i32; 2]) -> i32 {
    let within = |at: i32, size: usize| at.clamp(0, size as i32 - 1) as usize;
    let at = within(row, map.height) * map.width + within(column, map.width);
    map.cells.get(at).copied().unwrap_or(NOBODYS)
}

/// The cells that walks look at which begin there, and what they are; none where one leaves the
/// map.
fn looked_at(map: &Map, begins: &[RangeInclusive<i32>; 2]) -> Option<FxHashMap<[i32; 2], i32>> {
    let [columns, rows] = begins.clone();
    let size = |k: usize| i64::from(begins[k].end() - begins[k].start()) + 1;
    if size(0) * size(1) > CELLS {
        return None;
    }
    let inside = |[column, row]: [i32; 2]| {
        (0..map.width as i32).contains(&column) && (0..map.height as i32).contains(&row)
    };
    let mut found = FxHashMap::default();
    let mut entered: FxHashSet<[i32; 2]> = FxHashSet::default();
    let mut todo: Vec<[i32; 2]> = rows
        .flat_map(|row| columns.clone().map(move |column| [column, row]))
        .collect();
    entered.extend(&todo);
    while let Some([x, y]) = todo.pop() {
        for beside in [[x - 1, y], [x + 1, y], [x, y - 1], [x, y + 1]] {
            let held = cell(map, beside);
            found.insert(beside, held);
            if held == 0 && entered.insert(beside) {
                if !inside(beside) {
                    return None;
                }
                todo.push(beside);
            }
        }
    }
    Some(found)
}

impl Numbered {
    fn of(map: &Map, begins: [RangeInclusive<i32>; 2]) -> Option<Numbered> {
        let found = looked_at(map, &begins)?;
        let span = |k: usize| {
            let all = || found.keys().map(|at| at[k]);
            Some((all().min()?, all().max()?))
        };
        let ((left, right), (top, bottom)) = (span(0)?, span(1)?);
        // Rows share numbers where what is looked at in both is the same, as walls at their ends.
        let numbered = |stride: i32, mask: i32| {
            let mut numbers: FxHashMap<i32, i32> = FxHashMap::default();
            let mut all = found.iter();
            let number = |[x, y]: [i32; 2]| (x + stride * y) & mask;
            all.all(|(at, held)| *numbers.entry(number(*at)).or_insert(*held) == *held)
                .then_some(numbers)
        };
        let strides = 1..=right - left + 1;
        let by = |mask: i32| {
            let mut all = strides.clone();
            all.find_map(|stride| numbered(stride, mask).map(|numbers| (stride, numbers)))
        };
        let ends =
            |numbers: &FxHashMap<i32, i32>| Some((*numbers.keys().min()?, *numbers.keys().max()?));
        let (mut stride, mut numbers) = by(-1)?;
        let (mut least, mut most) = ends(&numbers)?;
        let mut mask = -1;
        if (BYTE..2 * BYTE).contains(&(most - least))
            && let Some(found) = by(BYTE - 1)
        {
            (stride, numbers) = found;
            (least, most, mask) = (0, BYTE - 1, BYTE - 1);
        }
        let held = |number: i32| numbers.get(&number).copied().unwrap_or(NOBODYS);
        Some(Numbered {
            begins,
            stride,
            zero: -least,
            mask,
            cells: (least..=most).map(held).collect(),
            steps: right - left + bottom - top + 1,
        })
    }
}

impl<'a> Lower<'a> {
    /// What the library's `walk` comes to, where no ray leaves the map.
    pub(super) fn walk_inside(
        &mut self,
        function: &'a Function,
        args: &[Val],
        span: Span,
    ) -> Found<Option<Val>> {
        let [map, from, dir, most] = args else {
            return Ok(None);
        };
        if !function.library || function.name != "walk" || self.options.ways.unbounded {
            return Ok(None);
        }
        let Val::Map(id) = self.force(map.clone())? else {
            return Ok(None);
        };
        let Some(map) = self.program.maps.get(id.0) else {
            return Err(self.confused(span));
        };
        let place = self.vector(from.clone(), 2, span)?;
        let mut cells = Vec::new();
        for at in &place {
            cells.push(self.apply(Op::Floor, &[*at], span)?);
        }
        let (Some(columns), Some(rows)) =
            (self.begins(cells[0], span), self.begins(cells[1], span))
        else {
            return Ok(None);
        };
        let Some(numbered) = Numbered::of(map, [columns, rows]) else {
            return Ok(None);
        };
        let mut parts = Vec::new();
        for (at, cell) in place.into_iter().zip(&cells) {
            let cell = self.apply(Op::ToReal, &[*cell], span)?;
            parts.push(Val::Node(self.apply(Op::Sub, &[at, cell], span)?));
        }
        for (cell, begins) in cells.iter_mut().zip(&numbered.begins) {
            *cell = self.kept_within(*cell, begins, span)?;
        }
        let stride = self.int(numbered.stride, span);
        let zero = self.int(numbered.zero, span);
        let below = self.apply(Op::IntMul, &[stride, cells[1]], span)?;
        let beside = self.apply(Op::IntAdd, &[below, cells[0]], span)?;
        let number = self.apply(Op::IntAdd, &[beside, zero], span)?;
        let mask = self.int(numbered.mask, span);
        let number = self.apply(Op::BitAnd, &[number, mask], span)?;
        let most = self.node(most.clone(), &Ty::Int, span)?;
        let steps = self.int(numbered.steps, span);
        let most = self.apply(Op::IntMin, &[most, steps], span)?;
        let entries = numbered.cells.iter();
        let table = Table {
            name: map.name.clone(),
            width: numbered.cells.len(),
            entries: entries.map(|c| Val::Node(self.int(*c, span))).collect(),
        };
        let args = vec![
            Val::Table(Rc::new(table)),
            Val::Node(number),
            Val::Node(stride),
            Val::Node(mask),
            Val::parts(parts),
            dir.clone(),
            Val::Node(most),
        ];
        let first = Ty::Table(Box::new(Ty::Int));
        self.library("walk_inside", first, args, span).map(Some)
    }

    /// Where a column or row lies.
    fn begins(&mut self, of: NodeId, span: Span) -> Option<RangeInclusive<i32>> {
        let nothing = self.real(0.0, span);
        let mut enclosure = Enclosure::new(&self.b, [nothing; 3], of, WORK);
        let range = enclosure.of([slowlight_routine::Range::point(0.0); 3]);
        let (lo, hi) = (range.lo, range.hi);
        let few = enclosure.left() > 0 && hi - lo < CELLS as f64;
        (few && lo.abs().max(hi.abs()) < CELLS as f64).then_some(lo as i32..=hi as i32)
    }

    /// An int that is known to lie there, which formats' roundings are not to change.
    fn kept_within(
        &mut self,
        of: NodeId,
        range: &RangeInclusive<i32>,
        span: Span,
    ) -> Found<NodeId> {
        let [least, most] = [*range.start(), *range.end()].map(|end| self.int(end, span));
        let below = self.apply(Op::IntMin, &[of, most], span)?;
        self.apply(Op::IntMax, &[below, least], span)
    }
}
