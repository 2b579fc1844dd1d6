//! Collection of polynomials by what hangs on a loop's counter alone: each such factor is worked
//! out as a whole, so that it can be a table's entry, and what is left to multiply by it is little.
//!
//! A loop over the faces of a mesh, or over balls, multiplies a ray by numbers of the k-th
//! one. As people write it, parts of the ray come first:
//! ```text
//! e1(k) . (d x e2(k))   is   d . (e2(k) x e1(k))
//! ```
//! Of nine products three are left, as all that hangs on k stands together on the right, and
//! [`super::induction_tables`] makes tables of it. What no turn changes is brought together in the
//! same way, and stands before the loop.
//!
//! Over the reals both are the same. Terms that are much greater than what is computed on the
//! way would lose digits that the formula as written keeps: such are left alone, unless the
//! format's roundings of them are below [`SOUND`].
//! (Collection as computer algebra has it: Geddes, Czapor and Labahn, Algorithms for Computer
//! Algebra, 1992, 3.2; by loop invariance as in Briggs and Cooper, Effective partial redundancy
//! elimination, PLDI 1994, who reassociate by rank.)

use super::induction_tables::on_counters;
use super::polynomials::SOUND;
use crate::analysis::range::Ranges;
use crate::analysis::rate::{Dependence, Rates, rates};
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::algebra::polynomial::number::Number;
use crate::passes::algebra::polynomial::poly::{Atom, Monomial, Poly};
use crate::passes::rewrite::rebuild::rebuild_old;
use crate::source::Span;
use rustc_hash::{FxHashMap, FxHashSet};
use slowlight_routine::{Op, Runtime, Type, Value};
use std::collections::BTreeMap;

/// How many times the greatest value on the way the terms may be.
const LARGER: f64 = 4.0;

/// The graph with such polynomials; nothing where there are none with fewer products.
pub fn collected(graph: &Graph, ranges: &Ranges, runtime: &Runtime) -> Option<Graph> {
    let found = Collector::new(graph, ranges, runtime)?;
    let put: FxHashMap<NodeId, Collected> = graph
        .ids()
        .filter_map(|id| Some((id, found.collected(id)?)))
        .collect();
    if put.is_empty() {
        return None;
    }
    Some(rebuild_old(graph, &mut |builder, made, id, span| {
        let mut emit = Emit {
            builder,
            made,
            span,
        };
        emit.collected(put.get(&id)?)
    }))
}

/// A value as a sum of products: of what hangs on counters, and of what does not.
struct Collected(Vec<(Poly, Poly)>);

struct Collector<'g> {
    graph: &'g Graph,
    ranges: &'g Ranges,
    runtime: &'g Runtime,
    rates: Rates,
    /// What hangs on counters alone, and is no polynomial in them: those are for
    /// [`super::polynomials`].
    on_counters: Vec<bool>,
    /// What has factors that do, as polynomials in these and in others.
    polys: Vec<Option<Poly>>,
    /// Who reads each value.
    users: Vec<Vec<NodeId>>,
}

impl<'g> Collector<'g> {
    /// Nothing where no loop counts.
    fn new(graph: &'g Graph, ranges: &'g Ranges, runtime: &'g Runtime) -> Option<Collector<'g>> {
        let mut made = Collector {
            graph,
            ranges,
            runtime,
            rates: rates(graph),
            on_counters: Vec::new(),
            polys: Vec::with_capacity(graph.nodes.len()),
            users: vec![Vec::new(); graph.nodes.len()],
        };
        let counted = counted(graph).into_iter();
        let on = on_counters(graph)?.into_iter();
        made.on_counters = on
            .zip(counted)
            .map(|(on, counted)| on && !counted)
            .collect();
        for id in graph.ids() {
            let poly = made.poly(id);
            made.polys.push(poly);
            for of in graph.references(id) {
                made.users[of.0 as usize].push(id);
            }
        }
        Some(made)
    }

    fn hangs(&self, id: NodeId) -> bool {
        self.on_counters[id.0 as usize]
    }

    fn operand(&self, id: NodeId) -> Poly {
        let known = self.polys[id.0 as usize].clone();
        match self.graph.constant(id) {
            Some(Value::Real(number)) => Poly::constant(Number::of(number)),
            _ => known.unwrap_or_else(|| Poly::atom(id.0)),
        }
    }

    /// A value that has such factors and others.
    fn poly(&self, id: NodeId) -> Option<Poly> {
        let Node::Apply(op, [a, b]) = self.graph.node(id) else {
            return None;
        };
        if self.graph.ty(id) != Type::Real || self.hangs(id) {
            return None;
        }
        let minus = |poly: &Poly| poly.scaled(Number::ONE.neg());
        let poly = match op {
            Op::Neg => minus(&self.operand(a)),
            Op::Add => self.operand(a).add(&self.operand(b))?,
            Op::Sub => self.operand(a).add(&minus(&self.operand(b)))?,
            Op::Mul => self.operand(a).mul(&self.operand(b))?,
            _ => return None,
        };
        let has_factor = |atom: Atom| self.hangs(NodeId(atom));
        poly.atoms().into_iter().any(has_factor).then_some(poly)
    }

    /// A value that something else than such a polynomial reads, collected, if that takes fewer
    /// products and loses nothing.
    fn collected(&self, id: NodeId) -> Option<Collected> {
        let poly = self.polys[id.0 as usize].as_ref()?;
        let users = &self.users[id.0 as usize];
        let ends = |user: &NodeId| self.polys[user.0 as usize].is_none();
        if !users.iter().any(ends) && !self.graph.roots().any(|root| root == id) {
            return None;
        }
        let made = self.grouped(poly)?;
        let (products, most) = self.cone(id);
        let fewer = made
            .0
            .iter()
            .map(|group| self.products(group))
            .sum::<usize>()
            < products;
        (fewer && self.is_sound(&made, most)).then_some(made)
    }

    /// A polynomial's terms by what does not hang on counters, and where the factors of two are
    /// the same but for a number, by these.
    fn grouped(&self, poly: &Poly) -> Option<Collected> {
        let mut by_rest: BTreeMap<Monomial, Poly> = BTreeMap::new();
        for (monomial, number) in &poly.terms {
            let (own, rest): (Monomial, Monomial) =
                (monomial.iter()).partition(|(atom, _)| self.hangs(NodeId(*atom)));
            let term = Poly {
                terms: BTreeMap::from([(own, *number)]),
            };
            let sum = by_rest.entry(rest).or_default();
            *sum = sum.add(&term)?;
        }
        let mut groups: Vec<(Poly, Poly)> = Vec::new();
        for (rest, factor) in by_rest {
            let lead = factor.lead();
            let factor = factor.scaled(lead.inverse()?);
            let rest = Poly {
                terms: BTreeMap::from([(rest, lead)]),
            };
            match groups.iter_mut().find(|(of, _)| *of == factor) {
                Some((_, sum)) => *sum = sum.add(&rest)?,
                None => groups.push((factor, rest)),
            }
        }
        // Numbers belong to what is worked out beforehand.
        let moved = |(factor, rest): (Poly, Poly)| match factor.value() {
            Some(_) => Some((factor, rest)),
            None => Some((
                factor.scaled(rest.lead()),
                rest.scaled(rest.lead().inverse()?),
            )),
        };
        let groups: Option<Vec<(Poly, Poly)>> = groups.into_iter().map(moved).collect();
        Some(Collected(groups?))
    }

    /// How many products a turn takes for a group.
    fn products(&self, (factor, rest): &(Poly, Poly)) -> usize {
        let by_factor = usize::from(factor.value().is_none() && rest.value().is_none());
        let changes = |atom: &Atom| {
            let by = self.rates.rate(NodeId(*atom));
            by.iter().any(|by| matches!(by, Dependence::Loop(_)))
        };
        if !rest.atoms().iter().any(changes) {
            return by_factor;
        }
        let of = |monomial: &Monomial| monomial.iter().map(|(_, power)| *power as usize).sum();
        let inside = rest.terms.keys().map(|m| usize::saturating_sub(of(m), 1));
        by_factor + inside.sum::<usize>()
    }

    /// How many products a value takes as it is, and the greatest magnitude on the way.
    fn cone(&self, id: NodeId) -> (usize, f64) {
        let (mut products, mut most) = (0, 0.0_f64);
        let mut seen = FxHashSet::from_iter([id]);
        let mut open = vec![id];
        while let Some(id) = open.pop() {
            most = most.max(self.size(id));
            if self.polys[id.0 as usize].is_none() {
                continue;
            }
            if let Node::Apply(Op::Mul, [a, b]) = self.graph.node(id) {
                let whole = |of: NodeId| self.graph.constant(of).is_some();
                products += usize::from(!whole(a) && !whole(b));
            }
            open.extend(self.graph.node(id).operands().filter(|of| seen.insert(*of)));
        }
        (products, most)
    }

    fn size(&self, id: NodeId) -> f64 {
        let range = self.ranges.result.get(id.0 as usize);
        range.map_or(f64::INFINITY, |range| range.magnitude())
    }

    /// What a polynomial's terms come to at most, together.
    fn sizes(&self, poly: &Poly) -> f64 {
        let term = |(monomial, number): (&Monomial, &Number)| {
            let power = |(atom, power): &(Atom, u32)| self.size(NodeId(*atom)).powi(*power as i32);
            number.real().abs() * monomial.iter().map(power).product::<f64>()
        };
        poly.terms.iter().map(term).sum()
    }

    /// Whether the terms may be rounded by themselves.
    fn is_sound(&self, of: &Collected, most: f64) -> bool {
        let all = of.0.iter();
        let sum: f64 = all
            .map(|(own, rest)| self.sizes(own) * self.sizes(rest))
            .sum();
        sum.is_finite() && (sum <= LARGER * most || sum * self.runtime.real.epsilon() <= SOUND)
    }
}

/// Of each value whether it is a polynomial in counters, or in others that loops carry.
fn counted(graph: &Graph) -> Vec<bool> {
    let mut counted: Vec<bool> = Vec::with_capacity(graph.nodes.len());
    for id in graph.ids() {
        let of = |id: NodeId| counted[id.0 as usize];
        counted.push(match graph.node(id) {
            Node::Const(_) | Node::Carried { .. } => true,
            Node::Apply(op, _) => {
                let reals = matches!(op, Op::Add | Op::Sub | Op::Mul | Op::Neg | Op::ToReal);
                let ints = matches!(op, Op::IntAdd | Op::IntSub | Op::IntMul | Op::IntNeg);
                (reals || ints) && graph.node(id).operands().all(of)
            }
            _ => false,
        });
    }
    counted
}

struct Emit<'b> {
    builder: &'b mut Builder,
    made: &'b [Option<NodeId>],
    span: Span,
}

impl Emit<'_> {
    fn apply(&mut self, op: Op, args: &[NodeId]) -> NodeId {
        self.builder.apply(op, args, self.span)
    }

    fn sum(&mut self, sum: Option<NodeId>, term: NodeId) -> Option<NodeId> {
        Some(sum.map_or(term, |sum| self.apply(Op::Add, &[sum, term])))
    }

    fn collected(&mut self, of: &Collected) -> Option<NodeId> {
        let mut sum = None;
        for (factor, rest) in &of.0 {
            let term = match (self.poly(factor)?, self.poly(rest)?) {
                (Some(factor), Some(rest)) => self.apply(Op::Mul, &[factor, rest]),
                (one, other) => one.or(other)?,
            };
            sum = self.sum(sum, term);
        }
        sum
    }

    /// A polynomial's value; nothing for 1.
    fn poly(&mut self, poly: &Poly) -> Option<Option<NodeId>> {
        if poly.value() == Some(Number::ONE) {
            return Some(None);
        }
        let mut sum = None;
        for (monomial, number) in &poly.terms {
            let number = number.real();
            let mut term = match number == 1.0 && !monomial.is_empty() {
                true => None,
                false => Some(self.builder.constant(Value::Real(number), self.span)),
            };
            for (atom, power) in monomial {
                let atom = self.made.get(*atom as usize).copied().flatten()?;
                for _ in 0..*power {
                    term = Some(term.map_or(atom, |of| self.apply(Op::Mul, &[of, atom])));
                }
            }
            sum = self.sum(sum, term?);
        }
        Some(sum)
    }
}

#[cfg(test)]
mod tests;
