//! A keyboard that a script plays: which key is held when, the same on every run.
//!
//! ```
//! use slowlight_vm::keys::{Keyboard, Script, Seen, Unit, Key};
//! let script: Script = "right*2 wait 1 space".parse()?;
//! let mut keyboard = Keyboard::new(script, Unit::Calls, |_| None);
//! let mut look = || keyboard.look(0, || None);
//! assert_eq!(look(), Seen::Key(Key::Right));
//! assert_eq!(look(), Seen::Key(Key::Right));
//! assert_eq!([look(), look()], [Seen::Nothing; 2]);
//! assert_eq!(look(), Seen::Key(Key::Char(b' ')));
//! # Ok::<(), slowlight_vm::Fault>(())
//! ```
//!
//! A script counts *units*: frames of the machine's clock, or calls, which are the looks
//! that the program takes at the keyboard. What is typed when a script has come to its
//! end, and only there where a program waits for it, is standard input.

mod names;
mod script;
mod still;
#[cfg(test)]
mod tests;

pub use names::Key;
pub use script::{Script, Unit};
pub(crate) use still::Still;

use crate::Screen;
use std::collections::VecDeque;

/// Reads a line of standard input, with its end; `None` where there is no more. It is told
/// what the program has printed on the line so far.
pub type ReadLine = fn(&str) -> Option<Vec<u8>>;

/// What a look at the keyboard sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seen {
    /// No key is held.
    Nothing,
    /// This key is.
    Key(Key),
    /// The script says that the run ends here.
    Quit,
}

/// What comes to a program that waits for a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Next {
    /// A key, so many frames later.
    Key(Key, u64),
    /// The script says that the run ends here.
    Quit,
    /// None, ever.
    Never,
}

/// A keyboard, and how far its script has been played.
#[derive(Clone, Debug)]
pub struct Keyboard {
    script: Script,
    by: Unit,
    read: ReadLine,
    /// Looks that the program has taken, and how many of them are a unit.
    calls: u64,
    looks: u64,
    /// The unit whose key was typed last.
    typed: Option<u64>,
    /// What was read of standard input and not yet typed.
    line: VecDeque<u8>,
    ended: bool,
    /// Whether the last look saw a key of standard input, which must be let go.
    down: bool,
    /// Looks that saw no key when none was left.
    late: u64,
    shots: Vec<(String, Option<Screen>)>,
    /// The memory at each look, where that is wanted, and the machine's cycles until then.
    memories: Option<Vec<Vec<i16>>>,
    times: Vec<u64>,
}

impl Keyboard {
    /// A keyboard that a script plays, by `unit` where the script does not say.
    pub fn new(script: Script, unit: Unit, read: ReadLine) -> Keyboard {
        Keyboard {
            by: script.unit().unwrap_or(unit),
            script,
            read,
            calls: 0,
            looks: 1,
            typed: None,
            line: VecDeque::new(),
            ended: false,
            down: false,
            late: 0,
            shots: Vec::new(),
            memories: None,
            times: Vec::new(),
        }
    }

    /// The same that keeps the memory at every look.
    #[must_use]
    pub fn remembering(self) -> Keyboard {
        Keyboard {
            memories: Some(Vec::new()),
            ..self
        }
    }

    /// The same for a program that takes so many looks in a row, one for each key that it asks
    /// for: only the first of them counts.
    #[must_use]
    pub fn looked_at(self, looks: u64) -> Keyboard {
        Keyboard {
            looks: looks.max(1),
            ..self
        }
    }

    /// Whether it keeps the memory at every look.
    pub(crate) fn remembers(&self) -> bool {
        self.memories.is_some()
    }

    /// The memory at each look, on machines that tell it.
    pub fn memories(&self) -> &[Vec<i16>] {
        self.memories.as_deref().unwrap_or_default()
    }

    /// The machine's cycles until each of those looks.
    pub fn times(&self) -> &[u64] {
        &self.times
    }

    /// The program is about to look, after so many cycles, and its memory is this.
    pub(crate) fn remember(&mut self, cycles: u64, memory: impl FnOnce() -> Vec<i16>) {
        if let Some(memories) = &mut self.memories
            && self.calls.is_multiple_of(self.looks)
        {
            memories.push(memory());
            self.times.push(cycles);
        }
    }

    /// What the script counts.
    pub fn unit(&self) -> Unit {
        self.by
    }

    /// Whether there is a script.
    pub fn is_scripted(&self) -> bool {
        !self.script.is_empty()
    }

    /// The screens at the script's shots, by the names of their files, as far as it has come;
    /// `None` where the screen showed nothing.
    pub fn shots(&self) -> &[(String, Option<Screen>)] {
        &self.shots
    }

    /// Another screen for a shot, which was not there yet.
    pub(crate) fn retake(&mut self, at: usize, screen: Option<Screen>) {
        if let Some((_, shot)) = self.shots.get_mut(at) {
            *shot = screen;
        }
    }

    /// The shots that the program has not come to.
    pub fn missed(&self) -> impl Iterator<Item = &str> {
        let names = self.script.shots().iter().skip(self.shots.len());
        names.map(|(_, name)| name.as_str())
    }

    /// How often the program has looked for a key since there was none left.
    pub fn late(&self) -> u64 {
        self.late
    }

    /// The program looks which key is held, `frame` frames after its start.
    pub fn look(&mut self, frame: u64, screen: impl FnOnce() -> Option<Screen>) -> Seen {
        let unit = self.at(frame);
        self.calls += 1;
        self.shoot(unit, screen);
        if let Some(key) = self.script.held(unit) {
            return Seen::Key(key);
        }
        if unit < self.script.length() {
            return Seen::Nothing;
        }
        if self.script.quits() {
            return Seen::Quit;
        }
        if self.script.types_input() {
            // A key is let go before the next.
            self.down = !self.down;
            match self.down.then(|| self.input("")).flatten() {
                Some(key) => return Seen::Key(key),
                None if !self.ended => return Seen::Nothing,
                None => {}
            }
        }
        self.late += 1;
        Seen::Nothing
    }

    /// The program takes the key that was typed, if one was: a key that is held is typed once
    /// a unit.
    pub fn take(&mut self, frame: u64, screen: impl FnOnce() -> Option<Screen>) -> Seen {
        let unit = self.at(frame);
        let again = self.by == Unit::Frames && self.typed == Some(unit);
        let seen = self.look(frame, screen);
        if !matches!(seen, Seen::Key(_)) {
            return seen;
        }
        self.typed = Some(unit);
        if again { Seen::Nothing } else { seen }
    }

    /// The program waits for the next key that is typed, and nothing happens until then;
    /// `shown` is what it has printed on the line.
    pub fn wait(
        &mut self,
        frame: u64,
        shown: &str,
        screen: impl FnOnce() -> Option<Screen>,
    ) -> Next {
        let now = self.at(frame);
        let from = match self.typed {
            Some(typed) if self.by == Unit::Frames && typed >= now => typed + 1,
            _ => now,
        };
        match self.script.next(from) {
            Some((unit, key)) => {
                self.shoot(unit, screen);
                self.calls = unit + 1;
                self.typed = Some(unit);
                Next::Key(key, self.frames(unit - now))
            }
            None => {
                self.shoot(self.script.length(), screen);
                self.calls = self.calls.max(self.script.length());
                if self.script.quits() {
                    return Next::Quit;
                }
                match self.input(shown) {
                    Some(key) => Next::Key(key, 0),
                    None => Next::Never,
                }
            }
        }
    }

    /// The same for a key that is pressed and let go again.
    pub fn wait_press(
        &mut self,
        frame: u64,
        shown: &str,
        screen: impl FnOnce() -> Option<Screen>,
    ) -> Next {
        let now = self.at(frame);
        let before = self.typed;
        let next = self.wait(frame, shown, screen);
        let pressed = self.typed.filter(|_| self.typed != before);
        let end = pressed.and_then(|unit| self.script.end(unit));
        if let (Next::Key(key, _), Some(end)) = (next, end) {
            // A look that sees that it is held no more.
            self.calls = end + 1;
            self.typed = Some(end);
            return Next::Key(key, self.frames(end.saturating_sub(now)));
        }
        next
    }

    fn frames(&self, units: u64) -> u64 {
        match self.by {
            Unit::Frames => units,
            Unit::Calls => 0,
        }
    }

    fn at(&self, frame: u64) -> u64 {
        match self.by {
            Unit::Frames => frame,
            Unit::Calls => self.calls / self.looks,
        }
    }

    /// Whether no key is left.
    pub fn is_over(&self) -> bool {
        self.late > 0
    }

    /// Takes the shots that are due.
    fn shoot(&mut self, unit: u64, screen: impl FnOnce() -> Option<Screen>) {
        let shots = self.script.shots();
        let due = shots.partition_point(|(at, _)| *at <= unit);
        if due > self.shots.len() {
            let now = screen();
            let names = shots.get(self.shots.len()..due).unwrap_or(&[]);
            let taken = names.iter().map(|(_, name)| (name.clone(), now.clone()));
            let taken: Vec<_> = taken.collect();
            self.shots.extend(taken);
        }
    }

    /// The next key of standard input.
    fn input(&mut self, shown: &str) -> Option<Key> {
        while !self.ended {
            while let Some(byte) = self.line.pop_front() {
                if let Some(key) = Key::typed(byte) {
                    return Some(key);
                }
            }
            match (self.read)(shown) {
                Some(line) if !line.is_empty() => self.line.extend(line),
                _ => self.ended = true,
            }
        }
        None
    }
}

/// What is said of a program that waits for a key when there is none.
pub(crate) fn never(who: &str) -> String {
    format!(
        "{who} waits for a key that never comes: the script of keys and standard input are at their end"
    )
}
