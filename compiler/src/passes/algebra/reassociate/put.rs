//! Emission of reassociated sums.

use super::terms::{Factor, Product, Term, Terms};
use super::{Common, Member, Sums, pair};
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::source::Span;
use rustc_hash::FxHashMap;
use slowlight_routine::{Op, Type, Value};

/// How much larger than what a sum had to add is what it has to add to another.
const LARGER: f64 = 16.0;

/// How deep what is known beforehand is copied.
const DEEP: u32 = 20;

/// A term that is made.
#[derive(Clone)]
struct Piece {
    minus: bool,
    node: NodeId,
    key: Product,
}

pub(super) struct Put<'p, 'g> {
    pub sums: &'p Sums<'g>,
    pub pairs: &'p FxHashMap<[Product; 2], usize>,
    pub builder: &'p mut Builder,
    pub made: &'p [Option<NodeId>],
    pub span: Span,
    /// Whether roundings are known to do hardly more than they did.
    pub proved: bool,
}

impl Sums<'_> {
    /// What all terms are divided by, if that is asked for and anything, and the terms
    /// without. Squares stay: whose length is asked for is known by them.
    pub(super) fn divided(&self, terms: &Terms, asked: bool) -> (Option<NodeId>, Vec<Product>) {
        let all: Vec<Product> = (terms.high.iter().chain(&terms.low))
            .map(|term| {
                let mut product = self.product(term.id);
                product.minus ^= term.minus;
                product
            })
            .collect();
        let square = |term: &Term| matches!(self.graph.node(term.id), Node::Apply(Op::Mul, [a, b]) if a == b);
        let fits = asked && all.len() > 1 && !terms.high.iter().any(square);
        let candidates = all
            .first()
            .filter(|_| fits)
            .map_or(&[][..], |p| &p.divisors);
        let common = (candidates.iter().copied())
            .find(|by| self.some(*by) && all.iter().all(|p| p.divisors.contains(by)));
        let Some(by) = common else {
            return (None, all);
        };
        let without = |mut product: Product| {
            let at = product.divisors.iter().position(|d| *d == by);
            at.map(|at| product.divisors.remove(at));
            product
        };
        (Some(by), all.into_iter().map(without).collect())
    }
}

impl Product {
    /// The product without a factor that is a value; nothing where it has no such.
    pub(super) fn divided(&self, by: NodeId) -> Option<Product> {
        let mut rest = self.clone();
        let at = rest.factors.iter().position(|f| *f == Factor::Value(by))?;
        rest.factors.remove(at);
        Some(rest)
    }
}

impl Put<'_, '_> {
    fn made(&self, old: NodeId) -> Option<NodeId> {
        self.made.get(old.0 as usize).copied().flatten()
    }

    /// What stands for a value: where it is known beforehand it may come later in the graph.
    fn at(&mut self, old: NodeId, deep: u32) -> Option<NodeId> {
        if let Some(made) = self.made(old) {
            return Some(made);
        }
        if deep > DEEP {
            return None;
        }
        match self.sums.graph.node(old) {
            Node::Const(c) => Some(self.builder.constant(c.value(), self.span)),
            Node::Axis(axis) => Some(self.builder.axis(axis, self.span)),
            Node::Apply(op, args) => {
                let args: Option<Vec<NodeId>> = (args.iter().take(op.arity()))
                    .map(|arg| self.at(*arg, deep + 1))
                    .collect();
                Some(self.builder.apply(op, &args?, self.span))
            }
            Node::Select { cond, yes, no } => {
                let [cond, yes, no] = [cond, yes, no].map(|id| self.at(id, deep + 1));
                Some(self.builder.select(cond?, yes?, no?, self.span))
            }
            _ => None,
        }
    }

    /// A value's own operation on what stands for its operands.
    fn plain(&mut self, old: NodeId) -> Option<NodeId> {
        let Node::Apply(op, args) = self.sums.graph.node(old) else {
            return self.made(old);
        };
        let args: Option<Vec<NodeId>> = (args.iter().take(op.arity()))
            .map(|arg| self.made(*arg))
            .collect();
        Some(self.builder.apply(op, &args?, self.span))
    }

    /// The product of its factors over its divisors.
    fn product(&mut self, product: &Product) -> Option<NodeId> {
        let mut all: Option<NodeId> = None;
        for factor in &product.factors {
            let next = match factor {
                Factor::Value(id) => self.made(*id)?,
                Factor::Size(_) => self.builder.constant(factor.size()?, self.span),
            };
            all = Some(match all {
                Some(all) => self.builder.apply(Op::Mul, &[all, next], self.span),
                None => next,
            });
        }
        let mut all = match all {
            Some(all) => all,
            None => self.builder.constant(Value::Real(1.0), self.span),
        };
        for by in &product.divisors {
            let by = self.made(*by)?;
            all = self.builder.apply(Op::Div, &[all, by], self.span);
        }
        Some(all)
    }

    fn pieces(&mut self, terms: &[Term]) -> Option<Vec<Piece>> {
        let all = terms.iter().map(|term| {
            Some(Piece {
                minus: term.minus,
                node: self.at(term.id, 0)?,
                key: Product::default(),
            })
        });
        all.collect()
    }

    /// Some pieces added up, in their order but for one that is not negative first.
    fn sum(&mut self, pieces: &[Piece]) -> Option<Piece> {
        let first = pieces.iter().position(|p| !p.minus).unwrap_or(0);
        let mut all = pieces.get(first)?.clone();
        let turned = all.minus;
        for (_, piece) in pieces.iter().enumerate().filter(|(k, _)| *k != first) {
            let op = if piece.minus == turned {
                Op::Add
            } else {
                Op::Sub
            };
            all.node = self.builder.apply(op, &[all.node, piece.node], self.span);
        }
        Some(all)
    }

    /// A piece's value, with its sign.
    fn signed(&mut self, piece: Piece) -> NodeId {
        match piece.minus {
            true => self.builder.apply(Op::Neg, &[piece.node], self.span),
            false => piece.node,
        }
    }

    /// What is known added to the rest.
    fn joined(&mut self, high: Piece, low: &[Piece]) -> NodeId {
        let Some(low) = self.sum(low) else {
            return self.signed(high);
        };
        if self.builder.value(low.node) == Some(Value::Real(0.0)) {
            return self.signed(high);
        }
        let both = match high.minus {
            true => [low, high],
            false => [high, low],
        };
        self.sum(&both).map_or(both[0].node, |sum| self.signed(sum))
    }

    /// A sum with its terms gathered, or a quotient without a factor of both sides.
    pub(super) fn gathered(&mut self, id: NodeId, divided: bool) -> Option<NodeId> {
        let found = match self.sums.graph.node(id) {
            Node::Apply(Op::Div, [a, by]) => {
                let product = self.sums.product(a).divided(by);
                let product = product.filter(|_| self.sums.some(by))?;
                let node = self.product(&product)?;
                self.proved = true;
                self.signed(Piece {
                    minus: product.minus,
                    node,
                    key: Product::default(),
                })
            }
            _ => self.gathered_sum(id, divided)?,
        };
        (self.plain(id) != Some(found)).then_some(found)
    }

    fn gathered_sum(&mut self, id: NodeId, divided: bool) -> Option<NodeId> {
        let sums = self.sums;
        let terms = sums.terms(id)?;
        let (by, products) = sums.divided(&terms, divided);
        let (mut high, mut low) = (Vec::new(), Vec::new());
        let (mut rounded, mut exact) = (true, 0);
        for (term, key) in terms.high.iter().chain(&terms.low).zip(products) {
            let known = sums.is_low(&key);
            let (minus, node) = match by {
                Some(_) => (key.minus, self.product(&key)?),
                None => (term.minus, self.at(term.id, 0)?),
            };
            let loose = by.is_none() && !sums.rounded(term.id);
            match known {
                true => exact += usize::from(loose),
                false => rounded &= !loose,
            }
            let piece = Piece { minus, node, key };
            if known { &mut low } else { &mut high }.push(piece);
        }
        self.proved = rounded && exact <= 2;
        self.paired(&mut high);
        let high = self.sum(&high)?;
        let sum = self.joined(high, &low);
        Some(match by {
            Some(by) => {
                let by = self.made(by)?;
                self.builder.apply(Op::Div, &[sum, by], self.span)
            }
            None => sum,
        })
    }

    /// Two terms that another sum has, too, are added first.
    fn paired(&mut self, pieces: &mut Vec<Piece>) {
        if pieces.len() < 3 {
            return;
        }
        let mut best: Option<(usize, usize, usize)> = None;
        for k in 0..pieces.len() {
            for l in k + 1..pieces.len() {
                let pair = pair(&pieces[k].key, &pieces[l].key);
                let count = self.pairs.get(&pair).copied().unwrap_or(0);
                if count > 1 && best.is_none_or(|(most, ..)| count > most) {
                    best = Some((count, k, l));
                }
            }
        }
        let Some((_, k, l)) = best else {
            return;
        };
        let (b, a) = (pieces.remove(l), pieces.remove(k));
        let (a, b) = if a.key.is_before(&b.key) {
            (a, b)
        } else {
            (b, a)
        };
        let op = if a.minus == b.minus { Op::Add } else { Op::Sub };
        let node = self.builder.apply(op, &[a.node, b.node], self.span);
        pieces.insert(0, Piece { node, ..a });
    }

    /// A member of a group made of another.
    pub(super) fn made_from(
        &mut self,
        id: NodeId,
        (common, member, base): (&Common, &Member, &Member),
    ) -> Option<NodeId> {
        let sums = self.sums;
        let group = sums.groups.get(common)?;
        let mut high = Vec::new();
        for term in common {
            let node = match group.iter().any(|m| m.id == term.id) {
                true => self.plain(term.id)?,
                false => self.made(term.id)?,
            };
            high.push(Piece {
                minus: term.minus,
                node,
                key: Product::default(),
            });
        }
        let mut high = self.sum(&high)?;
        high.minus ^= base.minus;
        let held = self.pieces(&base.low)?;
        let node = self.joined(high, &held);
        self.proved = member == base && common.iter().all(|t| sums.rounded(t.id));
        let turned = member.minus != base.minus;
        let low = difference(&member.low, &base.low, turned);
        let low = self.pieces(&low)?;
        if let Some(own) = self.constant(&member.low)
            && let Some(known) = self.sum(&low).map(|p| self.signed(p))
            && let Some(Value::Real(known)) = self.builder.value(known)
        {
            self.proved |= known.abs() <= LARGER * own.abs();
        }
        let found = match member == base {
            true => node,
            false => {
                let high = Piece {
                    minus: turned,
                    node,
                    key: Product::default(),
                };
                self.joined(high, &low)
            }
        };
        (self.plain(id) != Some(found)).then_some(found)
    }

    /// What some terms are together, where that is a constant.
    fn constant(&self, terms: &[Term]) -> Option<f64> {
        let mut all = 0.0;
        for term in terms {
            let value = self.sums.graph.constant(term.id)?;
            let value = (value.ty() == Type::Real).then(|| value.real())?;
            all += if term.minus { -value } else { value };
        }
        (!terms.is_empty()).then_some(all)
    }
}

impl Product {
    /// An order of products up to their signs.
    fn is_before(&self, other: &Product) -> bool {
        (&self.factors, &self.divisors) <= (&other.factors, &other.divisors)
    }
}

/// Some terms less others, or with those where `turned`; what goes against itself is left out.
fn difference(terms: &[Term], less: &[Term], turned: bool) -> Vec<Term> {
    let mut all = terms.to_vec();
    for term in less {
        let minus = term.minus == turned;
        match all.iter().position(|t| t.id == term.id && t.minus != minus) {
            Some(at) => drop(all.remove(at)),
            None => all.push(Term { minus, ..*term }),
        }
    }
    all
}
