//! Comparison of quotients by cross-multiplication: what a quotient is compared with says how
//! great its divisor may be.
//!
//! A shade that falls with the ray's length is a/n < t: a and the threshold t are the same
//! for a whole row or pass, n is another at each pixel. With t above 0, as n is, that is
//! a/t < n: the quotient is the same for the whole row or pass, too, and a pixel compares.
//! What is chosen from two such dividends is chosen from two such limits.
//!
//! Both sides are equal over the reals where n and t are above 0. Of n the ranges must
//! prove it; where they do not of t, the row asks, and where it is not so the quotient is
//! compared as before. Neither comparison has more roundings than the other: one quotient.

use crate::analysis::range::Ranges;
use crate::analysis::rate::{Rates, rates};
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use crate::source::Span;
use slowlight_routine::{Op, Runtime, Value};

/// The graph with limits where there are such comparisons; nothing where there are none, or
/// where divisions are no dearer than products.
pub fn cross_multiply(graph: &Graph, ranges: &Ranges, runtime: &Runtime) -> Option<Graph> {
    if !runtime.reciprocals {
        return None;
    }
    let site = Site {
        graph,
        ranges,
        rates: rates(graph),
    };
    let mut done = false;
    let next = rebuild_old(graph, &mut |builder, made, id, span| {
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        let made = site.compared(builder, &new, id, span)?;
        done = true;
        Some(made)
    });
    done.then_some(next)
}

type New<'n> = &'n dyn Fn(NodeId) -> Option<NodeId>;

struct Site<'g> {
    graph: &'g Graph,
    ranges: &'g Ranges,
    rates: Rates,
}

impl Site<'_> {
    /// A comparison of a quotient, made one of its divisor.
    fn compared(&self, b: &mut Builder, new: New<'_>, id: NodeId, span: Span) -> Option<NodeId> {
        let Node::Apply(op @ (Op::Less | Op::LessEqual), sides) = self.graph.node(id) else {
            return None;
        };
        let k = (0..2).find(|k| self.divisor(sides[*k], sides[1 - *k]).is_some())?;
        let (quotient, with) = (sides[k], sides[1 - k]);
        let (dividend, divisor) = self.divisor(quotient, with)?;
        let (with_now, divisor_now) = (new(with)?, new(divisor)?);
        let limit = self.limit(b, new, dividend, with_now, span)?;
        let ordered = |b: &mut Builder, one: NodeId, other: NodeId| {
            let args = if k == 0 { [one, other] } else { [other, one] };
            b.apply(op, &args, span)
        };
        let found = ordered(b, limit, divisor_now);
        if self.is_above_0(with) {
            return Some(found);
        }
        let quotient = new(quotient)?;
        let before = ordered(b, quotient, with_now);
        let zero = b.constant(Value::Real(0.0), span);
        let above = b.apply(Op::Less, &[zero, with_now], span);
        Some(b.select(above, found, before, span))
    }

    /// A quotient's dividend and divisor, if it is the divisor that makes it another at each
    /// pixel, and what it is compared with is not.
    fn divisor(&self, quotient: NodeId, with: NodeId) -> Option<(NodeId, NodeId)> {
        let Node::Apply(Op::Div, [dividend, divisor]) = self.graph.node(quotient) else {
            return None;
        };
        let still = |id| self.rates.is_still(id);
        let arms = match self.graph.node(dividend) {
            Node::Select { yes, no, .. } => still(yes) && still(no),
            _ => still(dividend),
        };
        let fits = arms && still(with) && !still(divisor) && self.is_above_0(divisor);
        fits.then_some((dividend, divisor))
    }

    fn is_above_0(&self, id: NodeId) -> bool {
        match self.graph.constant(id) {
            Some(value) => value.real() > 0.0,
            None => (self.ranges.result.get(id.0 as usize)).is_some_and(|range| range.lo > 0.0),
        }
    }

    /// What a divisor must be above or below.
    fn limit(
        &self,
        b: &mut Builder,
        new: New<'_>,
        dividend: NodeId,
        with: NodeId,
        span: Span,
    ) -> Option<NodeId> {
        match self.graph.node(dividend) {
            Node::Select { cond, yes, no } if !self.rates.is_still(dividend) => {
                let [yes, no] = [new(yes)?, new(no)?].map(|a| b.apply(Op::Div, &[a, with], span));
                Some(b.select(new(cond)?, yes, no, span))
            }
            _ => Some(b.apply(Op::Div, &[new(dividend)?, with], span)),
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::analysis::verify::verify;
    use crate::eval::native::Native;
    use crate::planner::context::Context;
    use crate::scene;
    use crate::schedule::analysed::Analysed;
    use crate::sema::Options;
    use crate::targets::{find, formats};

    /// One whose divisions are dear.
    fn runtime() -> &'static Runtime {
        let mut all = formats(find("6502:plain").unwrap()).map(|target| target.runtime);
        all.find(|runtime| runtime.reciprocals).unwrap()
    }

    fn settled(source: &str) -> Analysed {
        let scene = scene::check("test", source);
        assert!(scene.is_right(), "{source}: {:?}", scene.diagnostics);
        let graph = scene.lower(&Options::default()).unwrap();
        let runtime = find("6502:plain").unwrap().runtime;
        Context::new(graph.clone(), runtime).simplified(&graph)
    }

    /// Quotients that pixels compute whatever they compare.
    fn quotients(graph: &Graph) -> usize {
        let (reached, rates) = (graph.reached(), rates(graph));
        let quotient = |id: &NodeId| {
            let div = matches!(graph.node(*id), Node::Apply(Op::Div, _));
            reached[id.0 as usize] && div && !rates.is_still(*id)
        };
        graph.ids().filter(quotient).count()
    }

    /// The picture of a comparison of quotients by `n` of the column.
    fn picture(comparison: &str, n: &str) -> String {
        format!(
            "image 32 x 16 inks black, white;
             draw (x, y) = {{
               let n = {n};
               let t = (y + 1) / 4;
               let u = y - 5.5;
               ink(if {comparison} then 1 else 0)
             }};"
        )
    }

    #[test]
    fn a_pixel_compares_the_divisor() {
        for (comparison, left) in [
            ("7 / n < t", 0),
            ("t < 7 / n", 0),
            ("u / n <= t", 0),
            ("t <= u / n", 0),
            ("(if x > y then u else 3.0) / n < t", 0),
            // Where u is not above 0 the quotient is asked.
            ("7 / n < u", 1),
        ] {
            let plain = settled(&picture(comparison, "(x - 16) * (x - 16) / 8 + 1"));
            let made = cross_multiply(&plain.graph, &plain.ranges, runtime()).unwrap();
            verify(&made).unwrap();
            assert_eq!(quotients(&plain.graph), 1);
            assert_eq!(quotients(&made), left, "{comparison}: {made}");
            let (mut before, mut after) = (Native::new(&plain.graph), Native::new(&made));
            for y in 0..16 {
                for x in 0..32 {
                    let inks = [&mut before, &mut after].map(|graph| graph.pixel(x, y).ink);
                    assert_eq!(inks[0], inks[1], "{comparison} at {x}, {y}");
                }
            }
        }
    }

    #[test]
    fn other_quotients_are_compared_as_before() {
        for (comparison, n) in [
            // A divisor that may be 0, what is compared with another at each pixel, and a
            // dividend that is.
            ("7 / n < t", "(x - 16) * (x - 16) / 8"),
            ("7 / n < x", "x + 1"),
            ("x / n < t", "x + 1"),
        ] {
            let plain = settled(&picture(comparison, n));
            assert!(
                cross_multiply(&plain.graph, &plain.ranges, runtime()).is_none(),
                "{comparison}"
            );
        }
    }
}
