//! Constant folding and algebraic simplification: what is equal by algebra alone, exactly.
//!
//! Every rule keeps the value bit for bit in binary arithmetic (a product with
//! a power of two for a quotient by one, say), so no picture changes. Rules
//! that move a rounding do not belong here. The graph is rebuilt through the
//! builder, which folds constants and shares equal nodes as it goes.

use crate::ir::build::Builder;
use crate::ir::graph::*;
use crate::passes::rewrite::rebuild::rebuild;
use crate::source::Span;
use slowlight_routine::{Op, Value};

/// The graph with every rule applied to every node, operands first.
pub fn fold(graph: &Graph) -> Graph {
    rebuild(graph, &mut |builder, _, node, span| match node {
        Node::Apply(op, [a, b]) => folded(builder, op, a, b, span),
        Node::Select { cond, yes, no } => Some(select(builder, cond, yes, no, span)),
        _ => None,
    })
}

/// Whether a real is a power of two whose reciprocal is a normal number.
fn power_of_two(x: f64) -> bool {
    x.is_normal() && x.to_bits() & ((1 << 52) - 1) == 0 && (1.0 / x).is_normal()
}

/// What is equal to an operation by a rule, if there is one; `y` is `x` where it takes one
/// operand.
pub(crate) fn folded(b: &mut Builder, op: Op, x: NodeId, y: NodeId, span: Span) -> Option<NodeId> {
    let (left, right) = (b.value(x), if op.arity() > 1 { b.value(y) } else { None });
    let is = |value: Option<Value>, what: f64| value.is_some_and(|v| v.real() == what);
    Some(match op {
        Op::Add | Op::IntAdd if is(left, 0.0) => y,
        Op::Add | Op::Sub | Op::IntAdd | Op::IntSub if is(right, 0.0) => x,
        Op::Sub if is(left, 0.0) => b.apply(Op::Neg, &[y], span),
        Op::IntSub if is(left, 0.0) => b.apply(Op::IntNeg, &[y], span),
        Op::Sub if x == y => b.constant(Value::Real(0.0), span),
        Op::IntSub if x == y => b.constant(Value::Int(0), span),
        Op::IntSub
            if right.is_some_and(|by| by.real() < 0.0 && by.real() > f64::from(i32::MIN)) =>
        {
            let by = right.map_or(0, |by| -by.real() as i32);
            let by = b.constant(Value::Int(by), span);
            b.apply(Op::IntAdd, &[x, by], span)
        }
        Op::Mul | Op::IntMul if is(left, 1.0) => y,
        Op::Mul | Op::Div | Op::IntMul | Op::IntDiv if is(right, 1.0) => x,
        // All bits.
        Op::BitAnd if is(right, -1.0) => x,
        Op::Mul if is(left, 0.0) || is(right, 0.0) => b.constant(Value::Real(0.0), span),
        Op::Div if is(left, 0.0) => b.constant(Value::Real(0.0), span),
        Op::IntMul if is(left, 0.0) || is(right, 0.0) => b.constant(Value::Int(0), span),
        Op::Mul if is(left, -1.0) => b.apply(Op::Neg, &[y], span),
        Op::Mul if is(right, -1.0) => b.apply(Op::Neg, &[x], span),
        Op::Mul if is(left, 2.0) => b.apply(Op::Add, &[y, y], span),
        Op::Mul if is(right, 2.0) => b.apply(Op::Add, &[x, x], span),
        Op::Div => match right {
            Some(Value::Real(r)) if power_of_two(r) => {
                let inverse = b.constant(Value::Real(1.0 / r), span);
                b.apply(Op::Mul, &[x, inverse], span)
            }
            // Of doubles, as gradients of lengths have them.
            _ => match (doubled(b, x), doubled(b, y)) {
                (Some(x), Some(y)) => b.apply(Op::Div, &[x, y], span),
                _ => return None,
            },
        },
        Op::IntMod => match right {
            // Two's complement: the low bits are the flooring remainder.
            Some(Value::Int(n)) if n > 0 && n & (n - 1) == 0 => {
                let mask = b.constant(Value::Int(n - 1), span);
                b.apply(Op::BitAnd, &[x, mask], span)
            }
            _ => return None,
        },
        // Doubling is exact, and so is taking one half away.
        Op::Sub if b.node(x) == Node::Apply(Op::Add, [y, y]) => y,
        Op::Sub | Op::Add => match b.node(y) {
            Node::Apply(Op::Neg, [inner, _]) => {
                let other = if op == Op::Add { Op::Sub } else { Op::Add };
                b.apply(other, &[x, inner], span)
            }
            _ => return None,
        },
        Op::Neg | Op::IntNeg => match b.node(x) {
            Node::Apply(inner, [z, _]) if inner == op => z,
            Node::Apply(Op::Sub, [p, q]) if op == Op::Neg => b.apply(Op::Sub, &[q, p], span),
            _ => return None,
        },
        Op::Not => match b.node(x) {
            Node::Apply(Op::Not, [z, _]) => z,
            Node::Apply(Op::Less, [p, q]) => b.apply(Op::LessEqual, &[q, p], span),
            Node::Apply(Op::LessEqual, [p, q]) => b.apply(Op::Less, &[q, p], span),
            Node::Apply(Op::IntLess, [p, q]) => b.apply(Op::IntLessEqual, &[q, p], span),
            Node::Apply(Op::IntLessEqual, [p, q]) => b.apply(Op::IntLess, &[q, p], span),
            _ => return None,
        },
        _ => return None,
    })
}

/// What a real is twice as much as.
fn doubled(b: &Builder, id: NodeId) -> Option<NodeId> {
    match b.node(id) {
        Node::Apply(Op::Add, [x, y]) if x == y => Some(x),
        _ => None,
    }
}

fn select(b: &mut Builder, cond: NodeId, yes: NodeId, no: NodeId, span: Span) -> NodeId {
    if let Node::Apply(Op::Not, [inner, _]) = b.node(cond) {
        return select(b, inner, no, yes, span);
    }
    // In an arm it is known whether the condition holds.
    let yes = known(b, cond, true, yes);
    let no = known(b, cond, false, no);
    match (b.value(yes), b.value(no)) {
        (Some(Value::Bool(true)), Some(Value::Bool(false))) => cond,
        (Some(Value::Bool(false)), Some(Value::Bool(true))) => {
            let not = b.apply(Op::Not, &[cond], span);
            folded(b, Op::Not, cond, cond, span).unwrap_or(not)
        }
        _ => b.select(cond, yes, no, span),
    }
}

/// What a choice by the same condition, or by its contrary, is where that is known.
fn known(b: &Builder, cond: NodeId, holds: bool, mut arm: NodeId) -> NodeId {
    while let Node::Select {
        cond: asked,
        yes,
        no,
    } = b.node(arm)
    {
        let holds = if asked == cond {
            holds
        } else if contrary(b.node(asked), b.node(cond), cond) {
            !holds
        } else {
            break;
        };
        arm = if holds { yes } else { no };
    }
    arm
}

/// Whether a condition is the contrary of another.
fn contrary(asked: Node, known: Node, id: NodeId) -> bool {
    match (asked, known) {
        (Node::Apply(Op::Not, [of, _]), _) => of == id,
        (Node::Apply(Op::Less, [a, b]), Node::Apply(Op::LessEqual, [c, d]))
        | (Node::Apply(Op::LessEqual, [a, b]), Node::Apply(Op::Less, [c, d]))
        | (Node::Apply(Op::IntLess, [a, b]), Node::Apply(Op::IntLessEqual, [c, d]))
        | (Node::Apply(Op::IntLessEqual, [a, b]), Node::Apply(Op::IntLess, [c, d])) => {
            (a, b) == (d, c)
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What becomes of a choice by x < y with another choice in an arm, by a comparison:
    /// of 1 and 2 in the arm, or nothing where both are left to choose.
    fn chosen(op: Op, turned: bool, in_yes: bool) -> Option<f64> {
        let (mut b, at) = (Builder::new(), Span::default());
        let [x, y] = [Axis::X, Axis::Y].map(|axis| b.axis(axis, at));
        let [x, y] = [x, y].map(|axis| b.apply(Op::ToReal, &[axis], at));
        let [one, two, other] = [1.0, 2.0, 3.0].map(|n| b.constant(Value::Real(n), at));
        let cond = b.apply(Op::Less, &[x, y], at);
        let asked = b.apply(op, &if turned { [y, x] } else { [x, y] }, at);
        let inner = b.select(asked, one, two, at);
        let (yes, no) = if in_yes {
            (inner, other)
        } else {
            (other, inner)
        };
        let made = select(&mut b, cond, yes, no, at);
        let Node::Select { yes, no, .. } = b.node(made) else {
            return None;
        };
        b.value(if in_yes { yes } else { no }).map(Value::real)
    }

    #[test]
    fn an_arm_knows_its_condition() {
        assert_eq!(chosen(Op::Less, false, true), Some(1.0));
        assert_eq!(chosen(Op::Less, false, false), Some(2.0));
    }

    #[test]
    fn an_arm_knows_the_contrary_of_its_condition() {
        assert_eq!(chosen(Op::LessEqual, true, true), Some(2.0));
        assert_eq!(chosen(Op::LessEqual, true, false), Some(1.0));
    }

    #[test]
    fn another_comparison_stays() {
        assert_eq!(chosen(Op::Less, true, true), None);
        assert_eq!(chosen(Op::LessEqual, false, false), None);
    }
}
