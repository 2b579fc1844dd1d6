//! Loop-invariant reassociation by the distributive law: a product with a sum whose terms change
//! less often than the sum becomes a sum of products.
//!
//! `zoom * (cx * cos(a) - cy * sin(a))`, cx of the column and cy of the row, is
//! `zoom * (cx * cos(a)) - zoom * (cy * sin(a))`: both products leave the pixel, for the column's
//! array and for the row. (Expression reassociation for code motion: Briggs and Cooper, Effective
//! Partial Redundancy Elimination, 1994.)

use crate::analysis::range::Ranges;
use crate::analysis::rate::{Dependence, Rates, rates};
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use crate::source::Span;
use rustc_hash::FxHashSet;
use slowlight_routine::Op;

/// How much larger than the product one of its parts may be: so much of what the format holds is
/// lost where they are nearly opposite.
const LARGER: f64 = 8.0;

/// How far sums are looked into.
const DEEP: u32 = 6;

/// How many terms sums in sums may have.
const TERMS: usize = 6;

/// How many factors one behind the other are looked at.
const FACTORS: usize = 4;

/// The graph with such sums; nothing where there are none.
pub fn distribute(graph: &Graph, ranges: &Ranges) -> Option<Graph> {
    let site = Site {
        graph,
        ranges,
        rates: rates(graph),
    };
    let mut done = false;
    let next = rebuild_old(graph, &mut |builder, made, id, span| {
        let (factors, terms) = site.product(id)?;
        let new = |id: NodeId| made.get(id.0 as usize).copied().flatten();
        let mut parts = Vec::new();
        for group in site.groups(terms) {
            let terms = group.iter().map(|term| Some((new(term.id)?, term.plus)));
            let (sum, plus) = sum_of(builder, &terms.collect::<Option<Vec<_>>>()?, span)?;
            parts.push((put(builder, &new, &factors, sum, span)?, plus));
        }
        done = true;
        sum_of(builder, &parts, span).map(|(sum, _)| sum)
    });
    done.then_some(next)
}

/// A factor, or what is divided by.
type Factor = (Op, NodeId);

/// A term of a sum, added or taken away.
#[derive(Clone, Copy)]
struct Term {
    id: NodeId,
    plus: bool,
}

/// The sum of values that are added or taken away; its negative, and that it is, where all are
/// taken away.
fn sum_of(builder: &mut Builder, values: &[(NodeId, bool)], span: Span) -> Option<(NodeId, bool)> {
    let (added, taken): (Vec<_>, Vec<_>) = values.iter().partition(|(_, plus)| *plus);
    let plus = !added.is_empty();
    let (first, rest) = if plus {
        (added, taken)
    } else {
        (taken, Vec::new())
    };
    let ids = |of: Vec<(NodeId, bool)>| of.into_iter().map(|(id, _)| id);
    let mut add = |op, a, b| builder.apply(op, &[a, b], span);
    let sum = ids(first).reduce(|a, b| add(Op::Add, a, b))?;
    Some((ids(rest).fold(sum, |a, b| add(Op::Sub, a, b)), plus))
}

/// A value with all the factors, as they stood around the sum.
fn put(
    builder: &mut Builder,
    new: &dyn Fn(NodeId) -> Option<NodeId>,
    factors: &[Factor],
    mut made: NodeId,
    span: Span,
) -> Option<NodeId> {
    for &(op, by) in factors.iter().rev() {
        made = builder.apply(op, &[made, new(by)?], span);
    }
    Some(made)
}

struct Site<'g> {
    graph: &'g Graph,
    ranges: &'g Ranges,
    rates: Rates,
}

impl Site<'_> {
    /// The factors of a product, the outermost first, and the terms of the sum, all of which change
    /// less often than it.
    fn product(&self, id: NodeId) -> Option<(Vec<Factor>, Vec<Term>)> {
        let (mut factors, mut at) = (Vec::new(), id);
        while let Node::Apply(op @ (Op::Mul | Op::Div), [a, b]) = self.graph.node(at) {
            let fewer = |one, other| self.changes(&[one]).len() < self.changes(&[other]).len();
            let (inner, by) = match op {
                Op::Mul if fewer(a, b) => (b, a),
                _ if fewer(b, a) => (a, b),
                _ => return None,
            };
            factors.push((op, by));
            at = inner;
            if factors.len() > FACTORS {
                return None;
            }
        }
        if factors.is_empty() {
            return None;
        }
        let by: Vec<NodeId> = factors.iter().map(|(_, by)| *by).collect();
        let all = self.changes(&[&by[..], &[at]].concat());
        let pays = |term: NodeId| {
            let needs = self.changes(&[&by[..], &[term]].concat());
            needs.len() < all.len() && self.fits(term, (at, id))
        };
        let mut terms = Vec::new();
        self.terms((at, DEEP), &pays, true, &mut terms)?;
        let exact = terms.iter().all(|term| self.is_exact(term.id, DEEP));
        (!exact).then_some((factors, terms))
    }

    /// The terms of a sum, those of a sum in it where that changes too often; so deep.
    fn terms(
        &self,
        (sum, deep): (NodeId, u32),
        pays: &dyn Fn(NodeId) -> bool,
        plus: bool,
        found: &mut Vec<Term>,
    ) -> Option<()> {
        let Node::Apply(op @ (Op::Add | Op::Sub), terms) = self.graph.node(sum) else {
            return None;
        };
        for (id, plus) in terms.into_iter().zip([plus, plus == (op == Op::Add)]) {
            match pays(id) {
                true => found.push(Term { id, plus }),
                false if found.len() < TERMS && deep > 0 => {
                    self.terms((id, deep - 1), pays, plus, found)?
                }
                false => return None,
            }
        }
        Some(())
    }

    /// Terms by what they change with: what changes with less is added to the first that changes
    /// with that, too.
    fn groups(&self, terms: Vec<Term>) -> Vec<Vec<Term>> {
        let mut groups: Vec<(FxHashSet<Dependence>, Vec<Term>)> = Vec::new();
        let mut sets: Vec<_> = terms.iter().map(|term| self.changes(&[term.id])).collect();
        for k in 0..sets.len() {
            let larger = |other: &&FxHashSet<Dependence>| other.is_superset(&sets[k]);
            let most = sets.iter().filter(larger).max_by_key(|set| set.len());
            if let Some(most) = most.cloned() {
                sets[k] = most;
            }
        }
        for (term, set) in terms.into_iter().zip(sets) {
            match groups.iter_mut().find(|(of, _)| *of == set) {
                Some((_, group)) => group.push(term),
                None => groups.push((set, vec![term])),
            }
        }
        groups.into_iter().map(|(_, group)| group).collect()
    }

    /// What values change with, within a picture.
    fn changes(&self, of: &[NodeId]) -> FxHashSet<Dependence> {
        let all = of.iter().flat_map(|id| self.rates.rate(*id));
        all.copied().filter(|d| *d != Dependence::Frame).collect()
    }

    /// Whether a term of a sum, with the factors that make a product of that, is not far larger
    /// than this.
    fn fits(&self, term: NodeId, (sum, product): (NodeId, NodeId)) -> bool {
        let [term, sum, product] =
            [term, sum, product].map(|id| self.ranges.result[id.0 as usize].magnitude());
        let by = product / sum;
        by.is_finite() && term * by <= LARGER * product
    }

    /// Whether a value is whole numbers and sums of them, as far as that is looked into: where
    /// all terms are, and opposite, nothing is left, as it is meant.
    fn is_exact(&self, id: NodeId, deep: u32) -> bool {
        match self.graph.node(id) {
            Node::Apply(Op::ToReal, _) => true,
            Node::Apply(op @ (Op::Add | Op::Sub | Op::Neg), args) if deep > 0 => {
                let mut args = args[..op.arity()].iter();
                args.all(|arg| self.is_exact(*arg, deep - 1))
            }
            Node::Const(value) => value.value().real().fract() == 0.0,
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::planner::context::Context;
    use crate::scene;
    use crate::sema::Options;
    use slowlight_runtime_6502::FIXED16_16 as FIXED;

    /// How many products hang on column and row, before and after, if anything is distributed.
    fn products(shade: &str) -> Option<(usize, usize)> {
        let source = format!(
            "image 64 x 64 inks black, white; param a: real = 1 in 1 .. 3;
             draw (x, y) = threshold({shade}, 0.5);"
        );
        let checked = scene::check("test", &source);
        assert!(checked.is_right(), "{source}: {:?}", checked.diagnostics);
        let graph = checked.lower(&Options::default()).ok()?;
        let plain = Context::new(graph.clone(), &FIXED).simplified(&graph);
        let next = distribute(&plain.graph, &plain.ranges)?;
        let count = |graph: &Graph| {
            let (reached, rates) = (graph.reached(), rates(graph));
            let both = |id: &NodeId| {
                let product = matches!(graph.node(*id), Node::Apply(Op::Mul | Op::Div, _));
                let all = [Dependence::Row, Dependence::Column];
                reached[id.0 as usize] && product && all.iter().all(|d| rates.depends(*id, *d))
            };
            graph.ids().filter(both).count()
        };
        Some((count(&plain.graph), count(&next)))
    }

    #[test]
    fn products_leave_the_pixel() {
        let turned = "a * ((x - 9) * cos(a * 1rad) - (y - 9) * sin(a * 1rad))";
        assert_eq!(products(turned), Some((1, 0)));
        assert_eq!(products(&format!("({turned}) / 7")), Some((2, 0)));
        assert_eq!(
            products("0.3 * (sin(x * 1rad) + cos(y * a * 1rad))"),
            Some((1, 0))
        );
        // Also where the sum has more of them, in any order.
        assert_eq!(
            products("0.3 * (sin(x * 1rad) - (a - cos(y * a * 1rad)))"),
            Some((1, 0))
        );
    }

    #[test]
    fn what_changes_as_often_or_is_exact_stays() {
        assert_eq!(products("a * (x * 0.3 + x * y * 0.7)"), None);
        assert_eq!(products("a * ((x - 9) - (y - 9))"), None);
        assert_eq!(products("x * (x * 0.7 + y * 0.3)"), None);
    }
}
