//! Comparisons solved for spans of columns: where one holds along a row, found once a row.
//!
//! A comparison that is decided by the sign of a polynomial of degree 1 or 2 in
//! the column, its coefficients the same for the whole row, holds between two
//! columns or outside of them. These are worked out where the row begins, with
//! ordinary nodes, and a pixel compares its column with them ([`super::ends`]). The sign of
//! such a polynomial that is never 0 is chosen by that.

use super::extent::{Extents, negative};
use super::form::{Forms, Two};
use super::judge::cycles;
use super::number::Number;
use super::poly::{Atom, Monomial, Poly};
use super::{Cheaper, Judge, Verdicts, allowance, end};
use crate::analysis::range::Ranges;
use crate::ir::graph::*;
use crate::passes::algebra::polynomial::emit::{Out, Put};
use crate::passes::algebra::polynomial::rounding_samples::samples;
use crate::passes::rewrite::rebuild::rebuild_old;
use slowlight_routine::{Op, Range, Runtime, Value};
use std::cell::Cell;

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
    let allowance = allowance(runtime);
    if allowance < 1.0 {
        return None;
    }
    let samples = samples(graph);
    let judge = Judge {
        graph,
        samples: &samples,
        allowance,
        end: end(runtime.real),
        followed: &verdicts.followed,
    };
    let column = graph
        .ids()
        .find(|id| graph.node(*id) == Node::Axis(Axis::X))?;
    let site = Site {
        full: verdicts.full(graph, ranges),
        rows: verdicts.rows(graph, ranges),
        extents: &verdicts.extents,
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
            Op::Sign | Op::IntSign if site.full.two(id.0)?.low == -1 => true,
            _ => return None,
        };
        let mut put = Put {
            forms: site.rows,
            builder,
            new: &new,
            span,
        };
        let asked = |put: &mut Put<'_, '_>| match op {
            Op::Sign | Op::IntSign => site.sign(put, a),
            _ => site.compared(put, strict, [a, b], CHOICES),
        };
        site.exact.set(true);
        let made = asked(&mut put)?;
        // What is asked at the borders must be as good as what the pixel asked.
        site.plainly.set(true);
        let plain = asked(&mut put);
        site.plainly.set(false);
        if !judge.sound(put.builder, &new, id, plain?) {
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

pub(super) struct Site<'g> {
    /// Forms by params and the pixel's place.
    pub(super) full: &'g Forms<'g>,
    /// Forms by the column and what a row computes.
    pub(super) rows: &'g Forms<'g>,
    pub(super) extents: &'g Extents,
    /// The format's unit roundoff.
    pub(super) unit: f64,
    pub(super) width: f64,
    pub(super) column: NodeId,
    /// Whether all that was asked of what is being put are whole numbers: then
    /// the span is what the comparison is.
    pub(super) exact: Cell<bool>,
    /// Whether polynomials are to be put where spans would be.
    plainly: Cell<bool>,
}

impl Site<'_> {
    /// The sign of what is never 0.
    fn sign(&self, put: &mut Put<'_, '_>, of: NodeId) -> Option<NodeId> {
        let [part] = self.rows.get(of)?.parts.as_slice() else {
            return None;
        };
        let above = self.decided(put, true, &negative(&part.poly))?;
        let [yes, no] = [1, -1].map(|n| put.builder.constant(Value::Int(n), put.span));
        Some(put.builder.select(above, yes, no, put.span))
    }

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
            [x] if *x == self.column.0 => self.span(put, strict, poly),
            _ => None,
        }
    }

    fn span(&self, put: &mut Put<'_, '_>, strict: bool, poly: &Poly) -> Option<NodeId> {
        let mut parts = poly.by(self.column.0);
        let lead = (self.extents).extent(self.rows, self.full, parts.last()?);
        // p < 0 is no -p <= 0.
        let turned = lead.hi < 0.0;
        if turned {
            parts.iter_mut().for_each(|part| *part = negative(part));
        } else if lead.lo <= 0.0 {
            return self.by_sign(put, strict, poly);
        }
        let asked = self.asked(parts, strict != turned);
        self.ends(put, &asked, turned)
    }

    /// The span of a polynomial with its first coefficient above 0, or the polynomial
    /// itself as it is asked at a border.
    fn ends(&self, put: &mut Put<'_, '_>, asked: &Asked, turned: bool) -> Option<NodeId> {
        match asked.parts.len() {
            // It does not matter which way it is turned.
            2 | 3 if self.plainly.get() => {
                let x = Out {
                    node: (put.new)(self.column)?,
                    whole: true,
                    lo: -1.0,
                    hi: self.width,
                };
                self.inside(put, asked, x)
            }
            2 => self.up_to(put, asked, turned),
            3 => self.between(put, asked, turned),
            _ => None,
        }
    }

    /// f q(x) + r, where q's first coefficient has a known sign and the row's f has
    /// not: the sign of q(x) + r/f where f is above 0, the other one where it is
    /// below, and r's where it is 0. The span is solved under the row's condition.
    fn by_sign(&self, put: &mut Put<'_, '_>, strict: bool, poly: &Poly) -> Option<NodeId> {
        let factor = shared(poly.by(self.column.0).get(1..)?);
        let alone = |monomial: &[(Atom, u32)]| Poly {
            terms: [(monomial.to_vec(), Number::ONE)].into(),
        };
        let above = |of: &Poly| (self.extents).extent(self.rows, self.full, of).lo > 0.0;
        let mut unknown = factor.iter().filter(|one| !above(&alone(&[**one])));
        let (Some((atom, power)), None) = (unknown.next(), unknown.next()) else {
            return None;
        };
        if power % 2 == 0 || self.rows.other(*atom).is_some() {
            return None;
        }
        let (q, r) = poly.split(&factor);
        let lead = (self.extents).extent(self.rows, self.full, q.by(self.column.0).last()?);
        if lead.lo <= 0.0 && lead.hi >= 0.0 {
            return None;
        }
        let side = |up: bool| {
            let turned = (lead.hi < 0.0) == up;
            let sign = |part: &Poly| match lead.hi < 0.0 {
                true => negative(part),
                false => part.clone(),
            };
            let asked = Asked {
                parts: q.by(self.column.0).iter().map(sign).collect(),
                more: (!r.is_zero()).then(|| (sign(&r), alone(&factor))),
                strict: strict != turned,
            };
            (asked, turned)
        };
        let is = |put: &mut Put<'_, '_>, up: bool| {
            let of = Poly::atom(*atom);
            put.test(Op::Less, &if up { negative(&of) } else { of })
        };
        for up in [true, false] {
            // What the other side and 0 decide alike.
            if let Some(holds) = self.same(strict, &q, &r, !up) {
                let (asked, turned) = side(up);
                let (cond, span) = (is(put, up)?, self.ends(put, &asked, turned)?);
                let holds = put.builder.constant(Value::Bool(holds), put.span);
                return Some(put.builder.select(cond, span, holds, put.span));
            }
        }
        let [yes, no] = [true, false].map(|up| {
            let (asked, turned) = side(up);
            self.ends(put, &asked, turned)
        });
        let (up, down) = (is(put, true)?, is(put, false)?);
        let zero = put.test(if strict { Op::Less } else { Op::LessEqual }, &r)?;
        let no = put.builder.select(down, no?, zero, put.span);
        Some(put.builder.select(up, yes?, no, put.span))
    }

    /// What f q(x) + r is for all f on one side and 0, if that is the same in all columns.
    fn same(&self, strict: bool, q: &Poly, r: &Poly, up: bool) -> Option<bool> {
        let [of, more] = [q, r].map(|poly| (self.extents).extent(self.rows, self.full, poly));
        let product = match up {
            true => of,
            false => Range::new(-of.hi, -of.lo),
        };
        let beyond = |x: f64| x > 0.0 || strict && x == 0.0;
        let within = |x: f64| x < 0.0 || !strict && x == 0.0;
        if product.lo >= 0.0 && beyond(more.lo) {
            Some(false)
        } else if product.hi <= 0.0 && within(more.hi) {
            Some(true)
        } else {
            None
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
        if factor.is_empty() || (self.extents).extent(self.rows, self.full, &of).lo <= 0.0 {
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
}

/// A row's polynomial with its first coefficient above 0, and what is asked of it.
pub(super) struct Asked {
    /// From power 0 on.
    pub(super) parts: Vec<Poly>,
    /// What is added to the first, one divided by the other: where all others have
    /// a factor that the whole was divided by.
    pub(super) more: Option<(Poly, Poly)>,
    /// Whether it is to be below 0, or at most 0.
    pub(super) strict: bool,
}
