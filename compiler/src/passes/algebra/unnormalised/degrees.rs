//! Degrees of homogeneity: which power of the length each value is held at.

use super::{Degree, Pass};
use crate::ir::graph::*;
use slowlight_routine::{Op, Type};

/// Degrees stay within this; what would leave it is brought to 0.
const DEGREES: i32 = 6;

/// A value in so many products may be a scalar that vectors are multiplied by.
const VECTOR: u32 = 3;

impl Pass<'_> {
    /// Finds every value's degree.
    pub(super) fn learn(&mut self) {
        self.degrees.clear();
        for id in self.graph.ids() {
            let degree = self.degree(id);
            self.degrees.push(degree);
        }
    }

    /// Counts the products of values that are both of a degree.
    pub(super) fn count(&mut self) {
        let reached = self.graph.reached();
        for id in self.graph.ids().filter(|id| reached[id.0 as usize]) {
            if let Node::Apply(Op::Mul, [a, b]) = self.graph.node(id)
                && self.even(a, b)
            {
                self.products[a.0 as usize] += 1;
                self.products[b.0 as usize] += 1;
            }
        }
    }

    /// Whether two different values are both of a degree, and their product of
    /// an even one.
    fn even(&self, a: NodeId, b: NodeId) -> bool {
        let of = |id| self.of(id).unwrap_or(0);
        a != b && of(a) != 0 && of(b) != 0 && (of(a) + of(b)) % 2 == 0
    }

    /// The degree at which a value comes cheapest, those before it known.
    fn degree(&self, id: NodeId) -> Degree {
        if self.graph.ty(id) != Type::Real {
            return Some(0);
        }
        if id == self.length {
            return Some(1);
        }
        let found = match self.graph.node(id) {
            Node::Const(c) if c.value().real() == 0.0 => return None,
            Node::Apply(op, [a, b]) => match op {
                Op::Mul if self.scalar(a, b).is_some() => 0,
                Op::Mul => self.of(a)? + self.of(b)?,
                Op::Div => self.of(a)? - self.of(b).unwrap_or(0),
                Op::Neg | Op::Abs => self.of(a)?,
                Op::Sqrt => self.of(a)?.div_euclid(2),
                Op::Add | Op::Sub | Op::Min | Op::Max => self.together(a, b)?,
                _ => 0,
            },
            Node::Select { yes, no, .. } => self.together(yes, no)?,
            Node::Carried { of, index } | Node::Last { of, index } => self.start(of, index),
            Node::Result { of, index } => self.result(of, index)?,
            _ => 0,
        };
        Some(if found.abs() > DEGREES { 0 } else { found })
    }

    /// The degree of what two values come together in.
    pub(super) fn together(&self, a: NodeId, b: NodeId) -> Degree {
        match (self.of(a), self.of(b)) {
            (None, other) | (other, None) => other,
            (Some(x), Some(y)) if x == y => Some(x),
            // A root is brought to any degree without a root more.
            (Some(x), Some(y)) if (x - y) % 2 != 0 && self.pliant(a) != self.pliant(b) => {
                Some(if self.pliant(a) { y } else { x })
            }
            (Some(0), _) | (_, Some(0)) => Some(0),
            (Some(x), Some(y)) => Some(x.max(y)),
        }
    }

    /// The factor of a product that is worth bringing to another degree, so that
    /// the product is of degree 0, and the other one: what is multiplied by a vector.
    pub(super) fn scalar(&self, a: NodeId, b: NodeId) -> Option<(NodeId, NodeId)> {
        if !self.even(a, b) {
            return None;
        }
        let products = |id: NodeId| self.products[id.0 as usize];
        let rank = |id: NodeId| (products(id), id);
        let (scalar, other) = match rank(a) > rank(b) {
            true => (a, b),
            false => (b, a),
        };
        (products(scalar) >= VECTOR).then_some((scalar, other))
    }

    fn pliant(&self, id: NodeId) -> bool {
        match self.graph.node(id) {
            Node::Apply(Op::Sqrt, _) => true,
            Node::Apply(Op::Neg, [a, _]) => self.pliant(a),
            _ => false,
        }
    }

    pub(super) fn start(&self, of: LoopId, index: u32) -> i32 {
        let init = self.graph.loops.get(of.0 as usize);
        let init = init.and_then(|l| l.init.get(index as usize));
        init.and_then(|id| self.of(*id)).unwrap_or(0)
    }

    pub(super) fn result(&self, of: LoopId, index: u32) -> Degree {
        let turns = self.graph.loops.get(of.0 as usize)?;
        let at = index as usize;
        self.together(*turns.done.get(at)?, *turns.otherwise.get(at)?)
    }
}
