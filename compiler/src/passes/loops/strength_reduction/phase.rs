//! Phase accumulators: the parity of floor(a x + b) as the sign of a ramp.
//!
//! Which of two tiles a pixel shows is the parity of a floor, and along a row
//! what is floored is often affine in the column x: a x + b with a and b the same
//! for the row. Let a whole turn be two tiles and 2^32 units; then the phase is an
//! int that grows by round(2^31 a) modulo 2^32 from column to column, and the
//! floor is odd where it is negative (direct digital synthesis: Tierney, Rader
//! and Gold, A digital frequency synthesizer, 1971). Ints that are added to the
//! floor add their parity to b, and each floor of a sum gets a ramp of its own,
//! their signs taken together.
//!
//! a and b are brought to -1..1 first, by subtracting an even whole number, which
//! is exact; then they are scaled by 2^31 and rounded. So the phase at column x
//! is off by (x + 1)/2 units for that, 2^-32 of a tile each, besides what the
//! roundings of a and b make of it; a x + b in the machine's reals is off by some
//! units in the last place of its terms. The pass estimates both at pixels spread
//! over the picture, as algebra does ([`crate::passes::algebra::polynomial`]), and leaves the
//! floor alone where, in some row, the phase's worst is more than [`MOST`] times the
//! reals' worst. A phase of slow tiles is refused so: reals near 0 are finer.

use super::Put;
use super::lines::{Find, Line, Lines, Numbers};
use crate::analysis::range::Ranges;
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::algebra::polynomial::rounding_samples::{Follow, Sample, samples};
use crate::passes::loops::strip_mine::passes;
use crate::passes::rewrite::rebuild::rebuild_old;
use crate::source::Span;
use rustc_hash::FxHashMap;
use slowlight_routine::{Op, Runtime, Type, Value};

/// By how much the phase may be further off than the reals: six bits.
const MOST: f64 = 64.0;

/// How many floors a sum may have.
const FLOORS: usize = 3;

/// Units of a phase in a tile.
const TILE: f64 = 2_147_483_648.0;

/// Whole numbers within this are exact.
const WHOLE: f64 = i32::MAX as f64;

/// What a parity is of.
#[derive(Default)]
struct Terms {
    /// What is floored, affine in the column.
    floors: Vec<NodeId>,
    /// Ints that are affine in the column.
    moving: Vec<NodeId>,
    /// Ints that are the same for the row.
    fixed: Vec<NodeId>,
}

/// Parities that could be the signs of ramps.
pub fn parities(graph: &Graph, ranges: &Ranges, runtime: &Runtime) -> Vec<NodeId> {
    let find = Find::of(graph, ranges);
    let reached = graph.reached();
    let samples = samples(graph);
    let site = |id: &NodeId| {
        let terms = find.terms(*id);
        terms.is_some_and(|terms| find.is_near(&terms, &samples, runtime))
    };
    let ids = graph.ids().filter(|id| reached[id.0 as usize]);
    ids.filter(site).collect()
}

/// The graph with ramps at some of those.
pub fn phases(graph: &Graph, ranges: &Ranges, at: &[NodeId]) -> Option<Graph> {
    let find = Find::of(graph, ranges);
    // For each parity, whether it is odd.
    let mut odd: FxHashMap<NodeId, NodeId> = FxHashMap::default();
    let mut all = true;
    let made = rebuild_old(graph, &mut |builder, made, id, span| {
        if let Some(found) = compared(graph, builder, &odd, id, span) {
            return Some(found);
        }
        if !at.contains(&id) {
            return None;
        }
        let mut write = Write {
            find: &find,
            builder,
            made,
            span,
        };
        let found = find.terms(id).and_then(|terms| write.odd(&terms));
        all &= found.is_some();
        let found = found?;
        odd.insert(id, found);
        let [yes, no] = [1, 0].map(|n| builder.constant(Value::Int(n), span));
        Some(builder.select(found, yes, no, span))
    });
    all.then_some(made)
}

/// A comparison of a parity with a constant is the bool itself, or its opposite.
fn compared(
    graph: &Graph,
    builder: &mut Builder,
    odd: &FxHashMap<NodeId, NodeId>,
    id: NodeId,
    span: Span,
) -> Option<NodeId> {
    let Node::Apply(op, args) = graph.node(id) else {
        return None;
    };
    if op.result() != Type::Bool || op.arity() != 2 {
        return None;
    }
    let of = args.into_iter().find(|arg| odd.contains_key(arg))?;
    let outcome = |parity: i32| {
        let value = |arg: NodeId| match arg == of {
            true => Some(Value::Int(parity)),
            false => graph.constant(arg),
        };
        Some(op.eval(&[value(args[0])?, value(args[1])?]).truth())
    };
    let (even, uneven) = (outcome(0)?, outcome(1)?);
    let [even, uneven] = [even, uneven].map(|b| builder.constant(Value::Bool(b), span));
    let cond = *odd.get(&of)?;
    Some(match builder.value(uneven).map(Value::truth) {
        _ if even == uneven => even,
        Some(true) => cond,
        _ => builder.apply(Op::Not, &[cond], span),
    })
}

impl Find<'_> {
    fn is_exact(&self, id: NodeId) -> bool {
        let exact = self.ranges.exact.get(id.0 as usize);
        exact.is_some_and(|range| range.within(-WHOLE, WHOLE))
    }

    fn terms(&self, id: NodeId) -> Option<Terms> {
        let graph = self.graph;
        let Node::Apply(op, [sum, by]) = graph.node(id) else {
            return None;
        };
        match (op, graph.constant(by)?) {
            (Op::IntMod, Value::Int(2)) | (Op::BitAnd, Value::Int(1)) => {}
            _ => return None,
        }
        let mut terms = Terms::default();
        self.collect(sum, &mut terms, 0)?;
        let lines = terms.floors.iter().all(|id| self.is_line(*id, 0));
        let some = (1..=FLOORS).contains(&terms.floors.len());
        (lines && some).then_some(terms)
    }

    /// Modulo 2 it does not matter what is added and what is subtracted.
    fn collect(&self, id: NodeId, terms: &mut Terms, deep: u32) -> Option<()> {
        if deep > 20 {
            return None;
        }
        match (self.degrees.at(id), self.graph.node(id)) {
            (Some(0), _) => terms.fixed.push(id),
            (Some(1), _) => terms.moving.push(id),
            (_, Node::Apply(Op::IntAdd | Op::IntSub, [a, b])) if self.is_exact(id) => {
                self.collect(a, terms, deep + 1)?;
                self.collect(b, terms, deep + 1)?;
            }
            (_, Node::Apply(Op::IntNeg, [a, _])) if self.is_exact(id) => {
                self.collect(a, terms, deep + 1)?;
            }
            (_, Node::Apply(Op::Floor, [a, _])) if self.is_exact(id) => terms.floors.push(a),
            _ => return None,
        }
        Some(())
    }

    /// Whether the phase loses little that the reals do not lose too.
    fn is_near(&self, terms: &Terms, samples: &[Sample], runtime: &Runtime) -> bool {
        // A unit of a phase in units of the reals' last place.
        let unit = 0.5 / TILE / runtime.real.epsilon();
        let tables = |t: TableId| self.graph.tables.get(t.0 as usize);
        // By row, params and floor: the worst of the reals and of the phase.
        let mut worst: FxHashMap<(Vec<u64>, NodeId), (f64, f64)> = FxHashMap::default();
        for sample in samples {
            let follow = Follow::new(self.graph, &tables, sample);
            let mut numbers = Numbers { find: self, follow };
            for &floor in &terms.floors {
                let Some(reals) = numbers.follow.value(floor, 0) else {
                    return false;
                };
                let Some((slope, start)) = self.line(&mut numbers, floor) else {
                    return false;
                };
                let turned = slope.map_or(0.0, |slope| slope.off);
                let phase = start.off + turned * sample.x + (sample.x + 1.0) * unit;
                let values = sample.params.iter().chain([&sample.y]);
                let row = values.map(|value| value.to_bits()).collect();
                let most = worst.entry((row, floor)).or_insert((2.0, 0.0));
                *most = (most.0.max(reals.off), most.1.max(phase));
            }
        }
        let near = |(reals, phase): &(f64, f64)| *phase <= MOST * reals;
        !worst.is_empty() && worst.values().all(near)
    }
}

/// Lines in the graph that is made.
struct Write<'w, 'g> {
    find: &'w Find<'g>,
    builder: &'w mut Builder,
    made: &'w [Option<NodeId>],
    span: Span,
}

impl Lines for Write<'_, '_> {
    type Value = NodeId;

    fn row(&mut self, id: NodeId) -> Option<NodeId> {
        self.made.get(id.0 as usize).copied().flatten()
    }

    fn whole(&mut self, id: NodeId) -> Option<Line<NodeId>> {
        let mut put = Put {
            graph: self.find.graph,
            ranges: self.find.ranges,
            known: &self.find.degrees,
            stride: passes(self.find.graph),
            builder: self.builder,
            made: self.made,
            span: self.span,
        };
        let parts = put.coefficients(id)?;
        let [start, slope] = parts.as_slice() else {
            return None;
        };
        let [start, slope] = [start.0, slope.0].map(|part| self.one(Op::ToReal, part));
        Some((Some(slope), start))
    }

    fn apply(&mut self, op: Op, a: NodeId, b: NodeId) -> NodeId {
        self.builder.apply(op, &[a, b][..op.arity()], self.span)
    }
}

impl Write<'_, '_> {
    fn one(&mut self, op: Op, a: NodeId) -> NodeId {
        self.builder.apply(op, &[a], self.span)
    }

    fn real(&mut self, x: f64) -> NodeId {
        self.builder.constant(Value::Real(x), self.span)
    }

    /// Whether a parity is odd.
    fn odd(&mut self, terms: &Terms) -> Option<NodeId> {
        let mut odd: Option<NodeId> = None;
        for (k, &floor) in terms.floors.iter().enumerate() {
            let (slope, start) = self.find.line(self, floor)?;
            let mut line = (slope, self.centred(start));
            if k == 0 {
                line = self.with_ints(line, terms)?;
            }
            let negative = self.negative(line);
            odd = Some(match odd {
                Some(before) => {
                    let not = self.one(Op::Not, negative);
                    self.builder.select(before, not, negative, self.span)
                }
                None => negative,
            });
        }
        odd
    }

    /// A line with ints added to it, modulo 2.
    fn with_ints(&mut self, line: Line<NodeId>, terms: &Terms) -> Option<Line<NodeId>> {
        let (mut slope, mut start) = line;
        let two = self.builder.constant(Value::Int(2), self.span);
        let mut parities = Vec::new();
        for &id in &terms.fixed {
            let made = self.row(id)?;
            parities.push(self.apply(Op::IntMod, made, two));
        }
        for &id in &terms.moving {
            let (by, from) = self.whole(id)?;
            if let Some(by) = by {
                slope = Some(match slope {
                    Some(slope) => self.apply(Op::Add, slope, by),
                    None => by,
                });
            }
            let from = self.centred(from);
            start = self.apply(Op::Add, start, from);
        }
        let some = !parities.is_empty() || !terms.moving.is_empty();
        for parity in parities {
            let parity = self.one(Op::ToReal, parity);
            start = self.apply(Op::Add, start, parity);
        }
        Some((slope, if some { self.centred(start) } else { start }))
    }

    /// Whether the phase of a line is negative.
    fn negative(&mut self, (slope, start): Line<NodeId>) -> NodeId {
        let first = self.scaled(start);
        let phase = match slope {
            Some(slope) => {
                let slope = self.centred(slope);
                let step = self.scaled(slope);
                self.builder
                    .ramp(first, step, passes(self.find.graph), self.span)
            }
            None => first,
        };
        let zero = self.builder.constant(Value::Int(0), self.span);
        self.apply(Op::IntLess, phase, zero)
    }

    /// x - 2 floor((x + 1)/2), from -1 to 1: exact but for where the floor is on
    /// its border.
    fn centred(&mut self, x: NodeId) -> NodeId {
        let half = self.real(0.5);
        let turns = self.apply(Op::Mul, x, half);
        let turns = self.apply(Op::Add, turns, half);
        let turns = self.one(Op::Floor, turns);
        let turns = self.one(Op::ToReal, turns);
        let whole = self.apply(Op::Add, turns, turns);
        self.apply(Op::Sub, x, whole)
    }

    /// What lies from -1 to 1 in units of a phase; the ends saturate.
    fn scaled(&mut self, x: NodeId) -> NodeId {
        let (tile, half) = (self.real(TILE), self.real(0.5));
        let units = self.apply(Op::Mul, x, tile);
        let units = self.apply(Op::Add, units, half);
        self.one(Op::Floor, units)
    }
}
