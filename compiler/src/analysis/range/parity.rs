//! Congruence facts: what intervals cannot see of whole numbers: one whose last bits are not all
//! 0 is not 0 (an odd one, or ten times that), and one that is not 0 is at least 1.

use crate::ir::graph::*;
use slowlight_routine::{Op, Range, Type, Value};

/// How deep operations are looked through.
const DEEP: u32 = 8;

/// The range of an operation with what its being of whole numbers implies.
pub fn whole(
    graph: &Graph,
    is_odd: &mut dyn FnMut() -> bool,
    id: NodeId,
    args: [Range; 2],
    range: Range,
) -> Range {
    let mut int = || Range {
        nonzero: range.nonzero || is_odd(),
        ..range
    };
    match graph.node(id) {
        Node::Apply(op, _) if op.result() == Type::Int => int(),
        Node::Ramp { .. } | Node::Stepped { .. } => int(),
        // By a whole number that is not 0: no greater than the dividend. One that is cut to
        // what its format holds is still 1 at least where that is.
        Node::Apply(Op::Div, [_, by])
            if args[1].nonzero && args[1].magnitude() >= 1.0 && is_whole(graph, by) =>
        {
            let most = args[0].magnitude();
            range.meet(Range::new(-most, most))
        }
        _ => range,
    }
}

/// Whether an int's last bits are known not to be all 0.
pub fn is_odd(graph: &Graph, id: NodeId) -> bool {
    low(graph, id, DEEP).rest != 0
}

fn is_whole(graph: &Graph, id: NodeId) -> bool {
    matches!(graph.node(id), Node::Apply(Op::ToReal, _))
}

/// What is known of an int's last bits: it is `rest` modulo 2^`bits`.
#[derive(Clone, Copy, Debug)]
struct Low {
    bits: u32,
    rest: i64,
}

/// More bits than these are not kept.
const BITS: u32 = 24;

impl Low {
    fn new(bits: u32, rest: i64) -> Low {
        let bits = bits.min(BITS);
        Low {
            bits,
            rest: rest.rem_euclid(1 << bits),
        }
    }

    /// How many bits at its end are 0 for sure.
    fn zeros(self) -> u32 {
        self.bits.min(self.rest.trailing_zeros())
    }

    fn times(self, other: Low) -> Low {
        let bits = (self.bits + other.zeros()).min(other.bits + self.zeros());
        Low::new(bits, self.rest * other.rest)
    }
}

/// An int's last bits, as far as they can be told. Ints saturate at an odd and
/// at an even end, so sums and products that might are left out.
fn low(graph: &Graph, id: NodeId, deep: u32) -> Low {
    let none = Low::new(0, 0);
    if deep == 0 {
        return none;
    }
    let of = |id| low(graph, id, deep - 1);
    match graph.node(id) {
        Node::Const(c) => match c.value() {
            Value::Int(n) => Low::new(BITS, i64::from(n)),
            _ => none,
        },
        // Wrapping takes whole powers of two away.
        Node::Ramp { first, step, .. } => {
            let (first, moved) = (of(first), of(step).times(none));
            Low::new(first.bits.min(moved.bits), first.rest)
        }
        Node::Stepped { first, step } => {
            let (first, step) = (of(first), of(step));
            Low::new(first.bits.min(step.bits), first.rest + step.rest)
        }
        Node::Apply(_, [a, b]) if !small(graph, a) || !small(graph, b) => none,
        Node::Apply(Op::IntNeg, [a, _]) => Low::new(of(a).bits, -of(a).rest),
        Node::Apply(Op::IntAdd, [a, b]) if a == b => Low::new(of(a).bits + 1, 2 * of(a).rest),
        Node::Apply(op @ (Op::IntAdd | Op::IntSub), [a, b]) => {
            let (a, b) = (of(a), of(b));
            let sign = if op == Op::IntAdd { 1 } else { -1 };
            Low::new(a.bits.min(b.bits), a.rest + sign * b.rest)
        }
        Node::Apply(Op::IntMul, [a, b]) => of(a).times(of(b)),
        _ => none,
    }
}

/// Whether an int is made of the pixel's place and small constants by so few
/// operations that it cannot saturate.
fn small(graph: &Graph, id: NodeId) -> bool {
    match graph.node(id) {
        Node::Axis(_) => true,
        Node::Const(c) => c.value().real().abs() < 1e5,
        Node::Apply(Op::IntAdd | Op::IntSub, [a, b]) => {
            let leaf = |id| !matches!(graph.node(id), Node::Apply(Op::IntAdd | Op::IntSub, _));
            leaf(a) && leaf(b) && small(graph, a) && small(graph, b)
        }
        Node::Apply(Op::IntMul, [a, b]) => {
            let place = |id| matches!(graph.node(id), Node::Axis(_));
            let few = |id| matches!(graph.node(id), Node::Const(c) if c.value().real().abs() < 1e4);
            (place(a) && few(b)) || (few(a) && place(b))
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn last_bits_of_products_are_what_is_said() {
        let all = (0..4).flat_map(|bits| (0..1 << bits).map(move |rest| Low::new(bits, rest)));
        let all: Vec<Low> = all.collect();
        let some = |low: Low| (-20..20).map(move |k: i64| (k << low.bits) + low.rest);
        for &a in &all {
            for &b in &all {
                let product = a.times(b);
                for (n, m) in some(a).flat_map(|n| some(b).map(move |m| (n, m))) {
                    let rest = (n * m).rem_euclid(1 << product.bits);
                    assert_eq!(rest, product.rest, "{a:?} {b:?} {n} {m}");
                }
            }
        }
        // 20 y - 2390 is 2 modulo 4, never 0.
        let (twenty, any) = (Low::new(BITS, 20), Low::new(0, 0));
        assert_eq!(twenty.times(any).bits, 2);
    }
}
