//! Factors of few values: what is multiplied by one of a few numbers is compared
//! with other numbers instead.
//!
//! A chequered floor is lit by h (0.5 p + 0.3) where p is 0 or 1. That such a shade
//! is below a threshold t is h < t / 0.3 or h < t / 0.8, and these are known before
//! the pixel is: any function of a value that takes few values is a choice between
//! what it is for each of them (Shannon's expansion, as in [`super::split`]), and in each
//! the factor is a constant, which goes over to the side of the comparison that is
//! the same for the whole pass.
//!
//! Over the reals nothing changes. At least one product at a pixel is gone for one
//! product with a constant on the other side, so no more roundings meet in the
//! comparison than before. Fixed point and logarithms keep their comparisons: a
//! threshold may leave their range.
//!
//! The choice copies what stands between the factor and the value that is chosen, so it
//! is for the plan to find out which of the ways pays, if any.

use super::rate::{Rates, rates};
use super::rebuild::rebuild_old;
use crate::flow::build::Builder;
use crate::flow::graph::*;
use crate::range::Ranges;
use crate::source::Span;
use slowlight_routine::{Format, Op, Runtime, Type, Value};
use std::collections::HashMap;

/// How many values a switch may take.
const FEW: usize = 3;

/// How many values may stand between a factor and what is chosen.
const BETWEEN: usize = 32;

/// The graph with a factor's switch asked sooner: in the `which`th of all the ways to do
/// that, the widest choice of each factor first. Nothing where there are not so many.
pub fn factors(graph: &Graph, ranges: &Ranges, runtime: &Runtime, which: usize) -> Option<Graph> {
    let site = Site::new(graph, ranges, runtime);
    let (switch, chosen) = site.ways().nth(which)?;
    let mut done = false;
    let next = rebuild_old(graph, &mut |builder, made, id, span| {
        if id != chosen {
            return None;
        }
        let choice = site.choice(builder, made, switch, chosen, span)?;
        done = true;
        Some(choice)
    });
    done.then_some(next)
}

/// What a value is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Of {
    /// Constants alone.
    Nothing,
    /// Those and one value that takes few values.
    Switch(NodeId),
    More,
}

struct Site<'g> {
    graph: &'g Graph,
    ranges: &'g Ranges,
    rates: Rates,
    of: Vec<Of>,
    /// Whether a constant factor may go over to a comparison's other side.
    moves: bool,
}

impl<'g> Site<'g> {
    fn new(graph: &'g Graph, ranges: &'g Ranges, runtime: &Runtime) -> Site<'g> {
        let mut site = Site {
            graph,
            ranges,
            rates: rates(graph),
            of: Vec::with_capacity(graph.nodes.len()),
            moves: !matches!(runtime.real, Format::Fixed { .. } | Format::Log { .. }),
        };
        for id in graph.ids() {
            let of = site.made_of(id);
            site.of.push(of);
        }
        site
    }

    fn of(&self, id: NodeId) -> Of {
        self.of.get(id.0 as usize).copied().unwrap_or(Of::More)
    }

    fn made_of(&self, id: NodeId) -> Of {
        let node = self.graph.node(id);
        match node {
            Node::Const(_) => return Of::Nothing,
            Node::Apply(..) => {
                let operands = node.operands().map(|a| self.of(a));
                let joined = operands.reduce(|a, b| match (a, b) {
                    (Of::Nothing, one) | (one, Of::Nothing) => one,
                    (a, b) if a == b => a,
                    _ => Of::More,
                });
                if let Some(found @ (Of::Nothing | Of::Switch(_))) = joined {
                    return found;
                }
            }
            _ => {}
        }
        match self.values(id).is_empty() {
            true => Of::More,
            false => Of::Switch(id),
        }
    }

    /// The values that a switch takes, in order; none if it is not one.
    fn values(&self, id: NodeId) -> Vec<Value> {
        if self.rates.is_still(id) {
            return Vec::new();
        }
        match self.graph.node(id) {
            Node::Select { yes, no, .. } if self.graph.ty(id) != Type::Bool => {
                let all = [no, yes].map(|arm| self.graph.constant(arm));
                all.into_iter().collect::<Option<_>>().unwrap_or_default()
            }
            Node::Apply(..) if self.graph.ty(id) == Type::Int => {
                let Some(range) = self.ranges.result.get(id.0 as usize) else {
                    return Vec::new();
                };
                let count = range.hi - range.lo + 1.0;
                match count >= 2.0 && count <= FEW as f64 {
                    true => (range.lo as i32..=range.hi as i32)
                        .map(Value::Int)
                        .collect(),
                    false => Vec::new(),
                }
            }
            _ => Vec::new(),
        }
    }

    /// Every switch with a value that may be chosen by it.
    fn ways(&self) -> impl Iterator<Item = (NodeId, NodeId)> {
        let reached = self.graph.reached();
        let ids = self.graph.ids().filter(move |id| reached[id.0 as usize]);
        ids.filter_map(|id| Some((id, self.factor(id)?)))
            .flat_map(|(product, (switch, factor))| {
                let mut ways = self.chosen(product, factor);
                // A choice between numbers is one already.
                ways.extend((factor != switch).then_some(factor));
                ways.dedup();
                ways.into_iter().map(move |chosen| (switch, chosen))
            })
    }

    /// The factor of few values of a product, or quotient, of something else, and its switch.
    fn factor(&self, product: NodeId) -> Option<(NodeId, NodeId)> {
        let Node::Apply(Op::Mul | Op::Div, [a, b]) = self.graph.node(product) else {
            return None;
        };
        match (self.of(a), self.of(b), self.of(product)) {
            (_, _, Of::Switch(_)) => None,
            (Of::Switch(switch), _, _) => Some((switch, a)),
            (_, Of::Switch(switch), _) => Some((switch, b)),
            _ => None,
        }
    }

    /// What may be chosen where a product of a factor is needed: the first value that is
    /// no real and has all that is made of the product, and the product itself.
    fn chosen(&self, product: NodeId, factor: NodeId) -> Vec<NodeId> {
        let mut above = vec![false; self.graph.nodes.len()];
        above[factor.0 as usize] = true;
        let mut all = Vec::new();
        for id in self.graph.ids().filter(|id| *id > factor) {
            let mut operands = self.graph.node(id).operands();
            if !operands.any(|a| above[a.0 as usize]) {
                continue;
            }
            above[id.0 as usize] = true;
            all.push(id);
            if all.len() > BETWEEN {
                break;
            }
            if self.graph.ty(id) != Type::Real && self.closes(factor, id) {
                return vec![id, product];
            }
        }
        vec![product]
    }

    /// Whether nothing that a pixel needs is made of a value but through another.
    fn closes(&self, value: NodeId, through: NodeId) -> bool {
        let mut seen = vec![false; self.graph.nodes.len()];
        let mut todo: Vec<NodeId> = self.graph.roots().collect();
        while let Some(id) = todo.pop() {
            if id == value {
                return false;
            }
            // What a value is made of stands before it.
            let open = id != through && id > value && !seen[id.0 as usize];
            seen[id.0 as usize] = true;
            if open {
                todo.extend(self.graph.references(id));
            }
        }
        true
    }

    /// A value chosen by a switch.
    fn choice(
        &self,
        builder: &mut Builder,
        made: &[Option<NodeId>],
        switch: NodeId,
        chosen: NodeId,
        span: Span,
    ) -> Option<NodeId> {
        let values = self.values(switch);
        let mut arms = Vec::new();
        for value in &values {
            let mut arm = Arm {
                site: self,
                made,
                switch,
                value: *value,
                done: HashMap::new(),
            };
            arms.push(arm.put(builder, chosen, span)?);
        }
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        if let Node::Select { cond, .. } = self.graph.node(switch) {
            return Some(builder.select(new(cond)?, *arms.get(1)?, *arms.first()?, span));
        }
        let asked = new(switch)?;
        let mut all = values.iter().zip(arms);
        let (low, first) = all.next()?;
        let chosen = all.try_fold((*low, first), |(low, less), (value, arm)| {
            let low = builder.constant(low, span);
            let more = builder.apply(Op::IntLess, &[low, asked], span);
            Some((*value, builder.select(more, arm, less, span)))
        });
        chosen.map(|(_, choice)| choice)
    }
}

/// What values are where a switch has one of its values.
struct Arm<'a, 'g> {
    site: &'a Site<'g>,
    made: &'a [Option<NodeId>],
    switch: NodeId,
    value: Value,
    done: HashMap<NodeId, Option<NodeId>>,
}

/// A product without its constant factors: those together, and the rest unless it is 1.
type Stripped = (f64, Option<NodeId>);

impl Arm<'_, '_> {
    fn new(&self, old: NodeId) -> Option<NodeId> {
        self.made.get(old.0 as usize).copied().flatten()
    }

    /// Whether a value is made otherwise here than anywhere.
    fn depends(&mut self, builder: &mut Builder, id: NodeId, span: Span) -> Option<bool> {
        Some(self.put(builder, id, span)? != self.new(id)?)
    }

    fn put(&mut self, builder: &mut Builder, id: NodeId, span: Span) -> Option<NodeId> {
        if id == self.switch {
            return Some(builder.constant(self.value, span));
        }
        if id < self.switch {
            return self.new(id);
        }
        if let Some(done) = self.done.get(&id) {
            return *done;
        }
        let put = self.made_anew(builder, id, span);
        self.done.insert(id, put);
        put
    }

    fn made_anew(&mut self, builder: &mut Builder, id: NodeId, span: Span) -> Option<NodeId> {
        match self.site.graph.node(id) {
            Node::Select { cond, yes, no } => {
                let cond = self.put(builder, cond, span)?;
                // What is never chosen is not put.
                match builder.value(cond).map(Value::truth) {
                    Some(true) => self.put(builder, yes, span),
                    Some(false) => self.put(builder, no, span),
                    None => {
                        let (yes, no) =
                            (self.put(builder, yes, span)?, self.put(builder, no, span)?);
                        Some(builder.select(cond, yes, no, span))
                    }
                }
            }
            Node::Apply(op, args) => {
                let mut new = Vec::with_capacity(2);
                for arg in &args[..op.arity()] {
                    new.push(self.put(builder, *arg, span)?);
                }
                let compares = matches!(op, Op::Less | Op::LessEqual) && self.site.moves;
                let moved = compares.then(|| self.compared(builder, op, args, span));
                let moved = moved.flatten();
                Some(moved.unwrap_or_else(|| builder.apply(op, &new, span)))
            }
            // A value that asks the switch itself is right in each arm as it is.
            _ => self.new(id),
        }
    }

    /// A comparison of a product with what is the same for the whole pass, the
    /// product's constant factors at the other side.
    fn compared(
        &mut self,
        builder: &mut Builder,
        op: Op,
        [a, b]: [NodeId; 2],
        span: Span,
    ) -> Option<NodeId> {
        let still = [a, b].map(|id| self.site.rates.is_still(id));
        let (product, other, first) = match still {
            [false, true] => (a, b, true),
            [true, false] => (b, a, false),
            _ => return None,
        };
        if !self.depends(builder, product, span)? {
            return None;
        }
        let (factor, rest) = self.stripped(builder, product, span)?;
        let (other, rest) = (self.new(other)?, rest?);
        // A product of 0 is a constant, and what is larger or smaller by far may leave the format.
        if !(1e-3..1e3).contains(&factor.abs()) {
            return None;
        }
        let other = times(builder, other, 1.0 / factor, span);
        Some(match first == (factor > 0.0) {
            true => builder.apply(op, &[rest, other], span),
            false => builder.apply(op, &[other, rest], span),
        })
    }

    fn stripped(&mut self, builder: &mut Builder, id: NodeId, span: Span) -> Option<Stripped> {
        let put = self.put(builder, id, span)?;
        if let Some(value) = builder.value(put) {
            return Some((value.real(), None));
        }
        let node = self.site.graph.node(id);
        if put == self.new(id)? && !matches!(node, Node::Apply(Op::Neg, _)) {
            return Some((1.0, Some(put)));
        }
        match node {
            Node::Apply(Op::Neg, [a, _]) => {
                let (factor, rest) = self.stripped(builder, a, span)?;
                Some((-factor, rest))
            }
            Node::Apply(Op::Mul, [a, b]) => {
                let (left, right) = (
                    self.stripped(builder, a, span)?,
                    self.stripped(builder, b, span)?,
                );
                let rest = match (left.1, right.1) {
                    (Some(a), Some(b)) => Some(builder.apply(Op::Mul, &[a, b], span)),
                    (one, other) => one.or(other),
                };
                Some((left.0 * right.0, rest))
            }
            Node::Apply(Op::Div, [a, b]) => {
                let (left, right) = (
                    self.stripped(builder, a, span)?,
                    self.stripped(builder, b, span)?,
                );
                let rest = match (left.1, right.1) {
                    (a, None) => a,
                    (Some(a), Some(b)) => Some(builder.apply(Op::Div, &[a, b], span)),
                    (None, Some(_)) => return None,
                };
                (right.0 != 0.0).then_some((left.0 / right.0, rest))
            }
            _ => None,
        }
    }
}

/// A value with a constant factor; entries of a table are those of another table.
fn times(builder: &mut Builder, value: NodeId, factor: f64, span: Span) -> NodeId {
    if factor == 1.0 {
        return value;
    }
    if let Node::Lookup { table, column, row } = builder.node(value)
        && let Some(found) = builder.table_of(table).cloned()
    {
        let entries = found.entries.iter().map(|e| e.value().real() * factor);
        let scaled = Table {
            entries: entries.map(|x| Constant::new(Value::Real(x))).collect(),
            ..found
        };
        let scaled = builder.table(scaled);
        return builder.lookup(scaled, column, row, span);
    }
    let factor = builder.constant(Value::Real(factor), span);
    builder.apply(Op::Mul, &[value, factor], span)
}
