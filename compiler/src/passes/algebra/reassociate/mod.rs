//! Reassociation: fewer additions at a pixel, by what sums are made of.
//!
//! - What is the same for a run of columns, or longer, is added together first:
//!   (x + j r) - q is j r + (x - q).
//! - What all terms are divided by divides their sum: a/s + b/s is (a + b)/s. The
//!   way from a hit to the light by the normal is then there for its sign and, over its
//!   length, for the light that falls.
//! - What several sums have is added once: of a + b + c and d + b + c, b + c.
//! - Sums that differ by what is the same for a run are made of one of them
//!   ([`Site::From`]): a value is held moved by what most of its users would add.
//! - A factor that divides its own product goes.
//!
//! Both sides are equal over the reals: what is divided by is proved not to be 0.
//! A sum of terms that are themselves rounded is off by no more than their number
//! times what their roundings do, in any order: what is known beforehand is at most
//! as large as the rest together and the sum. Where that is not so, roundings are
//! judged as algebra's are.

mod ends;
mod put;
mod terms;
#[cfg(test)]
mod tests;

use crate::analysis::range::Ranges;
use crate::analysis::rate::{Rates, rates};
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::algebra::polynomial::rounding_samples::{Sample, samples};
use crate::passes::algebra::polynomial::{Followed, Judge, allowance, end, users};
use crate::passes::rewrite::rebuild::{Trace, traced_old};
use crate::schedule::segment::Known;
pub use ends::sunk;
use rustc_hash::{FxHashMap, FxHashSet};
use slowlight_routine::{Op, Runtime, Type};
use terms::{Product, Term};

/// What may be put.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Site {
    /// A sum, its terms gathered; or a quotient, without what goes against itself.
    Gathered(NodeId),
    /// A sum of which all terms are divided by one value: it is once.
    Divided(NodeId),
    /// The sums that differ from one by what is the same for a run, made of that.
    From(NodeId),
}

/// A value that is what a group has in common, or its negative, and something known.
#[derive(Clone, Debug, PartialEq)]
struct Member {
    id: NodeId,
    /// Whether it has the negative of what is common.
    minus: bool,
    /// What is added to that.
    low: Vec<Term>,
}

/// The terms that the members of a group have in common, the first one positive.
type Common = Vec<Term>;

/// What is put.
type Sites = FxHashSet<Site>;

/// A group, and the member from which the others are made.
struct MadeFrom<'s> {
    common: &'s Common,
    group: &'s [Member],
    base: &'s Member,
}

/// A value as a member of its group, and what it is made from.
fn base<'s>(
    id: NodeId,
    made_from: &[MadeFrom<'s>],
) -> Option<(&'s Common, &'s Member, &'s Member)> {
    made_from.iter().find_map(|from| {
        let member = from.group.iter().find(|member| member.id == id)?;
        Some((from.common, member, from.base))
    })
}

/// A graph with sums in other forms.
pub struct Regrouped {
    pub graph: Graph,
    /// The values of the old graph in the place of which something else stands.
    pub changed: Vec<NodeId>,
    pub trace: Trace,
}

/// What is known of a graph's sums, whichever of them are put in another form.
pub struct Sums<'g> {
    graph: &'g Graph,
    ranges: &'g Ranges,
    runtime: &'g Runtime,
    users: Vec<Vec<NodeId>>,
    rates: Rates,
    /// What runs of columns know, on machines that have such.
    known: Option<Known<'g>>,
    samples: Vec<Sample>,
    allowance: f64,
    end: f64,
    followed: Followed,
    groups: FxHashMap<Common, Vec<Member>>,
}

impl<'g> Sums<'g> {
    pub fn new(graph: &'g Graph, ranges: &'g Ranges, runtime: &'g Runtime) -> Sums<'g> {
        let mut sums = Sums {
            graph,
            ranges,
            runtime,
            users: users(graph),
            rates: rates(graph),
            known: runtime.segments.then(|| Known::of(graph)),
            samples: samples(graph),
            allowance: allowance(runtime),
            end: end(runtime.real),
            followed: Followed::local(),
            groups: FxHashMap::default(),
        };
        sums.groups = sums.grouped();
        sums
    }

    /// Where sums might be cheaper; nothing in formats whose sums are exact anyway.
    pub fn sites(&self) -> Vec<Site> {
        if self.runtime.real.is_fixed() {
            return Vec::new();
        }
        let gathered = self.graph.ids().filter(|id| self.is_site(*id));
        let mut all: Vec<Site> = gathered.map(Site::Gathered).collect();
        let divided = self.graph.ids().filter(|id| self.is_divided(*id));
        all.extend(divided.map(Site::Divided));
        for group in self.groups.values().filter(|group| group.len() > 1) {
            let bases = group.iter().filter(|member| self.is_sum(member.id));
            all.extend(bases.map(|member| Site::From(member.id)));
        }
        all
    }

    /// The graph with sums at some sites put in the other form; nothing where none is.
    pub fn regrouped(&self, sites: &[Site]) -> Option<Regrouped> {
        let sites: Sites = sites.iter().copied().collect();
        let (pairs, made_from) = (self.pairs(&sites), self.made_from(&sites));
        let mut changed = Vec::new();
        let (graph, trace) = traced_old(self.graph, &mut |builder, made, id, span| {
            let mut put = put::Put {
                sums: self,
                pairs: &pairs,
                builder,
                made,
                span,
                proved: false,
            };
            let found = match base(id, &made_from) {
                Some(base) => put.made_from(id, base),
                None if sites.contains(&Site::Divided(id)) => put.gathered(id, true),
                None if sites.contains(&Site::Gathered(id)) => put.gathered(id, false),
                None => None,
            }?;
            let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
            let sound = put.proved || self.judged(put.builder, &new, id, found);
            sound.then(|| {
                changed.push(id);
                found
            })
        });
        let made = Regrouped {
            graph,
            changed,
            trace,
        };
        (!made.changed.is_empty()).then_some(made)
    }

    /// Whether a value is known before a run of columns, or a row.
    fn low(&self, id: NodeId) -> bool {
        match &self.known {
            Some(known) => known.before(id),
            None => self.rates.is_still(id),
        }
    }

    fn used(&self, id: NodeId) -> bool {
        !self.users[id.0 as usize].is_empty()
    }

    fn is_sum(&self, id: NodeId) -> bool {
        let sum = matches!(self.graph.node(id), Node::Apply(Op::Add | Op::Sub, _));
        sum && self.used(id) && !self.low(id)
    }

    /// Whether a value is a sum that is no part of another, or a quotient of a product.
    fn is_site(&self, id: NodeId) -> bool {
        match self.graph.node(id) {
            Node::Apply(Op::Add | Op::Sub, _) => {
                let part =
                    self.alone(id) && self.users[id.0 as usize].iter().all(|u| self.is_sum(*u));
                self.is_sum(id) && !part
            }
            Node::Apply(Op::Div, [a, by]) => {
                self.used(id) && !self.low(id) && self.product(a).divided(by).is_some()
            }
            _ => false,
        }
    }

    fn is_divided(&self, id: NodeId) -> bool {
        let sum = self.is_sum(id) && self.is_site(id);
        let terms = sum.then(|| self.terms(id)).flatten();
        terms.is_some_and(|terms| self.divided(&terms, true).0.is_some())
    }

    /// Whether a value is proved not to be 0.
    fn some(&self, id: NodeId) -> bool {
        let range = self.ranges.result.get(id.0 as usize);
        range.is_some_and(|r| r.lo > 0.0 || r.hi < 0.0)
    }

    /// Values by what they have in common beside what is known.
    fn grouped(&self) -> FxHashMap<Common, Vec<Member>> {
        let mut groups: FxHashMap<Common, Vec<Member>> = FxHashMap::default();
        for id in self.graph.ids().filter(|id| self.is_sum(*id)) {
            let Some(mut terms) = self.terms(id).filter(|t| !t.low.is_empty()) else {
                continue;
            };
            terms.high.sort_unstable_by_key(|t| t.id);
            let minus = terms.high.first().is_some_and(|t| t.minus);
            terms.high.iter_mut().for_each(|t| t.minus ^= minus);
            let low = terms.low;
            let member = Member { id, minus, low };
            groups.entry(terms.high).or_default().push(member);
        }
        // What one term is by itself something else may need.
        for (common, group) in &mut groups {
            let [Term { id, .. }] = common[..] else {
                continue;
            };
            let others = self.users[id.0 as usize]
                .iter()
                .filter(|user| group.iter().all(|member| member.id != **user));
            let arithmetic = matches!(self.graph.node(id), Node::Apply(..));
            if arithmetic && others.count() > 0 {
                group.push(Member {
                    id,
                    minus: false,
                    low: Vec::new(),
                });
            }
        }
        groups
    }

    /// The groups of which one member is what others are made from.
    fn made_from(&self, sites: &Sites) -> Vec<MadeFrom<'_>> {
        let groups = self.groups.iter().filter_map(|(common, group)| {
            let is_base = |m: &&Member| sites.contains(&Site::From(m.id));
            let base = group.iter().find(is_base)?;
            Some(MadeFrom {
                common,
                group,
                base,
            })
        });
        groups.collect()
    }

    /// The pairs of terms that several sums have, and how many.
    fn pairs(&self, sites: &Sites) -> FxHashMap<[Product; 2], usize> {
        let mut pairs = FxHashMap::default();
        for id in self.graph.ids() {
            let divides = sites.contains(&Site::Divided(id));
            let gathers = divides || sites.contains(&Site::Gathered(id));
            let Some(terms) = gathers.then(|| self.terms(id)).flatten() else {
                continue;
            };
            let all = self.divided(&terms, divides).1;
            for (k, a) in all.iter().enumerate() {
                for b in &all[k + 1..] {
                    *pairs.entry(pair(a, b)).or_insert(0) += 1;
                }
            }
        }
        pairs
    }

    fn judged(
        &self,
        b: &Builder,
        new: &dyn Fn(NodeId) -> Option<NodeId>,
        old: NodeId,
        made: NodeId,
    ) -> bool {
        let judge = Judge {
            graph: self.graph,
            samples: &self.samples,
            allowance: self.allowance,
            end: self.end,
            followed: &self.followed,
        };
        self.allowance >= 1.0 && self.graph.ty(old) == Type::Real && judge.sound(b, new, old, made)
    }
}

/// Two terms as what they are up to a common sign.
fn pair(a: &Product, b: &Product) -> [Product; 2] {
    let (mut a, mut b) = match a <= b {
        true => (a.clone(), b.clone()),
        false => (b.clone(), a.clone()),
    };
    b.minus ^= a.minus;
    a.minus = false;
    [a, b]
}
