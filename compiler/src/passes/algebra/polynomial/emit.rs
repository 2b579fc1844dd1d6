//! Emission of normal forms: putting one into a graph, cheaply.
//!
//! A polynomial in the column is put by Horner's scheme over coefficients that
//! are worked out once a row; in whole numbers, exactly, where its coefficients
//! can be made whole and nothing leaves 31 bits. A quadratic whose first two
//! coefficients are constants is put as a square and a rest, of which the ranges
//! see that it is no negative. An int of two values makes a choice between two
//! polynomials.

use super::form::{Forms, Other, Two, primitive};
use super::number::Number;
use super::number::isqrt;
use super::poly::{Atom, Poly};
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::source::Span;
use slowlight_routine::{Op, Type, Value};

/// Whole numbers stay within this.
const WHOLE: f64 = 2_000_000_000.0;

/// What was put: a node, whether it is an int, and what it stays within if so.
#[derive(Clone, Copy, Debug)]
pub struct Out {
    pub node: NodeId,
    pub whole: bool,
    pub(super) lo: f64,
    pub(super) hi: f64,
}

/// Where forms are put.
pub struct Put<'p, 'g> {
    pub forms: &'p Forms<'g>,
    pub builder: &'p mut Builder,
    pub new: &'p dyn Fn(NodeId) -> Option<NodeId>,
    pub span: Span,
}

impl Put<'_, '_> {
    /// A polynomial.
    pub fn poly(&mut self, poly: &Poly) -> Option<Out> {
        if let Some(number) = poly.value() {
            return Some(self.constant(number));
        }
        if let Some(atom) = self.choice(poly) {
            return self.chosen(poly, atom, |put, poly| put.poly(poly));
        }
        let main = self.main(poly)?;
        let parts = poly.by(main);
        if let (Some(of), [rest, over]) = (self.forms.inverse(main), parts.as_slice()) {
            return self.quotient(over, of, rest);
        }
        let x = self.atom(main)?;
        if let Some(square) = self.square(&parts, x) {
            return square;
        }
        self.horner(&parts, x)
    }

    /// A polynomial in `x` by its coefficients, from power 0 on.
    pub(super) fn horner(&mut self, parts: &[Poly], x: Out) -> Option<Out> {
        let (top, rest) = parts.split_last()?;
        let mut sum = self.poly(top)?;
        for part in rest.iter().rev() {
            sum = self.times(sum, x);
            if !part.is_zero() {
                let part = self.poly(part)?;
                sum = self.plus(sum, part);
            }
        }
        Some(sum)
    }

    /// over / of + rest: one rounding, and none where it is whole.
    pub(super) fn quotient(&mut self, over: &Poly, of: &Poly, rest: &Poly) -> Option<Out> {
        let (over, of) = (self.poly(over)?, self.poly(of)?);
        let (over, of) = (self.real(over), self.real(of));
        let quotient = real(self.builder.apply(Op::Div, &[over, of], self.span));
        if rest.is_zero() {
            return Some(quotient);
        }
        let rest = self.poly(rest)?;
        Some(self.plus(quotient, rest))
    }

    /// An atom of two values in a polynomial that is another in every column.
    pub(super) fn choice(&self, poly: &Poly) -> Option<Atom> {
        let forms = self.forms;
        let fits = |a: &Atom| forms.varies(*a) && forms.two(*a).is_some();
        poly.atoms().into_iter().find(fits)
    }

    /// A choice by the value of an atom that has two.
    pub(super) fn chosen(
        &mut self,
        poly: &Poly,
        atom: Atom,
        put: impl Fn(&mut Self, &Poly) -> Option<Out>,
    ) -> Option<Out> {
        let two = self.forms.two(atom)?;
        let high = self.high(atom, two.low)?;
        let yes = put(self, &poly.at(atom, i128::from(two.high))?)?;
        let no = put(self, &poly.at(atom, i128::from(two.low))?)?;
        let whole = yes.whole && no.whole;
        let [a, b] = [yes, no].map(|out| if whole { out.node } else { self.real(out) });
        Some(Out {
            node: self.builder.select(high, a, b, self.span),
            whole,
            lo: yes.lo.min(no.lo),
            hi: yes.hi.max(no.hi),
        })
    }

    /// Whether an atom of two values has the greater.
    pub(super) fn high(&mut self, atom: Atom, low: i32) -> Option<NodeId> {
        let forms = self.forms;
        if let Some(Other::Holds(cond)) = forms.other(atom) {
            return (self.new)(*cond);
        }
        if let Node::Apply(Op::Sign | Op::IntSign, [of, _]) = forms.graph.node(NodeId(atom))
            && let Some(form) = forms.get(of)
            && let [part] = form.parts.as_slice()
        {
            let negative = part.poly.scaled(Number::whole(-1));
            return self.test(Op::Less, &negative);
        }
        let low = self.builder.constant(Value::Int(low), self.span);
        let node = (self.new)(NodeId(atom))?;
        Some(self.builder.apply(Op::IntLess, &[low, node], self.span))
    }

    /// The sign of what is never 0.
    pub fn sign(&mut self, id: NodeId, two: Two) -> Option<NodeId> {
        let high = self.high(id.0, two.low)?;
        let [yes, no] = [two.high, two.low].map(Value::Int);
        let yes = self.builder.constant(yes, self.span);
        let no = self.builder.constant(no, self.span);
        Some(self.builder.select(high, yes, no, self.span))
    }

    /// The atom to put a polynomial by: what varies before what does not, the
    /// pixel's place before other things.
    fn main(&self, poly: &Poly) -> Option<Atom> {
        let rank = |atom: &Atom| {
            let axis = matches!(self.forms.graph.node(NodeId(*atom)), Node::Axis(_));
            (!self.forms.varies(*atom), !axis, *atom)
        };
        poly.atoms().into_iter().min_by_key(rank)
    }

    fn atom(&mut self, atom: Atom) -> Option<Out> {
        let forms = self.forms;
        if let Some(of) = forms.inverse(atom) {
            let of = self.poly(of)?;
            let of = self.real(of);
            let one = self.builder.constant(Value::Real(1.0), self.span);
            return Some(real(self.builder.apply(Op::Div, &[one, of], self.span)));
        }
        let node = (self.new)(NodeId(atom))?;
        let range = forms.ranges.result.get(atom as usize)?;
        Some(Out {
            node,
            whole: forms.graph.ty(NodeId(atom)) == Type::Int,
            lo: range.lo,
            hi: range.hi,
        })
    }

    pub(super) fn constant(&mut self, number: Number) -> Out {
        let x = number.real();
        let whole = matches!(number, Number::Exact(_, 1)) && x.abs() <= WHOLE;
        let value = if whole {
            Value::Int(x as i32)
        } else {
            Value::Real(x)
        };
        Out {
            node: self.builder.constant(value, self.span),
            whole,
            lo: x,
            hi: x,
        }
    }

    /// a x² + b x + c with constants a and b as a/d² (d x + n)² + rest, for a
    /// whole x that varies; nothing where it is no such thing.
    fn square(&mut self, parts: &[Poly], x: Out) -> Option<Option<Out>> {
        let [c, b, a] = parts else {
            return None;
        };
        let ((n, d), scale) = halved(a.value()?, b.value()?)?;
        let fits = |n: i128, d: i128| n.unsigned_abs() < 40_000 && d < 1_000;
        if !x.whole || !matches!(scale, Number::Exact(_, 1)) || !fits(n, d) {
            return None;
        }
        // The square of a whole number goes into the line.
        let root = match scale {
            Number::Exact(scale, 1) => isqrt(scale).filter(|r| *r > 0 && fits(n * r, d * r)),
            _ => None,
        };
        let (n, d, scale) = root.map_or((n, d, scale), |r| (n * r, d * r, Number::ONE));
        let (dx, n) = (Number::whole(d), Number::whole(n));
        let rest = c.add(&Poly::constant(n.mul(n).mul(scale).neg()))?;
        let by = self.constant(dx);
        let moved = self.constant(n);
        let line = self.times(x, by);
        let line = self.plus(line, moved);
        let mut out = self.times(line, line);
        out.lo = out.lo.max(0.0);
        let scale = self.constant(scale);
        let out = self.times(out, scale);
        if rest.is_zero() {
            return Some(Some(out));
        }
        let rest = self.poly(&rest);
        Some(rest.map(|rest| self.plus(out, rest)))
    }

    fn times(&mut self, a: Out, b: Out) -> Out {
        let known = |b: &Builder, out: Out| b.value(out.node).map(Value::real);
        match (known(self.builder, a), known(self.builder, b)) {
            (Some(1.0), _) => return b,
            (_, Some(1.0)) => return a,
            (_, Some(2.0)) => return self.plus(a, a),
            (Some(2.0), _) => return self.plus(b, b),
            _ => {}
        }
        let ends = [a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi];
        self.both(Op::Mul, Op::IntMul, a, b, &ends)
    }

    pub(super) fn plus(&mut self, a: Out, b: Out) -> Out {
        let ends = [a.lo + b.lo, a.hi + b.hi];
        // A constant below 0 is subtracted.
        match self.builder.value(b.node) {
            Some(Value::Int(n)) if n < 0 => {
                let less = self.constant(Number::whole(-i128::from(n)));
                self.both(Op::Sub, Op::IntSub, a, less, &ends)
            }
            Some(Value::Real(x)) if x < 0.0 => {
                let less = self.constant(Number::Near(-x));
                self.both(Op::Sub, Op::IntSub, a, less, &ends)
            }
            _ => self.both(Op::Add, Op::IntAdd, a, b, &ends),
        }
    }

    /// An operation on ints where both are and the result stays within bounds.
    fn both(&mut self, reals: Op, ints: Op, a: Out, b: Out, ends: &[f64]) -> Out {
        let lo = ends.iter().copied().fold(f64::INFINITY, f64::min);
        let hi = ends.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let whole = a.whole && b.whole && -WHOLE <= lo && hi <= WHOLE;
        let op = if whole { ints } else { reals };
        let [x, y] = [a, b].map(|out| if whole { out.node } else { self.real(out) });
        Out {
            node: self.builder.apply(op, &[x, y], self.span),
            whole,
            lo,
            hi,
        }
    }

    /// As a real.
    pub fn real(&mut self, out: Out) -> NodeId {
        match self.builder.value(out.node) {
            Some(value) => self.builder.constant(Value::Real(value.real()), self.span),
            None if out.whole => self.builder.apply(Op::ToReal, &[out.node], self.span),
            None => out.node,
        }
    }

    /// A polynomial but for a factor above 0, its coefficients whole if they can
    /// be, those of its square too, and that factor.
    pub(super) fn whole(&self, poly: &Poly) -> Option<(Poly, Number)> {
        let (whole, factor) = primitive(poly)?;
        let (whole, factor) = match factor.real() < 0.0 {
            true => (whole.scaled(Number::whole(-1)), factor.neg()),
            false => (whole, factor),
        };
        let part = || {
            let parts = whole.by(self.main(&whole)?);
            let [_, b, a] = parts.as_slice() else {
                return None;
            };
            match halved(a.value()?, b.value()?)? {
                (_, Number::Exact(_, part)) if part > 1 => Some(Number::whole(part)),
                _ => None,
            }
        };
        Some(match part() {
            Some(part) => (whole.scaled(part), factor.mul(part.inverse()?)),
            None => (whole, factor),
        })
    }

    /// A polynomial but for a factor above 0, as cheap as it comes, and that factor.
    pub(super) fn sized(&mut self, poly: &Poly) -> Option<(Out, Number)> {
        let (whole, factor) = self.whole(poly)?;
        let out = self.poly(&whole)?;
        if out.whole || self.choice(poly).is_some() {
            return Some((out, factor));
        }
        // No product with the first coefficient, then.
        let main = self.main(poly)?;
        let lead = poly.by(main).last().and_then(Poly::value);
        match lead {
            Some(lead) if self.forms.varies(main) && lead.real().abs() > 1e-12 => {
                let size = match lead.real() < 0.0 {
                    true => lead.neg(),
                    false => lead,
                };
                Some((self.poly(&poly.scaled(size.inverse()?))?, size))
            }
            _ => Some((out, factor)),
        }
    }

    /// Whether a polynomial is less than 0, at most 0, or 0.
    pub fn test(&mut self, op: Op, poly: &Poly) -> Option<NodeId> {
        // The same node for a polynomial and its negative.
        let negative = poly.lead().real() < 0.0;
        let turned = match negative {
            true => poly.scaled(Number::whole(-1)),
            false => poly.clone(),
        };
        let (out, _) = self.sized(&turned)?;
        let op = match (op, out.whole) {
            (Op::Less, true) => Op::IntLess,
            (Op::LessEqual, true) => Op::IntLessEqual,
            (Op::Equal, true) => Op::IntEqual,
            (op, _) => op,
        };
        let zero = match out.whole {
            true => self.builder.constant(Value::Int(0), self.span),
            false => self.builder.constant(Value::Real(0.0), self.span),
        };
        let pair = match negative {
            true => [zero, out.node],
            false => [out.node, zero],
        };
        Some(self.builder.apply(op, &pair, self.span))
    }
}

/// n and d of a x² + b x = a/d² ((d x + n)² - n²), and a/d².
fn halved(a: Number, b: Number) -> Option<((i128, i128), Number)> {
    let Number::Exact(n, d) = b.mul(a.mul(Number::whole(2)).inverse()?) else {
        return None;
    };
    let square = Number::whole(d.checked_mul(d)?);
    Some(((n, d), a.mul(square.inverse()?)))
}

pub(super) fn real(node: NodeId) -> Out {
    Out {
        node,
        whole: false,
        lo: f64::NEG_INFINITY,
        hi: f64::INFINITY,
    }
}
