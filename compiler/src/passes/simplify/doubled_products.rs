//! Doubled products as products with a doubled factor.
//!
//! ```text
//! p = mul(a, b); q = add(p, p)   →   d = add(a, a); q = mul(d, b)
//! ```
//!
//! Products of complex numbers and quaternions, double angles and reflections double what they
//! multiply. An interpreter keeps a product in a variable to add it to itself; a doubled factor
//! stands within the product, or serves several of them. In floating point both are the same to
//! the bit, as long as nothing overflows.

use crate::analysis::range::Ranges;
use crate::ir::graph::*;
use crate::passes::branches::square_comparisons::uses;
use crate::passes::rewrite::rebuild::rebuild_old;
use rustc_hash::FxHashMap;
use slowlight_routine::{Op, Runtime, Value};

/// Factors that may be doubled are within this.
const MOST: f64 = 1e18;

/// The graph with such products; nothing where there are none, where reals do not float, or where
/// programs are not interpreted: compiled ones double a product at no cost beside the sum's.
pub fn doubled_products(graph: &Graph, ranges: &Ranges, runtime: &Runtime) -> Option<Graph> {
    if !runtime.real.has_mantissa() || runtime.overhead.digit == 0 {
        return None;
    }
    let uses = uses(graph);
    let read = |id: NodeId| uses.get(id.0 as usize).copied().unwrap_or(0);
    let may_be_doubled = |id: NodeId| {
        let range = ranges.result.get(id.0 as usize);
        // A value that is read once would need a variable to be doubled.
        let kept = read(id) > 1 || !matches!(graph.node(id), Node::Apply(..));
        kept && graph.constant(id).is_none() && range.is_some_and(|r| r.within(-MOST, MOST))
    };
    let mut found: Vec<(NodeId, [NodeId; 2])> = Vec::new();
    let mut worth: FxHashMap<NodeId, u32> = FxHashMap::default();
    for id in graph.ids().filter(|id| read(*id) > 0) {
        let Some((of, times)) = doubled(graph, id) else {
            continue;
        };
        // What is doubled already is there to be read.
        *worth.entry(of).or_default() += 1;
        if let Node::Apply(Op::Mul, factors) = graph.node(of)
            && read(of) == times
            && factors.iter().any(|of| may_be_doubled(*of))
        {
            found.push((id, factors));
            for factor in factors {
                *worth.entry(factor).or_default() += 1;
            }
        }
    }
    if found.is_empty() {
        return None;
    }
    let found: FxHashMap<NodeId, [NodeId; 2]> = found.into_iter().collect();
    Some(rebuild_old(graph, &mut |builder, made, id, span| {
        let [a, b] = *found.get(&id)?;
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        let worth = |id: NodeId| match may_be_doubled(id) {
            true => worth.get(&id).copied().unwrap_or(0),
            false => 0,
        };
        let (twice, once) = if worth(b) > worth(a) { (b, a) } else { (a, b) };
        let (twice, once) = (new(twice)?, new(once)?);
        let sum = builder.apply(Op::Add, &[twice, twice], span);
        Some(builder.apply(Op::Mul, &[sum, once], span))
    }))
}

/// What a value is the double of, and how often it reads that.
fn doubled(graph: &Graph, id: NodeId) -> Option<(NodeId, u32)> {
    let two = |id: NodeId| graph.constant(id) == Some(Value::Real(2.0));
    match graph.node(id) {
        Node::Apply(Op::Add, [a, b]) if a == b => Some((a, 2)),
        Node::Apply(Op::Mul, [a, b]) if two(a) => Some((b, 1)),
        Node::Apply(Op::Mul, [a, b]) if two(b) => Some((a, 1)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::passes::loops::drawn::{analysed, shades};
    use slowlight_runtime_bbc::RUNTIME as MICRO;

    fn drawn(shade: &str) -> (Graph, Option<Graph>) {
        let source = format!(
            "image 24 x 16 inks black, white;
             draw (x, y) = {{
               let a = x * 0.137 - y * 0.071; let b = x * 0.05 + y * 0.03;
               threshold({shade}, 0.5)
             }};"
        );
        let plain = analysed(&source, &MICRO);
        let next = doubled_products(&plain.graph, &plain.ranges, &MICRO);
        (plain.graph.clone(), next)
    }

    #[test]
    fn doubled_products_are_of_a_doubled_factor() {
        let (plain, next) = drawn("2 * (a * b) + a - b");
        let next = next.expect("a doubled product");
        assert_eq!(shades(&plain), shades(&next));
        let reached = next.reached();
        let of = next.ids().filter(|id| reached[id.0 as usize]);
        let of: Vec<NodeId> = of
            .filter_map(|id| doubled(&next, id))
            .map(|d| d.0)
            .collect();
        assert!(!of.is_empty());
        for id in of {
            assert!(!matches!(next.node(id), Node::Apply(Op::Mul, _)));
        }
    }

    #[test]
    fn a_product_that_is_read_elsewhere_stays() {
        assert!(drawn("2 * (a * b) + a / (a * b)").1.is_none());
    }
}
