//! The program, read again as a whole: what is known of registers, flags and bytes at each
//! line, and what is still read of them, leaves out what nobody needs.
//!
//! Statements are written one by one, each as if it stood alone, and so are the parts of the
//! runtime that stand in place. Here that is seen together:
//!
//! - a byte that a register has is not loaded again, and one that a place has not stored;
//! - what a place got from another, or as a number, is read from there (a copy is then often
//!   read by nobody);
//! - what is read by nobody is not computed;
//! - a carry that is known is not cleared or set;
//! - jumps go where they end up, and a branch around a jump is a branch.
//!
//! The runtime's parts and the machine's are read with the program, and left as they stand.
//! `code` reads lines, `effects` says what an instruction does, `flow` where it goes on, `live`
//! what is read later, `values` what is held (`state`: in a block); `rules`, `thread` and
//! `jumps` change lines.

mod code;
mod effects;
mod flow;
mod jumps;
mod live;
pub mod outline;
mod rules;
mod state;
#[cfg(test)]
mod tests;
mod thread;
pub mod undocumented;
mod values;

use code::{Line, Names};
use flow::{Block, Flow};
use live::Alive;
use rules::Edit;
use state::State;
use std::cell::{Cell, OnceCell};
use std::ops::Range;
use thread::Known;
use values::Held;

/// Rounds of all rules, at most; what a round leaves is a program like any other.
const ROUNDS: usize = 8;

/// A round that changes no more than one line in so many is the last of them.
const FEW: usize = 2_000;

/// What stands for a line that is left out, until all are taken away.
const GONE: &str = ";";

/// Leaves out of a program what it does without. `symbols` are the lines that name the bytes
/// that it alone uses, `own` those that may change. Each line comes with something that it
/// keeps.
pub fn tidy<T>(lines: &mut Vec<(String, T)>, symbols: &Range<usize>, own: &Range<usize>) {
    let mut program = Program::new(lines, symbols);
    for _ in 0..ROUNDS {
        let mut changed = 0;
        for rule in [forward, backward, threads, jumps] {
            let edits = rule(&program, own);
            changed += program.change(lines, edits);
        }
        if changed * FEW <= lines.len() {
            break;
        }
    }
    // What is left is mostly theirs, and they look at no more than lines.
    for _ in 0..ROUNDS {
        let edits = jumps(&program, own);
        if program.change(lines, edits) == 0 {
            break;
        }
    }
    lines.retain(|(text, _)| text != GONE);
}

/// Lines as instructions.
struct Program {
    code: Vec<Line>,
    names: Names,
    /// What is known of them as they are now, once that was asked for.
    facts: OnceCell<Facts>,
    /// What was known before, to be written over.
    spare: Cell<Held>,
}

/// What is known of a program.
struct Facts {
    flow: Flow,
    alive: Alive,
    held: OnceCell<Held>,
}

impl Program {
    fn new<T>(lines: &[(String, T)], symbols: &Range<usize>) -> Program {
        let texts: Vec<&str> = lines.iter().map(|(text, _)| text.as_str()).collect();
        let names = Names::new(&texts, symbols.clone());
        let code = texts.iter().map(|text| names.read(text)).collect();
        Program {
            code,
            names,
            facts: OnceCell::new(),
            spare: Cell::default(),
        }
    }

    fn facts(&self) -> &Facts {
        self.facts.get_or_init(|| {
            let flow = Flow::new(&self.code, &self.names);
            let alive = live::alive(&flow);
            Facts {
                flow,
                alive,
                held: OnceCell::new(),
            }
        })
    }

    /// Edits touch instructions alone, so names stay what they are. How many lines became others.
    fn change<T>(&mut self, lines: &mut [(String, T)], edits: Vec<(usize, Edit)>) -> usize {
        let mut changed = 0;
        for (k, edit) in edits {
            if let (Some((text, _)), Some(code)) = (lines.get_mut(k), self.code.get_mut(k)) {
                let other = match edit {
                    Edit::Gone => GONE.to_owned(),
                    Edit::Instead(code) => format!("        {code}"),
                };
                changed += usize::from(*text != other);
                *text = other;
                *code = self.names.read(text);
            }
        }
        if changed > 0 {
            let held = self.facts.take().and_then(|facts| facts.held.into_inner());
            self.spare.set(held.unwrap_or_default());
        }
        changed
    }
}

/// Whether all lines of a block may change.
fn may_change(block: &Block, own: &Range<usize>) -> bool {
    own.start <= block.lines.start && block.lines.end <= own.end
}

fn forward(program: &Program, own: &Range<usize>) -> Vec<(usize, Edit)> {
    let Facts { flow, alive, .. } = program.facts();
    let met = rules::met(flow);
    known(program, own, |b, start| {
        let Some((block, behind)) = flow.blocks.get(b).zip(alive.behind.get(b)) else {
            return Vec::new();
        };
        rules::forward(&program.code, flow, block, start, behind, &met)
    })
}

fn backward(program: &Program, own: &Range<usize>) -> Vec<(usize, Edit)> {
    let Facts { flow, alive, .. } = program.facts();
    (flow.blocks.iter().zip(&alive.behind))
        .filter(|(block, _)| may_change(block, own))
        .flat_map(|(block, behind)| rules::backward(&program.code, flow, block, behind))
        .collect()
}

fn threads(program: &Program, own: &Range<usize>) -> Vec<(usize, Edit)> {
    let Facts { flow, alive, .. } = program.facts();
    let ways = Known {
        lines: &program.code,
        names: &program.names,
        flow,
        behind: &alive.behind,
    };
    known(program, own, |b, start| {
        let block = flow.blocks.get(b);
        block.map_or_else(Vec::new, |block| ways.edits(block, start))
    })
}

/// Edits of all blocks that may change and of which it is known what places hold where they
/// begin.
fn known(
    program: &Program,
    own: &Range<usize>,
    edits: impl Fn(usize, &mut State) -> Vec<(usize, Edit)>,
) -> Vec<(usize, Edit)> {
    let Facts { flow, alive, held } = program.facts();
    let held = held.get_or_init(|| Held::of(&program.code, flow, alive, program.spare.take()));
    let mut state = State::default();
    let blocks = flow.blocks.iter().enumerate();
    blocks
        .filter(|(_, block)| may_change(block, own))
        .filter_map(|(b, _)| Some((b, held.at_start(b)?)))
        .flat_map(|(b, start)| {
            state.enter(b, start);
            edits(b, &mut state)
        })
        .collect()
}

fn jumps(program: &Program, own: &Range<usize>) -> Vec<(usize, Edit)> {
    jumps::edits(&program.code, &program.names, own)
}
