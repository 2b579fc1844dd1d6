//! The keyboard of the Commodore 64: its matrix, which the first CIA reads, and the codes
//! that the KERNAL's GETIN and CHRIN give.
//!
//! Source: *Commodore 64 Programmer's Reference Guide* (1982), appendices C and the
//! keyboard's circuit diagram.

use super::{Circuits, FRAME};
use crate::Stop;
use crate::keys::{Key, Keyboard, Next, Seen, never};
use crate::mos6502::computer::Board;
use crate::mos6502::cpu::{Cpu, flag};
use std::collections::VecDeque;

/// What keys type without SHIFT: bit of $DC00 that selects them, then bit of $DC01 that
/// they pull down. A blank is another key.
const MATRIX: [&[u8; 8]; 8] = [
    b"        ",
    b"3wa4zse ",
    b"5rd6cftx",
    b"7yg8bhuv",
    b"9ij0mkon",
    b"+pl-.:@,",
    b" *;  = /",
    b"1  2  q ",
];

/// What keys type with SHIFT, and without.
const SHIFTED: &[u8] = b"!1\"2#3$4%5&6'7(8)9[:];<,>.?/";

/// Where the left SHIFT key is.
const SHIFT: (u8, u8) = (1, 7);

/// Where a key is, and whether it is typed with SHIFT.
fn place(key: Key) -> Option<((u8, u8), bool)> {
    let plain = |column, row| Some(((column, row), false));
    let shifted = |column, row| Some(((column, row), true));
    match key {
        Key::Backspace | Key::Delete => plain(0, 0),
        Key::Insert => shifted(0, 0),
        Key::Enter => plain(0, 1),
        Key::Right => plain(0, 2),
        Key::Left => shifted(0, 2),
        Key::Down => plain(0, 7),
        Key::Up => shifted(0, 7),
        Key::Home => plain(6, 3),
        Key::Escape => plain(7, 7),
        Key::Control => plain(7, 2),
        Key::Shift => plain(SHIFT.0, SHIFT.1),
        Key::Function(n @ 1..=8) => {
            let row = [4, 5, 6, 3].get(usize::from(n - 1) / 2).copied()?;
            Some(((0, row), n % 2 == 0))
        }
        Key::Char(b' ') => plain(7, 4),
        Key::Char(c) => {
            let pair = SHIFTED.chunks(2).find(|pair| pair.first() == Some(&c));
            let own = pair.and_then(|pair| pair.get(1)).copied();
            let shift = own.is_some() || c.is_ascii_uppercase();
            let own = own.unwrap_or(c.to_ascii_lowercase());
            let in_row = |row: &&[u8; 8]| row.iter().position(|k| *k == own);
            let found = (0..)
                .zip(&MATRIX)
                .find_map(|(k, row)| Some((k, in_row(row)? as u8)));
            found.map(|place| (place, shift))
        }
        _ => None,
    }
}

/// The code that a key types, in PETSCII.
fn code(key: Key) -> Option<u8> {
    Some(match key {
        Key::Char(c @ b'a'..=b'z') => c - 32,
        Key::Char(c @ b'A'..=b'Z') => c + 128,
        Key::Char(c) => c,
        Key::Enter => 13,
        Key::Backspace | Key::Delete => 20,
        Key::Insert => 148,
        Key::Home => 19,
        Key::Left => 157,
        Key::Right => 29,
        Key::Up => 145,
        Key::Down => 17,
        Key::Escape => 3,
        Key::Function(n @ 1..=8) => 133 + (n - 1) / 2 + 4 * u8::from(n % 2 == 0),
        _ => return None,
    })
}

/// A keyboard, and a line of it that CHRIN gives character by character.
#[derive(Clone, Debug)]
pub(super) struct Keys {
    pub keyboard: Keyboard,
    line: VecDeque<u8>,
}

impl Keys {
    pub fn new(keyboard: Keyboard) -> Keys {
        Keys {
            keyboard,
            line: VecDeque::new(),
        }
    }
}

impl Circuits {
    /// Plays the keyboard, which is taken out for as long: it looks at the screen.
    fn with_keys<T>(&mut self, play: impl FnOnce(&mut Keys, &Circuits) -> T) -> Option<T> {
        let mut keys = self.keys.take()?;
        let played = play(&mut keys, self);
        self.keys = Some(keys);
        Some(played)
    }

    fn frame(&self) -> u64 {
        self.cycles / FRAME
    }

    fn seen(&mut self, seen: Option<Seen>) -> Option<Key> {
        match seen {
            Some(Seen::Key(key)) => Some(key),
            Some(Seen::Quit) => {
                self.stop.get_or_insert(Stop::Ended);
                None
            }
            _ => None,
        }
    }

    /// What $DC00 reads, where nothing is selected: a joystick in port 2, which the arrow keys and
    /// space move. A bit is 0 where it is held: up, down, left, right, fire.
    pub(super) fn stick(&mut self) -> u8 {
        let stored = self.register(0xDC00);
        let seen = self.with_keys(|keys, c64| {
            keys.keyboard.remember(c64.cycles, || {
                c64.ram.iter().map(|byte| i16::from(*byte)).collect()
            });
            keys.keyboard.look(c64.frame(), || c64.screen())
        });
        let held = match self.seen(seen) {
            Some(Key::Up) => 1,
            Some(Key::Down) => 2,
            Some(Key::Left) => 4,
            Some(Key::Right) => 8,
            Some(Key::Char(b' ')) => 16,
            _ => 0,
        };
        stored & !held
    }

    /// What $DC01 reads, where there is a keyboard: a bit is 0 where a key of its row is held
    /// in a column for which $DC00 has a 0.
    pub(super) fn rows(&mut self) -> u8 {
        let columns = self.register(0xDC00);
        let seen = self.with_keys(|keys, c64| keys.keyboard.look(c64.frame(), || c64.screen()));
        let Some((own, shift)) = self.seen(seen).and_then(place) else {
            return 0xFF;
        };
        let down = [Some(own), shift.then_some(SHIFT)].into_iter().flatten();
        let selected = down.filter(|(column, _)| columns >> column & 1 == 0);
        selected.fold(0xFF, |bits, (_, row)| bits & !(1 << row))
    }

    /// GETIN: the code of a key that was typed in A, 0 without, and the flags for it.
    pub(super) fn get(&mut self, cpu: &mut Cpu) {
        let seen = self.with_keys(|keys, c64| keys.keyboard.take(c64.frame(), || c64.screen()));
        cpu.a = self.seen(seen).and_then(code).unwrap_or(0);
        let changed = flag::C | flag::N | flag::Z;
        let zero = if cpu.a == 0 { flag::Z } else { 0 };
        cpu.set_status(cpu.status() & !changed | zero | cpu.a & flag::N);
    }

    /// CHRIN: waits for a line, shows it, and gives its characters one by one.
    pub(super) fn next_of_line(&mut self, cpu: &mut Cpu) {
        let mut typed: Vec<u8> = Vec::new();
        while self.stop.is_none() {
            if let Some(c) = self.with_keys(|keys, _| keys.line.pop_front()).flatten() {
                cpu.a = c;
                return cpu.set_status(cpu.status() & !flag::C);
            }
            let next =
                self.with_keys(|keys, c64| keys.keyboard.wait(c64.frame(), "", || c64.screen()));
            match next {
                Some(Next::Key(key, frames)) => {
                    self.cycles += frames * FRAME;
                    match code(key) {
                        Some(20) => drop(typed.pop()),
                        Some(13) => {
                            typed.push(13);
                            self.text.extend(typed.iter().map(|c| match c {
                                13 => b'\n',
                                c => c.to_ascii_lowercase(),
                            }));
                            let line = std::mem::take(&mut typed);
                            self.with_keys(|keys, _| keys.line.extend(line));
                        }
                        Some(c) => typed.push(c),
                        None => {}
                    }
                }
                Some(Next::Never) => self.fail(never("CHRIN")),
                Some(Next::Quit) | None => {
                    self.stop.get_or_insert(Stop::Ended);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All keys are in places of their own, and the text's are where the diagram has them.
    #[test]
    fn places() {
        let text = "0123456789abcdefghijklmnopqrstuvwxyz+-*/=:;.,@ ";
        let mut places: Vec<_> = text.bytes().map(|c| place(Key::Char(c))).collect();
        assert!(places.iter().all(Option::is_some));
        places.sort();
        places.dedup();
        assert_eq!(places.len(), text.len());
        assert_eq!(place(Key::Char(b'q')), Some(((7, 6), false)));
    }
}
