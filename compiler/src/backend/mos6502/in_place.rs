//! Results in place: whether an operation's instructions read all of an operand's bytes before
//! they write those of the result, so that both may have one home.

use super::logs;
use super::shapes::Shapes;
use crate::ir::graph::*;
use crate::ir::tree::Place;
use crate::plan::Plan;
use slowlight_routine::{Format, Routine, Type};
use slowlight_runtime_6502::write::{self, Goal, Place as Operand};
use std::collections::BTreeSet;

/// What stands for the result and the operands.
const RESULT: &str = "result";
const OPERANDS: [&str; 2] = ["operand_0", "operand_1"];

/// Whether that is so of each operand of a value.
pub(super) fn in_place(plan: &Plan, shapes: Option<&Shapes>, id: NodeId) -> [bool; 2] {
    let (Node::Apply(op, args), Some(routine)) = (plan.graph.node(id), plan.routine(id)) else {
        return [false; 2];
    };
    // Reals with points of their own are moved on the way, or written out.
    let is_real = |ty: &Type| *ty == Type::Real;
    if plan.points().is_some() && (op.args().iter().any(is_real) || is_real(&op.result())) {
        return [false; 2];
    }
    let mut operands = Vec::new();
    for (k, arg) in args.into_iter().enumerate().take(routine.args.len()) {
        let name = match k == 1 && arg == args[0] {
            true => OPERANDS[0],
            false => OPERANDS[k],
        };
        operands.push(operand(plan, shapes, arg, name.to_owned()));
    }
    let bytes = shapes.map_or(write::size(routine.result), |shapes| {
        shapes.of(plan, Place::of(&plan.graph, id)).bytes
    });
    let lines = instructions(plan, routine, &operands, bytes);
    let mut found = OPERANDS.map(|operand| is_read_first(&lines, operand));
    if args[0] == args[1] {
        found[1] = found[0];
    }
    found
}

fn operand(plan: &Plan, shapes: Option<&Shapes>, id: NodeId, name: String) -> Operand {
    match (plan.graph.constant(id), plan.place(id), shapes) {
        (Some(value), ..) => Operand::Constant(plan.bits(value)),
        _ if logs::is_one(plan, id) => logs::operand(plan, id, name),
        (_, Some(place), Some(shapes)) => match plan.place_format(place) {
            Format::Log { .. } => Operand::At(name),
            _ => Operand::Held(name, shapes.of(plan, place)),
        },
        _ => Operand::At(name),
    }
}

fn instructions(plan: &Plan, routine: &Routine, args: &[Operand], bytes: u8) -> Vec<String> {
    let mut lines = Vec::new();
    let used = write::Use {
        routine,
        args,
        goal: &Goal::Held(RESULT, bytes),
        serial: 0,
        number: 0,
        calls: plan.lean || plan.tight,
    };
    write::instructions(used, &mut lines);
    lines
}

/// Which byte of a symbol stands in an operand; nothing where it is not one byte of it.
fn byte_of(operand: &str, symbol: &str) -> Option<u8> {
    match operand.strip_prefix(symbol)? {
        "" => Some(0),
        rest => rest.strip_prefix('+')?.parse().ok(),
    }
}

/// Whether no line reads a byte of an operand behind one that may have written that of the
/// result, and none goes back.
fn is_read_first(lines: &[String], symbol: &str) -> bool {
    let (mut labels, mut written) = (BTreeSet::new(), BTreeSet::new());
    for line in lines {
        let line = line.trim();
        if let Some(label) = line.strip_suffix(':') {
            labels.insert(label);
            continue;
        }
        let (name, operand) = line.split_once(' ').unwrap_or((line, ""));
        if labels.contains(operand) {
            return false;
        }
        if operand.contains(symbol) {
            match byte_of(operand, symbol) {
                Some(byte) if !written.contains(&byte) && !name.starts_with("st") => {}
                _ => return false,
            }
        }
        if operand.contains(RESULT) {
            match byte_of(operand, RESULT) {
                Some(byte) => written.insert(byte),
                None => return false,
            };
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_first(text: &str) -> bool {
        let lines: Vec<String> = text.split('|').map(str::to_owned).collect();
        is_read_first(&lines, OPERANDS[0])
    }

    #[test]
    fn what_is_read_behind_the_result_is_found() {
        let sum = "lda operand_0 | adc operand_1 | sta result | lda operand_0+1 | sta result+1";
        assert!(is_first(sum));
        assert!(!is_first(
            "lda operand_0 | sta result | lda operand_0+1 | cmp operand_0"
        ));
        // An operand that is changed, one that is pointed to, a way back.
        assert!(!is_first("lda #0 | sta operand_0"));
        assert!(!is_first("lda #<operand_0 | sta acc"));
        assert!(!is_first("again: | lda operand_0 | dex | bne again"));
        assert!(is_first("lda operand_0 | bne on | inx | on: | stx result"));
    }
}
