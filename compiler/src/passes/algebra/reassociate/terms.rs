//! Linear forms: what a sum is made of, terms that are each a product of factors over divisors.

use super::Sums;
use crate::ir::graph::*;
use slowlight_routine::{Op, Type, Value};

/// How many terms a sum may have, and how many factors a term.
const TERMS: usize = 8;
const FACTORS: usize = 6;

/// A part of a sum: a node, or its negative.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Term {
    pub minus: bool,
    pub id: NodeId,
}

/// The terms of a sum in the order in which they are added: those that pixels have,
/// and those that are the same for a run of columns or longer.
#[derive(Clone, Debug, Default)]
pub(super) struct Terms {
    pub high: Vec<Term>,
    pub low: Vec<Term>,
}

/// A term's factors and divisors, constants' signs taken out.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Product {
    pub factors: Vec<Factor>,
    pub divisors: Vec<NodeId>,
    pub minus: bool,
}

/// A value, or a constant's size.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) enum Factor {
    Value(NodeId),
    Size(u64),
}

impl Sums<'_> {
    /// The terms of a sum; nothing where it is none, or has too many.
    pub(super) fn terms(&self, id: NodeId) -> Option<Terms> {
        let mut all = Terms::default();
        let top = Term { minus: false, id };
        self.descend(top, true, &mut all);
        (all.high.len() + all.low.len() <= TERMS && !all.high.is_empty()).then_some(all)
    }

    fn descend(&self, term: Term, open: bool, all: &mut Terms) {
        let Term { minus, id } = term;
        if self.low(id) {
            return all.low.push(term);
        }
        let deep = all.high.len() + all.low.len() >= TERMS;
        match self.graph.node(id) {
            Node::Apply(Op::Neg, [a, _]) if !deep => {
                let turned = Term {
                    minus: !minus,
                    id: a,
                };
                self.descend(turned, open, all);
            }
            Node::Apply(op @ (Op::Add | Op::Sub), [a, b]) if open && a != b && !deep => {
                for (part, other, minus) in [(a, b, minus), (b, a, minus != (op == Op::Sub))] {
                    // What something else needs is taken apart where that costs nothing.
                    let open = self.alone(part) || self.low(other) && self.shifted(part);
                    self.descend(Term { minus, id: part }, open, all);
                }
            }
            _ => all.high.push(term),
        }
    }

    /// Whether nothing but one sum needs a value.
    pub(super) fn alone(&self, id: NodeId) -> bool {
        self.users[id.0 as usize].len() == 1
    }

    /// Whether a value is something and what is the same for a run of columns.
    fn shifted(&self, id: NodeId) -> bool {
        match self.graph.node(id) {
            Node::Apply(Op::Neg, [a, _]) => self.shifted(a),
            Node::Apply(Op::Add | Op::Sub, [a, b]) => self.low(a) != self.low(b),
            _ => false,
        }
    }

    /// A value as a product.
    pub(super) fn product(&self, id: NodeId) -> Product {
        let mut all = Product::default();
        self.factors(id, true, &mut all);
        all
    }

    /// Whether something divides a value or a factor of it.
    fn is_over(&self, id: NodeId, deep: usize) -> bool {
        match self.graph.node(id) {
            Node::Apply(Op::Div, _) => true,
            Node::Apply(Op::Neg, [a, _]) if deep > 0 => self.is_over(a, deep - 1),
            Node::Apply(Op::Mul, [a, b]) if deep > 0 => {
                [a, b].iter().any(|id| self.is_over(*id, deep - 1))
            }
            _ => false,
        }
    }

    /// A product by itself is taken apart; one in it that nothing divides stays as it is.
    fn factors(&self, id: NodeId, whole: bool, all: &mut Product) {
        let more = all.factors.len() + all.divisors.len() < FACTORS;
        let more = more && (whole || self.is_over(id, FACTORS));
        match self.graph.node(id) {
            Node::Const(c) if c.value().ty() == Type::Real => {
                let value = c.value().real();
                all.minus ^= value < 0.0;
                all.factors.push(Factor::Size(value.abs().to_bits()));
            }
            Node::Apply(Op::Neg, [a, _]) => {
                all.minus = !all.minus;
                self.factors(a, whole, all);
            }
            Node::Apply(Op::Mul, [a, b]) if more => {
                self.factors(a, false, all);
                self.factors(b, false, all);
            }
            Node::Apply(Op::Div, [a, b]) if more => {
                self.factors(a, whole, all);
                all.divisors.push(b);
            }
            _ => all.factors.push(Factor::Value(id)),
        }
    }

    /// Whether a product is the same for a run of columns.
    pub(super) fn is_low(&self, product: &Product) -> bool {
        let factors = product.factors.iter().all(|f| match f {
            Factor::Value(id) => self.low(*id),
            Factor::Size(_) => true,
        });
        factors && product.divisors.iter().all(|id| self.low(*id))
    }

    /// Whether a value was rounded when it was made, so that sums that need it are
    /// off by as much in any order.
    pub(super) fn rounded(&self, id: NodeId) -> bool {
        match self.graph.node(id) {
            Node::Apply(Op::Neg | Op::Abs, [a, _]) => self.rounded(a),
            Node::Apply(op, _) => op.result() == Type::Real && op != Op::ToReal,
            _ => false,
        }
    }
}

impl Factor {
    /// A constant's value.
    pub(super) fn size(self) -> Option<Value> {
        match self {
            Factor::Size(bits) => Some(Value::Real(f64::from_bits(bits))),
            Factor::Value(_) => None,
        }
    }
}
