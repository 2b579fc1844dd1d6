//! Bitwise operations of what was added up bit by bit.
//!
//! `a xor b` written with quotients and remainders is a sum of bits, each with its weight:
//! `2 ^ k * ((a div 2 ^ k + b div 2 ^ k) mod 2)`. By which bits of which values each bit of an int
//! is a function of is found for the low [`BITS`] by a forward analysis, of which known bits (LLVM's
//! `KnownBits`) are the constant part. A sum whose bits are all one function
//! of the bits of the same two values, moved by as much, is that function of the values.

use crate::analysis::range::Ranges;
use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild_old;
use crate::source::Span;
use slowlight_routine::{Op, Runtime, Type, Value};

/// How many bits of an int are looked at: no machine has fewer, its sign aside.
const BITS: usize = 15;

/// A bit of a value.
type Place = (NodeId, usize);

/// What a bit is.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Bit {
    Zero,
    One,
    /// That of another value.
    Copy(Place),
    /// A bitwise operation of two.
    Both(Op, [Place; 2]),
}

type Bits = [Bit; BITS];

/// The graph with bitwise operations in the place of such sums; nothing where there are none.
pub fn bitwise(graph: &Graph, ranges: &Ranges, _: &Runtime) -> Option<Graph> {
    let is_sum = |id| matches!(graph.node(id), Node::Apply(Op::IntAdd, _));
    if !graph.ids().any(is_sum) {
        return None;
    }
    let all = all_bits(graph, ranges);
    let mut done = false;
    let next = rebuild_old(graph, &mut |builder, made, id, span| {
        let bits = all.get(id.0 as usize).filter(|_| is_sum(id))?;
        let one = one_operation(bits)?;
        // What has more bits than are looked at is another value.
        let range = ranges.result.get(id.0 as usize)?;
        if range.lo < 0.0 || range.hi >= f64::from(1 << BITS) {
            return None;
        }
        let new = |old: NodeId| made.get(old.0 as usize).copied().flatten();
        let [a, b] = one
            .of
            .map(|(of, by)| Some(moved(builder, new(of)?, by, span)));
        done = true;
        let both = builder.apply(one.op, &[a?, b?], span);
        let mask = builder.constant(Value::Int(one.mask), span);
        Some(builder.apply(Op::BitAnd, &[both, mask], span))
    });
    done.then_some(next)
}

/// A bitwise operation of two values, each without so many of its lowest bits.
struct Operation {
    op: Op,
    of: [(NodeId, usize); 2],
    /// Which bits of the result there are.
    mask: i32,
}

/// What all bits come from, where that is one operation of two values, and there are several.
fn one_operation(bits: &Bits) -> Option<Operation> {
    let mut found: Option<Operation> = None;
    for (at, bit) in bits.iter().enumerate() {
        let (op, places) = match bit {
            Bit::Zero => continue,
            Bit::Both(op, places) => (*op, *places),
            _ => return None,
        };
        let by = |(of, bit): Place| Some((of, bit.checked_sub(at)?));
        let [a, b] = places.map(by);
        let of = [a?, b?];
        match &mut found {
            None => {
                found = Some(Operation {
                    op,
                    of,
                    mask: 1 << at,
                })
            }
            Some(all) if (all.op, all.of) == (op, of) => all.mask |= 1 << at,
            Some(_) => return None,
        }
    }
    found.filter(|all| all.mask.count_ones() > 1)
}

/// A value without its lowest bits.
fn moved(builder: &mut Builder, of: NodeId, by: usize, span: Span) -> NodeId {
    if by == 0 {
        return of;
    }
    let divisor = builder.constant(Value::Int(1 << by), span);
    builder.apply(Op::IntDiv, &[of, divisor], span)
}

/// Every int's bits; others' are their own. Linear in the graph.
fn all_bits(graph: &Graph, ranges: &Ranges) -> Vec<Bits> {
    let mut all: Vec<Bits> = Vec::with_capacity(graph.nodes.len());
    // What saturates has other bits.
    let fits = |id: NodeId| {
        let exact = ranges.exact.get(id.0 as usize);
        exact.is_some_and(|range| range.within(-32767.0, 32767.0))
    };
    for id in graph.ids() {
        let own: Bits = std::array::from_fn(|k| Bit::Copy((id, k)));
        let mut bits = match graph.node(id) {
            Node::Const(c) if c.value().ty() == Type::Int && c.value().int() >= 0 => {
                let n = c.value().int();
                std::array::from_fn(|k| if n >> k & 1 == 1 { Bit::One } else { Bit::Zero })
            }
            Node::Apply(op, [a, b]) if op.result() == Type::Int => {
                let power = |id| power_of_two(graph.constant(id)?);
                let of = |id: NodeId| all.get(id.0 as usize).copied().unwrap_or(own);
                let made = fits(id).then(|| match (op, power(a), power(b)) {
                    (Op::BitAnd, _, Some(0)) => {
                        let sum = fits(a).then(|| lowest(graph, a, &of)).flatten();
                        sum.or_else(|| together(op, &of(a), &of(b), own))
                    }
                    (Op::IntDiv, _, Some(by)) => Some(right(&of(a), by, own)),
                    (Op::IntMul, _, Some(by)) => Some(left(&of(a), by)),
                    (Op::IntMul, Some(by), _) => Some(left(&of(b), by)),
                    _ => together(op, &of(a), &of(b), own),
                });
                made.flatten().unwrap_or(own)
            }
            _ => own,
        };
        // What is never so large has no such bits.
        if let Some(range) = ranges.result.get(id.0 as usize)
            && range.lo >= 0.0
        {
            for (k, bit) in bits.iter_mut().enumerate() {
                if range.hi < f64::from(1 << k) {
                    *bit = Bit::Zero;
                }
            }
        }
        all.push(bits);
    }
    all
}

/// Which power of two a constant is.
fn power_of_two(value: Value) -> Option<usize> {
    let Value::Int(n) = value else { return None };
    (n > 0 && n & (n - 1) == 0).then(|| n.trailing_zeros() as usize)
}

/// The lowest bit of a sum or difference, into which nothing is carried, if a value is one whose
/// bits are its own.
fn lowest(graph: &Graph, sum: NodeId, of: &dyn Fn(NodeId) -> Bits) -> Option<Bits> {
    let Node::Apply(Op::IntAdd | Op::IntSub, [a, b]) = graph.node(sum) else {
        return None;
    };
    (of(sum)[0] == Bit::Copy((sum, 0))).then_some(())?;
    let mut bits = [Bit::Zero; BITS];
    bits[0] = joined(Op::BitXor, of(a)[0], of(b)[0])?;
    Some(bits)
}

/// The bits of a quotient; those that come from above what is looked at are its own.
fn right(bits: &Bits, by: usize, own: Bits) -> Bits {
    std::array::from_fn(|k| bits.get(k + by).copied().unwrap_or(own[k]))
}

/// The bits of a product.
fn left(bits: &Bits, by: usize) -> Bits {
    std::array::from_fn(|k| match k.checked_sub(by) {
        Some(from) => bits[from],
        None => Bit::Zero,
    })
}

/// The bits of an operation of two; nothing where these are its own.
fn together(op: Op, a: &Bits, b: &Bits, own: Bits) -> Option<Bits> {
    let is_bit = |bits: &Bits| bits[1..].iter().all(|bit| *bit == Bit::Zero);
    let each = |op| std::array::from_fn(|k| joined(op, a[k], b[k]).unwrap_or(own[k]));
    match op {
        Op::BitAnd | Op::BitOr | Op::BitXor => Some(each(op)),
        Op::IntMul | Op::IntMin if is_bit(a) && is_bit(b) => Some(each(Op::BitAnd)),
        Op::IntMax if is_bit(a) && is_bit(b) => Some(each(Op::BitOr)),
        Op::IntAdd => {
            let pairs = a.iter().zip(b);
            let apart = |pair| matches!(pair, (Bit::Zero, _) | (_, Bit::Zero));
            (pairs.map(|(a, b)| (*a, *b)))
                .all(apart)
                .then(|| each(Op::BitOr))
        }
        _ => None,
    }
}

/// A bitwise operation of two bits, as far as that can be told.
fn joined(op: Op, a: Bit, b: Bit) -> Option<Bit> {
    match (op, a, b) {
        (Op::BitAnd, Bit::Zero, _) | (Op::BitAnd, _, Bit::Zero) => Some(Bit::Zero),
        (Op::BitAnd, Bit::One, bit) | (Op::BitAnd, bit, Bit::One) => Some(bit),
        (Op::BitOr | Op::BitXor, Bit::Zero, bit) | (Op::BitOr | Op::BitXor, bit, Bit::Zero) => {
            Some(bit)
        }
        (Op::BitOr, Bit::One, _) | (Op::BitOr, _, Bit::One) => Some(Bit::One),
        (_, Bit::Copy(a), Bit::Copy(b)) if a != b => Some(Bit::Both(op, [a.min(b), a.max(b)])),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::passes::loops::drawn::{analysed, shades};
    use slowlight_runtime_6502::scaled::FIXED16;

    /// A graph of `a` and `b`, 6 bits each, and what the pass makes of it.
    fn made(value: &str) -> (Graph, Option<Graph>) {
        let source = format!(
            "image 32 x 32 inks black, white;
             draw (x, y) = {{
               let a = (7 * x + y) mod 64; let b = (x + 5 * y) mod 64;
               threshold(({value}) / 64, 0.5)
             }};"
        );
        let plain = analysed(&source, &FIXED16);
        let next = bitwise(&plain.graph, &plain.ranges, &FIXED16);
        (plain.graph.clone(), next)
    }

    fn quotients(graph: &Graph) -> usize {
        let reached = graph.reached();
        let is = |id: &NodeId| matches!(graph.node(*id), Node::Apply(Op::IntDiv, _));
        graph
            .ids()
            .filter(|id| reached[id.0 as usize])
            .filter(is)
            .count()
    }

    /// A sum over six bits, `{}` being the bit's weight.
    fn sum(of: &str) -> String {
        let terms = (0..6).map(|k| of.replace("{}", &(1 << k).to_string()));
        terms.collect::<Vec<_>>().join(" + ")
    }

    #[test]
    fn sums_of_bits_are_one_operation() {
        for (of, op) in [
            ("{} * ((a div {} + b div {}) mod 2)", Op::BitXor),
            (
                "{} * (((a div {}) mod 2 + (b div {}) mod 2) mod 2)",
                Op::BitXor,
            ),
            ("{} * ((a div {}) mod 2 * ((b div {}) mod 2))", Op::BitAnd),
            ("{} * max((a div {}) mod 2, (b div {}) mod 2)", Op::BitOr),
        ] {
            let (plain, next) = made(&sum(of));
            let next = next.expect(of);
            assert_eq!(quotients(&next), 0, "{of}");
            let reached = next.reached();
            let has = |id: &NodeId| matches!(next.node(*id), Node::Apply(at, _) if at == op);
            assert!(
                next.ids()
                    .filter(|id| reached[id.0 as usize])
                    .any(|id| has(&id)),
                "{of}"
            );
            assert_eq!(shades(&plain), shades(&next), "{of}");
        }
    }

    #[test]
    fn other_sums_are_left() {
        for value in [
            // Carries; bits of different places; one bit only; of three values.
            "a + b",
            "2 * (a mod 2) + (b div 4) mod 2",
            "(a + b) mod 2 + 2 * (x mod 4)",
            "(a + b) mod 2 + 2 * ((a div 2 + y div 2) mod 2)",
        ] {
            let (plain, next) = made(value);
            if let Some(next) = next {
                assert_eq!(shades(&plain), shades(&next), "{value}");
                panic!("{value}");
            }
        }
    }
}
