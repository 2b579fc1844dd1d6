//! Spans: where a comparison holds along a row, found once a row.
//!
//! A comparison that is decided by the sign of a polynomial of degree 1 or 2 in
//! the column, its coefficients the same for the whole row, holds between two
//! columns or outside of them. These are worked out where the row begins, with
//! ordinary nodes, and a pixel compares its column with them.
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

use super::extent::{extent, negative, ratio};
use super::form::{Forms, Two};
use super::judge::{cycles, samples};
use super::number::Number;
use super::poly::{Atom, Monomial, Poly};
use super::put::{Out, Put};
use super::{Cheaper, Judge, Verdicts, allowance};
use crate::flow::graph::*;
use crate::passes::rebuild::rebuild_old;
use crate::range::Ranges;
use slowlight_routine::{Op, Runtime, Value};
use std::cell::Cell;

/// By how much of a column a root may be off.
const OFF: f64 = 0.25;

/// How deep choices between polynomials may stand in each other.
const CHOICES: u32 = 4;

/// The graph with comparisons of the column with a row's spans in the place of
/// comparisons that `may` be replaced; nothing where there are none.
pub fn spans<'g>(
    graph: &'g Graph,
    ranges: &'g Ranges,
    runtime: &Runtime,
    may: &dyn Fn(NodeId) -> bool,
    verdicts: &Verdicts<'g>,
) -> Option<Cheaper> {
    let allowance = allowance(runtime.real);
    if allowance < 1.0 {
        return None;
    }
    let samples = samples(graph);
    let judge = Judge {
        graph,
        samples: &samples,
        allowance,
    };
    let column = graph
        .ids()
        .find(|id| graph.node(*id) == Node::Axis(Axis::X))?;
    let site = Site {
        full: verdicts.full(graph, ranges),
        rows: verdicts.rows(graph, ranges),
        unit: runtime.real.epsilon(),
        width: f64::from(graph.image.width),
        column,
        exact: Cell::new(true),
        plainly: Cell::new(false),
    };
    let mut sites = Vec::new();
    let next = rebuild_old(graph, &mut |builder, made, id, span| {
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        if !site.rows.pixel(id) || !may(id) {
            return None;
        }
        let Node::Apply(op, [a, b]) = graph.node(id) else {
            return None;
        };
        let strict = match op {
            Op::Less | Op::IntLess => true,
            Op::LessEqual | Op::IntLessEqual => false,
            _ => return None,
        };
        let mut put = Put {
            forms: site.rows,
            builder,
            new: &new,
            span,
        };
        site.exact.set(true);
        let made = site.compared(&mut put, strict, [a, b], CHOICES)?;
        // What is asked at the borders must be as good as what the pixel asked.
        site.plainly.set(true);
        let asked = site.compared(&mut put, strict, [a, b], CHOICES);
        site.plainly.set(false);
        if !judge.sound(put.builder, &new, id, asked?) {
            return None;
        }
        let now = cycles(&*put.builder, made, runtime, &|_| false);
        if now >= cycles(graph, id, runtime, &|_| false) {
            return None;
        }
        sites.push(id);
        if site.exact.get()
            && matches!(op, Op::IntLess | Op::IntLessEqual)
            && let (Some(a), Some(b)) = (new(a), new(b))
        {
            builder.claim(made, op, [a, b]);
        }
        Some(made)
    });
    let some = !sites.is_empty();
    some.then_some(Cheaper { graph: next, sites })
}

/// What two columns of a x² + b x have as their sum where it is the same, if that is whole
/// and the same for all rows: so the last column of a span is as far from there as
/// the first.
fn mirrored(a: &Poly, b: &Poly) -> Option<i32> {
    match b.value()?.mul(a.value()?.inverse()?).neg() {
        Number::Exact(sum, 1) => i32::try_from(sum).ok().filter(|sum| sum.abs() < 1 << 20),
        _ => None,
    }
}

/// The greatest monomial that divides every term of some polynomials.
fn shared(parts: &[Poly]) -> Monomial {
    let each = parts.iter().filter(|part| !part.is_zero());
    let common = each.map(Poly::common);
    let both = |a: Monomial, b: Monomial| {
        let power = |atom: u32| b.iter().find(|(other, _)| *other == atom).map(|(_, k)| *k);
        let least = |(atom, k): (u32, u32)| Some((atom, k.min(power(atom)?)));
        a.into_iter().filter_map(least).collect()
    };
    common.reduce(both).unwrap_or_default()
}

struct Site<'g> {
    /// Forms by params and the pixel's place.
    full: &'g Forms<'g>,
    /// Forms by the column and what a row computes.
    rows: &'g Forms<'g>,
    /// The format's unit roundoff.
    unit: f64,
    width: f64,
    column: NodeId,
    /// Whether all that was asked of what is being put are whole numbers: then
    /// the span is what the comparison is.
    exact: Cell<bool>,
    /// Whether polynomials are to be put where spans would be.
    plainly: Cell<bool>,
}

/// A row's polynomial with its first coefficient above 0, and what is asked of it.
struct Asked {
    /// From power 0 on.
    parts: Vec<Poly>,
    /// What is added to the first, one divided by the other: where all others have
    /// a factor that the whole was divided by.
    more: Option<(Poly, Poly)>,
    /// Whether it is to be below 0, or at most 0.
    strict: bool,
}

impl Site<'_> {
    /// Whether the first value is less than the second (or at most that).
    fn compared(
        &self,
        put: &mut Put<'_, '_>,
        strict: bool,
        [a, b]: [NodeId; 2],
        choices: u32,
    ) -> Option<NodeId> {
        for (value, first) in [(a, true), (b, false)] {
            if let Node::Select { cond, yes, no } = self.rows.graph.node(value)
                && self.rows.pixel(value)
                && choices > 0
            {
                let mut arm = |value: NodeId| {
                    let pair = if first { [value, b] } else { [a, value] };
                    self.compared(put, strict, pair, choices - 1)
                };
                let (yes, no) = (arm(yes)?, arm(no)?);
                let cond = (put.new)(cond)?;
                return Some(put.builder.select(cond, yes, no, put.span));
            }
        }
        let (x, y) = (self.rows.get(a)?, self.rows.get(b)?);
        let difference = self.rows.sum(x, &super::scaled(y, Number::whole(-1)))?;
        match difference.parts.as_slice() {
            // Roots are positive factors.
            [part] => self.decided(put, strict, &part.poly),
            _ => None,
        }
    }

    /// Whether a polynomial is below 0, or at most 0.
    fn decided(&self, put: &mut Put<'_, '_>, strict: bool, poly: &Poly) -> Option<NodeId> {
        if let Some(atom) = put.choice(poly) {
            let Two { low, high } = self.rows.two(atom)?;
            let cond = put.high(atom, low)?;
            let yes = self.decided(put, strict, &poly.at(atom, i128::from(high))?)?;
            let no = self.decided(put, strict, &poly.at(atom, i128::from(low))?)?;
            return Some(put.builder.select(cond, yes, no, put.span));
        }
        let varying: Vec<Atom> = (poly.atoms().into_iter())
            .filter(|atom| self.rows.varies(*atom))
            .collect();
        match varying.as_slice() {
            [] => put.test(if strict { Op::Less } else { Op::LessEqual }, poly),
            [x] if *x == self.column.0 && self.plainly.get() => self.plain(put, strict, poly),
            [x] if *x == self.column.0 => self.span(put, strict, poly),
            _ => None,
        }
    }

    /// The polynomial itself, as it is asked at a border.
    fn plain(&self, put: &mut Put<'_, '_>, strict: bool, poly: &Poly) -> Option<NodeId> {
        let parts = poly.by(self.column.0);
        // It does not matter which way it is turned.
        let asked = self.asked(parts, strict);
        let x = Out {
            node: (put.new)(self.column)?,
            whole: true,
            lo: -1.0,
            hi: self.width,
        };
        self.inside(put, &asked, x)
    }

    fn span(&self, put: &mut Put<'_, '_>, strict: bool, poly: &Poly) -> Option<NodeId> {
        let mut parts = poly.by(self.column.0);
        let lead = extent(self.rows, self.full, parts.last()?);
        // p < 0 is no -p <= 0.
        let turned = lead.hi < 0.0;
        if turned {
            parts.iter_mut().for_each(|part| *part = negative(part));
        } else if lead.lo <= 0.0 {
            return None;
        }
        let asked = self.asked(parts, strict != turned);
        match asked.parts.len() {
            2 => self.up_to(put, &asked, turned),
            3 => self.between(put, &asked, turned),
            _ => None,
        }
    }

    /// Divided by the factor above 0 that all coefficients but the constant one have.
    fn asked(&self, mut parts: Vec<Poly>, strict: bool) -> Asked {
        let none = |parts| Asked {
            parts,
            more: None,
            strict,
        };
        let factor = shared(&parts[1..]);
        let of = Poly {
            terms: [(factor.clone(), Number::ONE)].into(),
        };
        if factor.is_empty() || extent(self.rows, self.full, &of).lo <= 0.0 {
            return none(parts);
        }
        let (first, rest) = parts[0].split(&factor);
        parts[0] = first;
        for part in parts.iter_mut().skip(1) {
            *part = part.split(&factor).0;
        }
        Asked {
            parts,
            more: (!rest.is_zero()).then_some((rest, of)),
            strict,
        }
    }

    /// The constant coefficient.
    fn constant(&self, put: &mut Put<'_, '_>, asked: &Asked) -> Option<Out> {
        match &asked.more {
            Some((over, of)) => put.quotient(over, of, &asked.parts[0]),
            None => put.poly(&asked.parts[0]),
        }
    }

    /// The columns up to a root, or those behind it.
    fn up_to(&self, put: &mut Put<'_, '_>, asked: &Asked, turned: bool) -> Option<NodeId> {
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
    fn between(&self, put: &mut Put<'_, '_>, asked: &Asked, turned: bool) -> Option<NodeId> {
        let [_, b, a] = asked.parts.as_slice() else {
            return None;
        };
        let middle = ratio(self.rows, self.full, b, a) / 2.0;
        if 2.0 * middle * self.unit.sqrt() > OFF {
            return None;
        }
        // A first column that was clamped to the one before the picture has its last
        // one behind it only if their sum is as large.
        let mirrored = mirrored(a, b).filter(|sum| f64::from(*sum) >= self.width - 2.0);
        let c = self.constant(put, asked)?;
        let (c, b, a) = (put.real(c), self.real(put, b)?, self.real(put, a)?);
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
    fn inside(&self, put: &mut Put<'_, '_>, asked: &Asked, x: Out) -> Option<NodeId> {
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

    /// What a row computes, as a real.
    fn real(&self, put: &mut Put<'_, '_>, poly: &Poly) -> Option<NodeId> {
        let out = put.poly(poly)?;
        Some(put.real(out))
    }
}
