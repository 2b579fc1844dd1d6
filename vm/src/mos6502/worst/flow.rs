//! Control flow: a routine's basic blocks, and their order with loops inside loops.
//!
//! Blocks that can reach each other are a loop (a strongly connected component). The one that
//! is entered from outside is the loop's head; where several are, one whose turns are bounded.
//! Without the ways back to the head the others are in order again, but for loops within the
//! loop: a weak topological order (Bourdoncle, 1993).

use super::{Question, Unknown, Why};
use slowlight_isa::opcodes::{Mode, OPCODES, Opcode, Trust};
use std::collections::{BTreeMap, BTreeSet};

/// An instruction of the program.
#[derive(Clone, Copy, Debug)]
pub(super) struct Instruction {
    pub address: u16,
    pub opcode: &'static Opcode,
    /// Its operand, of one byte or two; of a branch, where it goes.
    pub operand: u16,
    /// The address behind it.
    pub next: u16,
    /// Whether the program ends with it.
    pub exits: bool,
}

impl Instruction {
    pub fn at(question: &Question<'_>, address: u16) -> Result<Instruction, Unknown> {
        let assembly = question.assembly;
        let none = Unknown {
            address,
            why: Why::Instruction,
        };
        let begin = usize::from(address.wrapping_sub(assembly.origin));
        let byte = |at: usize| assembly.bytes.get(begin + at).copied().ok_or(none);
        let opcode = &OPCODES[usize::from(byte(0)?)];
        if matches!(opcode.trust, Trust::Jam | Trust::Unstable) {
            return Err(none);
        }
        let length = opcode.mode.bytes();
        let next = address.wrapping_add(length);
        let operand = match length {
            1 => 0,
            2 => u16::from(byte(1)?),
            _ => u16::from_le_bytes([byte(1)?, byte(2)?]),
        };
        let operand = match (opcode.mode, operand.to_le_bytes()[0]) {
            (Mode::Relative, distance) => next.wrapping_add_signed(i16::from(distance as i8)),
            _ => operand,
        };
        let stores = matches!(opcode.mnemonic, "sta" | "stx" | "sty");
        let exits = stores && opcode.mode == Mode::Absolute && question.exit == Some(operand);
        Ok(Instruction {
            address,
            opcode,
            operand,
            next,
            exits,
        })
    }

    /// Where it may go on within its routine.
    fn ways(&self) -> Result<Vec<u16>, Unknown> {
        match (self.opcode.mnemonic, self.opcode.mode) {
            _ if self.exits => Ok(Vec::new()),
            ("jmp", Mode::Absolute) => Ok(vec![self.operand]),
            ("rts", _) => Ok(Vec::new()),
            ("jmp" | "rti" | "brk", _) => Err(Unknown {
                address: self.address,
                why: Why::Jump,
            }),
            (_, Mode::Relative) => Ok(vec![self.next, self.operand]),
            _ => Ok(vec![self.next]),
        }
    }

    fn is_last(&self) -> bool {
        let jumps = matches!(self.opcode.mnemonic, "jmp" | "rts");
        self.exits || jumps || self.opcode.mode == Mode::Relative
    }
}

/// Blocks in an order in which each comes behind those that lead to it.
#[derive(Clone, Debug)]
pub(super) enum Part {
    /// A block.
    One(u16),
    /// A loop.
    Loop(Loop),
}

/// Blocks that can reach each other.
#[derive(Clone, Debug)]
pub(super) struct Loop {
    /// Where its turns begin.
    pub head: u16,
    /// What else is in it, in order from its head.
    pub rest: Vec<Part>,
    /// Where it is entered beside its head.
    pub entries: Vec<u16>,
}

/// A routine.
#[derive(Clone, Debug)]
pub(super) struct Routine {
    /// Instructions of the blocks, by their first ones' addresses.
    pub blocks: BTreeMap<u16, Vec<Instruction>>,
    pub parts: Vec<Part>,
}

type Ways = BTreeMap<u16, Vec<u16>>;

impl Routine {
    /// What begins at an address.
    pub fn of(question: &Question<'_>, entry: u16) -> Result<Routine, Unknown> {
        let mut code = BTreeMap::new();
        let mut heads = BTreeSet::from([entry]);
        let mut left = vec![entry];
        while let Some(address) = left.pop() {
            if code.contains_key(&address) || question.ends.contains(&address) {
                continue;
            }
            let instruction = Instruction::at(question, address)?;
            let ways = instruction.ways()?;
            if instruction.is_last() {
                heads.extend(&ways);
            }
            left.extend(&ways);
            code.insert(address, instruction);
        }
        heads.extend(&question.ends);
        let mut blocks = BTreeMap::new();
        let mut ways = Ways::new();
        for head in heads.iter().filter(|head| code.contains_key(head)) {
            let mut block: Vec<Instruction> = Vec::new();
            let mut at = *head;
            while let Some(instruction) = code.get(&at) {
                block.push(*instruction);
                at = instruction.next;
                if instruction.is_last() || heads.contains(&at) {
                    break;
                }
            }
            if let Some(last) = block.last() {
                let mut onward = last.ways()?;
                onward.retain(|to| code.contains_key(to));
                ways.insert(*head, onward);
                blocks.insert(*head, block);
            }
        }
        let all: BTreeSet<u16> = blocks.keys().copied().collect();
        let whole = Whole {
            ways: &ways,
            entry,
            question,
        };
        let parts = whole.order(&ways, &all, entry)?;
        Ok(Routine { blocks, parts })
    }
}

/// All of a routine's ways.
struct Whole<'w> {
    ways: &'w Ways,
    entry: u16,
    question: &'w Question<'w>,
}

impl Whole<'_> {
    /// The order of some blocks that are all reached from one of them, by some of the ways.
    fn order(&self, ways: &Ways, blocks: &BTreeSet<u16>, from: u16) -> Result<Vec<Part>, Unknown> {
        let mut parts = Vec::new();
        for component in components(ways, blocks, from) {
            let only = component.first().copied().unwrap_or(from);
            let again = ways.get(&only).is_some_and(|to| to.contains(&only));
            parts.push(match component.len() == 1 && !again {
                true => Part::One(only),
                false => Part::Loop(self.inside(ways, &component)?),
            });
        }
        Ok(parts)
    }

    /// A component as a loop: its head is where it is entered, or of several such places, or
    /// all of its blocks, the one of which it is said how often it is come to.
    fn inside(&self, ways: &Ways, component: &BTreeSet<u16>) -> Result<Loop, Unknown> {
        let outside = self
            .ways
            .iter()
            .filter(|(from, _)| !component.contains(from));
        let onward = outside.flat_map(|(_, to)| to).copied();
        let entered = onward.chain([self.entry]);
        let mut entries: Vec<u16> = entered.filter(|to| component.contains(to)).collect();
        entries.sort_unstable();
        entries.dedup();
        let known = |block: &&u16| self.question.turns.contains_key(block);
        let head = match entries.as_slice() {
            [one] => *one,
            several => {
                let address = several.first().copied().unwrap_or(self.entry);
                let said = several.iter().chain(component).find(known);
                *said.ok_or(Unknown {
                    address,
                    why: Why::Irregular,
                })?
            }
        };
        entries.retain(|entry| *entry != head);
        // Without the ways back to the head there are no loops but those within, and all is
        // still reached from it.
        let mut own = ways.clone();
        for onward in own.values_mut() {
            onward.retain(|to| *to != head && component.contains(to));
        }
        let mut rest = self.order(&own, component, head)?;
        rest.retain(|part| !matches!(part, Part::One(block) if *block == head));
        Ok(Loop {
            head,
            rest,
            entries,
        })
    }
}

/// Strongly connected components, each behind those that lead to it (Kosaraju).
fn components(ways: &Ways, blocks: &BTreeSet<u16>, entry: u16) -> Vec<BTreeSet<u16>> {
    let none = Vec::new();
    let onward = |block: u16| ways.get(&block).unwrap_or(&none);
    let mut seen = BTreeSet::from([entry]);
    let mut done = Vec::new();
    let mut path = vec![(entry, 0)];
    while let Some((block, next)) = path.pop() {
        match onward(block).get(next) {
            Some(to) => {
                path.push((block, next + 1));
                if blocks.contains(to) && seen.insert(*to) {
                    path.push((*to, 0));
                }
            }
            None => done.push(block),
        }
    }
    let mut back: BTreeMap<u16, Vec<u16>> = BTreeMap::new();
    for block in &done {
        for to in onward(*block) {
            back.entry(*to).or_default().push(*block);
        }
    }
    let mut all = Vec::new();
    let mut left: BTreeSet<u16> = done.iter().copied().collect();
    for block in done.iter().rev() {
        let mut component = BTreeSet::new();
        let mut path = vec![*block];
        while let Some(block) = path.pop() {
            if left.remove(&block) {
                component.insert(block);
                path.extend(back.get(&block).into_iter().flatten());
            }
        }
        if !component.is_empty() {
            all.push(component);
        }
    }
    all
}
