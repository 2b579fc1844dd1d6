//! One specialised version: what a value is where a factor's switch has one of its values.

use super::{Site, Way};
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::source::Span;
use rustc_hash::FxHashMap;
use slowlight_routine::{Op, Value};

/// What values are where a switch has one of its values.
pub struct Arm<'a, 'g> {
    site: &'a Site<'g>,
    made: &'a [Option<NodeId>],
    /// The switch, and what is made of it.
    done: FxHashMap<NodeId, NodeId>,
}

/// A product without its constant factors: those together, and the rest unless it is 1.
type Stripped = (f64, Option<NodeId>);

impl<'a, 'g> Arm<'a, 'g> {
    pub fn new(
        site: &'a Site<'g>,
        made: &'a [Option<NodeId>],
        switch: NodeId,
        value: NodeId,
    ) -> Self {
        Arm {
            site,
            made,
            done: FxHashMap::from_iter([(switch, value)]),
        }
    }

    /// An old value, made with all that it is made of the switch.
    pub fn value(&mut self, builder: &mut Builder, way: Way, span: Span) -> Option<NodeId> {
        // What a value is made of stands before it.
        for id in (way.switch.0 + 1..=way.chosen.0).map(NodeId) {
            let mut operands = self.site.graph.node(id).operands();
            if operands.any(|a| self.done.contains_key(&a))
                && let Some(made) = self.made_anew(builder, id, span)
            {
                self.done.insert(id, made);
            }
        }
        self.here(way.chosen)
    }

    /// What stands for an old value elsewhere.
    fn old(&self, id: NodeId) -> Option<NodeId> {
        self.made.get(id.0 as usize).copied().flatten()
    }

    /// What stands for an old value here.
    fn here(&self, id: NodeId) -> Option<NodeId> {
        self.done.get(&id).copied().or_else(|| self.old(id))
    }

    /// A value made of the switch; another value that asks the switch itself is right
    /// in each arm as it is.
    fn made_anew(&self, builder: &mut Builder, id: NodeId, span: Span) -> Option<NodeId> {
        match self.site.graph.node(id) {
            Node::Select { cond, yes, no } => {
                let [cond, yes, no] = [cond, yes, no].map(|id| self.here(id));
                Some(builder.select(cond?, yes?, no?, span))
            }
            Node::Apply(op, args) => {
                let compares = matches!(op, Op::Less | Op::LessEqual) && self.site.moves;
                let moved = compares.then(|| self.compared(builder, op, args, span));
                if let Some(moved) = moved.flatten() {
                    return Some(moved);
                }
                let [a, b] = args.map(|arg| self.here(arg));
                Some(builder.apply(op, &[a?, b?][..op.arity()], span))
            }
            _ => None,
        }
    }

    /// A comparison of a product with what is the same for the whole pass, the
    /// product's constant factors at the other side.
    fn compared(
        &self,
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
        if !self.done.contains_key(&product) {
            return None;
        }
        let (factor, rest) = self.stripped(builder, product, span)?;
        let (other, rest) = (self.old(other)?, rest?);
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

    fn stripped(&self, builder: &mut Builder, id: NodeId, span: Span) -> Option<Stripped> {
        let put = self.here(id)?;
        if let Some(value) = builder.value(put) {
            return Some((value.real(), None));
        }
        let node = self.site.graph.node(id);
        if !self.done.contains_key(&id) && !matches!(node, Node::Apply(Op::Neg, _)) {
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

/// A value with a constant factor; the entries of a table are those of another, which is
/// read as quickly as the first.
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
