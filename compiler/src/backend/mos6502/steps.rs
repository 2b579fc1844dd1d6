//! Between two pictures: what is held, and the states' next values.

use super::bbc;
use super::c64;
use super::code::Code;
use super::memory::Machine;
use super::ports::{HANDS, HELD};
use super::slots::Slot;
use crate::backend::bbc::key as bbc_key;
use crate::backend::mos6502::homes::Homes;
use crate::ir::graph::*;
use crate::plan::Plan;
use slowlight_routine::{Format, Type};
use std::collections::BTreeSet;

/// Where the next picture begins.
pub(super) const NEXT: &str = "next_picture";

/// What stands behind a picture that moves.
pub(super) fn between(code: &mut Code<'_>) {
    code.text.span = None;
    let plan = code.plan;
    bbc::turn(plan, code.text);
    code.text.headline("what is held now");
    let machine = Machine::of(plan);
    // Looks once, whatever is asked for: who runs the program sees that a picture is drawn.
    match machine {
        Machine::Plain => code.text.code(&format!("sta {HANDS}")),
        Machine::C64 => {
            code.text
                .line("        ; a joystick in port 2, where no keys are selected");
            code.text.code(&format!(
                "{} | lda #$ff | sta $dc00 | lda $dc00 | sta prod | {}",
                c64::CIRCUITS,
                c64::RAM
            ));
        }
        Machine::Bbc if plan.graph.buttons().next().is_none() => {
            code.text.code(&is_held(Button::Fire));
        }
        Machine::Bbc => {
            code.text
                .line("        ; keys that are held are typed as well: a full buffer beeps");
            code.text.code("lda #21 | ldx #0 | jsr osbyte");
        }
    }
    for (id, button) in plan.graph.buttons() {
        let slot = Slot::Param(id.0);
        let (home, bytes) = (
            code.homes.name(slot).to_owned(),
            code.homes.bytes(plan, slot),
        );
        let skip = format!("not_{}", button.name());
        let tested = match machine {
            Machine::Plain => Some((HELD, 1 << button as u8, "beq")),
            Machine::C64 => Some(("prod", stick(button), "bne")),
            Machine::Bbc => None,
        };
        match tested {
            Some((held, bit, branch)) => {
                code.text.code(&format!(
                    "ldx #0 | lda {held} | and #{bit} | {branch} {skip} | inx"
                ));
                code.text.label(&skip);
                code.text.code(&format!("stx {home} | lda #0"));
            }
            None => {
                code.text.code(&is_held(button));
                code.text
                    .code(&format!("txa | and #1 | sta {home} | lda #0"));
            }
        }
        for k in 1..bytes {
            code.text.code(&format!("sta {home}+{k}"));
        }
    }
    code.text.headline("the states in the next picture");
    code.block(&plan.tree.step);
    code.text.span = None;
    for step in in_turn(&plan.graph) {
        code.give(step);
    }
    code.text.code(&format!("jmp {NEXT}"));
}

/// A button's bit of a joystick, which is 0 where it is held.
fn stick(button: Button) -> u8 {
    match button {
        Button::Up => 1,
        Button::Down => 2,
        Button::Left => 4,
        Button::Right => 8,
        Button::Fire => 16,
    }
}

/// Asks a BBC Micro whether a button's key is held: x is 255 then, else 0.
fn is_held(button: Button) -> String {
    let number = bbc_key(button).wrapping_neg();
    format!("lda #129 | ldx #{number} | ldy #255 | jsr osbyte")
}

/// One of the copies that give all states their next values at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Move {
    /// Gives a state a node's value.
    Give(ParamId, NodeId),
    /// Puts a state's value aside, before it is given another.
    Aside(ParamId),
    /// Gives a state what was put aside.
    Back(ParamId),
}

/// The copies in an order in which none spoils what a later one reads: a state that others are
/// given is read before it is written, and of a ring of such one is put aside.
pub(super) fn in_turn(graph: &Graph) -> Vec<Move> {
    let source = |next: NodeId| match graph.node(next) {
        Node::Param(other) => Some(other),
        _ => None,
    };
    let steps = graph
        .steps()
        .filter(|(state, next)| source(*next) != Some(*state));
    let mut waiting: Vec<(ParamId, NodeId)> = steps.collect();
    let mut aside: BTreeSet<ParamId> = BTreeSet::new();
    let mut done = Vec::new();
    while !waiting.is_empty() {
        let read = |state: ParamId| {
            let readers = waiting
                .iter()
                .filter(|(_, next)| source(*next) == Some(state));
            readers.count() > 0 && !aside.contains(&state)
        };
        match waiting.iter().position(|(state, _)| !read(*state)) {
            Some(at) => {
                let (state, next) = waiting.remove(at);
                let from = source(next).filter(|from| aside.remove(from));
                done.push(match from {
                    Some(_) => Move::Back(state),
                    None => Move::Give(state, next),
                });
            }
            None => {
                let Some((state, _)) = waiting.first() else {
                    break;
                };
                aside.insert(*state);
                done.push(Move::Aside(*state));
            }
        }
    }
    done
}

impl Code<'_> {
    pub(super) fn give(&mut self, copy: Move) {
        let plan = self.plan;
        let home = |code: &Self, state: ParamId| {
            let slot = Slot::Param(state.0);
            (
                code.homes.name(slot).to_owned(),
                code.homes.bytes(plan, slot),
            )
        };
        match copy {
            Move::Aside(state) => {
                let (home, bytes) = home(self, state);
                for k in 0..bytes {
                    self.text.code(&format!("lda {home}+{k} | pha"));
                }
            }
            Move::Back(state) => {
                let (home, bytes) = home(self, state);
                for k in (0..bytes).rev() {
                    self.text.code(&format!("pla | sta {home}+{k}"));
                }
            }
            Move::Give(state, next) => {
                let (home, bytes) = home(self, state);
                let bytes = match plan.graph.ty(next) {
                    Type::Bool => 1,
                    _ => bytes as u8,
                };
                self.text.line(format!("        ; {home}"));
                let real = plan.graph.ty(next) == Type::Real;
                if real && plan.points().is_some() {
                    return self.give_real(state, (&home, bytes), next);
                }
                let from = self.homes.operand(plan, next);
                match plan.runtime.real {
                    format @ Format::Real40 if real => self.copy(&from, &home, format),
                    _ => self.copy_bytes(&from, (&home, bytes)),
                }
            }
        }
    }
}

/// Where a state is in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Held {
    /// Which state.
    pub state: ParamId,
    /// The address of its lowest byte.
    pub address: u16,
    /// How many bytes it has.
    pub bytes: u8,
    /// Which of them the program reads, by bit: the others are not kept.
    pub read: u8,
}

/// Which bytes of a home a program reads, by bit: all where it takes the home's address.
pub(super) fn read(lines: &[&str], home: &str) -> u8 {
    let mut read = 0;
    for line in lines {
        let mut words = line.split_whitespace();
        let (Some(name), Some(operand)) = (words.next(), words.next()) else {
            continue;
        };
        let named = |word: &str| {
            let mut symbols = word.split(|c: char| !(c.is_alphanumeric() || c == '_'));
            symbols.any(|symbol| symbol == home)
        };
        if matches!(name, "sta" | "stx" | "sty") || name.starts_with(';') || !named(operand) {
            continue;
        }
        let byte = match operand.strip_prefix(home) {
            Some("") => Some(0),
            Some(rest) => rest.strip_prefix('+').and_then(|k| k.parse::<u32>().ok()),
            None => None,
        };
        read |= byte.and_then(|k| 1u8.checked_shl(k)).unwrap_or(0xFF);
    }
    read
}

/// Where the program has its states, in their order.
pub fn held(plan: &Plan) -> Vec<Held> {
    let homes = Homes::new(plan);
    let text = super::document(plan, super::syntax::USUAL).text;
    let lines: Vec<&str> = text.lines().filter(|line| line.starts_with(' ')).collect();
    let steps = plan.graph.steps();
    let held = steps.filter_map(|(state, next)| {
        let slot = Slot::Param(state.0);
        let size = homes.bytes(plan, slot) as u8;
        Some(Held {
            state,
            address: homes.address(slot)?,
            bytes: match plan.graph.ty(next) {
                Type::Bool => 1,
                Type::Real if plan.runtime.real == Format::Real40 => 5,
                _ => size,
            },
            read: read(&lines, homes.name(slot)),
        })
    });
    held.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::check;
    use crate::sema::Options;

    /// What copies make of the values 1, 2, 3 and so on, where a computed one gives 100.
    fn given(text: &str) -> Vec<u32> {
        let text = format!("image 8 x 4 inks black, white; {text} draw (x, y) = ink(a);");
        let scene = check("test", &text);
        assert!(scene.is_right(), "{:?}", scene.diagnostics);
        let options = Options {
            moves: true,
            ..Options::default()
        };
        let graph = scene.lower(&options).expect("a graph");
        let mut values: Vec<u32> = (1..).take(graph.params.len()).collect();
        let mut aside = Vec::new();
        for copy in in_turn(&graph) {
            match copy {
                Move::Aside(state) => aside.push(values[state.0 as usize]),
                Move::Back(state) => values[state.0 as usize] = aside.pop().expect("one"),
                Move::Give(state, next) => {
                    values[state.0 as usize] = match graph.node(next) {
                        Node::Param(other) => values[other.0 as usize],
                        _ => 100,
                    };
                }
            }
        }
        assert!(aside.is_empty());
        values
    }

    fn state(name: &str, next: &str) -> String {
        format!("state {name}: bool = true -> {next};")
    }

    #[test]
    fn states_are_given_each_other_s_values_at_once() {
        let all = |pairs: &[(&str, &str)]| {
            let a = "state a: int = 1 in 0 .. 9 -> a + 1;".to_owned();
            let rest = pairs.iter().map(|(name, next)| state(name, next));
            given(&std::iter::once(a).chain(rest).collect::<String>())
        };
        assert_eq!(all(&[("p", "q"), ("q", "p")]), [100, 3, 2]);
        assert_eq!(all(&[("p", "q"), ("q", "r"), ("r", "p")]), [100, 3, 4, 2]);
        assert_eq!(
            all(&[("p", "q"), ("q", "not q"), ("r", "q")]),
            [100, 3, 100, 3]
        );
        assert_eq!(
            all(&[("p", "q"), ("q", "p"), ("r", "p"), ("s", "t"), ("t", "s")]),
            [100, 3, 2, 2, 6, 5]
        );
    }
}
