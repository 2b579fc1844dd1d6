//! The last steps: jumps to jumps, code that nobody reaches, addresses.

use super::code::{Code, GO, Ins, Label};
use crate::hack::asm::instruction::{LARGEST, written};
use crate::hack::asm::is_predefined;
use std::collections::{HashMap, HashSet};

/// Jumps go to where the jumps that they go to go.
fn thread(code: &mut Code) {
    let mut leads = HashMap::new();
    let mut waiting: Vec<Label> = Vec::new();
    let mut rest = code.ins.as_slice();
    while let Some((first, after)) = rest.split_first() {
        match (first, after.first()) {
            (Ins::Mark(label), _) => waiting.push(*label),
            (Ins::To(to), Some(Ins::Compute(GO))) => {
                leads.extend(waiting.drain(..).map(|label| (label, *to)));
            }
            _ => waiting.clear(),
        }
        rest = after;
    }
    let end = |label: Label| {
        let mut at = label;
        // A circle is an endless loop, wherever one enters it.
        for _ in 0..16 {
            match leads.get(&at) {
                Some(next) => at = *next,
                None => break,
            }
        }
        at
    };
    for ins in &mut code.ins {
        if let Ins::To(label) = ins {
            *label = end(*label);
        }
    }
}

/// Leaves out what follows a jump up to the next label that is used.
fn prune(code: &mut Code) {
    loop {
        let mut used = vec![false; code.names.len()];
        for ins in &code.ins {
            if let Ins::To(label) = ins
                && let Some(used) = used.get_mut(*label)
            {
                *used = true;
            }
        }
        let before = code.ins.len();
        let mut dead = false;
        code.ins.retain(|ins| {
            if let Ins::Mark(label) = ins {
                let used = used.get(*label).is_some_and(|used| *used);
                dead &= !used;
                return used;
            }
            let keep = !dead;
            dead |= *ins == Ins::Compute(GO);
            keep
        });
        if code.ins.len() == before {
            break;
        }
    }
}

/// Makes code final.
pub(super) fn tidy(code: &mut Code) {
    thread(code);
    prune(code);
}

/// The address of each label.
pub(super) fn addresses(code: &Code) -> Vec<usize> {
    let mut addresses = vec![0; code.names.len()];
    let mut at = 0;
    for ins in &code.ins {
        match ins {
            Ins::Mark(label) => {
                if let Some(address) = addresses.get_mut(*label) {
                    *address = at;
                }
            }
            _ => at += 1,
        }
    }
    addresses
}

/// The words of code that is final; addresses beyond the ROM are cut.
pub(super) fn words(code: &Code, addresses: &[usize]) -> Vec<u16> {
    let word = |ins: &Ins| match ins {
        Ins::At(value) => Some(*value),
        Ins::To(label) => {
            let address = addresses.get(*label).copied().unwrap_or(0);
            Some(address.min(usize::from(LARGEST)) as u16)
        }
        Ins::Compute(word) => Some(*word),
        Ins::Mark(_) => None,
    };
    code.ins.iter().filter_map(word).collect()
}

/// A name for each label, no two alike: its function's, or its number.
fn names(code: &Code) -> Vec<String> {
    let mut taken = HashSet::new();
    let labels = code.names.iter().enumerate();
    labels
        .map(|(label, name)| {
            let mut name = name.clone().unwrap_or_else(|| format!("${label}"));
            // What the assembler knows, and functions that are called like ours.
            while (!name.starts_with('$') && is_predefined(&name)) || taken.contains(&name) {
                name.push_str(&format!("${label}"));
            }
            taken.insert(name.clone());
            name
        })
        .collect()
}

/// The code as assembly.
pub(super) fn text(code: &Code) -> String {
    let names = names(code);
    let name = |label: &Label| names.get(*label).map_or("", String::as_str);
    let mut text = String::new();
    for ins in &code.ins {
        match ins {
            Ins::Mark(label) => text.push_str(&format!("({})\n", name(label))),
            Ins::To(label) => text.push_str(&format!("    @{}\n", name(label))),
            Ins::At(word) | Ins::Compute(word) => {
                if let Some(instruction) = written(*word) {
                    text.push_str(&format!("    {instruction}\n"));
                }
            }
        }
    }
    text
}
