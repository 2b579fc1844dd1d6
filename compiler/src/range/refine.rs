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

/// How many steps from a value down to what it is made of are gone.
const DEEP: u32 = 8;

/// Ints up to this are reals in every format that holds them.
const EXACT: f64 = 16384.0;

/// The int that a value is a line in, and between which bounds it stays where the
/// value, which stayed within `held` before, stays between those of now. Nothing
/// where the value may have been cut to what its format holds.
fn below(graph: &Graph, now: &[Range], id: NodeId, held: Range) -> Option<(NodeId, Range)> {
    let Node::Apply(op, [a, b]) = graph.node(id) else {
        return None;
    };
    let number = |id: NodeId| graph.constant(id).map(slowlight_routine::Value::real);
    // As factor x + offset.
    let (of, factor, offset) = match (op, number(a), number(b)) {
        (Op::ToReal, None, _) => (a, 1.0, 0.0),
        (Op::IntAdd, None, Some(c)) => (a, 1.0, c),
        (Op::IntAdd, Some(c), None) => (b, 1.0, c),
        (Op::IntSub, None, Some(c)) => (a, 1.0, -c),
        (Op::IntSub, Some(c), None) => (b, -1.0, c),
        (Op::IntMul, None, Some(c)) if c != 0.0 => (a, c, 0.0),
        (Op::IntMul, Some(c), None) if c != 0.0 => (b, c, 0.0),
        (Op::IntNeg, None, _) => (a, -1.0, 0.0),
        _ => return None,
    };
    let x = now[of.0 as usize];
    let whole = |x: f64| {
        let y = factor * x + offset;
        held.lo <= y && y <= held.hi && y.abs() < f64::from(i32::MAX)
    };
    if !whole(x.lo) || !whole(x.hi) || op == Op::ToReal && x.magnitude() > EXACT {
        return None;
    }
    let range = now[id.0 as usize];
    let beside = |end: f64, by: f64| if range.nonzero && end == 0.0 { by } else { end };
    let [p, q] = [beside(range.lo, 1.0), beside(range.hi, -1.0)].map(|end| (end - offset) / factor);
    Some((of, Range::new(p.min(q).ceil(), p.max(q).floor())))
}

/// A row or column as a real, where it is one that its format holds.
fn reals_of(graph: &Graph, now: &[Range], axis: NodeId) -> Vec<NodeId> {
    if !matches!(graph.node(axis), Node::Axis(_)) {
        return Vec::new();
    }
    let whole = now[axis.0 as usize];
    let same = |id: &NodeId| {
        let held = now[id.0 as usize];
        let real = matches!(graph.node(*id), Node::Apply(Op::ToReal, [a, _]) if a == axis);
        real && held.lo <= whole.lo && whole.hi <= held.hi && whole.magnitude() <= EXACT
    };
    graph.ids().filter(same).collect()
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
                let held = now[at];
                let mut met = held.meet(range);
                met.nonzero |= strict && (range.lo == 0.0 || range.hi == 0.0);
                now[at] = met;
                // What it is a line in is narrowed with it, down to the row.
                let (mut of, mut before) = (id, held);
                for _ in 0..DEEP {
                    let Some((inner, range)) = below(graph, now, of, before) else {
                        break;
                    };
                    (of, before) = (inner, now[inner.0 as usize]);
                    let mut all = reals_of(graph, now, inner);
                    all.push(inner);
                    for id in all {
                        saved.push((id, now[id.0 as usize]));
                        now[id.0 as usize] = now[id.0 as usize].meet(range);
                    }
                }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::build::Builder;
    use crate::source::Span;
    use slowlight_routine::Value;

    #[test]
    fn what_a_line_says_of_the_row_holds_for_the_row() {
        let at = Span::default();
        // y from 0 to 239, as an int and through a real.
        for real in [false, true] {
            let mut b = Builder::new();
            let y = b.axis(Axis::Y, at);
            let [by, from] = [-20, 2390].map(|n| b.constant(Value::Int(n), at));
            let product = b.apply(Op::IntMul, &[by, y], at);
            let sum = b.apply(Op::IntAdd, &[product, from], at);
            let (zero, sum, op) = match real {
                true => (
                    Value::Real(0.0),
                    b.apply(Op::ToReal, &[sum], at),
                    Op::LessEqual,
                ),
                false => (Value::Int(0), sum, Op::IntLessEqual),
            };
            let height = b.apply(Op::ToReal, &[y], at);
            let zero = b.constant(zero, at);
            let above = b.apply(op, &[zero, sum], at);
            let image = Image {
                block: (1, 1),
                width: 1,
                height: 240,
                palette: vec![[0; 3]; 2],
            };
            let graph = b.finish(image, y, None);
            let known = |id: NodeId| match id {
                id if id == y || id == height => Range::new(0.0, 239.0),
                id if id == product => Range::new(-4780.0, 0.0),
                _ => match graph.constant(id) {
                    Some(value) => Range::point(value.real()),
                    None => Range::new(-2390.0, 2390.0),
                },
            };
            let before: Vec<Range> = graph.ids().map(known).collect();
            for (holds, lo, hi) in [(true, 0.0, 119.0), (false, 120.0, 239.0)] {
                let mut now = before.clone();
                let saved = refine(&graph, &mut now, above, holds);
                assert_eq!(now[y.0 as usize], Range::new(lo, hi));
                assert_eq!(now[height.0 as usize], Range::new(lo, hi));
                for (id, range) in saved.into_iter().rev() {
                    now[id.0 as usize] = range;
                }
                assert_eq!(now, before);
            }
        }
    }
}
