//! What values are at pixels spread over the picture, with the params in many places of
//! their ranges.
//!
//! Where a few are far larger than all others, as quotients beside a horizon are, room for
//! these would cost all others their digits: they are cut where that loses less.

use crate::eval::arithmetic::{Arithmetic, Exact};
use crate::eval::run::Run;
use crate::flow::graph::*;
use crate::flow::tree::*;
use slowlight_routine::{Op, Type, Value};
use std::cell::{Cell, RefCell};
use std::collections::HashMap;

/// Rows and columns that are looked at.
const ROWS: u32 = 24;
const COLUMNS: u32 = 31;

/// What values are expected to stay within, of the greatest seen.
const ROOM: f64 = 1.2;

/// By how much a last place counts, as a part of a value, beside a value that is cut.
const DIGITS: f64 = 4.0;

/// Magnitudes are counted by their octaves, the first of which ends at 2^-40.
const OCTAVES: usize = 96;
const FIRST: i32 = -40;

/// How often params are chosen anew.
const CHOICES: u32 = 12;

/// How many statements may run, all choices together.
const PATIENCE: u64 = 18_000_000;

/// Rows are gone through in steps of so many, so that something of every part of the
/// picture is seen where patience ends before its rows do.
const APART: u32 = 7;

/// What was seen of an operation's results.
#[derive(Clone)]
struct Seen {
    most: f64,
    octaves: [u32; OCTAVES],
}

impl Default for Seen {
    fn default() -> Seen {
        let octaves = [0; OCTAVES];
        Seen { most: 0.0, octaves }
    }
}

impl Seen {
    fn see(&mut self, size: f64) {
        self.most = self.most.max(size);
        if size > 0.0 {
            let octave = size.log2().ceil() as i32 - FIRST;
            self.octaves[octave.clamp(0, OCTAVES as i32 - 1) as usize] += 1;
        }
    }

    /// What the results are expected to stay within, in so many bits.
    fn expected(&self, bits: u8) -> Option<f64> {
        let last = self.octaves.iter().rposition(|n| *n > 0)?;
        let end = |octave: usize| f64::from(octave as i32 + FIRST).exp2();
        let lost = |at: usize| {
            let place = end(at) * f64::from(1 - i32::from(bits)).exp2() * DIGITS;
            let each = self.octaves.iter().enumerate();
            let each = each.map(|(octave, n)| {
                let part = if octave > at {
                    1.0
                } else {
                    // In an octave's middle.
                    (place / (end(octave) * 0.75)).min(1.0)
                };
                f64::from(*n) * part
            });
            each.sum::<f64>()
        };
        let best = (0..=last)
            .rev()
            .min_by(|a, b| lost(*a).total_cmp(&lost(*b)))?;
        Some(match best == last {
            true => self.most * ROOM,
            false => end(best),
        })
    }
}

/// What each operation's result is expected to stay within, in so many bits; what choices and
/// loops are given, too. Nothing where none was seen.
pub fn expected(graph: &Graph, tree: &Tree, bits: u8) -> Vec<Option<f64>> {
    let seen = RefCell::new(vec![Seen::default(); graph.nodes.len()]);
    let carried = readers(graph);
    let live = graph.params.iter().any(|p| p.range.is_some());
    let choices = if live { CHOICES } else { 1 };
    for choice in 0..choices {
        let watch = Watch {
            exact: Exact(graph),
            carried: &carried,
            choice,
            seen: &seen,
            ran: Cell::new(0),
        };
        let mut run = Run::new(graph, tree, &watch);
        for row in 0..ROWS {
            for column in 0..COLUMNS {
                let at = |k: u32, of: u32, long: u32| {
                    ((u64::from(k) * 2 + 1) * u64::from(long) / 2 / u64::from(of)) as i32
                };
                let y = at(row * APART % ROWS, ROWS, graph.image.height);
                if watch.ran.get() < PATIENCE / u64::from(choices) {
                    run.pixel(at(column, COLUMNS, graph.image.width), y);
                }
            }
        }
    }
    let seen = seen.into_inner();
    seen.iter().map(|seen| seen.expected(bits)).collect()
}

/// A node that reads each carried value.
pub fn readers(graph: &Graph) -> HashMap<(LoopId, u32), NodeId> {
    let of = |id: NodeId| match graph.node(id) {
        Node::Carried { of, index } => Some(((of, index), id)),
        _ => None,
    };
    graph.ids().filter_map(of).collect()
}

/// The node whose value a place holds.
pub fn held_by(carried: &HashMap<(LoopId, u32), NodeId>, place: Place) -> Option<NodeId> {
    match place {
        Place::Node(id) => Some(id),
        Place::Carried(of, index) | Place::Scratch(of, index) => carried.get(&(of, index)).copied(),
    }
}

/// Computes in `f64` and counts each operation's results.
struct Watch<'g> {
    exact: Exact<'g>,
    /// By whom carried values are read.
    carried: &'g HashMap<(LoopId, u32), NodeId>,
    choice: u32,
    seen: &'g RefCell<Vec<Seen>>,
    ran: Cell<u64>,
}

impl Watch<'_> {
    fn see(&self, id: NodeId, value: Value) {
        if let Value::Real(x) = value
            && let Some(seen) = self.seen.borrow_mut().get_mut(id.0 as usize)
        {
            seen.see(x.abs());
        }
    }

    /// Where in its range a param is: as it is, at either end, in the middle, then spread.
    fn part(&self, param: u32) -> f64 {
        match self.choice {
            1 => 0.0,
            2 => 1.0,
            3 => 0.5,
            // Multiples of the golden ratio's fraction, another for each param.
            n => (f64::from(n * (param + 1)) * 0.618_033_988_749_895).fract(),
        }
    }
}

impl Arithmetic for &Watch<'_> {
    type Value = Value;

    fn constant(&self, value: Value) -> Value {
        self.exact.constant(value)
    }

    fn param(&self, id: ParamId) -> Value {
        let own = self.exact.param(id);
        let found = self.exact.0.params.get(id.0 as usize);
        let Some((param, range)) = found.and_then(|p| Some((p, p.range?))) else {
            return own;
        };
        let part = self.part(id.0);
        let value = range.lo + part * (range.hi - range.lo);
        match param.ty {
            // As the scene has it: a program whose params are edited keeps its points.
            Type::Bool if self.choice == 0 => Value::Bool(param.usual != 0.0),
            Type::Int if self.choice == 0 => Value::Int(param.usual as i32),
            Type::Real if self.choice == 0 => Value::Real(param.usual),
            Type::Bool => Value::Bool(part > 0.5),
            Type::Int => Value::Int(value.round() as i32),
            Type::Real => Value::Real(value),
        }
    }

    fn apply(&self, id: NodeId, op: Op, args: &[Value]) -> Value {
        let made = self.exact.apply(id, op, args);
        self.see(id, made);
        made
    }

    fn copied(&self, place: Place, _: NodeId, value: Value) -> Value {
        if let Some(id) = held_by(self.carried, place) {
            self.see(id, value);
        }
        value
    }

    fn gather(&self, received: Value, sent: Value) -> Value {
        self.exact.gather(received, sent)
    }

    fn truth(&self, value: Value) -> bool {
        self.exact.truth(value)
    }

    fn int(&self, value: Value) -> i32 {
        self.exact.int(value)
    }

    fn step(&self, _: &Statement) {
        self.ran.set(self.ran.get() + 1);
    }
}
