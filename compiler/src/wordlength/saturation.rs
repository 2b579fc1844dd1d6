//! Saturation limits by use: how large values need be told apart: what is only compared with 1
//! may saturate above 1, and so may what is only squared and added to other squares for that.
//!
//! An interval is useful of a value if nothing changes where the value is cut to it. It is
//! found from the readers back to what they read: all of these operations are monotone in the
//! operand where it is cut, so a cut operand gives a result beyond where the result
//! may be cut itself. What only the sign is asked of needs no range at all.

use crate::analysis::range::Ranges;
use crate::ir::graph::*;
use crate::ir::tree::*;
use slowlight_routine::{Op, Range, Type};

/// What is useful of each node's value.
pub fn useful(graph: &Graph, tree: &Tree, ranges: &Ranges) -> Vec<Range> {
    let mut all: Vec<Option<Range>> = vec![None; graph.nodes.len()];
    // What places are given, but choices their arms: what subroutines are given and leave, and
    // what loops carry, have all that they may hold.
    for block in tree.blocks() {
        walk(block, &mut |statement| {
            if let Statement::Set {
                place,
                from: Origin::Node(from),
            } = statement
                && !matches!(place, Place::Node(id) if is_arm(graph, *id, *from))
            {
                join(&mut all, *from, ranges.result[from.0 as usize]);
            }
        });
    }
    for id in graph.outputs() {
        join(&mut all, id, ranges.result[id.0 as usize]);
    }
    for id in graph.ids().rev() {
        match graph.node(id) {
            Node::Apply(op, args) => {
                let own = all[id.0 as usize].unwrap_or(ranges.result[id.0 as usize]);
                for k in 0..op.arity() {
                    let held = ranges.args[id.0 as usize];
                    let same = args[0] == args[1] && op.arity() == 2;
                    let range = match of_operand(op, k, own, held, same) {
                        Some(range) => meet(held[k], range),
                        None => held[k],
                    };
                    join(&mut all, args[k], range);
                }
            }
            Node::Select { yes, no, .. } => {
                for arm in [yes, no] {
                    let range = ranges.result[arm.0 as usize];
                    let own = all[id.0 as usize].unwrap_or(range);
                    join(&mut all, arm, meet(range, own));
                }
            }
            _ => {}
        }
    }
    (all.into_iter().zip(&ranges.result))
        .map(|(useful, range)| useful.map_or(*range, |useful| meet(*range, useful)))
        .collect()
}

/// Whether a real is one of the two that a choice is between.
fn is_arm(graph: &Graph, choice: NodeId, arm: NodeId) -> bool {
    let arms = match graph.node(choice) {
        Node::Select { yes, no, .. } => [yes, no],
        _ => return false,
    };
    arms.contains(&arm) && graph.ty(choice) == Type::Real
}

fn join(all: &mut [Option<Range>], id: NodeId, range: Range) {
    let now = &mut all[id.0 as usize];
    *now = Some(now.map_or(range, |now| now.join(range)));
}

/// What of a range is in another; the nearer end where nothing is.
fn meet(range: Range, other: Range) -> Range {
    let cut = |x: f64| x.clamp(other.lo, other.hi);
    Range::new(cut(range.lo), cut(range.hi))
}

/// Whether a factor is cut where the product is: that of a square or of a multiple. Of two
/// other values neither is, so that their product has no more bits for being cut.
pub fn cuts_factor(graph: &Graph, [a, b]: [NodeId; 2]) -> bool {
    a == b || [a, b].iter().any(|id| graph.constant(*id).is_some())
}

/// What is useful of operand `k`, given what is of the result, and between which bounds
/// the operands are; all of it where nothing is known.
fn of_operand(op: Op, k: usize, own: Range, held: [Range; 2], same: bool) -> Option<Range> {
    let other = held[1 - k];
    let (lo, hi) = (own.lo, own.hi);
    let (below, above) = (f64::NEG_INFINITY, f64::INFINITY);
    let made = match (op, k) {
        (Op::Less | Op::LessEqual | Op::Equal, _) => [other.lo, other.hi],
        (Op::Sign, _) => [0.0, 0.0],
        // Twice itself.
        (Op::Add, _) if same => [lo / 2.0, hi / 2.0],
        (Op::Add, _) => [lo - other.hi, hi - other.lo],
        (Op::Sub, 0) if !same => [lo + other.lo, hi + other.hi],
        (Op::Sub, 1) if !same => [other.lo - hi, other.hi - lo],
        (Op::Neg, _) => [-hi, -lo],
        (Op::Abs, _) => [-hi.max(0.0), hi.max(0.0)],
        (Op::Mul, _) if same => {
            let root = hi.max(0.0).sqrt();
            [-root, root]
        }
        (Op::Mul, _) => match other.constant() {
            Some(c) if c > 0.0 => [lo / c, hi / c],
            Some(c) if c < 0.0 => [hi / c, lo / c],
            _ => return None,
        },
        (Op::Sqrt, _) => [0.0, hi.max(0.0) * hi.max(0.0)],
        (Op::ReciprocalRoot, _) => {
            let [least, most] = [hi, lo].map(|y| y.max(0.0).powi(-2));
            [least, most]
        }
        (Op::Max, _) => [lo.max(other.lo), hi.max(other.lo)],
        (Op::Min, _) => [lo.min(other.hi), hi.min(other.hi)],
        _ => return None,
    };
    let [lo, hi] = made;
    let lo = if lo.is_nan() { below } else { lo };
    let hi = if hi.is_nan() { above } else { hi };
    Some(Range::new(lo.min(hi), hi))
}
