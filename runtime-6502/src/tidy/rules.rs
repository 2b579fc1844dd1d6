//! What is left out or written shorter in a block.

use super::code::{Instruction, Line, Operand};
use super::effects::{A, C, Effects, NZ, Place, REGISTERS, X, Y};
use super::flow::{Block, Flow};
use super::live::Places;
use super::state::{BYTES, Sieve, State, Value, made_in};
use super::values;

/// What no place holds.
const NONE: Value = Value::MAX - 1;

/// What becomes of a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Edit {
    Gone,
    Instead(String),
}

/// How often each place is read.
pub(super) fn met(flow: &Flow) -> Vec<u32> {
    let mut met = vec![0; flow.space.len()];
    for place in flow.effects.iter().flat_map(|effects| &effects.reads) {
        met.get_mut(*place)
            .into_iter()
            .for_each(|count| *count += 1);
    }
    met
}

/// Goes through a block with what its places hold: what is there already is not fetched or
/// stored again, and what several places hold is read where that is cheapest.
pub(super) fn forward(
    lines: &[Line],
    flow: &Flow,
    block: &Block,
    state: &mut State,
    behind: &Places,
    met: &[u32],
) -> Vec<(usize, Edit)> {
    // What is left out before may have set the flags; so they are not relied on.
    state.put(NZ, NONE);
    let flags_read = flags_read(flow, block, behind);
    let mut shared = shared(state, flow.space.cells());
    let stale = values::stale(state, &block.lines);
    let mut edits = Vec::new();
    for k in block.lines.clone() {
        let (Some(Line::Code(code)), Some(effects)) = (lines.get(k), flow.effects.get(k)) else {
            continue;
        };
        let read = flags_read.get(k - block.lines.start).copied();
        let now = Now {
            flow,
            state,
            shared: &shared,
            met,
        };
        if now.is_idle(code, effects, read.unwrap_or(true)) {
            edits.push((k, Edit::Gone));
            continue;
        }
        if let Some(text) = now.shorter(code) {
            edits.push((k, Edit::Instead(text)));
        }
        values::carry_out(state, flow, k, code, &stale);
        if let ("sta" | "stx" | "sty", [cell]) = (code.name.as_str(), effects.writes.as_slice()) {
            shared.insert(state.held(*cell));
        }
    }
    edits
}

/// The values that several bytes of memory hold.
fn shared(state: &State, cells: usize) -> Sieve {
    let (mut held, mut shared) = (Sieve::new(cells), Sieve::new(cells));
    for (_, value) in state.told().filter(|(place, _)| *place >= REGISTERS) {
        if held.may_have(value) {
            shared.insert(value);
        }
        held.insert(value);
    }
    shared
}

/// Whether the zero and negative flags are read behind each line of a block.
fn flags_read(flow: &Flow, block: &Block, behind: &Places) -> Vec<bool> {
    let mut alive = behind.clone();
    let mut read: Vec<bool> = (block.lines.clone().rev())
        .map(|k| {
            let now = alive.has(NZ);
            flow.effects
                .get(k)
                .iter()
                .for_each(|effects| alive.back(effects));
            now
        })
        .collect();
    read.reverse();
    read
}

/// Before a line.
struct Now<'a> {
    flow: &'a Flow,
    state: &'a State,
    /// Those of its values that other bytes may hold as well.
    shared: &'a Sieve,
    met: &'a [u32],
}

impl Now<'_> {
    fn held(&self, place: Place) -> Value {
        self.state.held(place)
    }

    /// Whether an instruction changes nothing.
    fn is_idle(&self, code: &Instruction, effects: &Effects, flags_read: bool) -> bool {
        let value = values::loaded(self.state, self.flow, code);
        let into = |place| {
            value.is_some_and(|value| {
                self.held(place) == value && (!flags_read || self.held(NZ) == value)
            })
        };
        let same = |place| match effects.writes.as_slice() {
            [cell] => self.held(*cell) == self.held(place),
            _ => false,
        };
        match code.name.as_str() {
            "lda" | "txa" | "tya" => into(A),
            "ldx" | "tax" => into(X),
            "ldy" | "tay" => into(Y),
            "sta" => same(A),
            "stx" => same(X),
            "sty" => same(Y),
            "clc" => self.held(C) == 0,
            "sec" => self.held(C) == 1,
            _ => false,
        }
    }

    /// The same, from where it is cheaper to have.
    fn shorter(&self, code: &Instruction) -> Option<String> {
        let Operand::Cell(at, text) = &code.operand else {
            return None;
        };
        let value = values::read(self.state, self.flow, &code.operand)?;
        let transfer = match code.name.as_str() {
            "lda" if self.held(X) == value => Some("txa"),
            "lda" if self.held(Y) == value => Some("tya"),
            "ldx" if self.held(A) == value => Some("tax"),
            "ldy" if self.held(A) == value => Some("tay"),
            _ => None,
        };
        if let Some(name) = transfer {
            return Some(name.to_owned());
        }
        let reads = [
            "lda", "ldx", "ldy", "adc", "sbc", "and", "ora", "eor", "cmp", "cpx", "cpy",
        ];
        if !reads.contains(&code.name.as_str()) {
            return None;
        }
        if value < BYTES {
            return Some(format!("{} #${value:02x}", code.name));
        }
        let (best, name) = self.best(value)?;
        let own = self.flow.space.place(*at)?;
        (best != own && name != text).then(|| format!("{} {name}", code.name))
    }

    /// Of the cells that hold a value, the one to read it from: one in the zero page, where it
    /// was computed, that is read most.
    fn best(&self, value: Value) -> Option<(Place, &str)> {
        if !self.shared.may_have(value) {
            return None;
        }
        let rank = |place: Place| {
            let at = self.flow.space.address(place).unwrap_or(u16::MAX);
            let met = self.met.get(place).copied().unwrap_or_default();
            (at > 0xFF, place != made_in(value), u32::MAX - met, at)
        };
        let best = self.state.holders(value).min_by_key(|p| rank(*p))?;
        let at = self.flow.space.address(best)?;
        Some((best, self.flow.space.name(at)?))
    }
}

/// Goes through a block from its end: what nobody reads behind it is not computed.
pub(super) fn backward(
    lines: &[Line],
    flow: &Flow,
    block: &Block,
    behind: &Places,
) -> Vec<(usize, Edit)> {
    let mut alive = behind.clone();
    let mut edits = Vec::new();
    for k in block.lines.clone().rev() {
        let (Some(Line::Code(_)), Some(effects)) = (lines.get(k), flow.effects.get(k)) else {
            continue;
        };
        let read = effects.writes.iter().any(|place| alive.has(*place));
        let does = effects.more || effects.unknown || !effects.may.is_empty();
        if !read && !does && !effects.writes.is_empty() {
            edits.push((k, Edit::Gone));
        } else {
            alive.back(effects);
        }
    }
    edits
}
