//! Exactness of whole results: what a `floor`, a `round` or a `mod` needs must not be a rounding
//! below a whole number where it is that number as written.
//!
//! x / 3 is 2 at x = 6, x * 0.333... is less. Everywhere else one rounding more does no harm that
//! samples would not show; under a `floor` it is a wrong picture at every multiple of the divisor.

use super::rounding_samples::Nodes;
use crate::ir::graph::*;
use rustc_hash::FxHashSet;
use slowlight_routine::Op;

/// Binary places that an exact constant may have.
const PLACES: i32 = 20;

/// Which values a `floor` needs as they are: its operand, and the parts of sums under it.
pub fn floored(graph: &Graph) -> Vec<bool> {
    let mut floored = vec![false; graph.nodes.len()];
    let all: Vec<NodeId> = graph.ids().collect();
    for id in all.into_iter().rev() {
        let node = graph.node(id);
        let passes = match node {
            Node::Apply(Op::Floor | Op::Round | Op::Mod, _) => true,
            Node::Apply(Op::Add | Op::Sub | Op::Neg | Op::Min | Op::Max, _)
            | Node::Select { .. } => floored[id.0 as usize],
            _ => false,
        };
        if passes {
            for used in node.operands() {
                floored[used.0 as usize] = true;
            }
        }
    }
    floored
}

/// Whether a value hangs on a constant that no format of binary places holds.
pub fn inexact(nodes: &dyn Nodes, root: NodeId) -> bool {
    let (mut todo, mut seen) = (vec![root], FxHashSet::default());
    while let Some(id) = todo.pop() {
        if !seen.insert(id) {
            continue;
        }
        match nodes.node(id) {
            Node::Const(x) if (x.value().real() * f64::from(PLACES).exp2()).fract() != 0.0 => {
                return true;
            }
            node => todo.extend(node.operands()),
        }
    }
    false
}
