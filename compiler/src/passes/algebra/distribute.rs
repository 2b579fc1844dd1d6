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

/// How far sums of whole numbers are looked into.
const DEEP: u32 = 6;

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
        let (factors, sum) = site.product(id)?;
        let Node::Apply(op, terms) = graph.node(sum) else {
            return None;
        };
        let new = |id: NodeId| made.get(id.0 as usize).copied().flatten();
        let [a, b] = terms.map(|term| put(builder, &new, &factors, term, span));
        done = true;
        Some(builder.apply(op, &[a?, b?], span))
    });
    done.then_some(next)
}

/// A factor, or what is divided by.
type Factor = (Op, NodeId);

/// A term with all the factors, as they stood around the sum.
fn put(
    builder: &mut Builder,
    new: &dyn Fn(NodeId) -> Option<NodeId>,
    factors: &[Factor],
    term: NodeId,
    span: Span,
) -> Option<NodeId> {
    let mut made = new(term)?;
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
    /// The factors of a product, the outermost first, and the sum of which both terms change less
    /// often than it.
    fn product(&self, id: NodeId) -> Option<(Vec<Factor>, NodeId)> {
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
        let Node::Apply(Op::Add | Op::Sub, terms) = self.graph.node(at) else {
            return None;
        };
        let by: Vec<NodeId> = factors.iter().map(|(_, by)| *by).collect();
        let all = self.changes(&[&by[..], &[at]].concat());
        let pays = |term: NodeId| {
            let needs = self.changes(&[&by[..], &[term]].concat());
            needs.len() < all.len() && self.fits(term, (at, id)) && !self.is_exact(term, DEEP)
        };
        (!factors.is_empty() && terms.into_iter().all(pays)).then_some((factors, at))
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
    /// two such are opposite, nothing is left, as it is meant.
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
    }

    #[test]
    fn what_changes_as_often_or_is_exact_stays() {
        assert_eq!(products("a * (x * 0.3 + x * y * 0.7)"), None);
        assert_eq!(products("a * ((x - 9) - (y - 9))"), None);
        assert_eq!(products("x * (x * 0.7 + y * 0.3)"), None);
    }
}
