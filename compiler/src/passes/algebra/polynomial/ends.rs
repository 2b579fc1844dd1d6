//! Solved comparisons: the columns where a span begins and ends, and what asks a pixel whether it
//! is between.
//!
//! Of a x² + b x + c with a above 0 the roots are v ± sqrt(v² - c/a), v = -b/2a.
//! With roundings of a unit u each, v² - c/a is off by less than 4 u v², so a
//! root by less than 2 v sqrt(u) where the two are close, and by less where they
//! are not. The pass asks for that to be at most a quarter of a column. A root is
//! moved outward by as much again, so that the column found for it is the one
//! looked for or the next one outside; then the polynomial itself is asked at
//! this column, with the pixel's own formula. So a pixel is decided as the
//! polynomial would, up to roundings of its value at columns further inside.
//!
//! An empty span begins behind its end. Columns are clamped to those beside the
//! picture while they are reals, so that nothing overflows.

use super::number::Number;
use super::poly::Poly;
use super::span::{Asked, Site};
use crate::ir::graph::*;
use crate::passes::algebra::polynomial::emit::{Out, Put};
use slowlight_routine::{Op, Value};

/// By how much of a column a root may be off.
const OFF: f64 = 0.25;

/// What part of its greatest value a coefficient's least must be, at least: then no
/// roundings make it a half of that.
const SURE: f64 = 1e-4;

/// What two columns of a x² + b x have as their sum where it is the same, if that is whole
/// and the same for all rows: so the last column of a span is as far from there as
/// the first.
fn mirrored(a: &Poly, b: &Poly) -> Option<i32> {
    match b.value()?.mul(a.value()?.inverse()?).neg() {
        Number::Exact(sum, 1) => i32::try_from(sum).ok().filter(|sum| sum.abs() < 1 << 20),
        _ => None,
    }
}

impl Site<'_> {
    /// The constant coefficient.
    fn constant(&self, put: &mut Put<'_, '_>, asked: &Asked) -> Option<Out> {
        match &asked.more {
            Some((over, of)) => put.quotient(over, of, &asked.parts[0]),
            None => put.poly(&asked.parts[0]),
        }
    }

    /// The columns up to a root, or those behind it.
    pub(super) fn up_to(
        &self,
        put: &mut Put<'_, '_>,
        asked: &Asked,
        turned: bool,
    ) -> Option<NodeId> {
        let [c, b] = asked.parts.as_slice() else {
            return None;
        };
        let alone = asked.more.is_none() && b.value() == Some(Number::ONE);
        if alone && c.value().is_none() && c.terms.len() == 1 {
            return None; // The column against something already.
        }
        let c = self.constant(put, asked)?;
        let (c, b) = (put.real(c), self.real(put, b)?);
        let root = put.builder.apply(Op::Div, &[c, b], put.span);
        let root = put.builder.apply(Op::Neg, &[root], put.span);
        let last = self.last(put, asked, root)?;
        let column = (put.new)(self.column)?;
        let (op, pair) = match turned {
            false => (Op::IntLessEqual, [column, last]),
            true => (Op::IntLess, [last, column]),
        };
        Some(put.builder.apply(op, &pair, put.span))
    }

    /// The columns between two roots, or those that are not.
    pub(super) fn between(
        &self,
        put: &mut Put<'_, '_>,
        asked: &Asked,
        turned: bool,
    ) -> Option<NodeId> {
        let [_, b, a] = asked.parts.as_slice() else {
            return None;
        };
        let middle = (self.extents).ratio(self.rows, self.full, b, a) / 2.0;
        if 2.0 * middle * self.unit.sqrt() > OFF {
            return None;
        }
        // A first column that was clamped to the one before the picture has its last
        // one behind it only if their sum is as large.
        let mirrored = mirrored(a, b).filter(|sum| f64::from(*sum) >= self.width - 2.0);
        let c = self.constant(put, asked)?;
        let (c, b, a) = (put.real(c), self.real(put, b)?, self.divisor(put, a)?);
        let at = put.span;
        let builder = &mut *put.builder;
        let two = builder.constant(Value::Real(-2.0), at);
        let double = builder.apply(Op::Mul, &[a, two], at);
        let middle = builder.apply(Op::Div, &[b, double], at);
        let square = builder.apply(Op::Mul, &[middle, middle], at);
        let rest = builder.apply(Op::Div, &[c, a], at);
        let square = builder.apply(Op::Sub, &[square, rest], at);
        // What is further below 0 than it can be off has no roots.
        let off = builder.constant(Value::Real(-OFF * OFF), at);
        let some = builder.apply(Op::LessEqual, &[off, square], at);
        let zero = builder.constant(Value::Real(0.0), at);
        let square = builder.apply(Op::Max, &[square, zero], at);
        let size = builder.apply(Op::Sqrt, &[square], at);
        let low = builder.apply(Op::Sub, &[middle, size], at);
        let high = builder.apply(Op::Add, &[middle, size], at);
        let first = self.first(put, asked, low)?;
        let behind = put.builder.constant(Value::Int(self.width as i32), at);
        let first = put.builder.select(some, first, behind, at);
        let last = match mirrored {
            Some(sum) => {
                let sum = put.builder.constant(Value::Int(sum), at);
                put.builder.apply(Op::IntSub, &[sum, first], at)
            }
            None => {
                let last = self.last(put, asked, high)?;
                let before = put.builder.constant(Value::Int(-1), at);
                put.builder.select(some, last, before, at)
            }
        };
        let builder = &mut *put.builder;
        let column = (put.new)(self.column)?;
        let [yes, no] = [true, false].map(|b| builder.constant(Value::Bool(b), at));
        Some(match turned {
            false => {
                let from = builder.apply(Op::IntLessEqual, &[first, column], at);
                let to = builder.apply(Op::IntLessEqual, &[column, last], at);
                builder.select(from, to, no, at)
            }
            true => {
                let before = builder.apply(Op::IntLess, &[column, first], at);
                let behind = builder.apply(Op::IntLess, &[last, column], at);
                builder.select(before, yes, behind, at)
            }
        })
    }

    /// The first column of those that are asked for, near a root.
    fn first(&self, put: &mut Put<'_, '_>, asked: &Asked, root: NodeId) -> Option<NodeId> {
        let found = self.column_at(put, root, 1.0 - OFF);
        self.stepped(put, asked, found, Op::IntAdd)
    }

    /// The last column of those that are asked for, near a root.
    fn last(&self, put: &mut Put<'_, '_>, asked: &Asked, root: NodeId) -> Option<NodeId> {
        let found = self.column_at(put, root, OFF);
        self.stepped(put, asked, found, Op::IntSub)
    }

    /// The column at a place, from the one before the picture to the one behind it.
    fn column_at(&self, put: &mut Put<'_, '_>, place: NodeId, moved: f64) -> NodeId {
        let at = put.span;
        let builder = &mut *put.builder;
        let [moved, before, behind] =
            [moved, -1.0, self.width].map(|x| builder.constant(Value::Real(x), at));
        let place = builder.apply(Op::Add, &[place, moved], at);
        let place = builder.apply(Op::Max, &[place, before], at);
        let place = builder.apply(Op::Min, &[place, behind], at);
        builder.apply(Op::Floor, &[place], at)
    }

    /// A column if it is asked for, else the next.
    fn stepped(
        &self,
        put: &mut Put<'_, '_>,
        asked: &Asked,
        column: NodeId,
        step: Op,
    ) -> Option<NodeId> {
        let x = Out {
            node: column,
            whole: true,
            lo: -1.0,
            hi: self.width,
        };
        let inside = self.inside(put, asked, x)?;
        let at = put.span;
        let builder = &mut *put.builder;
        let one = builder.constant(Value::Int(1), at);
        let next = builder.apply(step, &[column, one], at);
        Some(builder.select(inside, column, next, at))
    }

    /// Whether what is asked for holds at a column.
    pub(super) fn inside(&self, put: &mut Put<'_, '_>, asked: &Asked, x: Out) -> Option<NodeId> {
        let value = match &asked.more {
            None => put.horner(&asked.parts, x)?,
            Some(_) => {
                let mut parts = asked.parts.clone();
                parts[0] = Poly::default();
                let (value, constant) = (put.horner(&parts, x)?, self.constant(put, asked)?);
                put.plus(value, constant)
            }
        };
        if !value.whole {
            self.exact.set(false);
        }
        let (zero, op) = match (value.whole, asked.strict) {
            (true, true) => (Value::Int(0), Op::IntLess),
            (true, false) => (Value::Int(0), Op::IntLessEqual),
            (false, true) => (Value::Real(0.0), Op::Less),
            (false, false) => (Value::Real(0.0), Op::LessEqual),
        };
        let zero = put.builder.constant(zero, put.span);
        Some(put.builder.apply(op, &[value.node, zero], put.span))
    }

    /// The first coefficient, as a real. Boxes see that it is above 0, ranges may
    /// not. That it is at least half of the least that it can be changes no value,
    /// and lets them know how large a quotient becomes.
    fn divisor(&self, put: &mut Put<'_, '_>, poly: &Poly) -> Option<NodeId> {
        let real = self.real(put, poly)?;
        let proved = (self.extents).extent(self.rows, self.full, poly);
        if poly.value().is_some() || proved.lo <= SURE * proved.hi {
            return Some(real);
        }
        // A power of two has few digits.
        let least = (proved.lo / 2.0).log2().floor().exp2();
        let (at, builder) = (put.span, &mut *put.builder);
        let least = builder.constant(Value::Real(least), at);
        Some(builder.apply(Op::Max, &[real, least], at))
    }

    /// What a row computes, as a real.
    fn real(&self, put: &mut Put<'_, '_>, poly: &Poly) -> Option<NodeId> {
        let out = put.poly(poly)?;
        Some(put.real(out))
    }
}
