//! What stands behind a line: the operation as the scene would write it.

use super::code::Code;
use crate::ir::graph::*;
use slowlight_routine::{Op, Type};
use slowlight_runtime_jack::{SUM, TERM};

impl Code<'_> {
    /// What an operation means, in the scene's names.
    pub fn meaning(&mut self, id: NodeId) -> String {
        let Node::Apply(op, args) = self.plan.graph.node(id) else {
            return String::new();
        };
        let level = if op == Op::ToReal { SUM } else { TERM };
        let args = args.map(|arg| self.said(arg, level, is_infix(op)));
        operation(op, &args[0], &args[1])
    }

    /// An operand in a remark, in brackets where the operation stands beside it.
    fn said(&mut self, id: NodeId, level: u8, beside: bool) -> String {
        if let Some(value) = self.plan.graph.constant(id) {
            return short(value.real());
        }
        // What is written in place at some point is said as the scene has it.
        let in_place = self.points().is_some() && self.folded.contains_key(&id);
        match self.plan.graph.node(id) {
            Node::Apply(Op::ToReal, [whole, _]) if in_place => self.read(whole).at(level),
            Node::Apply(op, _) if in_place && op.result() == Type::Real => {
                let said = self.meaning(id);
                match beside && is_infix(op) {
                    true => format!("({said})"),
                    false => said,
                }
            }
            _ => self.read(id).at(level),
        }
    }
}

/// A number in a remark: six digits behind the point at most.
fn short(value: f64) -> String {
    let (exact, rounded) = (format!("{value}"), format!("{value:.6}"));
    match exact.len() > rounded.len() {
        true => rounded,
        false => exact,
    }
}

/// Whether an operation is said with a sign between its operands, or before its only one.
fn is_infix(op: Op) -> bool {
    matches!(
        op,
        Op::Add | Op::Sub | Op::Mul | Op::Div | Op::Mod | Op::Neg
    )
}

/// An operation as the scene would write it, for comments.
fn operation(op: Op, a: &str, b: &str) -> String {
    let infix = match op {
        Op::Add => "+",
        Op::Sub => "-",
        Op::Mul => "*",
        Op::Div => "/",
        Op::Mod => "mod",
        Op::Neg => return format!("-{a}"),
        Op::ToReal => return a.to_owned(),
        _ if op.arity() > 1 => return format!("{}({a}, {b})", op.name()),
        _ => return format!("{}({a})", op.name()),
    };
    format!("{a} {infix} {b}")
}
