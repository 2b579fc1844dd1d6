//! Operations in one arm of a choice: what is known there, and what that makes of them.

use crate::analysis::range::Ranges;
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::simplify::fold::folded;
use crate::source::Span;
use slowlight_routine::{Op, Type, Value};
use std::collections::BTreeSet;

/// One arm.
pub(super) struct Arm {
    /// Values of the old graph that are not 0 in this arm.
    nonzero: BTreeSet<NodeId>,
}

impl Arm {
    /// That where a condition holds, or does not.
    pub fn new(graph: &Graph, ranges: &Ranges, cond: NodeId, holds: bool) -> Arm {
        let by_range = |id: &NodeId| {
            let range = ranges.result.get(id.0 as usize);
            let apart = range.is_some_and(|range| range.lo > 0.0 || range.hi < 0.0);
            apart && graph.ty(*id) == Type::Real
        };
        let mut nonzero: BTreeSet<NodeId> = graph.ids().filter(by_range).collect();
        let known = implied(graph, cond, holds).into_iter();
        nonzero.extend(known.filter_map(|(id, holds)| not_zero(graph, id, holds)));
        Arm { nonzero }
    }

    /// An operation, and whether it is none here: what it gives is there without it.
    pub fn put(
        &self,
        (builder, made): (&mut Builder, &[Option<NodeId>]),
        (op, args): (Op, &[NodeId]),
        span: Span,
    ) -> (NodeId, bool) {
        let nonzero = |id: NodeId| {
            let is = |old: &NodeId| made.get(old.0 as usize).copied().flatten() == Some(id);
            self.nonzero.iter().any(is)
        };
        let cancelled = match (op, args) {
            (Op::Mul, &[a, b]) => {
                product(builder, (a, b), &nonzero).or_else(|| product(builder, (b, a), &nonzero))
            }
            (Op::Div, &[a, b]) => quotient(builder, (a, b), &nonzero, span),
            _ => None,
        };
        let put = cancelled.or_else(|| {
            let first = args.first().copied()?;
            let second = args.get(1).copied().unwrap_or(first);
            folded(builder, op, first, second, span)
        });
        let put = put.unwrap_or_else(|| builder.apply(op, args, span));
        let negative = match builder.node(put) {
            Node::Apply(Op::Neg, [a, _]) => op != Op::Neg && args.contains(&a),
            _ => false,
        };
        let known = builder.value(put).is_some() || cancelled == Some(put);
        (put, known || negative || args.contains(&put))
    }
}

/// What a product with a quotient is that its factor is cancelled from.
fn product(
    builder: &Builder,
    (factor, quotient): (NodeId, NodeId),
    nonzero: &dyn Fn(NodeId) -> bool,
) -> Option<NodeId> {
    match builder.node(quotient) {
        Node::Apply(Op::Div, [over, by]) if by == factor && nonzero(by) => Some(over),
        _ => None,
    }
}

/// What a quotient is of a product by its factor, or of a number by a quotient of it.
fn quotient(
    builder: &mut Builder,
    (over, by): (NodeId, NodeId),
    nonzero: &dyn Fn(NodeId) -> bool,
    span: Span,
) -> Option<NodeId> {
    if !nonzero(by) {
        return None;
    }
    let (bare, minus) = match builder.node(over) {
        Node::Apply(Op::Neg, [a, _]) => (a, true),
        _ => (over, false),
    };
    let (rest, minus) = match (builder.node(bare), builder.node(by)) {
        (Node::Apply(Op::Mul, [a, k]), _) if k == by => (a, minus),
        (Node::Apply(Op::Mul, [k, a]), _) if k == by => (a, minus),
        (_, Node::Apply(Op::Div, [c, d])) if nonzero(d) => {
            match (builder.value(over), builder.value(c)) {
                (Some(Value::Real(x)), Some(Value::Real(c))) if x == c => (d, false),
                (Some(Value::Real(x)), Some(Value::Real(c))) if x == -c => (d, true),
                _ => return None,
            }
        }
        _ => return None,
    };
    Some(match minus {
        true => builder.apply(Op::Neg, &[rest], span),
        false => rest,
    })
}

/// The real that is not 0 where a bool holds, or does not.
fn not_zero(graph: &Graph, id: NodeId, holds: bool) -> Option<NodeId> {
    let value = |id: NodeId| match graph.constant(id) {
        Some(Value::Real(value)) => Some(value),
        _ => None,
    };
    let Node::Apply(op, [a, b]) = graph.node(id) else {
        return None;
    };
    match (op, holds, value(a), value(b)) {
        (Op::Equal, false, _, Some(0.0)) => Some(a),
        (Op::Equal, false, Some(0.0), _) => Some(b),
        (Op::Less, true, Some(least), _) if least >= 0.0 => Some(b),
        (Op::Less, true, _, Some(most)) if most <= 0.0 => Some(a),
        _ => None,
    }
}

/// The bools that are known where another holds, or does not, and what they are there.
fn implied(graph: &Graph, id: NodeId, holds: bool) -> Vec<(NodeId, bool)> {
    let (mut all, mut todo) = (Vec::new(), vec![(id, holds)]);
    while let Some((id, holds)) = todo.pop() {
        all.push((id, holds));
        let other = |id: NodeId| graph.constant(id) == Some(Value::Bool(!holds));
        match graph.node(id) {
            Node::Apply(Op::Not, [a, _]) => todo.push((a, !holds)),
            // An arm that is not what the choice is was not taken.
            Node::Select { cond, yes, no } if other(yes) => {
                todo.extend([(cond, false), (no, holds)]);
            }
            Node::Select { cond, yes, no } if other(no) => {
                todo.extend([(cond, true), (yes, holds)]);
            }
            _ => {}
        }
    }
    all
}
