//! Tabulation: functions of one real that is clamped to a short range, or is what a floor leaves,
//! become tables, read at the place where the real stands among 256; sines and cosines, too, by
//! their period ([`periodic`]).
//!
//! A fade between two numbers of noise is a cubic of what is left of a coordinate: two products
//! and four sums that clamp. Formats of few bits hold no more of it than a table of 256 does,
//! and a table takes no product. The nearest place is taken, so that what was rounded to one is
//! looked up there. A function that changes by more than [`ROUGH`] of all its values between two
//! is left. Whether a picture takes that is looked at when its format is chosen.
//!
//! Places in tables are clamped, so that what is clamped before need not be. (The last bits of
//! `x` itself are no place of `x - floor(x)`: 256 `x` may be rounded up where `x` is cut.)

use crate::analysis::range::Ranges;
use crate::analysis::rate::{Dependence, rates};
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use crate::source::Span;
use rustc_hash::FxHashMap;
use slowlight_routine::{Format, Op, Runtime, Type, Value};
use std::cell::Cell;

pub(super) mod periodic;

/// Into how many parts a range is cut; a table has an entry for each end of them.
const PARTS: u32 = 256;

/// How much a function may change within an entry, as a part of the span of its values.
const ROUGH: f64 = 1.0 / 128.0;

/// At how many places about an entry a function is looked at, its own in the middle.
const PLACES: usize = 9;

/// How many operations are looked through for what they are a function of.
const DEEP: usize = 32;

/// How many parts apart a function is looked at first, so that steep ones are left soon.
const COARSE: u32 = 8;

/// How many operations may be worked out for all tables together.
const WORK: u64 = 4_000_000;

/// The name of such a table; a scene's own may have it, too.
pub(super) const NAME: &str = "function";

/// The graph with such tables; nothing where there are none. Where its format has digits for more
/// than they give, only periods are tabulated.
pub fn function_tables(graph: &Graph, ranges: &Ranges, runtime: &Runtime) -> Option<Graph> {
    let site = Site {
        graph,
        ranges,
        runtime,
        left: Cell::new(WORK),
    };
    let all = match is_short(runtime.real) {
        true => site.found(),
        false => FxHashMap::default(),
    };
    let rates = rates(graph);
    let is_angle = |id| periodic::angle(graph, &rates, id).is_some();
    if all.is_empty() && !graph.ids().any(is_angle) {
        return None;
    }
    Some(rebuild_old(graph, &mut |builder, made, id, span| {
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        if let Some((op, angle)) = periodic::angle(graph, &rates, id) {
            return Some(periodic::looked_up(builder, op, new(angle)?, span));
        }
        let found = all.get(&id)?;
        let index = site.index(builder, &new, found, span)?;
        let entries = found.entries.iter().map(|x| Constant::new(Value::Real(*x)));
        let table = builder.table(Table {
            name: NAME.to_owned(),
            width: PARTS + 1,
            height: 1,
            ty: Type::Real,
            entries: entries.collect(),
            seed: Vec::new(),
        });
        let row = builder.constant(Value::Int(0), span);
        Some(builder.lookup(table, index, row, span))
    }))
}

/// Whether a graph has sines or cosines that may be looked up.
pub fn has_periods(graph: &Graph) -> bool {
    let rates = rates(graph);
    graph
        .ids()
        .any(|id| periodic::angle(graph, &rates, id).is_some())
}

/// Whether a loop that ends by a condition reads a table of a period: what changes in steps may
/// end it after other turns than the function does.
pub fn has_periods_in_open_loops(graph: &Graph) -> bool {
    let rates = rates(graph);
    let open = |of: LoopId| {
        let again = graph.loops.get(of.0 as usize).map(|l| l.again);
        again.is_some_and(|again| graph.constant(again).is_none())
    };
    graph.ids().any(|id| {
        let Node::Lookup { table, .. } = graph.node(id) else {
            return false;
        };
        let table = graph.tables.get(table.0 as usize);
        let period = table.is_some_and(|t| t.name == NAME && t.width.is_power_of_two());
        period
            && rates.rate(id).iter().any(|by| match by {
                Dependence::Loop(of) | Dependence::Last(of) => open(*of),
                _ => false,
            })
    })
}

/// Whether a graph reads such tables.
pub fn has_function_tables(graph: &Graph) -> bool {
    graph.tables.iter().any(|table| table.name == NAME)
}

/// Whether a format has so few digits that a table of 256 is as good.
fn is_short(real: Format) -> bool {
    match real {
        Format::Scaled { bits } => bits <= 16,
        Format::Log { .. } => true,
        _ => false,
    }
}

/// A function of a real.
struct Function {
    /// The real that it is a function of, clamped or not.
    of: NodeId,
    /// Between which of its values.
    within: [f64; 2],
    entries: Vec<f64>,
    /// What its operations take.
    cycles: f64,
    /// How many nodes it was made of, itself included.
    through: Vec<NodeId>,
}

struct Site<'g> {
    graph: &'g Graph,
    ranges: &'g Ranges,
    runtime: &'g Runtime,
    /// How many operations may still be worked out.
    left: Cell<u64>,
}

impl Site<'_> {
    /// Which values become tables: the last ones of each chain, but none that a table is made of.
    fn found(&self) -> FxHashMap<NodeId, Function> {
        let mut all: FxHashMap<NodeId, Function> = FxHashMap::default();
        let mut taken = vec![false; self.graph.nodes.len()];
        for id in self.graph.ids().rev() {
            if taken[id.0 as usize] || !self.is_function(id) {
                continue;
            }
            if let Some(found) = self.function(id) {
                found
                    .through
                    .iter()
                    .for_each(|id| taken[id.0 as usize] = true);
                all.insert(id, found);
            }
        }
        all
    }

    /// Whether a value may be looked through: a real made of reals.
    fn is_function(&self, id: NodeId) -> bool {
        matches!(self.graph.node(id), Node::Apply(op, _)
            if op.result() == Type::Real && op.args().iter().all(|ty| *ty == Type::Real))
    }

    /// What a value is a function of where a table pays: of all reals that everything it is made
    /// of goes through, that one from which on most is spared.
    fn function(&self, root: NodeId) -> Option<Function> {
        let mut best: Option<Function> = None;
        let mut open = vec![root];
        let mut through: Vec<NodeId> = Vec::new();
        for _ in 0..DEEP {
            // Operands stand before what is made of them.
            open.sort_unstable();
            open.dedup();
            let last = open.pop()?;
            if open.is_empty() && last != root {
                let found = self.table(root, last, &through);
                let more =
                    |found: &Function| best.as_ref().is_none_or(|best| found.cycles > best.cycles);
                best = found.filter(more).or(best);
            }
            if !self.is_function(last) {
                break;
            }
            through.push(last);
            let operands = self.graph.node(last).operands();
            open.extend(operands.filter(|id| self.graph.constant(*id).is_none()));
            if open.is_empty() {
                break;
            }
        }
        best
    }

    /// A value as a table of another, where the operations between are dearer.
    fn table(&self, root: NodeId, of: NodeId, through: &[NodeId]) -> Option<Function> {
        let bare = self.unclamped(of);
        let range = self.ranges.result.get(of.0 as usize)?;
        let within = match self.is_rest(bare) {
            true => [0.0, 1.0],
            // What nobody clamps is a place or a direction, of which every digit counts.
            false if bare == of => return None,
            false => [range.lo, range.hi],
        };
        let cycles = |op: Op| {
            let routine = self.runtime.usual(op);
            routine.map_or(0.0, |routine| f64::from(routine.cycles))
        };
        let ops = through.iter().filter_map(|id| match self.graph.node(*id) {
            Node::Apply(op, _) => Some(cycles(op)),
            _ => None,
        });
        let cycles_of_all: f64 = ops.sum();
        if cycles_of_all < 2.0 * cycles(Op::Mul) + cycles(Op::Add) {
            return None;
        }
        let wide = within[1] - within[0];
        if !(wide > 1e-3 && wide < 1e3) {
            return None;
        }
        let entries = self.entries(root, of, through, within)?;
        Some(Function {
            of,
            within,
            entries,
            cycles: cycles_of_all,
            through: through.to_vec(),
        })
    }

    /// What stands in the table; nothing where the function is too steep for it.
    fn entries(
        &self,
        root: NodeId,
        of: NodeId,
        through: &[NodeId],
        [low, high]: [f64; 2],
    ) -> Option<Vec<f64>> {
        let part = (high - low) / f64::from(PARTS);
        let value = |at: f64| {
            let at = (low + at * part).clamp(low, high);
            self.value(root, (of, at), through)
        };
        // No steeper on the way than it may be.
        let coarse = (0..=PARTS)
            .step_by(COARSE as usize)
            .map(|k| value(f64::from(k)));
        let coarse: Vec<f64> = coarse.collect::<Option<_>>()?;
        let steps = coarse.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        let steepest = steps.fold(0.0, f64::max);
        let lowest = coarse.iter().copied().fold(f64::INFINITY, f64::min);
        let highest = coarse.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if steepest > f64::from(2 * COARSE) * ROUGH * (highest - lowest) {
            return None;
        }
        let mut all = Vec::new();
        let (mut least, mut most, mut rough) = (f64::INFINITY, f64::NEG_INFINITY, 0.0f64);
        for k in 0..=PARTS {
            let mut entry = [0.0; PLACES];
            for (place, found) in entry.iter_mut().enumerate() {
                let off = place as f64 / (PLACES - 1) as f64 - 0.5;
                *found = value(f64::from(k) + off)?;
            }
            let lo = entry.iter().copied().fold(f64::INFINITY, f64::min);
            let hi = entry.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            (least, most, rough) = (least.min(lo), most.max(hi), rough.max(hi - lo));
            all.push(entry[PLACES / 2]);
        }
        (rough.is_finite() && rough <= ROUGH * (most - least)).then_some(all)
    }

    /// What a value comes to where that which it is a function of is so much.
    fn value(&self, root: NodeId, (of, at): (NodeId, f64), through: &[NodeId]) -> Option<f64> {
        self.left
            .set(self.left.get().checked_sub(through.len() as u64)?);
        let mut known: Vec<(NodeId, f64)> = vec![(of, at)];
        // The last one that was looked through is made first.
        for id in through.iter().rev() {
            let Node::Apply(op, [a, b]) = self.graph.node(*id) else {
                return None;
            };
            let value = |id: NodeId| match self.graph.constant(id) {
                Some(value) => Some(value.real()),
                None => known
                    .iter()
                    .rev()
                    .find(|(of, _)| *of == id)
                    .map(|(_, x)| *x),
            };
            known.push((*id, op.eval_real(value(a)?, value(b)?).real()));
        }
        let (last, found) = *known.last()?;
        (last == root && found.is_finite()).then_some(found)
    }

    /// What is clamped to a value: a place in a table is.
    fn unclamped(&self, mut id: NodeId) -> NodeId {
        while let Node::Apply(op @ (Op::Min | Op::Max), [a, b]) = self.graph.node(id) {
            let end = Some(if op == Op::Min { 1.0 } else { 0.0 });
            id = match [a, b].map(|id| self.graph.constant(id).map(Value::real)) {
                [bound, None] if bound == end => b,
                [None, bound] if bound == end => a,
                _ => return id,
            };
        }
        id
    }

    /// Whether a value is what is left of another above the whole number below.
    fn is_rest(&self, id: NodeId) -> bool {
        let part = |id: NodeId| match self.graph.node(id) {
            Node::Apply(op, args) => Some((op, args)),
            _ => None,
        };
        let Some((Op::Sub, [whole, below])) = part(id) else {
            return false;
        };
        let Some((Op::ToReal, [int, _])) = part(below) else {
            return false;
        };
        part(int).is_some_and(|(op, [of, _])| op == Op::Floor && of == whole)
    }

    /// The place in the table.
    fn index(
        &self,
        b: &mut Builder,
        new: &dyn Fn(NodeId) -> Option<NodeId>,
        found: &Function,
        span: Span,
    ) -> Option<NodeId> {
        let parts = f64::from(PARTS);
        let real = |b: &mut Builder, x: f64| b.constant(Value::Real(x), span);
        let of = match self.is_rest(self.unclamped(found.of)) {
            true => self.unclamped(found.of),
            false => found.of,
        };
        let [low, high] = found.within;
        let by = real(b, parts / (high - low));
        let place = b.apply(Op::Mul, &[new(of)?, by], span);
        let first = real(b, low * parts / (high - low));
        let place = match low == 0.0 {
            true => place,
            false => b.apply(Op::Sub, &[place, first], span),
        };
        Some(b.apply(Op::Round, &[place], span))
    }
}

#[cfg(test)]
mod tests;
