//! Repeated sequences of instructions, by the sorted suffixes of a program.

use super::super::code::{Instruction, Line, Names, Operand, is_branch};
use super::{Repeat, Step};
use rustc_hash::{FxHashMap, FxHashSet};
use std::ops::Range;

/// How many instructions a sequence has at most.
const LONGEST: usize = 60;

/// Bytes of a call, and of a return.
const CALL: i64 = 3;
const RETURN: i64 = 1;

/// What is worth a subroutine, in bytes.
const WORTH: i64 = 3;

/// An instruction that may be in a sequence.
struct Token {
    line: usize,
    /// The same for what is alike; what is in no sequence has a key of its own.
    key: u32,
    bytes: i64,
    /// How far it goes forward or back, in tokens.
    goes: Option<isize>,
}

/// A label: what goes there.
struct Entry {
    from: Vec<usize>,
    /// Something else than a branch of the program's own names it.
    pinned: bool,
}

pub(super) struct Program {
    tokens: Vec<Token>,
    /// The labels at or before each token, but behind the one before it.
    entries: FxHashMap<usize, Vec<Entry>>,
}

impl Program {
    pub(super) fn new(texts: &[&str], names: &Names, own: &Range<usize>) -> Program {
        let code: Vec<Line> = texts.iter().map(|text| names.read(text)).collect();
        let mut at = FxHashMap::default();
        let mut lines = Vec::new();
        for k in own.clone() {
            match code.get(k) {
                Some(Line::Label(name)) => {
                    at.insert(name.as_str(), lines.len());
                }
                Some(Line::Code(_) | Line::Data) => lines.push(k),
                _ => {}
            }
        }
        let mut keys = FxHashMap::default();
        let mut tokens = Vec::with_capacity(lines.len());
        for (k, &line) in lines.iter().enumerate() {
            let next = keys.len() as u32;
            let (key, bytes, goes) = match code.get(line) {
                Some(Line::Code(instruction)) if may_move(instruction) => {
                    let text = instruction.operand.text();
                    let there = is_branch(&instruction.name).then(|| at.get(text));
                    let goes = there.flatten().map(|to| *to as isize - k as isize);
                    let said = match (is_branch(&instruction.name), goes) {
                        (true, Some(by)) => Some(by.to_string()),
                        (true, None) => None,
                        _ => Some(text.to_owned()),
                    };
                    let key = said.map(|said| (instruction.name.clone(), said));
                    (key, size(instruction), goes)
                }
                _ => (None, 0, None),
            };
            let key = key.unwrap_or_else(|| (String::new(), line.to_string()));
            let key = *keys.entry(key).or_insert(next);
            tokens.push(Token {
                line,
                key,
                bytes,
                goes,
            });
        }
        let pinned = pinned(texts, &code, own);
        let mut entries: FxHashMap<usize, Vec<Entry>> = FxHashMap::default();
        for (name, at) in at {
            let entry = Entry {
                from: Vec::new(),
                pinned: pinned.contains(name),
            };
            entries.entry(at).or_default().push(entry);
        }
        for (k, token) in tokens.iter().enumerate() {
            let to = token.goes.and_then(|by| k.checked_add_signed(by));
            for entry in to.and_then(|to| entries.get_mut(&to)).into_iter().flatten() {
                entry.from.push(k);
            }
        }
        Program { tokens, entries }
    }

    /// Whether a sequence is entered at its start only, and left at its end.
    fn is_whole(&self, of: &Range<usize>) -> bool {
        let inner = of.start + 1..of.end;
        let entered = inner.filter_map(|k| self.entries.get(&k)).flatten();
        let mut entered = entered.map(|entry| !entry.pinned && within(&entry.from, of));
        let mut ends = of.clone().filter_map(|k| {
            let to = k.checked_add_signed(self.tokens.get(k)?.goes?)?;
            Some(of.start <= to && to <= of.end)
        });
        entered.all(|whole| whole) && ends.all(|within| within)
    }

    fn keys(&self, from: usize) -> impl Iterator<Item = u32> + '_ {
        let rest = self.tokens.get(from..).unwrap_or_default();
        rest.iter().take(LONGEST).map(|token| token.key)
    }

    fn bytes(&self, of: Range<usize>) -> i64 {
        let tokens = self.tokens.get(of).unwrap_or_default();
        tokens.iter().map(|token| token.bytes).sum()
    }

    /// Sequences that are met several times, by their first tokens and their length; what saves
    /// most comes first.
    fn candidates(&self) -> Vec<(i64, usize, Vec<usize>)> {
        let mut sorted: Vec<usize> = (0..self.tokens.len()).collect();
        sorted.sort_by(|a, b| self.keys(*a).cmp(self.keys(*b)).then(a.cmp(b)));
        let alike = |a: &usize, b: &usize| {
            let pairs = self.keys(*a).zip(self.keys(*b));
            pairs.take_while(|(a, b)| a == b).count()
        };
        let common: Vec<usize> = (sorted.windows(2))
            .map(|pair| {
                pair.first()
                    .zip(pair.last())
                    .map_or(0, |(a, b)| alike(a, b))
            })
            .collect();
        let mut found = Vec::new();
        for length in 2..=LONGEST {
            let mut start = 0;
            while start < common.len() {
                let run = common.iter().skip(start);
                let more = run.take_while(|common| **common >= length).count();
                if more > 0 {
                    let places = sorted.get(start..=start + more).unwrap_or_default();
                    found.extend(self.candidate(length, places));
                }
                start += more + 1;
            }
        }
        found.sort_by(|a, b| (b.0, b.1, &a.2).cmp(&(a.0, a.1, &b.2)));
        found
    }

    fn candidate(&self, length: usize, places: &[usize]) -> Option<(i64, usize, Vec<usize>)> {
        let first = *places.first()?;
        let bytes = self.bytes(first..first + length);
        if saved(bytes, places.len()) < WORTH {
            return None;
        }
        let mut places: Vec<usize> = places
            .iter()
            .copied()
            .filter(|at| self.is_whole(&(*at..*at + length)))
            .collect();
        places.sort_unstable();
        let mut free = 0;
        places.retain(|at| {
            let apart = *at >= free;
            if apart {
                free = at + length;
            }
            apart
        });
        let saved = saved(bytes, places.len());
        (saved >= WORTH).then_some((saved, length, places))
    }

    /// What becomes a subroutine: no more than saves so many bytes.
    pub(super) fn repeats(&self, excess: i64) -> Vec<Repeat> {
        let mut taken = vec![false; self.tokens.len()];
        let (mut found, mut sum) = (Vec::new(), 0);
        for (hoped, length, mut places) in self.candidates() {
            if sum >= excess {
                break;
            }
            let of = |at: usize| at..at + length;
            places.retain(|at| {
                taken
                    .get(of(*at))
                    .is_some_and(|taken| !taken.contains(&true))
            });
            let Some(&first) = places.first() else {
                continue;
            };
            let saved = saved(self.bytes(of(first)), places.len());
            // What others have taken most of may be more with theirs in it.
            if saved < WORTH || saved < hoped / 2 {
                continue;
            }
            for at in &places {
                taken
                    .get_mut(of(*at))
                    .into_iter()
                    .flatten()
                    .for_each(|t| *t = true);
            }
            sum += saved;
            found.push(Repeat {
                body: self.body(&of(first)),
                places: places
                    .into_iter()
                    .filter_map(|at| self.lines(&of(at)))
                    .collect(),
                saved,
            });
        }
        found
    }

    fn body(&self, of: &Range<usize>) -> Vec<Step> {
        let step = |k: usize| {
            let Token { line, goes, .. } = *self.tokens.get(k)?;
            let to = goes.and_then(|by| k.checked_add_signed(by)?.checked_sub(of.start));
            Some(Step { line, goes: to })
        };
        of.clone().filter_map(step).collect()
    }

    /// The lines of some tokens, from the first to behind the last.
    fn lines(&self, of: &Range<usize>) -> Option<Range<usize>> {
        let first = self.tokens.get(of.start)?;
        let last = self.tokens.get(of.end.checked_sub(1)?)?;
        Some(first.line..last.line + 1)
    }
}

/// What one subroutine for so many sequences of so many bytes saves.
fn saved(bytes: i64, places: usize) -> i64 {
    let places = places as i64;
    places * bytes - (places * CALL + bytes + RETURN)
}

fn within(all: &[usize], of: &Range<usize>) -> bool {
    all.iter().all(|k| of.contains(k))
}

/// Whether an instruction does the same in a subroutine.
fn may_move(instruction: &Instruction) -> bool {
    let stack = ["pha", "pla", "php", "plp", "tsx", "txs"];
    let leaves = ["jmp", "rts", "rti", "brk"];
    let name = instruction.name.as_str();
    !stack.contains(&name) && !leaves.contains(&name)
}

/// The bytes of an instruction, where those beyond the zero page are known to be.
fn size(Instruction { name, operand }: &Instruction) -> i64 {
    match operand {
        Operand::None => 1,
        Operand::Immediate(..) | Operand::Pointed(..) => 2,
        Operand::Label(_) if is_branch(name) => 2,
        Operand::Cell(at, _) if *at < 0x100 => 2,
        Operand::Region(range, text) if range.start < 0x100 && text.ends_with(",x") => 2,
        _ => 3,
    }
}

/// The names that anything but a branch of the program's own mentions.
fn pinned<'t>(texts: &[&'t str], code: &[Line], own: &Range<usize>) -> FxHashSet<&'t str> {
    let mut pinned = FxHashSet::default();
    for (k, (text, line)) in texts.iter().zip(code).enumerate() {
        let branch = matches!(line, Line::Code(code) if is_branch(&code.name));
        if branch && own.contains(&k) || matches!(line, Line::Label(_)) {
            continue;
        }
        let said = text.split(';').next().unwrap_or(text);
        let words = said.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        pinned.extend(words.filter(|word| !word.is_empty()));
    }
    pinned
}
