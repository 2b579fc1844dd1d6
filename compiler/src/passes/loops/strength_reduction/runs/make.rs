//! Forward differences: polynomials as ints that are stepped along runs.

use super::find::{Find, Whole};
use super::{Part, Put};
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::loops::strip_mine::passes;
use crate::source::Span;
use slowlight_routine::{Op, Range, Type, Value};

/// How many polynomials a choice may be between.
const CHOICES: usize = 4;

/// A value as an int that is a polynomial, and something real beside it.
pub struct Split {
    rest: Option<NodeId>,
    pub whole: Whole,
    /// The int a column before a run's first.
    first: NodeId,
}

/// Works out polynomials in a new graph.
pub struct Make<'m> {
    find: &'m Find<'m>,
    put: Put<'m>,
}

impl<'m> Make<'m> {
    pub fn new(
        find: &'m Find<'m>,
        builder: &'m mut Builder,
        made: &'m [Option<NodeId>],
        span: Span,
    ) -> Make<'m> {
        let put = Put {
            graph: find.graph,
            ranges: find.ranges,
            known: &find.plain,
            stride: 1,
            builder,
            made,
            span,
        };
        Make { find, put }
    }

    fn apply(&mut self, op: Op, args: &[NodeId]) -> NodeId {
        self.put.builder.apply(op, args, self.put.span)
    }

    fn made(&self, id: NodeId) -> Option<NodeId> {
        self.put.made.get(id.0 as usize).copied().flatten()
    }

    /// What stands for a value that is stepped.
    pub fn stepped(&mut self, id: NodeId, known: &mut Vec<(Whole, NodeId)>) -> Option<NodeId> {
        let split = self.split(id)?;
        let before = known.iter().find(|(whole, _)| *whole == split.whole);
        let int = match before {
            Some((_, int)) => *int,
            None => {
                let int = self.steps(&split)?;
                known.push((split.whole, int));
                int
            }
        };
        if self.find.graph.ty(id) == Type::Int {
            return Some(int);
        }
        let real = self.apply(Op::ToReal, &[int]);
        match split.rest {
            Some(rest) => {
                let rest = self.made(rest)?;
                Some(self.apply(Op::Add, &[rest, real]))
            }
            None => Some(real),
        }
    }

    /// An int that is stepped, by its difference, which may be stepped, too.
    fn steps(&mut self, split: &Split) -> Option<NodeId> {
        let span = self.put.span;
        let stride = self.put.whole(passes(self.find.graph) as i32);
        let one = |parts: &[Part], k: usize, put: &mut Put<'_>| match parts.get(k) {
            Some(part) => *part,
            None => put.whole(0),
        };
        let step = match split.whole.degree() {
            0 => return None,
            1 => self.each(&split.whole, &mut |put, parts| {
                let by = one(parts, 1, put);
                put.both(Op::IntMul, by, stride)
            })?,
            _ => {
                // c2 x² + c1 x grows by (c2 (2 x - stride) + c1) stride to column x.
                let column = self.before();
                let first = self.each(&split.whole, &mut |put, parts| {
                    let twice = put.both(Op::IntAdd, column, column)?;
                    let middle = put.both(Op::IntSub, twice, stride)?;
                    let (by, square) = (one(parts, 1, put), one(parts, 2, put));
                    let slope = put.both(Op::IntMul, square, middle)?;
                    let slope = put.both(Op::IntAdd, slope, by)?;
                    put.both(Op::IntMul, slope, stride)
                })?;
                let twice = self.put.both(Op::IntAdd, stride, stride)?;
                let square = self.put.both(Op::IntMul, twice, stride)?;
                let step = self.each(&split.whole, &mut |put, parts| {
                    let by = one(parts, 2, put);
                    put.both(Op::IntMul, by, square)
                })?;
                (self.put.builder.stepped(first.0, step.0, span), first.1)
            }
        };
        Some(self.put.builder.stepped(split.first, step.0, span))
    }

    /// The column before a run's first.
    fn before(&mut self) -> Part {
        let stride = passes(self.find.graph);
        let run = self.put.builder.axis(Axis::Run, self.put.span);
        let by = self.put.whole(stride as i32).0;
        let (lo, hi) = (-f64::from(stride), f64::from(self.find.graph.image.width));
        (self.apply(Op::IntSub, &[run, by]), Range::new(lo, hi))
    }

    /// What follows from the polynomials, chosen as they are.
    fn each(
        &mut self,
        whole: &Whole,
        of: &mut dyn FnMut(&mut Put<'_>, &[Part]) -> Option<Part>,
    ) -> Option<Part> {
        match whole {
            Whole::Polynomial(parts) => of(&mut self.put, parts),
            Whole::Choice(cond, ways) => {
                let (yes, no) = (self.each(&ways[0], of)?, self.each(&ways[1], of)?);
                let either = self.put.builder.select(*cond, yes.0, no.0, self.put.span);
                Some((either, yes.1.join(no.1)))
            }
        }
    }

    /// A value's int, what it is beside, and what it begins with.
    pub fn split(&mut self, id: NodeId) -> Option<Split> {
        let graph = self.find.graph;
        if graph.ty(id) == Type::Int {
            let whole = self.whole(id)?;
            let first = self.at_beginning(id)?;
            let rest = None;
            return (whole.choices() <= CHOICES).then_some(Split { rest, whole, first });
        }
        if self.find.reals[id.0 as usize].is_none() {
            let zero = self.put.whole(0);
            return Some(Split {
                rest: Some(id),
                whole: Whole::Polynomial(vec![zero]),
                first: zero.0,
            });
        }
        match graph.node(id) {
            Node::Apply(Op::ToReal, [a, _]) => self.split(a),
            Node::Apply(Op::Neg, [a, _]) => {
                let zero = self.put.whole(0);
                let zero = (Whole::Polynomial(vec![zero]), zero.0);
                let a = self.split(a)?;
                self.sum(Op::IntSub, zero, (a.whole, a.first), None)
            }
            Node::Apply(op, [a, b]) => {
                let (a, b) = (self.split(a)?, self.split(b)?);
                let op = match op {
                    Op::Add => Op::IntAdd,
                    _ => Op::IntSub,
                };
                let rest = a.rest.or(b.rest);
                self.sum(op, (a.whole, a.first), (b.whole, b.first), rest)
            }
            Node::Select { cond, yes, no } => {
                let cond = self.made(cond)?;
                let (yes, no) = (self.split(yes)?, self.split(no)?);
                Some(Split {
                    rest: yes.rest,
                    whole: Whole::Choice(cond, Box::new([yes.whole, no.whole])),
                    first: self
                        .put
                        .builder
                        .select(cond, yes.first, no.first, self.put.span),
                })
            }
            _ => None,
        }
    }

    fn sum(
        &mut self,
        op: Op,
        a: (Whole, NodeId),
        b: (Whole, NodeId),
        rest: Option<NodeId>,
    ) -> Option<Split> {
        let is_zero = |make: &Make<'_>, id: NodeId| match make.put.builder.node(id) {
            Node::Const(c) => c.value() == Value::Int(0),
            _ => false,
        };
        let first = match op {
            Op::IntAdd if is_zero(self, a.1) => b.1,
            Op::IntSub if is_zero(self, a.1) => self.apply(Op::IntNeg, &[b.1]),
            _ if is_zero(self, b.1) => a.1,
            _ => self.apply(op, &[a.1, b.1]),
        };
        let whole = self.both(op, &a.0, &b.0)?;
        (whole.choices() <= CHOICES).then_some(Split { rest, whole, first })
    }

    /// An int's polynomials.
    fn whole(&mut self, id: NodeId) -> Option<Whole> {
        if self.find.plain.at(id).is_some() {
            return Some(Whole::Polynomial(self.put.coefficients(id)?));
        }
        match self.find.graph.node(id) {
            Node::Select { cond, yes, no } => {
                let ways = [self.whole(yes)?, self.whole(no)?];
                Some(Whole::Choice(self.made(cond)?, Box::new(ways)))
            }
            Node::Apply(Op::IntNeg, [a, _]) => {
                let zero = Whole::Polynomial(vec![self.put.whole(0)]);
                let a = self.whole(a)?;
                self.both(Op::IntSub, &zero, &a)
            }
            Node::Apply(op, [a, b]) => {
                let (a, b) = (self.whole(a)?, self.whole(b)?);
                self.both(op, &a, &b)
            }
            _ => None,
        }
    }

    fn both(&mut self, op: Op, a: &Whole, b: &Whole) -> Option<Whole> {
        if a.choices() * b.choices() > CHOICES * CHOICES {
            return None;
        }
        let (cond, yes, no) = match (a, b) {
            (Whole::Polynomial(a), Whole::Polynomial(b)) => {
                let parts = match op {
                    Op::IntMul => self.put.product(a, b),
                    _ => self.put.each(op, a, b),
                };
                return Some(Whole::Polynomial(parts?));
            }
            (Whole::Choice(c, a), Whole::Choice(d, b)) if c == d => {
                (c, (&a[0], &b[0]), (&a[1], &b[1]))
            }
            (Whole::Choice(c, a), b) => (c, (&a[0], b), (&a[1], b)),
            (a, Whole::Choice(c, b)) => (c, (a, &b[0]), (a, &b[1])),
        };
        let ways = [self.both(op, yes.0, yes.1)?, self.both(op, no.0, no.1)?];
        Some(Whole::Choice(*cond, Box::new(ways)))
    }

    /// An int a column before a run's first: its own formula there.
    fn at_beginning(&mut self, id: NodeId) -> Option<NodeId> {
        if self.find.is_still(id) {
            return self.made(id);
        }
        match self.find.graph.node(id) {
            Node::Axis(Axis::X) => Some(self.before().0),
            Node::Apply(op, [a, b]) => {
                let a = self.at_beginning(a)?;
                let b = if op.arity() > 1 {
                    self.at_beginning(b)?
                } else {
                    a
                };
                Some(self.apply(op, &[a, b][..op.arity()]))
            }
            Node::Select { cond, yes, no } => {
                let cond = self.made(cond)?;
                let (yes, no) = (self.at_beginning(yes)?, self.at_beginning(no)?);
                Some(self.put.builder.select(cond, yes, no, self.put.span))
            }
            _ => None,
        }
    }
}
