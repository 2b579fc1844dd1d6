//! Opcodes that the data sheet leaves out and every NMOS 6502 has: two instructions at once.
//!
//! The program is read once more, when nothing can be left out of it ([`super::tidy`]), the
//! runtime's parts with it. `rules` has what a few instructions become, `twice` loads a byte
//! into both registers that is wanted again. Only opcodes are put that are stable
//! ([`slowlight_isa::opcodes::Trust::Stable`]), and only where what is left in registers,
//! flags and memory is the same, but for what nobody reads behind it. A CMOS 6502 has other
//! instructions in their places.

mod rules;
#[cfg(test)]
mod tests;
mod twice;

use super::code::{Instruction, Line};
use super::flow::{Block, Flow};
use super::live::Places;
use super::rules::Edit;
use super::{Facts, GONE, Program};
use std::ops::Range;

/// Puts undocumented opcodes where they save bytes or cycles. `symbols` are the lines that
/// name the bytes that the program alone uses; what stands from line `from` on may change.
pub fn undocumented<T>(lines: &mut Vec<(String, T)>, symbols: &Range<usize>, from: usize) {
    let mut program = Program::new(lines, symbols);
    let edits = edits(&program, from);
    program.change(lines, edits);
    lines.retain(|(text, _)| text != GONE);
}

fn edits(program: &Program, from: usize) -> Vec<(usize, Edit)> {
    let Facts { flow, alive, .. } = program.facts();
    let rules = rules::all();
    (flow.blocks.iter().zip(&alive.behind))
        .filter(|(block, _)| from <= block.lines.start)
        .flat_map(|(block, behind)| {
            let block = Straight::new(&program.code, flow, block, behind);
            let mut edits = twice::edits(&block);
            rules::add(&block, &rules, &mut edits);
            let line = |(k, edit)| Some((*block.lines.get(k)?, edit));
            edits.into_iter().filter_map(line).collect::<Vec<_>>()
        })
        .collect()
}

/// The instructions of a block, one behind the other.
struct Straight<'a> {
    flow: &'a Flow,
    code: Vec<&'a Instruction>,
    /// Where each stands.
    lines: Vec<usize>,
    /// What is read later, behind each.
    behind: Vec<Places>,
}

impl<'a> Straight<'a> {
    fn new(lines: &'a [Line], flow: &'a Flow, block: &Block, behind: &Places) -> Straight<'a> {
        let found = block.lines.clone().filter_map(|k| match lines.get(k)? {
            Line::Code(code) => Some((k, code)),
            _ => None,
        });
        let (at, code): (Vec<usize>, Vec<&Instruction>) = found.unzip();
        let mut alive = behind.clone();
        let mut reversed: Vec<Places> = Vec::with_capacity(at.len());
        for k in at.iter().rev() {
            reversed.push(alive.clone());
            (flow.effects.get(*k).iter()).for_each(|effects| alive.back(effects));
        }
        reversed.reverse();
        Straight {
            flow,
            code,
            lines: at,
            behind: reversed,
        }
    }

    /// Whether nobody reads a place behind an instruction.
    fn is_dead(&self, k: usize, place: super::effects::Place) -> bool {
        self.behind.get(k).is_some_and(|alive| !alive.has(place))
    }
}
