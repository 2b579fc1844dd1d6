//! Error bounds: how far a machine's values may be from the native ones.
//!
//! The statements are run once with, for every value, an interval that holds
//! the exact value and a [`form::Form`] that holds the machine's error, over a
//! tile of the picture and a box of params. Routines say how far each rounding
//! may be off ([`slowlight_routine::Error`]); `rules` says what an operation
//! does to the errors of its arguments. What comes out is a proof, under one
//! assumption: that no branch flips, that is, that every comparison and every
//! `floor` gives the machine what it gives natively. Where that cannot be
//! proved, the place is listed ([`Bounds::undecided`]).
//!
//! The smaller the tile, the sharper the bound: a tile of one pixel takes one
//! way through the program. A box of params that is wide is taken in parts, the worst in
//! smaller ones ([`bound_within`]). Loops are walked turn by turn; a value of one that
//! goes on for more turns than a tile is worth has no bound.

mod form;
mod pointed;
mod rules;
mod subdivision;
mod walk;

use crate::ir::graph::{NodeId, ParamId};
use crate::plan::Plan;
use form::Form;
use slowlight_routine::Range;
use std::collections::BTreeSet;
pub use subdivision::{Keep, Proved, bound_within};

/// A part of the picture, and a box of params.
#[derive(Clone, Debug, PartialEq)]
pub struct Tile {
    /// First and last column.
    pub columns: (u32, u32),
    /// First and last row.
    pub rows: (u32, u32),
    /// What each scalar of each param may be, natively, and by how much the
    /// machine's may differ from it; in the graph's order.
    pub params: Vec<(Range, f64)>,
}

impl Tile {
    /// One part of the picture, the params at their values.
    pub fn of(plan: &Plan, columns: (u32, u32), rows: (u32, u32)) -> Tile {
        let runtime = plan.runtime;
        let params = plan.graph.params.iter().zip(&plan.params);
        let params = params.zip(0..).map(|((param, planned), k)| {
            let made = (runtime.decode)(planned.bits, plan.param_format(ParamId(k))).real();
            (Range::point(param.value), (made - param.value).abs())
        });
        Tile {
            columns,
            rows,
            params: params.collect(),
        }
    }
}

/// What is proved of one value over a tile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    /// What the native value stays within.
    pub exact: Range,
    /// How far the machine's may be from it; infinite where nothing is proved.
    pub error: f64,
}

/// What is proved over a tile.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bounds {
    /// By node; `None` where the tile does not compute it.
    pub values: Vec<Option<Bound>>,
    /// Comparisons and steps that may give the machine another answer.
    pub undecided: BTreeSet<NodeId>,
    /// How many roundings were followed.
    pub operations: u32,
    /// How many statements were walked.
    pub walked: u64,
}

impl Bounds {
    /// What is proved of a node.
    pub fn of(&self, id: NodeId) -> Option<Bound> {
        self.values.get(id.0 as usize).copied().flatten()
    }
}

/// What is proved of a plan's values over a tile.
pub fn bounds(plan: &Plan, tile: &Tile) -> Bounds {
    walk::walk(plan, tile)
}

/// A value as the walk knows it.
#[derive(Clone, Debug, PartialEq)]
struct Value {
    /// What the exact value lies within.
    range: Range,
    /// The machine's value less the exact one.
    error: Form,
}

impl Value {
    fn exact(range: Range) -> Value {
        Value {
            range,
            error: Form::EXACT,
        }
    }

    /// What the machine's value lies within.
    fn machine(&self) -> Range {
        let off = self.error.bound();
        if off == 0.0 {
            return self.range;
        }
        Range::new(self.range.lo - off, self.range.hi + off)
    }

    /// What holds the exact value and the machine's.
    fn hull(&self) -> Range {
        self.range.join(self.machine())
    }

    fn join(&self, other: &Value) -> Value {
        Value {
            range: self.range.join(other.range),
            error: self.error.hull(&other.error),
        }
    }
}

#[cfg(test)]
mod tests;
