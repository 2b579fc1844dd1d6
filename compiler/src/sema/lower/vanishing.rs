//! Detection of singular gradients: roots that are 0 all over a surface.
//!
//! The distance to a box is often written as `length(max(q, 0)) + min(..)`, that to a polygon as
//! a length with a sign. On the surface such a length is 0 with what it is the length of, and
//! its gradient is 0 / 0, or a quotient of roundings next to it. So it is looked for a root that
//! may be about 0 where the formula is, backwards from that (constraint propagation as of HC4,
//! Benhamou et al. 1999, one pass): on the surface of a capsule, `length(p - nearest) - r`, the
//! root is r, and on that of a rounded box no less. A length of what moves smoothly is 0 at single
//! points; only what is cut or chosen is 0 on a whole face.

use super::Lower;
use super::derive::Formula;
use crate::ir::graph::{Loop, Node, NodeId};
use rustc_hash::FxHashMap;
use slowlight_routine::{Op, Value};
use std::collections::BTreeSet;

/// What counts as about 0.
const ABOUT: f64 = 1.0 / 64.0;

/// What a value may be.
type Extent = (f64, f64);

const ALL: Extent = (f64::NEG_INFINITY, f64::INFINITY);

impl Lower<'_> {
    /// Whether a root may be about 0, with all that it is of, on a formula's surface.
    pub(super) fn vanishes(&self, formula: &Formula) -> bool {
        let first = formula.markers.iter().min().copied();
        let mut seen: FxHashMap<NodeId, Extent> = FxHashMap::default();
        let mut todo = vec![(formula.root, (-ABOUT, ABOUT))];
        while let Some((id, (lo, hi))) = todo.pop() {
            // What was made before the markers cannot depend on them.
            if Some(id) < first {
                continue;
            }
            let (lo, hi) = match seen.get(&id) {
                Some((l, h)) if *l <= lo && hi <= *h => continue,
                // Whatever it may be: so each is looked at twice.
                Some(_) => ALL,
                None => (lo, hi),
            };
            seen.insert(id, (lo, hi));
            let node = self.b.node(id);
            match node {
                Node::Apply(Op::Sqrt, [of, _]) if lo <= ABOUT && self.is_cut(of, formula) => {
                    return true;
                }
                Node::Apply(op, [a, b]) => match self.backwards(op, [a, b], (lo, hi)) {
                    Some(spans) => todo.extend(spans),
                    None => todo.extend(node.operands().map(|of| (of, ALL))),
                },
                Node::Select { cond, yes, no } => {
                    todo.extend([(cond, ALL), (yes, (lo, hi)), (no, (lo, hi))]);
                }
                _ => {
                    todo.extend(node.operands().map(|of| (of, ALL)));
                    let inner = self.own_loop(formula, node);
                    todo.extend(inner.into_iter().flat_map(Loop::roots).map(|of| (of, ALL)));
                }
            }
        }
        false
    }

    /// What operands may be where an operation's result is within an extent; nothing where
    /// that tells nothing of them.
    fn backwards(
        &self,
        op: Op,
        [a, b]: [NodeId; 2],
        (lo, hi): Extent,
    ) -> Option<Vec<(NodeId, Extent)>> {
        let (x, y) = (self.written_extent(a), self.written_extent(b));
        Some(match op {
            Op::Add => vec![(a, (lo - y.1, hi - y.0)), (b, (lo - x.1, hi - x.0))],
            Op::Sub => vec![(a, (lo + y.0, hi + y.1)), (b, (x.0 - hi, x.1 - lo))],
            Op::Neg => vec![(a, (-hi, -lo))],
            Op::Abs => vec![(a, (-hi, hi))],
            // What the result is not has no part in its gradient.
            Op::Min | Op::Max => vec![(a, (lo, hi)), (b, (lo, hi))],
            Op::Mul if y.0 > 0.0 && y.1.is_finite() => vec![(a, divided((lo, hi), y))],
            Op::Mul if x.0 > 0.0 && x.1.is_finite() => vec![(b, divided((lo, hi), x))],
            _ => return None,
        })
    }

    /// What a value may be as it is written: a constant, a param, what is cut there.
    fn written_extent(&self, id: NodeId) -> Extent {
        if let Some(value) = self.b.value(id) {
            return (value.real(), value.real());
        }
        if let Some(range) = self.b.param_at(id).and_then(|param| param.range) {
            return (range.lo, range.hi);
        }
        let bound = |args: [NodeId; 2]| args.into_iter().find_map(|arg| self.b.value(arg));
        match self.b.node(id) {
            Node::Apply(Op::Sqrt | Op::Abs, _) => (0.0, f64::INFINITY),
            Node::Apply(Op::Min, args) => (ALL.0, bound(args).map_or(ALL.1, Value::real)),
            Node::Apply(Op::Max, args) => (bound(args).map_or(ALL.0, Value::real), ALL.1),
            _ => ALL,
        }
    }

    /// Whether a value is of others that are cut or chosen, or of the least that a loop has found,
    /// as the distance to a polygon is.
    fn is_cut(&self, of: NodeId, formula: &Formula) -> bool {
        let first = formula.markers.iter().min().copied();
        let (mut todo, mut seen) = (vec![of], BTreeSet::new());
        while let Some(id) = todo.pop() {
            if Some(id) < first || !seen.insert(id) {
                continue;
            }
            let node = self.b.node(id);
            let cut = match node {
                Node::Apply(Op::Min | Op::Max, _) | Node::Select { .. } => true,
                Node::Carried { index, .. } => {
                    let inner = self.own_loop(formula, node);
                    let next = inner.and_then(|l| l.next.get(index as usize));
                    next.is_some_and(|next| match self.b.node(*next) {
                        Node::Apply(Op::Min, among) => among.contains(&id),
                        _ => false,
                    })
                }
                _ => false,
            };
            if cut {
                return true;
            }
            todo.extend(node.operands());
        }
        false
    }
}

/// An extent divided by one above 0.
fn divided((lo, hi): Extent, (l, h): Extent) -> Extent {
    let lo = if lo < 0.0 { lo / l } else { lo / h };
    (lo, if hi > 0.0 { hi / l } else { hi / h })
}
