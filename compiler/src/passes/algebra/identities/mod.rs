//! Identity discovery: values that are sums of few products of what is at hand.
//!
//! A value may follow from others in a way that nobody wrote down: with n a unit
//! normal, n·n = 1, so what a reflected ray has of the direction to another
//! sphere is the sum of a root that is known and of two of its components. Such
//! an identity holds modulo the equations that made the values, whatever they
//! are; it is found by looking for formulas whose values agree in a finite [`field`].
//!
//! A formula stands for a value where the machine needs fewer cycles for it and
//! its roundings do no more than algebra's may.

mod around;
pub mod field;
mod search;
#[cfg(test)]
mod tests;

use super::formula::Formula;
use super::formula::Found;
use super::formula::Fraction;
use crate::analysis::range::Ranges;
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::algebra::polynomial::rounding_samples::samples;
use crate::passes::algebra::polynomial::{
    Cheaper, Forms, Judge, Verdicts, allowance, end, own, users,
};
use crate::passes::rewrite::rebuild::rebuild_old;
use crate::source::Span;
pub use around::around;
use field::{Field, Print};
use rustc_hash::FxHashSet;
use search::Sums;
use slowlight_routine::{Op, Runtime, Type, Value};
use std::collections::BTreeSet;

/// Among how many values that one is made of a formula is looked for.
const VALUES: usize = 40;

/// How many formulas of a value are looked at closely.
const TRIES: usize = 8;

/// The graph with shorter formulas in the place of values that `may` be replaced;
/// nothing where there are none, or where the format bears none.
pub fn identities<'g>(
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
    let known = verdicts.formulas(|| {
        let forms = verdicts.full(graph, ranges);
        let found = Search::new(graph, ranges, forms, runtime);
        found.map_or(Vec::new(), |search| search.all())
    });
    let samples = samples(graph);
    let judge = Judge {
        graph,
        samples: &samples,
        allowance,
        end: end(runtime.real),
        followed: &verdicts.followed,
    };
    let mut sites = Vec::new();
    let next = rebuild_old(graph, &mut |b, made, id, span| {
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        let (_, found) = known.iter().find(|(at, _)| *at == id && may(id))?;
        let put = put(b, &new, found, span)?;
        judge.equal(b, &new, id, put).then(|| {
            sites.push(id);
            put
        })
    });
    (!sites.is_empty()).then_some(Cheaper { graph: next, sites })
}

struct Search<'g> {
    graph: &'g Graph,
    forms: &'g Forms<'g>,
    runtime: &'g Runtime,
    field: Field<'g>,
    prints: Vec<Option<Print>>,
    users: Vec<Vec<NodeId>>,
}

impl<'g> Search<'g> {
    fn new(
        graph: &'g Graph,
        ranges: &'g Ranges,
        forms: &'g Forms<'g>,
        runtime: &'g Runtime,
    ) -> Option<Search<'g>> {
        let field = Field::new(graph, ranges, forms);
        Some(Search {
            graph,
            prints: field.prints()?,
            field,
            forms,
            runtime,
            users: users(graph),
        })
    }

    fn all(&self) -> Vec<(NodeId, Found)> {
        let (ids, mut sums) = (self.graph.ids(), Sums::new());
        ids.filter_map(|id| Some((id, self.shorter(id, &mut sums)?)))
            .collect()
    }

    fn cycles(&self, op: Op) -> u32 {
        let found = self.runtime.usual(op);
        found.map_or(0, |r| r.cycles)
    }

    /// What computing some nodes costs, those the same for a whole row left out.
    fn cost<'n>(&self, nodes: impl Iterator<Item = &'n NodeId>) -> u32 {
        let one = |id: &NodeId| match self.graph.node(*id) {
            Node::Apply(op, _) if self.forms.pixel(*id) => self.cycles(op),
            _ => 0,
        };
        nodes.map(one).sum()
    }

    /// A formula that costs less than what is computed for a value alone.
    fn shorter(&self, id: NodeId, sums: &mut Sums) -> Option<Found> {
        let arithmetic = matches!(
            self.graph.node(id),
            Node::Apply(Op::Add | Op::Sub | Op::Mul | Op::Div, _)
        );
        let used = !self.users[id.0 as usize].is_empty();
        if !arithmetic || !used || !self.forms.pixel(id) || self.looped(id) {
            return None;
        }
        let own = own(self.graph, &self.users, id);
        let limit = self.cost(own.iter());
        if limit < 2 * self.cycles(Op::Mul) {
            return None;
        }
        let value = self.prints[id.0 as usize]?;
        let (values, prints) = self.at_hand(id);
        let two = |k: &usize| self.is_either(values[*k]);
        let by: Vec<usize> = (0..values.len()).filter(two).collect();
        sums.of(prints);
        let cost = |formula: &Formula| {
            let mut needed = FxHashSet::default();
            for k in formula.values() {
                self.own_cone(values[k], &own, &mut needed);
            }
            self.cost(needed.iter()) + self.written(formula, &values)
        };
        let all = sums.formulas(&value, &by).into_iter();
        let mut all: Vec<_> = all.map(|formula| (cost(&formula), formula)).collect();
        all.retain(|(cost, _)| *cost < limit);
        all.sort_by_key(|(cost, _)| *cost);
        let mut tries = all.into_iter().map(|(_, formula)| formula).take(TRIES);
        let formula = tries.find(|formula| self.holds(id, formula, &values))?;
        Some(Found { formula, values })
    }

    /// Whether a value is a formula whichever way conditions go.
    fn holds(&self, id: NodeId, formula: &Formula, values: &[NodeId]) -> bool {
        let made = formula.values().map(|k| values[k]);
        let all: Vec<NodeId> = made.chain([id]).collect();
        self.field
            .always(&all, &|of| formula.value(&|k| of(values[k])) == of(id))
    }

    /// Whether a value is one of two constants.
    fn is_either(&self, id: NodeId) -> bool {
        let constant = |id| self.graph.constant(id).is_some();
        match self.graph.node(id) {
            Node::Apply(Op::ToReal | Op::Neg | Op::IntNeg, [a, _]) => self.is_either(a),
            Node::Select { yes, no, .. } => constant(yes) && constant(no),
            _ => self.forms.two(id.0).is_some(),
        }
    }

    fn looped(&self, id: NodeId) -> bool {
        self.forms.looped(id)
    }

    /// Values that one is made of on every way, so that what is known where they are
    /// computed is known where it is; the nearest first, and their prints; none twice.
    fn at_hand(&self, id: NodeId) -> (Vec<NodeId>, Vec<Print>) {
        let (mut values, mut all) = (Vec::new(), Vec::<Print>::new());
        let mut todo: BTreeSet<NodeId> = self.graph.node(id).operands().collect();
        while let Some(next) = todo.pop_last() {
            if values.len() >= VALUES {
                break;
            }
            match self.graph.node(next) {
                Node::Select { cond, .. } => todo.extend([cond]),
                node => todo.extend(node.operands()),
            }
            let fits = self.forms.pixel(next) && !self.looped(next);
            let real = self.graph.ty(next) != Type::Bool && self.graph.constant(next).is_none();
            let print = self.prints[next.0 as usize];
            if let Some(print) = print.filter(|p| fits && real && p[0] != 0 && !all.contains(p)) {
                values.push(next);
                all.push(print);
            }
        }
        (values, all)
    }

    /// What of the nodes computed for a value alone another one needs.
    fn own_cone(&self, id: NodeId, own: &FxHashSet<NodeId>, needed: &mut FxHashSet<NodeId>) {
        if own.contains(&id) && needed.insert(id) {
            for used in self.graph.node(id).operands() {
                self.own_cone(used, own, needed);
            }
        }
    }

    /// What a formula itself costs.
    fn written(&self, formula: &Formula, values: &[NodeId]) -> u32 {
        let (product, sum) = (self.cycles(Op::Mul), self.cycles(Op::Add));
        let factor = |f: Fraction| match f {
            (1 | -1, 1) => 0,
            _ => product,
        };
        let first = formula.product.map_or(0, |(d, _, w)| {
            sum + factor(d) + if w.is_some() { product } else { 0 }
        });
        // A constant goes with what is the same for a run of columns.
        let by = match formula.by {
            Some(k) if self.graph.ty(values[k]) == Type::Int => product,
            Some(_) => product + factor(formula.factor),
            None => factor(formula.factor),
        };
        let inner = formula.sum.1.map_or(0, |(s, _)| sum + factor(s));
        first + by + inner
    }
}

type New<'n> = &'n dyn Fn(NodeId) -> Option<NodeId>;

/// A formula in a graph.
fn put(b: &mut Builder, new: New<'_>, found: &Found, span: Span) -> Option<NodeId> {
    let Found { formula, values } = found;
    let real = |b: &mut Builder, k: usize| {
        let node = new(values[k])?;
        Some(match b.ty(node) {
            Type::Int => b.apply(Op::ToReal, &[node], span),
            _ => node,
        })
    };
    let (u, other) = formula.sum;
    let mut sum = real(b, u)?;
    if let Some((s, v)) = other {
        let v = match v {
            Some(v) => real(b, v)?,
            None => b.constant(Value::Real(1.0), span),
        };
        sum = plus(b, sum, s, v, span);
    }
    let (sum, negative) = match formula.by {
        Some(by) => {
            let by = real(b, by)?;
            let by = scaled(b, formula.factor, by, span);
            (b.apply(Op::Mul, &[by, sum], span), (1, 1))
        }
        None if formula.factor == (-1, 1) => (sum, (-1, 1)),
        None => (scaled(b, formula.factor, sum, span), (1, 1)),
    };
    let Some((d, w, second)) = formula.product else {
        return Some(scaled(b, negative, sum, span));
    };
    let mut product = real(b, w)?;
    if let Some(second) = second {
        let second = real(b, second)?;
        product = b.apply(Op::Mul, &[product, second], span);
    }
    Some(match (d, negative) {
        ((1, 1), sign) => plus(b, product, sign, sum, span),
        (d, (1, 1)) => plus(b, sum, d, product, span),
        (d, sign) => {
            let product = scaled(b, d, product, span);
            plus(b, product, sign, sum, span)
        }
    })
}

/// a + f x.
fn plus(b: &mut Builder, a: NodeId, f: Fraction, x: NodeId, span: Span) -> NodeId {
    if f.0 < 0 {
        let x = scaled(b, (-f.0, f.1), x, span);
        b.apply(Op::Sub, &[a, x], span)
    } else {
        let x = scaled(b, f, x, span);
        b.apply(Op::Add, &[a, x], span)
    }
}

/// f x.
fn scaled(b: &mut Builder, f: Fraction, x: NodeId, span: Span) -> NodeId {
    match f {
        (1, 1) => x,
        (-1, 1) => b.apply(Op::Neg, &[x], span),
        (2, 1) => b.apply(Op::Add, &[x, x], span),
        (n, d) => {
            let factor = b.constant(Value::Real(n as f64 / d as f64), span);
            b.apply(Op::Mul, &[factor, x], span)
        }
    }
}
