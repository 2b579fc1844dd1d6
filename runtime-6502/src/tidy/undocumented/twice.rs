//! A byte that is wanted again is loaded into both registers, where nobody needs X: where it
//! is loaded the second time it comes from there.

use super::super::code::{Instruction, Operand};
use super::super::effects::{A, Effects, NZ, Place, X};
use super::super::rules::Edit;
use super::Straight;
use std::collections::BTreeMap;

/// The edits, by the instruction's number in the block.
pub(super) fn edits(block: &Straight) -> BTreeMap<usize, Edit> {
    let mut spans: Vec<(usize, usize, Edit)> = (block.code.iter().enumerate())
        .filter(|(k, code)| code.name == "lda" && has_both(&code.operand) && block.is_dead(*k, X))
        .filter_map(|(k, code)| {
            let (to, edit) = again(block, k, &code.operand)?;
            Some((k, to, edit))
        })
        .collect();
    // X holds one byte at a time: what ends first leaves room for most.
    spans.sort_by_key(|(_, to, _)| *to);
    let (mut edits, mut free) = (BTreeMap::new(), 0);
    for (from, to, edit) in spans {
        let Some(code) = block.code.get(from).filter(|_| from >= free) else {
            continue;
        };
        // Where the byte comes from X it stays there.
        let both = Edit::Instead(format!("lax {}", code.operand.text()));
        edits.entry(from).or_insert(both);
        edits.insert(to, edit);
        free = to;
    }
    edits
}

/// Whether there is an opcode that loads A and X from there.
pub(super) fn has_both(operand: &Operand) -> bool {
    match operand {
        Operand::Cell(..) | Operand::Pointed(..) => true,
        Operand::Table(text) => text.ends_with(",y"),
        _ => false,
    }
}

/// Where a byte need not be fetched again, if X has it from an instruction on, and what
/// stands there instead.
fn again(block: &Straight, from: usize, operand: &Operand) -> Option<(usize, Edit)> {
    let cell = match operand {
        Operand::Cell(at, _) => block.flow.space.place(*at),
        _ => None,
    };
    // Whether A and the flags still have it.
    let (mut in_a, mut in_flags) = (true, true);
    for (k, code) in block.code.iter().enumerate().skip(from + 1) {
        let effects = block.flow.effects.get(*block.lines.get(k)?)?;
        let changes = |place| changes(effects, place);
        let same = cell.is_some() && code.operand == *operand;
        let quiet = in_flags || block.is_dead(k, NZ);
        match code.name.as_str() {
            "lda" if same => return Some((k, Edit::Instead("txa".to_owned()))),
            "ldx" if same && quiet => return Some((k, Edit::Gone)),
            "tax" if in_a && quiet => return Some((k, Edit::Gone)),
            _ => {}
        }
        if effects.unknown || changes(X) || cell.is_some_and(changes) || goes(code) {
            return None;
        }
        in_a &= !changes(A);
        in_flags &= !changes(NZ);
    }
    None
}

fn changes(effects: &Effects, place: Place) -> bool {
    effects.writes.contains(&place) || effects.may.contains(&place)
}

/// Whether an instruction is carried out elsewhere before the next.
fn goes(code: &Instruction) -> bool {
    matches!(code.name.as_str(), "jsr" | "jmp" | "rts")
}
