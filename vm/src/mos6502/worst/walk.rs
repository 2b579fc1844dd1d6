//! The interpretation: all ways through a routine, the longest where they meet.

use super::flow::{Instruction, Loop, Part, Routine};
use super::state::State;
use super::step::{learn, push, step, taken};
use super::{Question, Unknown, Why};
use slowlight_isa::opcodes::Mode;
use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;

/// Calls within calls.
const DEPTH: usize = 40;

/// Cycles and what is known, by the block that is come to.
type Inbox = BTreeMap<u16, (u64, State)>;

/// How a routine goes out.
#[derive(Clone, Debug, Default)]
struct Outcome {
    /// The most cycles to its return, and what is known there.
    returns: Option<(u64, State)>,
    /// The most cycles to an end.
    ends: Option<u64>,
}

impl Outcome {
    fn end(&mut self, cycles: u64) {
        self.ends = Some(self.ends.map_or(cycles, |most| most.max(cycles)));
    }
}

pub(super) struct Walk<'q> {
    question: &'q Question<'q>,
    routines: HashMap<u16, Rc<Routine>>,
    /// What calls came to.
    called: HashMap<(u16, State), Outcome>,
    depth: usize,
    fuel: u64,
}

fn unknown<T>(address: u16, why: Why) -> Result<T, Unknown> {
    Err(Unknown { address, why })
}

/// Adds a way to those that lead to a block.
fn meet(inbox: &mut Inbox, to: u16, cycles: u64, state: State) -> Result<(), Unknown> {
    let joined = match inbox.remove(&to) {
        None => (cycles, state),
        Some((before, other)) => match other.join(&state) {
            Some(joined) => (cycles.max(before), joined),
            None => return unknown(to, Why::Stack),
        },
    };
    inbox.insert(to, joined);
    Ok(())
}

impl<'q> Walk<'q> {
    pub fn new(question: &'q Question<'q>, fuel: u64) -> Walk<'q> {
        Walk {
            question,
            routines: HashMap::new(),
            called: HashMap::new(),
            depth: 0,
            fuel,
        }
    }

    pub fn worst(&mut self, from: u16) -> Result<u64, Unknown> {
        let out = self.call(from, State::default())?;
        let returns = out.returns.map(|(cycles, _)| cycles);
        returns.max(out.ends).ok_or(Unknown {
            address: from,
            why: Why::Endless,
        })
    }

    /// The most cycles from an address to one of the ends.
    pub fn slice(&mut self, from: u16) -> Result<u64, Unknown> {
        let out = self.call(from, State::default())?;
        match (out.returns, out.ends) {
            (None, Some(cycles)) => Ok(cycles),
            (None, None) => unknown(from, Why::Endless),
            (Some(_), _) => unknown(from, Why::Returns),
        }
    }

    /// Runs a routine from its first instruction.
    fn call(&mut self, entry: u16, state: State) -> Result<Outcome, Unknown> {
        let key = (entry, state);
        if let Some(known) = self.called.get(&key) {
            return Ok(known.clone());
        }
        if self.depth >= DEPTH {
            return unknown(entry, Why::Depth);
        }
        if self.question.ends.contains(&entry) {
            let mut out = Outcome::default();
            out.end(0);
            return Ok(out);
        }
        let routine = match self.routines.get(&entry) {
            Some(routine) => Rc::clone(routine),
            None => {
                let routine = Rc::new(Routine::of(self.question, entry)?);
                self.routines.insert(entry, Rc::clone(&routine));
                routine
            }
        };
        let mut out = Outcome::default();
        let mut inbox = Inbox::from([(entry, (0, key.1.clone()))]);
        self.depth += 1;
        self.parts(&routine, &routine.parts, &mut inbox, &mut out)?;
        self.depth -= 1;
        // What no block has is an end.
        for (cycles, _) in inbox.into_values() {
            out.end(cycles);
        }
        self.called.insert(key, out.clone());
        Ok(out)
    }

    fn parts(
        &mut self,
        routine: &Routine,
        parts: &[Part],
        inbox: &mut Inbox,
        out: &mut Outcome,
    ) -> Result<(), Unknown> {
        for part in parts {
            match part {
                Part::One(block) => {
                    if let Some((cycles, state)) = inbox.remove(block) {
                        self.block(routine, *block, (cycles, state), inbox, out)?;
                    }
                }
                Part::Loop(which) => {
                    self.begin(routine, which, inbox, out)?;
                    let Some(entered) = inbox.remove(&which.head) else {
                        continue;
                    };
                    match self.question.turns.get(&which.head) {
                        Some(turns) => {
                            let turns = u64::from(*turns);
                            self.bounded(routine, which, (entered, turns), inbox, out)?;
                        }
                        None => self.counted(routine, which, entered, inbox, out)?,
                    }
                }
            }
        }
        Ok(())
    }

    /// Follows the ways into a loop beside its head, to the head or out again.
    fn begin(
        &mut self,
        routine: &Routine,
        which: &Loop,
        inbox: &mut Inbox,
        out: &mut Outcome,
    ) -> Result<(), Unknown> {
        let mut inner = Inbox::new();
        for entry in &which.entries {
            if let Some(entered) = inbox.remove(entry) {
                inner.insert(*entry, entered);
            }
        }
        if inner.is_empty() {
            return Ok(());
        }
        self.parts(routine, &which.rest, &mut inner, out)?;
        for (to, (cycles, state)) in inner {
            meet(inbox, to, cycles, state)?;
        }
        Ok(())
    }

    /// A turn of a loop; what leads back to its head is left in `inbox`.
    fn turn(
        &mut self,
        routine: &Routine,
        which: &Loop,
        entered: (u64, State),
        inbox: &mut Inbox,
        out: &mut Outcome,
    ) -> Result<Option<(u64, State)>, Unknown> {
        self.block(routine, which.head, entered, inbox, out)?;
        self.parts(routine, &which.rest, inbox, out)?;
        Ok(inbox.remove(&which.head))
    }

    /// A loop that is run until no way leads back.
    fn counted(
        &mut self,
        routine: &Routine,
        which: &Loop,
        entered: (u64, State),
        inbox: &mut Inbox,
        out: &mut Outcome,
    ) -> Result<(), Unknown> {
        let mut now = entered;
        loop {
            let mut inner = Inbox::new();
            let before = now.1.clone();
            let back = self.turn(routine, which, now, &mut inner, out)?;
            for (to, (cycles, state)) in inner {
                meet(inbox, to, cycles, state)?;
            }
            match back {
                None => return Ok(()),
                // A turn that changes nothing that is known may come again for ever.
                Some((_, state)) if state == before => return unknown(which.head, Why::Loop),
                Some(again) => now = again,
            }
        }
    }

    /// A loop of so many turns at most, of which each may be the longest.
    fn bounded(
        &mut self,
        routine: &Routine,
        which: &Loop,
        ((begun, mut state), turns): ((u64, State), u64),
        inbox: &mut Inbox,
        out: &mut Outcome,
    ) -> Result<(), Unknown> {
        loop {
            let (mut inner, mut outer) = (Inbox::new(), Outcome::default());
            let back = self.turn(routine, which, (0, state.clone()), &mut inner, &mut outer)?;
            let longest = match back {
                None => 0,
                Some((cycles, after)) => {
                    let Some(joined) = state.join(&after) else {
                        return unknown(which.head, Why::Stack);
                    };
                    if joined != state {
                        state = joined;
                        continue;
                    }
                    cycles
                }
            };
            // All turns but the last, which goes out of the loop.
            let before = turns
                .saturating_sub(1)
                .saturating_mul(longest)
                .saturating_add(begun);
            for (to, (cycles, state)) in inner {
                meet(inbox, to, before.saturating_add(cycles), state)?;
            }
            if let Some(cycles) = outer.ends {
                out.end(before.saturating_add(cycles));
            }
            if let Some((cycles, state)) = outer.returns {
                returned(out, which.head, before.saturating_add(cycles), state)?;
            }
            return Ok(());
        }
    }

    fn block(
        &mut self,
        routine: &Routine,
        block: u16,
        (mut cycles, mut state): (u64, State),
        inbox: &mut Inbox,
        out: &mut Outcome,
    ) -> Result<(), Unknown> {
        let Some(instructions) = routine.blocks.get(&block) else {
            return unknown(block, Why::Instruction);
        };
        let spent = instructions.len() as u64;
        let Some(fuel) = self.fuel.checked_sub(spent) else {
            return unknown(block, Why::Fuel);
        };
        self.fuel = fuel;
        let mut next = block;
        for instruction in instructions {
            next = instruction.next;
            let base = u64::from(instruction.opcode.cycles);
            if instruction.exits {
                out.end(cycles + base);
                return Ok(());
            }
            match (instruction.opcode.mnemonic, instruction.opcode.mode) {
                (name, Mode::Relative) => {
                    let known = taken(name, &state);
                    if known != Some(true) {
                        let mut other = state.clone();
                        learn(name, false, &mut other);
                        meet(inbox, next, cycles + base, other)?;
                    }
                    if known != Some(false) {
                        learn(name, true, &mut state);
                        let more = branch(instruction);
                        meet(inbox, instruction.operand, cycles + base + more, state)?;
                    }
                    return Ok(());
                }
                ("jmp", _) => {
                    return meet(inbox, instruction.operand, cycles + base, state);
                }
                ("rts", _) => {
                    if !state.pushed.is_empty() {
                        return unknown(instruction.address, Why::Stack);
                    }
                    return returned(out, instruction.address, cycles + base, state);
                }
                ("jsr", _) => {
                    let (pushed, below) = (state.pushed.clone(), state.below);
                    for _ in 0..2 {
                        if !push(self.question, &mut state, false) {
                            return unknown(instruction.address, Why::Stack);
                        }
                    }
                    state.below = match self.question.mirrored {
                        true => u8::try_from(state.depth()).unwrap_or(u8::MAX),
                        false => 1,
                    };
                    state.pushed.clear();
                    let called = self.call(instruction.operand, state)?;
                    if let Some(ends) = called.ends {
                        out.end(cycles + base + ends);
                    }
                    let Some((taken, after)) = called.returns else {
                        return Ok(());
                    };
                    cycles = cycles.saturating_add(base + taken);
                    state = State {
                        pushed,
                        below,
                        ..after
                    };
                }
                _ => cycles += step(self.question, instruction, &mut state)?,
            }
        }
        meet(inbox, next, cycles, state)
    }
}

/// What a branch that is taken costs beside its two cycles.
fn branch(instruction: &Instruction) -> u64 {
    1 + u64::from((instruction.operand ^ instruction.next) & 0xFF00 != 0)
}

fn returned(out: &mut Outcome, at: u16, cycles: u64, state: State) -> Result<(), Unknown> {
    out.returns = Some(match out.returns.take() {
        None => (cycles, state),
        Some((before, other)) => match other.join(&state) {
            Some(joined) => (before.max(cycles), joined),
            None => return unknown(at, Why::Stack),
        },
    });
    Ok(())
}
