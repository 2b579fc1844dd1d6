//! Inverse of a monotone function: an ink that grows or falls with a shade is found by comparing
//! the shade, not by working the ink out.
//!
//! A dither takes a shade v through steps that are each monotone (a square root,
//! a product with a constant, the addition of the dither's cell, a floor) to one
//! of a few inks. So for every ink there is a number that v must reach, and the
//! ink is a few comparisons: two for four inks. The numbers depend on the cell,
//! so they are kept in tables of the cell's own shape, read at the same place.
//!
//! They are found by bisection over the reals of an `f64`, on the very operations
//! of the scene: each step is monotone in `f64` too, since rounding is, and the
//! comparison gives the ink that the steps would have given, for every `f64` below
//! 1E30 in size.
//! In the machine's format v and the threshold are rounded, and nothing else; of the two
//! neighbours between which an ink changes, the one that formats hold is compared with.
//!
//! A shade that is a choice is compared in either arm, and one that is a loop's
//! result where the loop ends: the machine then needs no more than the arm's own
//! value.

mod invert;
mod sunk;
#[cfg(test)]
mod tests;

use crate::analysis::range::Ranges;
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::{End, Rewrite, rebuild_by};
use crate::source::Span;
use invert::{Chain, Selector, Thresholds};
use slowlight_routine::{Op, Runtime, Type, Value};
use sunk::Copy;

/// How many inks may be told apart by comparisons.
const INKS: i32 = 16;
/// How many values the selector of a threshold may have.
const CELLS: usize = 1024;
/// How many arms of choices the comparisons may be copied into.
const ARMS: u32 = 6;

/// The graph with the ink found by comparisons; nothing where it is not
/// monotone in a shade, or where that costs no less on this machine.
pub fn invert_monotone(graph: &Graph, ranges: &Ranges, runtime: &Runtime) -> Option<Graph> {
    if graph.is_in_order() {
        return None; // The error needs the dither's own steps.
    }
    let chain = Chain::find(graph, ranges, graph.ink)?;
    let inks = ranges.result.get(graph.ink.0 as usize)?;
    let (low, high) = (inks.lo as i32, inks.hi as i32);
    if high <= low || high - low >= INKS || !saves(graph, &chain, high - low, runtime) {
        return None;
    }
    let bounds = chain.thresholds(graph, ranges, low, high)?;
    let compared = |sunk: Vec<(LoopId, u32)>| {
        let mut comparing = Comparing {
            graph,
            chain: &chain,
            bounds: &bounds,
            low,
            sunk,
            done: false,
            failed: false,
        };
        let next = rebuild_by(graph, &mut comparing);
        (comparing.done && !comparing.failed).then_some(next)
    };
    // What selects a threshold may not be there yet where a loop ends, and states' next values
    // may hang on what a loop's results were.
    let sunk = match graph.is_moving() {
        true => Vec::new(),
        false => sunk::results(graph, &chain),
    };
    compared(sunk).or_else(|| compared(Vec::new()))
}

/// Finds the ink by comparisons while a graph is rebuilt.
struct Comparing<'g> {
    graph: &'g Graph,
    chain: &'g Chain,
    bounds: &'g Thresholds,
    low: i32,
    /// The results of loops that become inks.
    sunk: Vec<(LoopId, u32)>,
    done: bool,
    /// Whether one of those could not be compared.
    failed: bool,
}

type Made<'m> = &'m [Option<NodeId>];

impl Comparing<'_> {
    /// The ink of a shade.
    fn ink(&self, b: &mut Builder, made: Made<'_>, shade: NodeId, span: Span) -> Option<NodeId> {
        let mut copy = Copy {
            graph: self.graph,
            made: made.to_vec(),
        };
        let mut compared = Vec::new();
        for entries in &self.bounds.by_ink {
            let same = entries.iter().all(|e| e == &entries[0]);
            compared.push(match self.chain.selector {
                Some(selector) if !same => entry(&mut copy, b, selector, entries, span)?,
                _ => b.constant(Value::Real(*entries.first()?), span),
            });
        }
        let tree = Tree {
            graph: self.graph,
            compared: &compared,
            rising: self.chain.rising,
            strict: self.bounds.strict,
            low: self.low,
            sunk: &self.sunk,
            span,
        };
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        tree.put(b, &new, shade, ARMS)
    }
}

impl Rewrite for Comparing<'_> {
    fn node(
        &mut self,
        b: &mut Builder,
        made: Made<'_>,
        id: NodeId,
        _moved: Node,
        span: Span,
    ) -> Option<NodeId> {
        if id != self.graph.ink {
            return None;
        }
        let ink = self.ink(b, made, self.chain.value, span)?;
        self.done = true;
        Some(ink)
    }

    fn end(&mut self, b: &mut Builder, made: Made<'_>, id: NodeId, end: End) -> Option<NodeId> {
        match end {
            End::Result(of, index) if self.sunk.contains(&(of, index)) => {
                let ink = self.ink(b, made, id, self.graph.span(id));
                self.failed |= ink.is_none();
                ink
            }
            // It is looked at, and gone where it became an ink.
            End::Ink => None,
            End::Output => (!self.sunk.is_empty()).then(|| b.undefined(Type::Real)),
            _ => None,
        }
    }
}

/// Whether comparisons and lookups cost less than the steps.
fn saves(graph: &Graph, chain: &Chain, inks: i32, runtime: &Runtime) -> bool {
    let cost = |op: Op| {
        let found = runtime.usual(op);
        found.map_or(0, |r| r.cycles)
    };
    let steps = chain.steps.iter().filter_map(|id| match graph.node(*id) {
        Node::Apply(op, _) => Some(cost(op)),
        _ => None,
    });
    let turns = 32 - (inks as u32).leading_zeros();
    // Reading an entry costs about as much as comparing it.
    steps.sum::<u32>() > turns * 2 * cost(Op::Less)
}

/// A threshold read from its table.
fn entry(
    copy: &mut Copy<'_>,
    b: &mut Builder,
    selector: Selector,
    entries: &[f64],
    span: Span,
) -> Option<NodeId> {
    let reals = entries.iter().map(|e| Constant::new(Value::Real(*e)));
    let seed = match selector {
        Selector::Entry { of, .. } => {
            let cells = copy.graph.tables.get(of.0 as usize)?.entries.iter();
            let ints = cells.map(|e| match e.value() {
                Value::Int(n) if n.abs() < 1_000_000 => Some(n),
                _ => None,
            });
            ints.collect::<Option<Vec<i32>>>().unwrap_or_default()
        }
        Selector::Int { low, .. } => (low..).take(entries.len()).collect(),
    };
    let table = |width, height| Table {
        name: "threshold".to_owned(),
        width,
        height,
        ty: Type::Real,
        entries: reals.clone().collect(),
        seed: seed.clone(),
    };
    match selector {
        Selector::Entry { of, column, row } => {
            let cells = copy.graph.tables.get(of.0 as usize)?;
            let table = b.table(table(cells.width, cells.height));
            let (column, row) = (copy.of(b, column)?, copy.of(b, row)?);
            Some(b.lookup(table, column, row, span))
        }
        Selector::Int { node, low, .. } => {
            let table = b.table(table(entries.len() as u32, 1));
            let (low, zero) = (
                b.constant(Value::Int(low), span),
                b.constant(Value::Int(0), span),
            );
            let node = copy.of(b, node)?;
            let index = b.apply(Op::IntSub, &[node, low], span);
            Some(b.lookup(table, index, zero, span))
        }
    }
}

/// The comparisons, the middle one first.
struct Tree<'t> {
    graph: &'t Graph,
    compared: &'t [NodeId],
    rising: bool,
    /// Whether a threshold itself is below ([`Thresholds::strict`]).
    strict: bool,
    low: i32,
    /// Results of loops that are inks already.
    sunk: &'t [(LoopId, u32)],
    span: Span,
}

impl Tree<'_> {
    /// The ink of a shade, in the arms of the choice that the shade may be.
    fn put(
        &self,
        b: &mut Builder,
        new: &dyn Fn(NodeId) -> Option<NodeId>,
        shade: NodeId,
        arms: u32,
    ) -> Option<NodeId> {
        match self.graph.node(shade) {
            Node::Select { cond, yes, no } if arms > 1 => {
                let cond = new(cond)?;
                let yes = self.put(b, new, yes, arms / 2)?;
                let no = self.put(b, new, no, arms - arms / 2)?;
                Some(b.select(cond, yes, no, self.span))
            }
            Node::Result { of, index } if self.sunk.contains(&(of, index)) => new(shade),
            _ => Some(self.between(b, new(shade)?, 0, self.compared.len())),
        }
    }

    /// The ink among those from the lowest plus `from` to the lowest plus `to`.
    fn between(&self, b: &mut Builder, shade: NodeId, from: usize, to: usize) -> NodeId {
        if from == to {
            return b.constant(Value::Int(self.low + from as i32), self.span);
        }
        let middle = (from + to) / 2;
        let (less, more) = (
            self.between(b, shade, from, middle),
            self.between(b, shade, middle + 1, to),
        );
        let compared = self.compared[middle];
        let (below, above) = match self.rising {
            true => (less, more),
            false => (more, less),
        };
        // Every machine has a comparison for less, not all have one for no more.
        match self.strict {
            true => {
                let passed = b.apply(Op::Less, &[compared, shade], self.span);
                b.select(passed, above, below, self.span)
            }
            false => {
                let short = b.apply(Op::Less, &[shade, compared], self.span);
                b.select(short, below, above, self.span)
            }
        }
    }
}
