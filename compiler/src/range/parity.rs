//! What intervals cannot see of whole numbers: an odd one is not 0, and one that
//! is not 0 is at least 1.

use crate::flow::graph::*;
use slowlight_routine::{Op, Range, Type, Value};

/// How deep operations are looked through.
const DEEP: u32 = 8;

/// The range of an operation with what its being of whole numbers implies.
pub fn whole(graph: &Graph, id: NodeId, args: [Range; 2], range: Range) -> Range {
    match graph.node(id) {
        Node::Apply(op, _) if op.result() == Type::Int => Range {
            nonzero: range.nonzero || odd(graph, id, DEEP) == Some(true),
            ..range
        },
        Node::Ramp { .. } => Range {
            nonzero: range.nonzero || odd(graph, id, DEEP) == Some(true),
            ..range
        },
        // By a whole number that is not 0: no greater than the dividend.
        Node::Apply(Op::Div, [_, by]) if args[1].nonzero && is_whole(graph, by) => {
            let most = args[0].magnitude();
            range.meet(Range::new(-most, most))
        }
        _ => range,
    }
}

fn is_whole(graph: &Graph, id: NodeId) -> bool {
    matches!(graph.node(id), Node::Apply(Op::ToReal, _))
}

/// Whether an int is odd, if that can be told. Ints saturate at an odd and at
/// an even end, so sums and products that might are left out.
fn odd(graph: &Graph, id: NodeId, deep: u32) -> Option<bool> {
    if deep == 0 {
        return None;
    }
    let of = |id| odd(graph, id, deep - 1);
    match graph.node(id) {
        Node::Const(c) => match c.value() {
            Value::Int(n) => Some(n % 2 != 0),
            _ => None,
        },
        // Wrapping takes whole powers of two away.
        Node::Ramp { first, step } if of(step) == Some(false) => of(first),
        Node::Apply(_, [a, b]) if !small(graph, a) || !small(graph, b) => None,
        Node::Apply(Op::IntNeg, [a, _]) => of(a),
        Node::Apply(Op::IntAdd, [a, b]) if a == b => Some(false),
        Node::Apply(Op::IntAdd | Op::IntSub, [a, b]) => Some(of(a)? != of(b)?),
        Node::Apply(Op::IntMul, [a, b]) => match (of(a), of(b)) {
            (Some(false), _) | (_, Some(false)) => Some(false),
            (Some(true), Some(true)) => Some(true),
            _ => None,
        },
        _ => None,
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
