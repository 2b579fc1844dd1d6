//! Keys: GET, INKEY and INPUT, from a script and from standard input.
//!
//! Codes are those of OS 1.20 where cursor keys give codes (`*FX 4,1`) and ESCAPE is a key
//! like others (`*FX 229,1`); internal numbers are those of INKEY with a negative argument
//! (*BBC Microcomputer User Guide*, chapters 33 and 43).

use super::ast::Kind;
use super::cost;
use super::error::Error;
use super::state::State;
use crate::keys::{Key, Keyboard, Next, Seen, Unit, never};
use crate::{Fault, Screen, Stop};

/// Cycles of a frame, a fiftieth of a second at 2 MHz.
pub(crate) const FRAME: u64 = 40_000;
/// Cycles of a hundredth of a second.
const HUNDREDTH: u64 = 20_000;

/// Characters that a line of INPUT takes.
const LINE: usize = 238;
/// Codes of keys that a line of INPUT knows.
const RETURN: u8 = 13;
const ERASE: u8 = 127;

/// The code that a key types.
pub(crate) fn code(key: Key) -> Option<u8> {
    Some(match key {
        Key::Char(c) => c,
        Key::Enter => RETURN,
        Key::Backspace | Key::Delete => ERASE,
        Key::Escape => 27,
        Key::Tab => 9,
        Key::Home => 135,
        Key::Left => 136,
        Key::Right => 137,
        Key::Down => 138,
        Key::Up => 139,
        _ => return None,
    })
}

/// What keys type without SHIFT, by rows of ten of the keyboard's matrix: the first of row
/// `r` has the internal number `16 * (r + 1)`. A blank is another key.
const ROWS: [&[u8; 10]; 7] = [
    b"q345 8 -^ ",
    b" wet7i90_ ",
    b"12dr6uop[ ",
    b" axfyjk@: ",
    b" scghnl;] ",
    b" z vbm,./ ",
    b"        \\ ",
];

/// What keys type with SHIFT, and without.
const SHIFTED: &[u8] = b"!1\"2#3$4%5&6'7(8)9=-~^`_{[}]*:+;<,>.?/|\\";

/// The internal numbers of f0 to f9.
const FUNCTIONS: [u8; 10] = [32, 113, 114, 115, 20, 116, 117, 22, 118, 119];

/// A key's internal number: INKEY of the negative of one more says whether it is held.
pub(crate) fn number(key: Key) -> Option<u8> {
    let c = match key {
        Key::Char(b' ') => return Some(98),
        Key::Char(c) => c.to_ascii_lowercase(),
        Key::Enter => return Some(73),
        Key::Backspace | Key::Delete => return Some(89),
        Key::Left => return Some(25),
        Key::Down => return Some(41),
        Key::Up => return Some(57),
        Key::Right => return Some(121),
        Key::Home => return Some(105),
        Key::Tab => return Some(96),
        Key::Escape => return Some(112),
        Key::Shift => return Some(0),
        Key::Control => return Some(1),
        Key::Function(n) => return FUNCTIONS.get(usize::from(n)).copied(),
        _ => return None,
    };
    let pair = SHIFTED.chunks(2).find(|pair| pair.first() == Some(&c));
    let c = pair.and_then(|pair| pair.get(1)).copied().unwrap_or(c);
    let place = |row: &&[u8; 10]| row.iter().position(|own| *own == c);
    let (row, column) = (0u8..)
        .zip(&ROWS)
        .find_map(|(at, row)| Some((at, place(row)?)))?;
    Some(16 * (row + 1) + column as u8)
}

/// A key is held whose number INKEY was asked for, as a keyboard sees it.
pub(crate) fn is_held(seen: Seen, asked: u8) -> bool {
    matches!(seen, Seen::Key(key) if number(key) == Some(asked))
}

impl State {
    /// The keyboard, frames since the start, and the screen for its shots.
    fn keys(&mut self) -> Option<(&mut Keyboard, u64, impl FnOnce() -> Option<Screen>)> {
        let keyboard = self.keyboard.as_mut()?;
        let frame = cost::with_interrupts(self.cycles) / FRAME;
        let (display, mem) = (&self.display, &self.mem);
        let shown = move || Some(display.screen(mem)).filter(|s| !s.pixels.is_empty());
        Some((keyboard, frame, shown))
    }

    /// Ends the run from within a statement.
    fn halt(&mut self, stop: Stop) -> Error {
        self.stop = Some(stop);
        Error::Halt
    }

    /// GET: waits for a key; answers its code. Where there is no keyboard it is RETURN's.
    pub fn get(&mut self, who: &str) -> Result<u8, Error> {
        let line = self.text.rsplit(|c| *c == 10).next().unwrap_or(&[]);
        let line: String = line.iter().map(|c| char::from(*c)).collect();
        loop {
            let Some((keyboard, frame, shown)) = self.keys() else {
                return Ok(RETURN);
            };
            match keyboard.wait(frame, &line, shown) {
                Next::Key(key, frames) => {
                    self.cycles += cost::without_interrupts(frames * FRAME);
                    if let Some(code) = code(key) {
                        return Ok(code);
                    }
                }
                Next::Quit => return Err(self.halt(Stop::Ended)),
                Next::Never => {
                    let fault = Fault {
                        message: never(who),
                        file: None,
                        line: None,
                        column: None,
                    };
                    return Err(self.halt(Stop::Fault(fault)));
                }
            }
        }
    }

    /// INKEY: the code of a key that is typed within some hundredths of a second.
    pub fn inkey(&mut self, hundredths: u32) -> Result<Option<u8>, Error> {
        let end = self.cycles + u64::from(hundredths) * HUNDREDTH;
        loop {
            let Some((keyboard, frame, shown)) = self.keys() else {
                break;
            };
            let by = keyboard.unit();
            match keyboard.take(frame, shown) {
                Seen::Key(key) => {
                    if let Some(code) = code(key) {
                        return Ok(Some(code));
                    }
                }
                Seen::Nothing => {}
                Seen::Quit => return Err(self.halt(Stop::Ended)),
            }
            let next = cost::without_interrupts((frame + 1) * FRAME) + 1;
            if by == Unit::Calls || next > end {
                break;
            }
            self.cycles = next.max(self.cycles);
        }
        self.cycles = end.max(self.cycles);
        Ok(None)
    }

    /// The numbers among the variables, for who looks on: of each the length of its name, the
    /// name, and its bits, in four words, the highest first.
    fn numbers(&self) -> Vec<i16> {
        let mut told = Vec::new();
        let mut tell = |name: Vec<u8>, bits: u64| {
            told.push(name.len() as i16);
            told.extend(name.into_iter().map(i16::from));
            told.extend((0..4).rev().map(|k| (bits >> (16 * k)) as u16 as i16));
        };
        for (slot, own) in (0..).zip(&self.ints) {
            let bits = i64::from(own.value) as u64;
            tell(self.names.spelt(Kind::Int, slot), bits);
        }
        for (slot, own) in (0..).zip(&self.reals) {
            tell(self.names.spelt(Kind::Real, slot), own.value.to_bits());
        }
        told
    }

    /// INKEY of a negative number: whether the key of an internal number is held.
    pub fn held(&mut self, number: u8) -> Result<bool, Error> {
        if let Some(mut keyboard) = self.keyboard.take() {
            let cycles = cost::with_interrupts(self.cycles);
            keyboard.remember(cycles, || self.numbers());
            self.keyboard = Some(keyboard);
        }
        let Some((keyboard, frame, shown)) = self.keys() else {
            return Ok(false);
        };
        match keyboard.look(frame, shown) {
            Seen::Quit => Err(self.halt(Stop::Ended)),
            seen => Ok(is_held(seen, number)),
        }
    }

    /// A line as it is typed, up to RETURN, and shown.
    pub(super) fn read_line(&mut self) -> Result<Vec<u8>, Error> {
        let mut line = Vec::new();
        loop {
            match self.get("INPUT")? {
                RETURN => break,
                ERASE if line.pop().is_some() => {
                    self.text.pop();
                    self.count = self.count.saturating_sub(1);
                }
                c @ 32..=126 if line.len() < LINE => {
                    line.push(c);
                    self.write(&[c]);
                }
                _ => {}
            }
        }
        self.new_line();
        Ok(line)
    }
}
