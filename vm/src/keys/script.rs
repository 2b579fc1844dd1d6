//! Scripts of keys: `right*20 wait 50 space`.
//!
//! Words, one after the other in time:
//!
//! | word | what it does |
//! |---|---|
//! | `KEY` | a key is held for one unit, and let go for one |
//! | `KEY*N` | the same, held for N units |
//! | `"text"` | each character is pressed for one unit, and let go for one |
//! | `wait N` | no key for N units |
//! | `shot FILE` | the screen is kept when the program next looks at the keyboard |
//! | `stdin` | at the end: standard input is typed from here on |
//! | `quit` | at the end: the run ends when the program next looks at the keyboard |
//! | `by frames`, `by calls` | at the start: what a unit is |
//! | `// ...` | nothing, to the end of the line |

use super::Key;
use crate::Fault;
use std::str::FromStr;

/// What a script counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Pictures of the machine's screen.
    Frames,
    /// Looks of the program at the keyboard.
    Calls,
}

/// No `*N` or `wait N` is longer.
const LONGEST: u64 = 1_000_000_000;

/// Keys in time.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Script {
    by: Option<Unit>,
    spans: Vec<Span>,
    /// When, and the file's name; in this order.
    shots: Vec<(u64, String)>,
    length: u64,
    end: End,
}

/// A key is held from one unit on, up to another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Span {
    from: u64,
    to: u64,
    key: Key,
}

/// What comes after the last word.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum End {
    /// Nobody touches the keyboard.
    #[default]
    Idle,
    Input,
    Quit,
}

impl Script {
    /// The same a unit a look at the keyboard, with a shot at each of the first `count` looks;
    /// the run ends at the last of these.
    #[must_use]
    pub fn filmed(self, count: u64) -> Script {
        let mut script = self.ended(count.saturating_sub(1));
        script.by = Some(Unit::Calls);
        script.shots = (0..count).map(|at| (at, at.to_string())).collect();
        script
    }

    /// The same that ends at a unit, `count`, whatever it says itself; what it would do later
    /// is left out, but for its shots, which are then missed.
    #[must_use]
    pub fn ended(mut self, count: u64) -> Script {
        self.spans.retain(|span| span.from < count);
        for span in &mut self.spans {
            span.to = span.to.min(count);
        }
        self.length = count;
        self.end = End::Quit;
        self
    }

    /// What it counts, if it says so.
    pub fn unit(&self) -> Option<Unit> {
        self.by
    }

    /// Whether it says nothing at all.
    pub fn is_empty(&self) -> bool {
        *self == Script::default()
    }

    /// The units from its start to its end.
    pub fn length(&self) -> u64 {
        self.length
    }

    /// The files of its shots.
    pub fn pictures(&self) -> impl Iterator<Item = &str> {
        self.shots.iter().map(|(_, name)| name.as_str())
    }

    /// Whether the run ends where it does.
    pub fn quits(&self) -> bool {
        self.end == End::Quit
    }

    pub(super) fn types_input(&self) -> bool {
        self.end == End::Input
    }

    pub(super) fn shots(&self) -> &[(u64, String)] {
        &self.shots
    }

    /// The key that is held in a unit.
    pub fn held(&self, unit: u64) -> Option<Key> {
        let (at, key) = self.next(unit)?;
        (at == unit).then_some(key)
    }

    /// The first unit from `unit` on in which a key is held, and the key.
    pub(super) fn next(&self, unit: u64) -> Option<(u64, Key)> {
        let first = self.spans.partition_point(|span| span.to <= unit);
        let span = self.spans.get(first)?;
        Some((span.from.max(unit), span.key))
    }

    /// The unit in which the key that is held in `unit` is let go.
    pub(super) fn end(&self, unit: u64) -> Option<u64> {
        let first = self.spans.partition_point(|span| span.to <= unit);
        let span = self.spans.get(first)?;
        (span.from <= unit).then_some(span.to)
    }

    fn press(&mut self, key: Key, units: u64) {
        let from = self.length;
        let to = from.saturating_add(units);
        if from < to {
            self.spans.push(Span { from, to, key });
        }
        self.length = to.saturating_add(1);
    }
}

impl FromStr for Script {
    type Err = Fault;

    /// Reads a script.
    ///
    /// # Errors
    /// The first word that is wrong, and where it is.
    fn from_str(text: &str) -> Result<Script, Fault> {
        let mut script = Script::default();
        let mut words = Words { text, at: 0 };
        let mut first = true;
        while let Some(word) = words.next()? {
            if script.end != End::Idle {
                return Err(word.wrong("nothing comes after `stdin` or `quit`"));
            }
            match word.text {
                "wait" => {
                    let units = words.argument(&word, "how long, in units: `wait 50`")?;
                    script.length = script.length.saturating_add(units.number(units.text)?);
                }
                "shot" => {
                    let name = words.argument(&word, "a file: `shot one.png`")?;
                    let name = name.text.trim_matches('"').to_owned();
                    script.shots.push((script.length, name));
                }
                "by" if first => {
                    let unit = words.argument(&word, "`frames` or `calls`")?;
                    script.by = Some(match unit.text {
                        "frames" => Unit::Frames,
                        "calls" => Unit::Calls,
                        _ => return Err(unit.wrong("a script is by `frames` or by `calls`")),
                    });
                }
                "by" => return Err(word.wrong("`by` stands at the start of a script")),
                "stdin" => script.end = End::Input,
                "quit" => script.end = End::Quit,
                text if text.len() > 1 && text.starts_with('"') => {
                    for c in text.trim_matches('"').bytes() {
                        let key = Key::typed(c).filter(|_| c != b'\n');
                        let key = key.ok_or_else(|| word.wrong("a text has only ASCII"))?;
                        script.press(key, 1);
                    }
                }
                _ => {
                    let (key, units) = word.key()?;
                    script.press(key, units);
                }
            }
            first = false;
        }
        Ok(script)
    }
}

/// A word of a script, and where it stands.
struct Word<'t> {
    text: &'t str,
    /// Bytes before it.
    at: usize,
    whole: &'t str,
}

impl<'t> Word<'t> {
    /// A key, and for how many units it is held.
    fn key(&self) -> Result<(Key, u64), Fault> {
        let (name, units) = match self.text.rsplit_once('*') {
            Some((name, number)) if !name.is_empty() => (name, self.number(number)?),
            _ => (self.text, 1),
        };
        let key = Key::named(name).ok_or_else(|| {
            let all: Vec<&str> = Key::names().collect();
            let (name, all) = (cut(name), all.join(", "));
            self.wrong(&format!(
                "there is no key `{name}`: keys are single characters, f0 to f12, {all}"
            ))
        })?;
        Ok((key, units))
    }

    fn number(&self, text: &str) -> Result<u64, Fault> {
        let digits = !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        let number = text.parse().ok().filter(|n| digits && *n <= LONGEST);
        number.ok_or_else(|| {
            let text = cut(text);
            self.wrong(&format!(
                "`{text}` is no number of units from 0 to {LONGEST}"
            ))
        })
    }

    fn wrong(&self, message: &str) -> Fault {
        let before = self.whole.get(..self.at).unwrap_or("");
        let line = before.matches('\n').count() + 1;
        let start = before.rfind('\n').map_or(0, |end| end + 1);
        let column = before.get(start..).unwrap_or("").chars().count() + 1;
        Fault {
            message: message.to_owned(),
            file: None,
            line: u32::try_from(line).ok(),
            column: u32::try_from(column).ok(),
        }
    }
}

/// The words of a text from some byte on.
struct Words<'t> {
    text: &'t str,
    at: usize,
}

impl<'t> Words<'t> {
    fn next(&mut self) -> Result<Option<Word<'t>>, Fault> {
        loop {
            let rest = self.text.get(self.at..).unwrap_or("");
            let start = rest.trim_start();
            self.at += rest.len() - start.len();
            if start.starts_with("//") {
                self.at += start.find('\n').unwrap_or(start.len());
                continue;
            }
            if start.is_empty() {
                return Ok(None);
            }
            let word = |length: usize| Word {
                text: start.get(..length).unwrap_or(""),
                at: self.at,
                whole: self.text,
            };
            let length = match start.strip_prefix('"') {
                Some(inner) => match inner.find('"') {
                    Some(end) => end + 2,
                    None => return Err(word(1).wrong("the text has no closing `\"`")),
                },
                None => start.find(char::is_whitespace).unwrap_or(start.len()),
            };
            let found = word(length);
            self.at += length;
            return Ok(Some(found));
        }
    }

    /// The word behind another, which needs it.
    fn argument(&mut self, word: &Word<'_>, what: &str) -> Result<Word<'t>, Fault> {
        let next = self.next()?;
        next.ok_or_else(|| word.wrong(&format!("`{}` needs {what}", word.text)))
    }
}

/// A word for a message, cut where it is absurdly long.
fn cut(text: &str) -> String {
    text.chars().take(40).collect()
}
