//! Normal forms over polynomials and roots: values that are cheaper in another form over the
//! reals.
//!
//! The rays of a picture without turns of a loop are algebra: a direction is an
//! affine function of the column and the row divided by its length, and what a
//! ray meets is decided by polynomials in it. This pass finds such [`form`]s and
//! puts them, where a machine needs fewer cycles for them, in the place of
//!
//! - a comparison: of a difference's sign alone, so the length of a direction
//!   that is a factor of it need not be known, and a discriminant is a quadratic
//!   in the column, its coefficients the same for a whole row;
//! - a comparison of a root with something else: of their squares, with their
//!   signs kept, a|a| < b|b|, which is the same for all reals;
//! - a value that something else needs: the place on a floor is affine in the
//!   column, since the length of the ray's direction goes against itself.
//!
//! Both sides are equal over the reals wherever the value is needed: roots are of
//! what is proved to be above 0, divisors proved not to be 0. What is lost to
//! roundings is estimated on both sides ([`judge`]); the pass leaves formats
//! alone that have nothing to lose.

mod arithmetic;
mod availability;
mod decided;
mod emit;
mod ends;
mod extent;
mod form;
mod halved;
mod integral;
pub(crate) mod judge;
mod key;
pub(crate) mod number;
pub(crate) mod poly;
mod rooted;
pub(crate) mod rounding_samples;
mod same_sign;
mod span;
#[cfg(test)]
mod span_tests;
#[cfg(test)]
mod tests;
mod wholes;

use super::formula::Found;
use crate::analysis::range::Ranges;
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::algebra::polynomial::emit::Put;
pub use crate::passes::algebra::polynomial::integral::Whole;
use crate::passes::algebra::polynomial::rounding_samples::{Sample, samples};
pub(crate) use crate::passes::algebra::polynomial::same_sign::Turns;
use crate::passes::rewrite::rebuild::rebuild_old;
use crate::source::Span;
use arithmetic::multiplied;
pub use decided::decided;
use extent::Extents;
pub(crate) use form::Forms;
use form::{Form, Part, scaled};
pub use halved::Proofs;
use judge::cycles;
pub(crate) use judge::{Followed, Judge, end};
pub(crate) use number::Number;
use rustc_hash::FxHashMap;
use rustc_hash::FxHashSet;
use slowlight_routine::{Format, Op, Runtime, Type};
pub use span::spans;
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::sync::OnceLock;

/// By how much a form's roundings may exceed those of what it replaces, given
/// the format's unit roundoff: what leaves a picture twenty bits.
pub fn allowance(runtime: &Runtime) -> f64 {
    let format = runtime.real;
    match (format, runtime.int) {
        (Format::Real40 | Format::Float316 { .. }, _) => {
            (0.5f64.powi(20) / format.epsilon()).min(64.0)
        }
        // Each value has all its bits where its point is its own, and ints have more: what
        // they make exact is gained.
        (Format::Scaled { bits }, Format::Int { bits: whole }) if whole > bits => ONCE_MORE,
        // A fixed point has no relative roundings; `f416` has, but Jack no ints of 31 bits.
        _ => 0.0,
    }
}

/// One rounding more.
const ONCE_MORE: f64 = 2.0;

/// Which nodes have good forms, of those looked at.
type Good = FxHashMap<NodeId, bool>;

/// What was found out about a graph's nodes, for whoever asks again with others
/// left out.
#[derive(Default)]
pub struct Verdicts<'g> {
    /// Whether a form is good in a node's place, as seen with forms wherever they are
    /// good: that hardly depends on those left out.
    good: OnceLock<Good>,
    full: OnceLock<Forms<'g>>,
    rows: OnceLock<Forms<'g>>,
    extents: Extents,
    pub(crate) followed: Followed,
    formulas: OnceLock<Vec<(NodeId, Found)>>,
}

impl<'g> Verdicts<'g> {
    /// The forms of the graph's values.
    pub(crate) fn full(&self, graph: &'g Graph, ranges: &'g Ranges) -> &Forms<'g> {
        self.full.get_or_init(|| Forms::new(graph, ranges))
    }

    /// The same by the column and what a row computes.
    fn rows(&self, graph: &'g Graph, ranges: &'g Ranges) -> &Forms<'g> {
        self.rows.get_or_init(|| Forms::by_row(graph, ranges))
    }

    /// The formulas found for a graph's values, looked for once.
    pub(crate) fn formulas(
        &self,
        find: impl FnOnce() -> Vec<(NodeId, Found)>,
    ) -> &[(NodeId, Found)] {
        self.formulas.get_or_init(find)
    }
}

/// A graph with cheaper forms in it.
pub struct Cheaper {
    pub graph: Graph,
    /// The nodes of the old graph for which they stand.
    pub sites: Vec<NodeId>,
}

/// The graph with cheaper forms in the place of nodes that `may` be replaced;
/// nothing where there are none, or where the format bears none.
pub fn normal_forms<'g>(
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
    let forms = verdicts.full(graph, ranges);
    let site = |good: Good| Site {
        exits: exits(forms),
        users: users(graph),
        good: RefCell::new(good),
        samples: samples(graph),
        forms,
        runtime,
        allowance,
        followed: &verdicts.followed,
    };
    let good = verdicts.good.get_or_init(|| {
        let mut site = site(Good::default());
        site.put_forms(&|_| true);
        site.good.into_inner()
    });
    let found = site(good.clone()).put_forms(may);
    (!found.sites.is_empty()).then_some(found)
}

/// How often it is looked for values that are needed since those that need
/// them stay as they are.
const ROUNDS: u32 = 8;

/// What uses each value; a root of the graph or of a loop is used for good.
pub(crate) fn users(graph: &Graph) -> Vec<Vec<NodeId>> {
    let mut users = vec![Vec::new(); graph.nodes.len()];
    let reached = graph.reached();
    for id in graph.ids().filter(|id| reached[id.0 as usize]) {
        for used in graph.refers(id) {
            users[used.0 as usize].push(id);
        }
    }
    graph.roots().for_each(|id| users[id.0 as usize].push(id));
    users
}

/// Which values with a form something needs that has none.
fn exits(forms: &Forms<'_>) -> Vec<bool> {
    let graph = forms.graph;
    let mut exits = vec![false; graph.nodes.len()];
    let reached = graph.reached();
    for id in graph.ids().filter(|id| reached[id.0 as usize]) {
        if forms.get(id).is_none_or(|f| atom_of(f) == Some(id.0)) {
            for used in graph.refers(id) {
                exits[used.0 as usize] = true;
            }
        }
    }
    graph.roots().for_each(|id| exits[id.0 as usize] = true);
    exits
}

/// The atom that a form is.
fn atom_of(form: &Form) -> Option<u32> {
    match form.parts.as_slice() {
        [Part { roots, poly }] if roots.is_empty() => match poly.atoms().as_slice() {
            [atom] if *poly == poly::Poly::atom(*atom) => Some(*atom),
            _ => None,
        },
        _ => None,
    }
}

struct Site<'g> {
    forms: &'g Forms<'g>,
    exits: Vec<bool>,
    /// What uses each value, itself where it is a root of the graph or of a loop.
    users: Vec<Vec<NodeId>>,
    /// See [`Verdicts`]; what was looked at since, too.
    good: RefCell<Good>,
    samples: Vec<Sample>,
    runtime: &'g Runtime,
    allowance: f64,
    followed: &'g Followed,
}

type New<'n> = &'n dyn Fn(NodeId) -> Option<NodeId>;

impl Site<'_> {
    /// The graph with forms in the place of exits. What stays as it is needs its
    /// operands: they are looked at in turn.
    fn put_forms(&mut self, may: &dyn Fn(NodeId) -> bool) -> Cheaper {
        for _ in 0..ROUNDS {
            let sites = self.foreseen(may);
            let sites = sites.unwrap_or_else(|| self.rebuilt(may).sites);
            if !self.open(&sites) {
                break;
            }
        }
        self.rebuilt(may)
    }

    /// The graph with forms in the place of exits.
    fn rebuilt(&self, may: &dyn Fn(NodeId) -> bool) -> Cheaper {
        let mut sites = Vec::new();
        let graph = rebuild_old(self.forms.graph, &mut |builder, made, id, span| {
            let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
            let try_it = may(id) && !self.at_hand(id, &sites);
            let put = try_it.then(|| self.rewritten(builder, &new, id, span))??;
            sites.push(id);
            Some(put)
        });
        Cheaper { graph, sites }
    }

    /// Where forms would stand, if that is known of every node without putting any.
    fn foreseen(&self, may: &dyn Fn(NodeId) -> bool) -> Option<Vec<NodeId>> {
        let graph = self.forms.graph;
        let reached = graph.reached();
        let good = self.good.borrow();
        let mut sites = Vec::new();
        for id in graph.ids().filter(|id| reached[id.0 as usize]) {
            if may(id) && !self.at_hand(id, &sites) && self.looks(id) && *good.get(&id)? {
                sites.push(id);
            }
        }
        Some(sites)
    }

    /// Whether a form is looked for in a node's place.
    fn looks(&self, id: NodeId) -> bool {
        let graph = self.forms.graph;
        self.forms.pixel(id)
            && match graph.node(id) {
                Node::Apply(Op::Less | Op::LessEqual | Op::Equal, _) => true,
                Node::Apply(Op::Sign | Op::IntSign, _) => true,
                Node::Apply(..) => self.exits[id.0 as usize] && graph.ty(id) == Type::Real,
                _ => false,
            }
    }

    /// Makes exits of the operands of exits that stay as they are; whether
    /// there are any that were none.
    fn open(&mut self, replaced: &[NodeId]) -> bool {
        let graph = self.forms.graph;
        let mut more = false;
        for id in graph.ids() {
            if !self.exits[id.0 as usize] || replaced.contains(&id) {
                continue;
            }
            for used in graph.references(id) {
                let used = used.0 as usize;
                more |= !self.exits[used];
                self.exits[used] = true;
            }
        }
        more
    }

    /// What stands for a node.
    fn rewritten(&self, b: &mut Builder, new: New<'_>, id: NodeId, span: Span) -> Option<NodeId> {
        let held = self.good.borrow().get(&id).copied();
        if !self.looks(id) || held == Some(false) {
            return None;
        }
        let made = self.put(b, new, id, span);
        let judge = Judge {
            graph: self.forms.graph,
            samples: &self.samples,
            allowance: self.allowance,
            end: end(self.runtime.real),
            followed: self.followed,
        };
        let good = |made| self.cheaper(b, new, id, made) && judge.sound(b, new, id, made);
        let good = held.unwrap_or_else(|| made.is_some_and(good));
        self.good.borrow_mut().insert(id, good);
        made.filter(|_| good)
    }

    /// A node's form.
    fn put(&self, b: &mut Builder, new: New<'_>, id: NodeId, span: Span) -> Option<NodeId> {
        let mut put = Put {
            forms: self.forms,
            builder: b,
            new,
            span,
        };
        match self.forms.graph.node(id) {
            Node::Apply(op @ (Op::Less | Op::LessEqual | Op::Equal), [x, y]) => {
                let (x, y) = (self.forms.get(x)?, self.forms.get(y)?);
                let difference = self.forms.sum(x, &scaled(y, Number::whole(-1)))?;
                compared(&mut put, op, &difference)
            }
            Node::Apply(Op::Sign | Op::IntSign, _) => {
                let two = self.forms.two(id.0).filter(|two| two.low == -1)?;
                put.sign(id, two)
            }
            _ => {
                let form = self.forms.get(id).filter(|f| atom_of(f).is_none())?;
                put.value(form)
            }
        }
    }

    /// Whether a form costs less than what it stands for: for a comparison all
    /// that it needs, since what else needs that may be a comparison, too; for a
    /// value what is computed for it alone.
    fn cheaper(&self, b: &Builder, new: New<'_>, id: NodeId, made: NodeId) -> bool {
        let graph = self.forms.graph;
        if graph.ty(id) == Type::Bool {
            let none = |_| false;
            return cycles(b, made, self.runtime, &none) < cycles(graph, id, self.runtime, &none);
        }
        let own = own(graph, &self.users, id);
        let others = (0..id.0).map(NodeId).filter(|old| !own.contains(old));
        let mut todo: Vec<NodeId> = others.filter_map(new).collect();
        let mut shared = FxHashSet::default();
        while let Some(id) = todo.pop() {
            if shared.insert(id) {
                todo.extend(b.node(id).operands());
            }
        }
        let now = cycles(b, made, self.runtime, &|id| shared.contains(&id));
        now < cycles(graph, id, self.runtime, &|id| !own.contains(&id))
    }
}

/// What is computed for a value alone.
pub(crate) fn own(graph: &Graph, users: &[Vec<NodeId>], id: NodeId) -> FxHashSet<NodeId> {
    let mut own = FxHashSet::from_iter([id]);
    let mut todo: BTreeSet<NodeId> = graph.node(id).operands().collect();
    while let Some(next) = todo.pop_last() {
        if users[next.0 as usize].iter().all(|u| own.contains(u)) {
            own.insert(next);
            todo.extend(graph.node(next).operands());
        }
    }
    own
}

/// Whether a form is less than 0, at most 0, or 0.
fn compared(put: &mut Put<'_, '_>, op: Op, form: &Form) -> Option<NodeId> {
    match form.parts.as_slice() {
        [part] => put.test(op, &part.poly),
        [a, b] => {
            // p s^k + q s^l < 0 as p s^(k-l) < -q, and that squared.
            let down = |part: &Part| part.roots.iter().map(|(_, k)| *k).sum::<i32>();
            let (a, b) = if down(a) >= down(b) { (a, b) } else { (b, a) };
            let inverse = b.roots.iter().map(|(r, k)| (*r, -k)).collect();
            let left = put.signed_square(&Part {
                roots: multiplied(&a.roots, &inverse),
                poly: a.poly.clone(),
            })?;
            let right = put.signed_square(&Part {
                roots: Vec::new(),
                poly: b.poly.scaled(Number::whole(-1)),
            })?;
            Some(put.builder.apply(op, &[left, right], put.span))
        }
        _ => None,
    }
}
