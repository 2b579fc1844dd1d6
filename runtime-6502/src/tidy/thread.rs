//! Ways on that what is known decides: a jump to a question whose answer is known goes where
//! that leads, and a branch that is never or always taken is none.

use super::code::{Line, Names, Operand, is_branch};
use super::effects::{A, C, NZ};
use super::flow::{Block, End, Flow};
use super::jumps::{self, label, name, next_code};
use super::live::Places;
use super::rules::Edit;
use super::state::{BYTES, State, Value};
use super::values;

/// Questions that are passed at once, at most.
const MOST: usize = 8;

/// A program, and what is known of it.
pub(super) struct Known<'a> {
    pub lines: &'a [Line],
    pub names: &'a Names,
    pub flow: &'a Flow,
    /// What is read behind each block.
    pub behind: &'a [Places],
}

impl Known<'_> {
    /// What becomes of a block's end; `state` is what places hold where it begins.
    pub fn edits(&self, block: &Block, state: &mut State) -> Vec<(usize, Edit)> {
        let (mut last, mut before) = (None, "");
        let stale = values::stale(state, &block.lines);
        for k in block.lines.clone() {
            if let Some(Line::Code(code)) = self.lines.get(k) {
                values::carry_out(state, self.flow, k, code, &stale);
                before = last.map_or("", |last| name(self.lines, last));
                last = Some(k);
            }
        }
        let Some(k) = last else {
            return Vec::new();
        };
        let own = name(self.lines, k);
        match block.end {
            End::Branch(_) => match taken(own, state) {
                Some(false) => vec![(k, Edit::Gone)],
                Some(true) => self.always(k, state),
                None => {
                    values::decided(state, own, true);
                    // What is equal is not below.
                    if own == "beq" && matches!(before, "cmp" | "cpx" | "cpy") {
                        state.put(C, 1);
                    }
                    self.onward(k, state)
                }
            },
            End::Jump => self.onward(k, state),
            _ => Vec::new(),
        }
    }

    /// A branch that is taken whenever it is come to.
    fn always(&self, k: usize, state: &mut State) -> Vec<(usize, Edit)> {
        let behind = self.lines.get(k + 1);
        let to = label(self.lines, k);
        match (behind, to) {
            // What stands behind it is come to by nothing.
            (Some(Line::Code(_)), Some(to)) => vec![(k, Edit::Instead(format!("jmp {to}")))],
            _ => self.onward(k, state),
        }
    }

    /// A jump or a branch goes where the questions behind it lead.
    fn onward(&self, k: usize, state: &mut State) -> Vec<(usize, Edit)> {
        let own = name(self.lines, k);
        let Some(first) = label(self.lines, k).and_then(|to| self.names.line_of(to)) else {
            return Vec::new();
        };
        let Some(to) = self.led(first, state) else {
            return Vec::new();
        };
        let near = own == "jmp"
            || (self.names.line_of(to)).is_some_and(|line| jumps::reaches(self.lines, k, line));
        match near {
            true => vec![(k, Edit::Instead(format!("{own} {to}")))],
            false => Vec::new(),
        }
    }

    /// The label that questions from a line on lead to.
    fn led(&self, from: usize, state: &mut State) -> Option<&str> {
        let (mut at, mut found) = (next_code(self.lines, from)?, None);
        let mut loads = false;
        for _ in 0..MOST {
            let Some(Line::Code(code)) = self.lines.get(at) else {
                break;
            };
            if is_branch(&code.name) {
                let Some(taken) = taken(&code.name, state) else {
                    break;
                };
                if taken {
                    let to = label(self.lines, at)?;
                    let line = self.names.line_of(to)?;
                    found = Some((to, line, loads));
                    at = next_code(self.lines, line)?;
                } else {
                    at = next_code(self.lines, at + 1)?;
                }
            } else if code.name == "jmp" {
                let to = label(self.lines, at)?;
                let line = self.names.line_of(to)?;
                found = Some((to, line, loads));
                at = next_code(self.lines, line)?;
            } else if code.name == "lda" && matches!(code.operand, Operand::Cell(..)) {
                let value = values::read(state, self.flow, &code.operand)?;
                [A, NZ].iter().for_each(|p| state.put(*p, value));
                loads = true;
                at = next_code(self.lines, at + 1)?;
            } else {
                break;
            }
        }
        // What was loaded on the way must not be read there.
        found.and_then(|(to, line, loads)| (!loads || self.is_free(line)).then_some(to))
    }

    /// Whether nobody reads the accumulator and the flags from a line on.
    fn is_free(&self, line: usize) -> bool {
        let mut blocks = self.flow.blocks.iter().zip(self.behind);
        let Some((block, behind)) = blocks.find(|(block, _)| block.lines.start == line) else {
            return false;
        };
        let mut alive = behind.clone();
        for k in block.lines.clone().rev() {
            (self.flow.effects.get(k).iter()).for_each(|effects| alive.back(effects));
        }
        !alive.has(A) && !alive.has(NZ)
    }
}

/// Whether a branch is taken, where that is known.
fn taken(branch: &str, state: &State) -> Option<bool> {
    let byte = |place| {
        let value: Value = state.held(place);
        (value < BYTES).then_some(value)
    };
    match branch {
        "bcs" => byte(C).map(|c| c == 1),
        "bcc" => byte(C).map(|c| c == 0),
        "beq" => byte(NZ).map(|v| v == 0),
        "bne" => byte(NZ).map(|v| v != 0),
        "bmi" => byte(NZ).map(|v| v >= 0x80),
        "bpl" => byte(NZ).map(|v| v < 0x80),
        _ => None,
    }
}
