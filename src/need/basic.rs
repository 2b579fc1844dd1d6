//! What a BASIC program takes of its machine's memory: the tokeniser's program, the list entries
//! of its names, its arrays, and the stack.

use super::{Measured, Need};
use crate::failure::{Failure, Outcome};
use slowlight_compiler::backend::Document;
use slowlight_compiler::ir::tree::{Statement, Tree, walk};
use slowlight_compiler::plan::Plan;
use slowlight_vm::bbc::{Config, Dialect, Machine, tokenise};

/// What BASIC's stack takes at most: three calls of the runtime's functions
/// inside each other, of 28 bytes and 8 an argument, and as much as a call more
/// for what an expression holds meanwhile.
const BASIC_STACK: u64 = 160;

/// What a procedure without arguments leaves on it while it runs: the
/// processor's stack, and where to return to.
const BASIC_CALL: u64 = 28;

pub(super) fn basic_machine(plan: &Plan, dialect: Dialect) -> Machine {
    let page = plan.page.unwrap_or(Config::default().page);
    Machine::new(Config { dialect, page })
}

pub(super) fn basic_room(plan: &Plan, machine: &Machine) -> Option<u64> {
    let mode = plan.mode.name.parse().ok()?;
    machine.memory(mode).map(|room| room as u64)
}

pub(super) fn basic(plan: &Plan, document: &Document, dialect: Dialect) -> Outcome<Option<Need>> {
    let refuse = |fault: slowlight_vm::Fault| {
        Failure::Wrong(format!("the tokeniser refuses {}: {fault}", document.name))
    };
    let tokens = tokenise(&document.text, dialect).map_err(refuse)?;
    let mut machine = basic_machine(plan, dialect);
    machine.load_tokenised(&tokens).map_err(refuse)?;
    let Some(room) = basic_room(plan, &machine) else {
        return Ok(None);
    };
    Ok(Some(Need {
        unit: "bytes",
        parts: vec![
            ("program", machine.program_bytes() as u64),
            ("variables", machine.entry_bytes() as u64),
            ("arrays", arrays(&document.text)),
            ("stack", BASIC_STACK + BASIC_CALL * depth(&plan.tree)),
        ],
        room,
        largest: None,
        system: false,
        of: Measured::Whole,
    }))
}

/// How many subroutines run inside each other at most.
fn depth(tree: &Tree) -> u64 {
    let mut depths: Vec<u64> = vec![0; tree.subroutines.len()];
    // One that is called stands before or behind who calls it; no chain of
    // calls is longer than there are subroutines.
    for _ in 0..depths.len() {
        for (k, subroutine) in tree.subroutines.iter().enumerate() {
            let mut inner = 0;
            walk(&subroutine.body, &mut |statement| {
                if let Statement::Call(id) = statement {
                    inner = inner.max(depths.get(id.0 as usize).copied().unwrap_or(0));
                }
            });
            if let Some(depth) = depths.get_mut(k) {
                *depth = inner + 1;
            }
        }
    }
    depths.into_iter().max().unwrap_or(0)
}

/// Bytes of the arrays, and of the places for bytes, that a program makes with constant bounds.
fn arrays(text: &str) -> u64 {
    let mut bytes = 0;
    for (at, _) in text.match_indices("DIM") {
        let mut rest = text.get(at + 3..).unwrap_or_default();
        // `DIM name% 99`: so many bytes and one more.
        let last = rest.split([':', '\n']).next().unwrap_or_default();
        if let Some((name, last)) = last.split_once('%')
            && !name.contains(['(', ','])
            && let Ok(last) = last.trim().parse::<u64>()
        {
            bytes += last + 1;
            continue;
        }
        while let Some((name, behind)) = rest.split_once('(')
            && let Some((bounds, behind)) = behind.split_once(')')
        {
            let bounds: Vec<u64> = bounds.split(',').filter_map(|n| n.parse().ok()).collect();
            let element = if name.ends_with('%') { 4 } else { 5 };
            let elements: u64 = bounds.iter().map(|n| n + 1).product();
            bytes += 1 + 2 * bounds.len() as u64 + element * elements;
            rest = match behind.strip_prefix(',') {
                Some(rest) => rest,
                None => break,
            };
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_are_counted_as_the_machine_makes_them() {
        assert_eq!(arrays("10DIM a(7,7):b=1"), 5 + 5 * 64);
        assert_eq!(arrays("10DIMn%(3):DIM error(9,1)"), 3 + 16 + 5 + 100);
        assert_eq!(arrays("10DIMn%(3),error(9,1):a=f(2)"), 3 + 16 + 5 + 100);
        assert_eq!(arrays("10PRINT"), 0);
        assert_eq!(arrays("10DIM kept% 99:DIMn%(3)\n20DIMb%7"), 100 + 19 + 8);
    }
}
