//! Transfer functions: what an instruction makes of what is known, and what it costs.

use super::super::LineSpan;
use super::flow::Instruction;
use super::state::State;
use super::{Question, Unknown, Why};
use slowlight_isa::opcodes::Mode;

/// Where an operand is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    Nowhere,
    Accumulator,
    Number(u8),
    At(u16),
    /// Within 256 bytes from here on.
    From(u16),
    /// Within the zero page.
    Zero,
    Anywhere,
}

/// Finds the operand; says whether an index may cross a page on the way.
fn place(instruction: &Instruction, state: &State) -> (Place, bool) {
    let operand = instruction.operand;
    let zero = |index: Option<u8>| match (index, operand.to_le_bytes()[0]) {
        (Some(index), base) => Place::At(u16::from(base.wrapping_add(index))),
        (None, _) => Place::Zero,
    };
    let indexed = |base: u16, index: Option<u8>| match index {
        Some(index) => {
            let at = base.wrapping_add(u16::from(index));
            (Place::At(at), (at ^ base) & 0xFF00 != 0)
        }
        None => (Place::From(base), base & 0xFF != 0),
    };
    match instruction.opcode.mode {
        Mode::Implied | Mode::Relative | Mode::Indirect => (Place::Nowhere, false),
        Mode::Accumulator => (Place::Accumulator, false),
        Mode::Immediate => (Place::Number(operand.to_le_bytes()[0]), false),
        Mode::ZeroPage | Mode::Absolute => (Place::At(operand), false),
        Mode::ZeroPageX => (zero(state.x), false),
        Mode::ZeroPageY => (zero(state.y), false),
        Mode::AbsoluteX => indexed(operand, state.x),
        Mode::AbsoluteY => indexed(operand, state.y),
        Mode::IndirectX => (Place::Anywhere, false),
        Mode::IndirectY => {
            let byte = |at: u16| state.memory.get(&(at & 0xFF)).copied();
            match (byte(operand), byte(operand.wrapping_add(1))) {
                (Some(low), Some(high)) => indexed(u16::from_le_bytes([low, high]), state.y),
                (Some(low), None) => {
                    let most = u16::from(low) + u16::from(state.y.unwrap_or(0xFF));
                    (Place::Anywhere, most > 0xFF)
                }
                (None, _) => (Place::Anywhere, state.y != Some(0)),
            }
        }
    }
}

fn read(place: Place, state: &State) -> Option<u8> {
    match place {
        Place::Accumulator => state.a,
        Place::Number(value) => Some(value),
        Place::At(at) => state.memory.get(&at).copied(),
        Place::Nowhere | Place::From(_) | Place::Zero | Place::Anywhere => None,
    }
}

/// Where a store goes.
struct Store<'q> {
    question: &'q Question<'q>,
    address: u16,
}

impl Store<'_> {
    fn write(&self, place: Place, value: Option<u8>, state: &mut State) -> Result<(), Unknown> {
        match place {
            Place::Accumulator => state.a = value,
            Place::At(at) => {
                self.is_data(at, 0)?;
                self.is_free(at, state)?;
                match value.filter(|_| self.question.ram.contains(&at)) {
                    Some(value) => {
                        state.memory.insert(at, value);
                    }
                    None => {
                        state.memory.remove(&at);
                    }
                }
            }
            Place::From(base) => {
                self.is_data(base, 0xFF)?;
                self.is_free(base.checked_add(0xFF).unwrap_or(0xFF), state)?;
                state.memory.retain(|at, _| at.wrapping_sub(base) > 0xFF);
            }
            Place::Zero => {
                self.is_free(0xFF, state)?;
                state.memory.retain(|at, _| *at > 0xFF);
            }
            Place::Anywhere => state.memory.clear(),
            Place::Nowhere | Place::Number(_) => {}
        }
        Ok(())
    }

    /// Fails where the stack is in the zero page and a store there may be as far up as it.
    fn is_free(&self, to: u16, state: &State) -> Result<(), Unknown> {
        let used = u16::try_from(state.depth()).unwrap_or(0x100);
        match self.question.mirrored && to <= 0xFF && to + used > 0xFF {
            true => Err(Unknown {
                address: self.address,
                why: Why::Stack,
            }),
            false => Ok(()),
        }
    }

    /// Whether one of the program's instructions is at one of these addresses.
    fn is_code(&self, from: u32, to: u32) -> bool {
        let lines = &self.question.assembly.lines;
        let behind = lines.partition_point(|span| u32::from(span.address) <= to);
        let before = lines.get(..behind).unwrap_or_default().iter().rev();
        let spans = before.filter(|span| span.length > 0);
        let reaches = |span: &&LineSpan| u32::from(span.address) + span.length > from;
        spans.take_while(reaches).any(|span| span.code)
    }

    /// Fails where an address, or one of the `reach` behind it, is one of the program's
    /// instructions or on the stack.
    fn is_data(&self, at: u16, reach: u16) -> Result<(), Unknown> {
        let wrong = |why| {
            Err(Unknown {
                address: self.address,
                why,
            })
        };
        let (from, to) = (u32::from(at), u32::from(at) + u32::from(reach));
        // Behind the last address the first comes again.
        let (again, last) = (to.checked_sub(0x10000), to.min(0xFFFF));
        if self.is_code(from, last) || again.is_some_and(|to| self.is_code(0, to)) {
            return wrong(Why::Modifies);
        }
        let stack = from <= 0x1FF && to >= 0x100 || again.is_some_and(|to| to >= 0x100);
        match stack {
            true => wrong(Why::Stack),
            false => Ok(()),
        }
    }
}

/// Puts a byte on the stack, which may be the flags; says whether there is room.
pub(super) fn push(question: &Question<'_>, state: &mut State, flags: bool) -> bool {
    let depth = state.depth();
    if question.mirrored {
        let at = u16::try_from(depth)
            .ok()
            .and_then(|d| 0xFF_u16.checked_sub(d));
        let Some(at) = at.filter(|at| question.ram.contains(at)) else {
            return false;
        };
        state.memory.remove(&at);
    }
    state.pushed.push(flags);
    depth < 0xFF
}

/// Runs an instruction that is no jump, branch, call or return; answers its cycles.
pub(super) fn step(
    question: &Question<'_>,
    instruction: &Instruction,
    state: &mut State,
) -> Result<u64, Unknown> {
    let opcode = instruction.opcode;
    let wrong = |why| {
        Err(Unknown {
            address: instruction.address,
            why,
        })
    };
    let (place, crosses) = place(instruction, state);
    let cycles = u64::from(opcode.cycles) + u64::from(crosses && opcode.page_cycle());
    let value = read(place, state);
    let store = Store {
        question,
        address: instruction.address,
    };
    let s = state;
    match opcode.mnemonic {
        "lda" => s.a = s.flags(value),
        "ldx" => s.x = s.flags(value),
        "ldy" => s.y = s.flags(value),
        "sta" => store.write(place, s.a, s)?,
        "stx" => store.write(place, s.x, s)?,
        "sty" => store.write(place, s.y, s)?,
        "tax" => s.x = s.flags(s.a),
        "tay" => s.y = s.flags(s.a),
        "txa" => s.a = s.flags(s.x),
        "tya" => s.a = s.flags(s.y),
        "inx" => s.x = s.flags(s.x.map(|x| x.wrapping_add(1))),
        "iny" => s.y = s.flags(s.y.map(|y| y.wrapping_add(1))),
        "dex" => s.x = s.flags(s.x.map(|x| x.wrapping_sub(1))),
        "dey" => s.y = s.flags(s.y.map(|y| y.wrapping_sub(1))),
        "inc" => {
            let value = s.flags(value.map(|v| v.wrapping_add(1)));
            store.write(place, value, s)?;
        }
        "dec" => {
            let value = s.flags(value.map(|v| v.wrapping_sub(1)));
            store.write(place, value, s)?;
        }
        "asl" | "lsr" | "rol" | "ror" => {
            let left = matches!(opcode.mnemonic, "asl" | "rol");
            let carried = matches!(opcode.mnemonic, "rol" | "ror");
            let value = s.shift(value, left, carried);
            store.write(place, value, s)?;
        }
        "adc" => s.add(value),
        "sbc" => s.add(value.map(|v| !v)),
        "cmp" => s.compare(s.a, value),
        "cpx" => s.compare(s.x, value),
        "cpy" => s.compare(s.y, value),
        "and" => s.a = s.flags(mixed(s.a, value, |a, v| a & v)),
        "ora" => s.a = s.flags(mixed(s.a, value, |a, v| a | v)),
        "eor" => s.a = s.flags(mixed(s.a, value, |a, v| a ^ v)),
        "bit" => {
            s.n = value.map(|v| v & 0x80 != 0);
            s.v = value.map(|v| v & 0x40 != 0);
            s.z = s.a.zip(value).map(|(a, v)| a & v == 0);
        }
        "clc" => s.c = Some(false),
        "sec" => s.c = Some(true),
        "clv" => s.v = Some(false),
        "cld" | "sei" | "cli" | "nop" => {}
        "pha" | "php" => {
            if !push(question, s, opcode.mnemonic == "php") {
                return wrong(Why::Stack);
            }
        }
        "pla" | "plp" => match (s.pushed.pop(), opcode.mnemonic) {
            (None, _) => return wrong(Why::Stack),
            (Some(_), "pla") => s.a = s.flags(None),
            (Some(true), _) => (s.n, s.z, s.c, s.v) = (None, None, None, None),
            // Any byte may be decimal mode's.
            (Some(false), _) => return wrong(Why::Decimal),
        },
        // The stack may be emptied where a program begins.
        "txs" if s.depth() == 0 && s.x == Some(0xFF) => {}
        "tsx" => s.x = s.flags(None),
        "txs" => return wrong(Why::Stack),
        "sed" => return wrong(Why::Decimal),
        // Undocumented: nothing is known of what they leave.
        _ => {
            (s.a, s.x, s.n, s.z, s.c, s.v) = (None, None, None, None, None, None);
            if !matches!(place, Place::Accumulator) && opcode.mnemonic != "lax" {
                store.write(place, None, s)?;
            }
        }
    }
    Ok(cycles)
}

fn mixed(a: Option<u8>, value: Option<u8>, of: impl Fn(u8, u8) -> u8) -> Option<u8> {
    a.zip(value).map(|(a, value)| of(a, value))
}

/// Whether a branch is taken, where that is known.
pub(super) fn taken(mnemonic: &str, state: &State) -> Option<bool> {
    let (flag, value) = match mnemonic {
        "bne" => (state.z, false),
        "beq" => (state.z, true),
        "bpl" => (state.n, false),
        "bmi" => (state.n, true),
        "bcc" => (state.c, false),
        "bcs" => (state.c, true),
        "bvc" => (state.v, false),
        _ => (state.v, true),
    };
    flag.map(|flag| flag == value)
}

/// What the flag of a branch is where it is taken, or is not.
pub(super) fn learn(mnemonic: &str, taken: bool, state: &mut State) {
    match mnemonic {
        "bne" | "beq" => state.z = Some(taken == (mnemonic == "beq")),
        "bpl" | "bmi" => state.n = Some(taken == (mnemonic == "bmi")),
        "bcc" | "bcs" => state.c = Some(taken == (mnemonic == "bcs")),
        _ => state.v = Some(taken == (mnemonic == "bvs")),
    }
}
