//! What places hold, from line to line and from block to block.

use super::code::{Instruction, Line, Operand};
use super::effects::{A, C, NZ, Place, X, Y};
use super::flow::{End, Flow};
use super::live::{Alive, Places};
use super::state::{From, Kept, State, Value, fresh, is_two, joined, origin, unknown};
use rustc_hash::FxHashMap;
use std::ops::Range;

/// What a block's end may be reached with, at most so many rounds.
const ROUNDS: usize = 60;

/// Whether a value is one of a line's own.
fn is_of(value: Value, line: usize) -> bool {
    matches!(origin(value), Some((From::Line | From::Lost, at)) if at == line)
}

/// The lines of a block whose values are still held from the last time.
pub(super) fn stale(state: &State, lines: &Range<usize>) -> Vec<usize> {
    let line = |(_, value): (Place, Value)| match origin(value)? {
        (From::Line | From::Lost, at) if lines.contains(&at) => Some(at),
        _ => None,
    };
    let mut stale: Vec<usize> = state.told().filter_map(line).collect();
    stale.sort_unstable();
    stale.dedup();
    stale
}

/// Forgets values of this line that are still held from the last time.
fn renew(state: &mut State, line: usize) {
    state.change(|place, value| is_of(value, line).then(|| fresh(From::Lost, line, place)));
}

/// Carries out a line; `stale` are those whose values are held from the last time.
pub(super) fn carry_out(
    state: &mut State,
    flow: &Flow,
    k: usize,
    instruction: &Instruction,
    stale: &[usize],
) {
    let Some(effects) = flow.effects.get(k) else {
        return;
    };
    let loaded = loaded(state, flow, instruction);
    let stored = stored(state, instruction);
    if stale.contains(&k) {
        renew(state, k);
    }
    if effects.unknown {
        return state.forget(k);
    }
    for &place in effects.writes.iter().chain(&effects.may) {
        state.put(place, fresh(From::Line, k, place));
    }
    if let Some(value) = stored {
        if let [place] = effects.writes.as_slice() {
            state.put(*place, value);
        }
        return;
    }
    let result = match instruction.name.as_str() {
        "lda" | "txa" | "tya" | "and" | "ora" | "eor" | "adc" | "sbc" => A,
        "ldx" | "tax" | "inx" | "dex" => X,
        "ldy" | "tay" | "iny" | "dey" => Y,
        "asl" | "lsr" | "rol" | "ror" | "inc" | "dec" => {
            let memory = effects.writes.iter().find(|place| ![C, NZ].contains(place));
            memory.copied().unwrap_or(NZ)
        }
        "bit" => return state.put(NZ, fresh(From::Two, k, NZ)),
        "clc" => return state.put(C, 0),
        "sec" => return state.put(C, 1),
        _ => return,
    };
    let value = loaded.unwrap_or(fresh(From::Line, k, result));
    state.put(result, value);
    state.put(NZ, value);
}

/// The value that an instruction brings into a register.
pub(super) fn loaded(state: &State, flow: &Flow, instruction: &Instruction) -> Option<Value> {
    match instruction.name.as_str() {
        "lda" | "ldx" | "ldy" => read(state, flow, &instruction.operand),
        "tax" | "tay" => Some(state.held(A)),
        "txa" => Some(state.held(X)),
        "tya" => Some(state.held(Y)),
        _ => None,
    }
}

/// The value of an operand.
pub(super) fn read(state: &State, flow: &Flow, operand: &Operand) -> Option<Value> {
    match operand {
        Operand::Immediate(_, byte) => byte.map(Value::from),
        Operand::Cell(at, _) => Some(state.held(flow.space.place(*at)?)),
        _ => None,
    }
}

/// The value that an instruction leaves in memory as it is.
fn stored(state: &State, instruction: &Instruction) -> Option<Value> {
    match instruction.name.as_str() {
        "sta" => Some(state.held(A)),
        "stx" => Some(state.held(X)),
        "sty" => Some(state.held(Y)),
        _ => None,
    }
}

/// What is known on one of the ways that a branch takes.
pub(super) fn decided(state: &mut State, branch: &str, taken: bool) {
    match (branch, taken) {
        ("bcs", taken) => state.put(C, Value::from(taken)),
        ("bcc", taken) => state.put(C, Value::from(!taken)),
        ("beq", true) | ("bne", false) => {
            let zero = state.held(NZ);
            if is_two(zero) {
                return;
            }
            state.change(|_, value| (value == zero).then_some(0));
        }
        _ => {}
    }
}

/// What places hold where each block begins; nothing where that was not found out, and of
/// blocks that nothing comes to.
pub(super) fn at_starts(lines: &[Line], flow: &Flow, alive: &Alive) -> Option<Vec<Option<Kept>>> {
    let count = flow.blocks.len();
    let changed = changed_by_calls(lines.len(), flow);
    let mut starts: Vec<Option<Kept>> = vec![None; count];
    // By where it came from and where it goes.
    let mut edges: FxHashMap<(usize, usize), Kept> = FxHashMap::default();
    let mut waiting = vec![true; count];
    let mut state = State::new(flow.space.cells());
    for _ in 0..ROUNDS {
        let mut any = false;
        for b in 0..count {
            if !waiting.get(b).copied().unwrap_or_default() {
                continue;
            }
            let Some(start) = start(flow, b, &edges) else {
                continue;
            };
            if let Some(flag) = waiting.get_mut(b) {
                *flag = false;
            }
            if starts.get(b).and_then(Option::as_ref) == Some(&start) {
                continue;
            }
            any = true;
            state.enter(b, &start);
            for (to, kept) in ends(lines, flow, b, &mut state, alive, &changed) {
                edges.insert((b, to), kept);
                if let Some(flag) = waiting.get_mut(to) {
                    *flag = true;
                }
            }
            if let Some(at) = starts.get_mut(b) {
                *at = Some(start);
            }
        }
        if !any {
            return Some(starts);
        }
    }
    None
}

/// What is held where a block begins, by the ways there that are known so far.
fn start(flow: &Flow, b: usize, edges: &FxHashMap<(usize, usize), Kept>) -> Option<Kept> {
    let block = flow.blocks.get(b)?;
    if block.entered || block.before.is_empty() {
        return Some(Kept::new());
    }
    let ways: Vec<&Kept> = (block.before.iter())
        .filter_map(|from| edges.get(&(*from, b)))
        .collect();
    (!ways.is_empty()).then(|| joined(b, &ways))
}

/// What is held at the ends of a block, on each way on; `state` is where it begins.
fn ends(
    lines: &[Line],
    flow: &Flow,
    b: usize,
    state: &mut State,
    alive: &Alive,
    changed: &FxHashMap<usize, Called>,
) -> Vec<(usize, Kept)> {
    let Some(block) = flow.blocks.get(b) else {
        return Vec::new();
    };
    let stale = stale(state, &block.lines);
    for k in block.lines.clone() {
        if let Some(Line::Code(instruction)) = lines.get(k) {
            carry_out(state, flow, k, instruction, &stale);
        }
    }
    let kept = |state: &State, to: usize| {
        let alive = alive.ahead.get(to);
        (to, alive.map_or_else(Kept::new, |alive| state.kept(alive)))
    };
    let on = |state: &State| block.next.iter().map(|to| kept(state, *to)).collect();
    match block.end {
        // A branch to what stands behind it tells nothing.
        End::Branch(_) if matches!(block.next.as_slice(), [one, other] if one == other) => block
            .next
            .first()
            .map(|to| kept(state, *to))
            .into_iter()
            .collect(),
        End::Branch(k) => {
            let Some(Line::Code(branch)) = lines.get(k) else {
                return Vec::new();
            };
            let mut other = state.clone();
            let ways = block.next.iter().zip([(true, &mut other), (false, state)]);
            ways.map(|(to, (taken, state))| {
                decided(state, &branch.name, taken);
                kept(state, *to)
            })
            .collect()
        }
        End::Call(to) => {
            let k = block.lines.end.saturating_sub(1);
            let called = changed.get(&to);
            let lost = |place: Place, value: Value| {
                let lost = called.is_none_or(|called| called.changes(place, value));
                (lost || is_of(value, k)).then(|| unknown(From::Line, k, place))
            };
            let mut ways: Vec<(usize, Kept)> = on(state);
            for (place, value) in ways.iter_mut().flat_map(|(_, kept)| kept) {
                *value = lost(*place, *value).unwrap_or(*value);
            }
            ways
        }
        End::Unknown => block.next.iter().map(|to| (*to, Kept::new())).collect(),
        End::On | End::Jump | End::Return => on(state),
    }
}

/// What a subroutine may do.
struct Called {
    places: Places,
    /// The lines and blocks that it may carry out.
    lines: Places,
    blocks: Places,
}

impl Called {
    /// Whether a value that a place holds may be another behind the call, or its number stand
    /// for another.
    fn changes(&self, place: Place, value: Value) -> bool {
        self.places.has(place)
            || match origin(value) {
                None => false,
                Some((From::Block, at)) => self.blocks.has(at),
                Some((_, at)) => self.lines.has(at),
            }
    }
}

/// What subroutines may change, by the blocks that they begin with; nothing of one that may
/// change everything.
fn changed_by_calls(lines: usize, flow: &Flow) -> FxHashMap<usize, Called> {
    let called = flow.blocks.iter().filter_map(|block| match block.end {
        End::Call(to) => Some(to),
        _ => None,
    });
    let entries: std::collections::BTreeSet<usize> = called.collect();
    (entries.into_iter())
        .filter_map(|entry| Some((entry, changed_from(lines, flow, entry)?)))
        .collect()
}

/// What may be changed between a block and the return that it comes to.
fn changed_from(lines: usize, flow: &Flow, entry: usize) -> Option<Called> {
    let mut called = Called {
        places: Places::none(flow.space.len()),
        lines: Places::none(lines),
        blocks: Places::none(flow.blocks.len()),
    };
    let mut open = vec![entry];
    while let Some(b) = open.pop() {
        let block = flow.blocks.get(b)?;
        if called.blocks.has(b) {
            continue;
        }
        called.blocks.insert(b);
        match block.end {
            End::Unknown => return None,
            End::Call(to) => open.push(to),
            End::On | End::Branch(_) | End::Jump | End::Return => {}
        }
        open.extend(&block.next);
        for k in block.lines.clone() {
            let effects = flow.effects.get(k)?;
            if effects.unknown {
                return None;
            }
            called.lines.insert(k);
            let changed = effects.writes.iter().chain(&effects.may);
            changed.for_each(|place| called.places.insert(*place));
        }
    }
    Some(called)
}
