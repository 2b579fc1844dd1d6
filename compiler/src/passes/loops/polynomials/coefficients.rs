//! The coefficients of a loop's polynomials, and Horner's rule with them.

use super::Loops;
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::simplify::unit_vectors::are_parts_of_unit;
use crate::source::Span;
use rustc_hash::FxHashMap;
use slowlight_routine::{Op, Value};

/// A polynomial's coefficients in the new graph, as far as there are any.
#[derive(Clone, Default)]
pub(super) struct Coefficients {
    low: Option<NodeId>,
    linear: Option<NodeId>,
    /// Half of what else the linear term has: squares have twice a product.
    half: Option<NodeId>,
    square: Option<NodeId>,
    /// Whose squares the whole is a sum of, if it is, by their coefficients.
    squares: Option<Vec<Line>>,
    /// What that sum lacks.
    beside: Option<NodeId>,
}

/// A polynomial of the first degree.
#[derive(Clone, Copy)]
struct Line {
    low: Option<NodeId>,
    linear: NodeId,
}

pub(super) struct Build<'b, 'g> {
    pub loops: &'b Loops<'g>,
    pub builder: &'b mut Builder,
    pub made: &'b [Option<NodeId>],
    pub known: &'b mut FxHashMap<NodeId, Coefficients>,
    pub span: Span,
}

impl Build<'_, '_> {
    fn apply(&mut self, op: Op, args: &[NodeId]) -> NodeId {
        self.builder.apply(op, args, self.span)
    }

    fn sum(&mut self, op: Op, a: Option<NodeId>, b: Option<NodeId>) -> Option<NodeId> {
        match (a, b, op) {
            (Some(a), Some(b), _) => Some(self.apply(op, &[a, b])),
            (None, Some(b), Op::Sub) => Some(self.apply(Op::Neg, &[b])),
            (a, b, _) => a.or(b),
        }
    }

    fn product(&mut self, a: NodeId, b: NodeId) -> NodeId {
        let is_one = |id| self.builder.value(id) == Some(Value::Real(1.0));
        match (is_one(a), is_one(b)) {
            (true, _) => b,
            (_, true) => a,
            _ => self.apply(Op::Mul, &[a, b]),
        }
    }

    fn both(&mut self, a: Option<NodeId>, b: Option<NodeId>) -> Option<NodeId> {
        Some(self.product(a?, b?))
    }

    /// What something is done to each coefficient.
    fn each(
        &mut self,
        of: Coefficients,
        to: &mut dyn FnMut(&mut Self, NodeId) -> NodeId,
    ) -> Coefficients {
        let parts = [of.low, of.linear, of.half, of.square];
        let [low, linear, half, square] = parts.map(|part| part.map(|part| to(self, part)));
        Coefficients {
            low,
            linear,
            half,
            square,
            ..Coefficients::default()
        }
    }

    /// An old value's coefficients.
    pub fn coefficients(&mut self, id: NodeId) -> Option<Coefficients> {
        if let Some(known) = self.known.get(&id) {
            return Some(known.clone());
        }
        let found = self.find(id)?;
        self.known.insert(id, found.clone());
        Some(found)
    }

    fn find(&mut self, id: NodeId) -> Option<Coefficients> {
        let home = self.loops.home(id)?;
        let Node::Apply(op, [a, b]) = self.loops.graph.node(id) else {
            return None;
        };
        let x = self.operand(home, a)?;
        if op == Op::Neg {
            return Some(self.each(x, &mut |build, part| build.apply(Op::Neg, &[part])));
        }
        let y = self.operand(home, b)?;
        let still = |of: NodeId| self.loops.operand(home, of).degree == 0;
        Some(match op {
            Op::Add | Op::Sub => {
                let own = |of: &Coefficients| match of.squares {
                    Some(_) => of.beside,
                    None => of.low,
                };
                let (squares, beside) = match (op, &x.squares, &y.squares) {
                    (Op::Add, Some(a), Some(b)) => (
                        Some([a.as_slice(), b].concat()),
                        self.sum(op, x.beside, y.beside),
                    ),
                    (_, of, None) if y.square.is_none() && y.linear.is_none() => {
                        (of.clone(), self.sum(op, own(&x), y.low))
                    }
                    (Op::Add, None, of) if x.square.is_none() && x.linear.is_none() => {
                        (of.clone(), self.sum(op, x.low, own(&y)))
                    }
                    _ => (None, None),
                };
                Coefficients {
                    low: self.sum(op, x.low, y.low),
                    linear: self.sum(op, x.linear, y.linear),
                    half: self.sum(op, x.half, y.half),
                    square: self.sum(op, x.square, y.square),
                    squares,
                    beside,
                }
            }
            Op::Mul if a == b => Coefficients {
                low: self.both(x.low, x.low),
                linear: None,
                half: self.both(x.low, x.linear),
                square: self.both(x.linear, x.linear),
                squares: x.linear.map(|linear| vec![Line { low: x.low, linear }]),
                beside: None,
            },
            Op::Mul if still(a) => {
                let by = x.low?;
                self.each(y, &mut |build, part| build.product(by, part))
            }
            Op::Mul if still(b) => {
                let by = y.low?;
                self.each(x, &mut |build, part| build.product(part, by))
            }
            Op::Mul => {
                let one = self.both(x.low, y.linear);
                let other = self.both(x.linear, y.low);
                Coefficients {
                    low: self.both(x.low, y.low),
                    linear: self.sum(Op::Add, one, other),
                    half: None,
                    square: self.both(x.linear, y.linear),
                    ..Coefficients::default()
                }
            }
            _ => {
                let by = y.low?;
                self.each(x, &mut |build, part| build.apply(Op::Div, &[part, by]))
            }
        })
    }

    fn operand(&mut self, home: LoopId, id: NodeId) -> Option<Coefficients> {
        let polynomial = self.loops.operand(home, id);
        let mut plain = Coefficients::default();
        if polynomial.atom == Some(id) {
            plain.linear = Some(self.builder.constant(Value::Real(1.0), self.span));
        } else if polynomial.degree == 0 {
            plain.low = Some(self.made.get(id.0 as usize).copied().flatten()?);
        } else {
            return self.coefficients(id);
        }
        Some(plain)
    }

    /// The polynomial at its atom.
    pub fn horner(&mut self, of: Coefficients, atom: NodeId) -> Option<NodeId> {
        let t = self.made.get(atom.0 as usize).copied().flatten();
        let twice = self.sum(Op::Add, of.half, of.half);
        let linear = self.sum(Op::Add, of.linear, twice);
        let is_unit = |parts: &Vec<Line>| {
            let slopes: Vec<NodeId> = parts.iter().map(|part| part.linear).collect();
            are_parts_of_unit(&|id| self.builder.node(id), &slopes)
        };
        let first = match of.square {
            Some(_) if of.squares.as_ref().is_some_and(is_unit) => t,
            square => self.both(t, square),
        };
        let slope = self.sum(Op::Add, first, linear);
        let first = self.both(t, slope);
        self.sum(Op::Add, first, of.low)
    }

    /// A sum of squares along a direction of length 1 at its atom, from the point on the line
    /// that is nearest to where all of them are 0.
    pub fn completed_square(&mut self, of: Coefficients, atom: NodeId) -> Option<NodeId> {
        let t = self.made.get(atom.0 as usize).copied().flatten();
        let lines = of.squares?;
        let mut along = None;
        for line in &lines {
            let part = self.both(line.low, Some(line.linear));
            along = self.sum(Op::Add, along, part);
        }
        let mut across = None;
        for line in &lines {
            let way = self.both(along, Some(line.linear));
            let part = self.sum(Op::Sub, line.low, way);
            let square = self.both(part, part);
            across = self.sum(Op::Add, across, square);
        }
        let from = self.sum(Op::Add, t, along);
        let square = self.both(from, from);
        let sum = self.sum(Op::Add, square, across);
        self.sum(Op::Add, sum, of.beside)
    }
}
