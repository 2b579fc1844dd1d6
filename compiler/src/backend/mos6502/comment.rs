//! What a statement means, in the scene's names.

use super::homes::Homes;
use crate::ir::graph::*;
use crate::plan::Plan;
use slowlight_routine::{Op, Value};
use slowlight_runtime_6502::write::Place as Operand;

/// `name = a + b`, for a value's computation.
pub(super) fn of_value(plan: &Plan, homes: &Homes, id: NodeId) -> String {
    let name = |id| operand(plan, homes, id);
    let meaning = match plan.graph.node(id) {
        Node::Apply(op, [a, b]) => operation(op, &name(a), &name(b)),
        Node::Lookup { table, column, row } => {
            let table = plan
                .graph
                .tables
                .get(table.0 as usize)
                .map_or("?", |t| &t.name);
            format!("{table}[{}, {}]", name(column), name(row))
        }
        Node::Tabulated(_) => format!("{}, by column", name(id)),
        _ => String::new(),
    };
    if homes.fused.contains(&id) {
        format!("; {meaning}?")
    } else {
        format!("; {} = {meaning}", name(id))
    }
}

/// A value as a reader would call it.
pub(super) fn operand(plan: &Plan, homes: &Homes, id: NodeId) -> String {
    match (plan.graph.constant(id), homes.operand(plan, id)) {
        (Some(Value::Real(r)), _) => format!("{r}"),
        (Some(Value::Int(i)), _) => format!("{i}"),
        (Some(Value::Bool(b)), _) => format!("{b}"),
        (None, Operand::At(name) | Operand::Held(name, _) | Operand::Signed(name, _)) => name,
        (None, Operand::Constant(_)) => "anything".to_owned(),
    }
}

fn operation(op: Op, a: &str, b: &str) -> String {
    let infix = match op {
        Op::Add | Op::IntAdd => "+",
        Op::Sub | Op::IntSub => "-",
        Op::Mul | Op::IntMul => "*",
        Op::Div => "/",
        Op::IntDiv => "div",
        Op::Mod | Op::IntMod => "mod",
        Op::BitAnd => "and",
        Op::BitOr => "or",
        Op::BitXor => "xor",
        Op::Less | Op::IntLess => "<",
        Op::LessEqual | Op::IntLessEqual => "<=",
        Op::Equal | Op::IntEqual => "=",
        Op::Neg | Op::IntNeg => return format!("-{a}"),
        Op::Not => return format!("not {a}"),
        Op::ToReal => return format!("real {a}"),
        Op::ReciprocalRoot => return format!("1 / sqrt({a})"),
        _ => {
            let name = op.name();
            let name = name
                .strip_prefix('i')
                .filter(|n| Op::named(n).is_some())
                .unwrap_or(name);
            return if op.arity() > 1 {
                format!("{name}({a}, {b})")
            } else {
                format!("{name}({a})")
            };
        }
    };
    format!("{a} {infix} {b}")
}
