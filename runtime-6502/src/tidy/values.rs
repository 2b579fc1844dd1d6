//! What places hold, from line to line and from block to block.

use super::code::{Instruction, Line, Operand};
use super::effects::{A, C, NZ, Place, X, Y};
use super::flow::{Block, End, Flow};
use super::jumps::name;
use super::live::{Alive, Places};
use super::state::{From, Kept, State, Value, fresh, is_two, of_lines, origin, unknown};
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
    let of_lines = of_lines(lines);
    let values = state.values().iter().filter(|value| of_lines(**value));
    let mut stale: Vec<usize> = values.filter_map(|v| Some(origin(*v)?.1)).collect();
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
        // Nothing is below 0.
        "cmp" | "cpx" | "cpy" if matches!(instruction.operand, Operand::Immediate(_, Some(0))) => {
            return state.put(C, 1);
        }
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

/// What places hold where blocks begin, and on the ways between them. It is much, so it is
/// written over when that is asked again of a program that was changed.
#[derive(Default)]
pub(super) struct Held {
    starts: Vec<Kept>,
    /// The blocks that are known to be come to.
    begun: Vec<bool>,
    /// By where a way comes from, and which of the ways on from there it is.
    edges: Vec<Vec<State>>,
    /// Whether it was found out.
    settled: bool,
}

impl Held {
    pub fn of(lines: &[Line], flow: &Flow, alive: &Alive, spare: Held) -> Held {
        let (count, cells) = (flow.blocks.len(), flow.space.cells());
        let mut held = spare;
        held.starts.resize_with(count, Kept::new);
        held.begun = vec![false; count];
        held.edges.resize_with(count, Vec::new);
        for (edges, block) in held.edges.iter_mut().zip(&flow.blocks) {
            edges.resize_with(block.next.len(), State::default);
            edges.iter_mut().for_each(|edge| edge.resize(cells));
        }
        held.settled = held.settle(lines, flow, alive).is_some();
        held
    }

    /// What places hold where a block begins; nothing where that was not found out, and of
    /// blocks that nothing comes to.
    pub fn at_start(&self, b: usize) -> Option<&Kept> {
        let known = self.settled && self.begun.get(b).copied().unwrap_or_default();
        self.starts.get(b).filter(|_| known)
    }

    /// Goes through all blocks until nothing changes.
    fn settle(&mut self, lines: &[Line], flow: &Flow, alive: &Alive) -> Option<()> {
        let changed = changed_by_calls(lines.len(), flow);
        let mut waiting = vec![true; flow.blocks.len()];
        let mut state = State::default();
        state.resize(flow.space.cells());
        for _ in 0..ROUNDS {
            let mut any = false;
            for &b in &flow.order {
                if !waiting.get(b).copied().unwrap_or_default() {
                    continue;
                }
                let Some(block) = flow.blocks.get(b) else {
                    continue;
                };
                let Some(ways) = self.ways_to(flow, b) else {
                    continue;
                };
                let begun = self.begun.get(b).copied().unwrap_or_default();
                state.join(b, &ways, begun);
                waiting.get_mut(b).into_iter().for_each(|w| *w = false);
                let Some(start) = self.starts.get_mut(b) else {
                    continue;
                };
                if begun && start == state.values() {
                    continue;
                }
                any = true;
                start.clone_from(state.values());
                // For the first time, none of its lines has given a value yet.
                let stale = match begun {
                    true => stale(&state, &block.lines),
                    false => Vec::new(),
                };
                self.begun.get_mut(b).into_iter().for_each(|b| *b = true);
                carry_out_all(&mut state, lines, flow, block, &stale);
                if let Some(ways) = self.edges.get_mut(b) {
                    end(lines, block, &mut state, alive, &changed, ways);
                }
                for to in &block.next {
                    waiting.get_mut(*to).into_iter().for_each(|w| *w = true);
                }
            }
            if !any {
                return Some(());
            }
        }
        None
    }

    /// What is held on the ways to where a block begins that are known so far; none where it
    /// may begin with anything. Nothing where it is not known yet that anything comes to it.
    fn ways_to(&self, flow: &Flow, b: usize) -> Option<Vec<&State>> {
        let block = flow.blocks.get(b)?;
        if block.entered || block.before.is_empty() {
            return Some(Vec::new());
        }
        let way = |from: &usize| {
            let begun = self.begun.get(*from).copied().unwrap_or_default();
            let next = &flow.blocks.get(*from).filter(|_| begun)?.next;
            let which = next.iter().position(|to| *to == b)?;
            self.edges.get(*from)?.get(which)
        };
        let ways: Vec<&State> = block.before.iter().filter_map(way).collect();
        (!ways.is_empty()).then_some(ways)
    }
}

/// Carries out the lines of a block.
fn carry_out_all(state: &mut State, lines: &[Line], flow: &Flow, block: &Block, stale: &[usize]) {
    for k in block.lines.clone() {
        if let Some(Line::Code(instruction)) = lines.get(k) {
            carry_out(state, flow, k, instruction, stale);
        }
    }
}

/// What is held behind a block, on each way on; `state` is where it ends.
fn end(
    lines: &[Line],
    block: &Block,
    state: &mut State,
    alive: &Alive,
    changed: &FxHashMap<usize, Called>,
    ways: &mut [State],
) {
    if block.end == End::Unknown {
        return ways.iter_mut().for_each(State::clear);
    }
    let branch = match (&block.end, block.next.as_slice()) {
        // A branch to what stands behind it tells nothing.
        (End::Branch(_), [one, other]) if one == other => None,
        (End::Branch(k), _) => Some(name(lines, *k)),
        _ => None,
    };
    let last = ways.len().saturating_sub(1);
    for (k, (to, way)) in block.next.iter().zip(ways).enumerate() {
        match k == last {
            true => std::mem::swap(way, state),
            false => way.copy(state),
        }
        if let Some(branch) = branch {
            decided(way, branch, k == 0);
        }
        if let Some(alive) = alive.ahead.get(*to) {
            way.keep(alive);
        }
        if let End::Call(to) = block.end {
            let k = block.lines.end.saturating_sub(1);
            let called = changed.get(&to);
            way.change(|place, value| {
                let lost = called.is_none_or(|called| called.changes(place, value));
                (lost || is_of(value, k)).then(|| unknown(From::Line, k, place))
            });
        }
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
