//! What a condition's holding says of the values that it compares, and of those
//! that a comparison which it stands for would compare.

use crate::flow::graph::*;
use crate::passes::region::implied;
use slowlight_routine::{Op, Range};

/// What a condition's holding or not says of values, by the comparisons that
/// are claimed to be the same, also where they are computed only then.
pub fn claimed(graph: &Graph, cond: NodeId, holds: bool) -> Vec<(NodeId, Range)> {
    let mut found = Vec::new();
    for (fact, holds) in implied(graph, cond, holds) {
        let Some((op, [a, b])) = graph.claims.get(&fact) else {
            continue;
        };
        let number = |id: &NodeId| graph.constant(*id).map(slowlight_routine::Value::real);
        // By how much ints on the two sides of a border differ.
        let strict = matches!(op, Op::IntLess) == holds;
        let step = if strict { 1.0 } else { 0.0 };
        let (below, above) = (f64::NEG_INFINITY, f64::INFINITY);
        found.extend(match (number(a), number(b), holds) {
            (Some(c), None, true) => Some((*b, Range::new(c + step, above))),
            (Some(c), None, false) => Some((*b, Range::new(below, c - step))),
            (None, Some(c), true) => Some((*a, Range::new(below, c - step))),
            (None, Some(c), false) => Some((*a, Range::new(c + step, above))),
            _ => None,
        });
    }
    found
}

/// Narrows `now` by a condition that holds or does not; answers what it was
/// before, in the order of change.
pub fn refine(graph: &Graph, now: &mut [Range], cond: NodeId, holds: bool) -> Vec<(NodeId, Range)> {
    let mut saved = Vec::new();
    for (fact, holds) in implied(graph, cond, holds) {
        let (op, [a, b]) = match (graph.claims.get(&fact), graph.node(fact)) {
            (Some(claimed), _) => *claimed,
            (_, Node::Apply(op, args)) => (op, args),
            _ => continue,
        };
        let unit = if op.args().first() == Some(&slowlight_routine::Type::Int) {
            1.0
        } else {
            0.0
        };
        let (ra, rb) = (now[a.0 as usize], now[b.0 as usize]);
        let mut narrow = |id: NodeId, range: Range, strict: bool| {
            let at = id.0 as usize;
            if graph.constant(id).is_none() {
                saved.push((id, now[at]));
                let mut met = now[at].meet(range);
                met.nonzero |= strict && (range.lo == 0.0 || range.hi == 0.0);
                now[at] = met;
            }
        };
        match (op, holds) {
            (Op::Less | Op::IntLess, true) => {
                narrow(a, Range::new(f64::NEG_INFINITY, rb.hi - unit), unit == 0.0);
                narrow(b, Range::new(ra.lo + unit, f64::INFINITY), unit == 0.0);
            }
            (Op::Less | Op::IntLess, false) => {
                narrow(a, Range::new(rb.lo, f64::INFINITY), false);
                narrow(b, Range::new(f64::NEG_INFINITY, ra.hi), false);
            }
            (Op::LessEqual | Op::IntLessEqual, true) => {
                narrow(a, Range::new(f64::NEG_INFINITY, rb.hi), false);
                narrow(b, Range::new(ra.lo, f64::INFINITY), false);
            }
            (Op::LessEqual | Op::IntLessEqual, false) => {
                narrow(a, Range::new(rb.lo + unit, f64::INFINITY), unit == 0.0);
                narrow(b, Range::new(f64::NEG_INFINITY, ra.hi - unit), unit == 0.0);
            }
            (Op::Equal | Op::IntEqual, true) => {
                narrow(a, rb, false);
                narrow(b, ra, false);
            }
            (Op::Equal | Op::IntEqual, false) if rb.constant() == Some(0.0) => {
                narrow(
                    a,
                    Range {
                        nonzero: true,
                        ..Range::ALL
                    },
                    false,
                );
            }
            _ => {}
        }
    }
    saved
}
