//! READ, DATA and RESTORE: the pointer into the program's DATA lines, and what an item is.
//!
//! As on the ROM, a number is whatever expression stands at the pointer, evaluated anew each time,
//! and what is left of an item goes unread; a string is quoted, or all up to the next comma.

use slowlight_isa::real40::text::{Parsed, parse};

use super::ast::Place;
use super::code::Code;
use super::cost;
use super::error::Error;
use super::state::State;
use super::strings::val_cost;
use super::values::{Num, Value, is_numeric};

type Result<T> = std::result::Result<T, Error>;

/// Where READ goes on: a DATA line, by its index among them, and a place in its text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct DataPointer {
    pub index: usize,
    pub at: usize,
    /// The line of the program from which on it is looked for.
    pub line: u32,
}

/// A string as READ and INPUT take it from `text`, and how many bytes it is long: spaces in front
/// are dropped; it is quoted, or goes on to a comma.
///
/// # Errors
/// A quoted one that does not end.
pub(crate) fn string_item(text: &[u8]) -> Result<(Vec<u8>, usize)> {
    let start = text.iter().take_while(|c| **c == b' ').count();
    let rest = text.get(start..).unwrap_or(&[]);
    let Some(quoted) = rest.strip_prefix(b"\"") else {
        let length = rest.iter().take_while(|c| **c != b',').count();
        return Ok((rest.get(..length).unwrap_or(&[]).to_vec(), start + length));
    };
    let mut string = Vec::new();
    let mut at = 0;
    loop {
        let c = *quoted.get(at).ok_or(Error::MissingQuote)?;
        at += 1;
        if c == b'"' {
            if quoted.get(at) != Some(&b'"') {
                return Ok((string, start + 1 + at));
            }
            at += 1;
        }
        string.push(c);
    }
}

/// The item after the next comma of `text`, from `at`; `None` where none is left.
pub(crate) fn after_comma(text: &[u8], at: usize) -> Option<usize> {
    let rest = text.get(at..)?;
    rest.iter().position(|c| *c == b',').map(|n| at + n + 1)
}

/// A number and its sign that stand alone, as most do: those need no expression.
fn plain(item: &[u8]) -> Result<Option<Num>> {
    let (negative, digits) = match item.strip_prefix(b"-") {
        Some(digits) => (true, digits),
        None => (false, item),
    };
    Ok(match parse(digits)? {
        Some((Parsed::Int(n), used)) if used == digits.len() => {
            Some(Num::Int(if negative { -n } else { n }))
        }
        Some((Parsed::Real(x), used)) if used == digits.len() => {
            Some(Num::Real(if negative { x.negate() } else { x }))
        }
        _ => None,
    })
}

impl State {
    /// RESTORE to a line of the program: to its first DATA or the first after it.
    pub(super) fn restore(&mut self, p: &Code<'_>, line: u32) {
        self.data = DataPointer {
            index: p.data.partition_point(|d| d.line < line),
            at: 0,
            line,
        };
    }

    /// The text of the next item, with what follows it; the pointer comes to stand before it.
    fn next_datum<'a>(&mut self, p: &'a Code<'_>) -> Result<&'a [u8]> {
        loop {
            let datum = p.data.get(self.data.index).ok_or(Error::OutOfData)?;
            let lines = datum.line.saturating_sub(self.data.line);
            self.cycles += u64::from(cost::PER_LINE_SCANNED * lines);
            self.data.line = self.data.line.max(datum.line);
            if let Some(at) = after_comma(&datum.text, self.data.at) {
                self.data.at = at;
                return datum.text.get(at..).ok_or(Error::OutOfData);
            }
            self.data.index += 1;
            self.data.at = 0;
        }
    }

    /// READ into one variable.
    pub(super) fn read(&mut self, p: &Code<'_>, place: &Place) -> Result<()> {
        let home = self.home(p, place)?;
        let text = self.next_datum(p)?;
        let (value, used) = if is_numeric(place) {
            self.read_number(p, text)?
        } else {
            let (string, used) = string_item(text)?;
            self.cycles += 50 * string.len() as u64;
            (Value::Str(string), used)
        };
        self.data.at += used;
        self.store(home, value)
    }

    fn read_number(&mut self, p: &Code<'_>, text: &[u8]) -> Result<(Value, usize)> {
        let spaces = text.iter().take_while(|c| **c == b' ').count();
        let length = text.iter().take_while(|c| **c != b',').count();
        let item = text.get(spaces..length).unwrap_or(&[]);
        if let Some(number) = plain(item)? {
            self.cycles += val_cost(item);
            return Ok((Value::Num(number), length));
        }
        self.evaluate(p, text)
    }
}
