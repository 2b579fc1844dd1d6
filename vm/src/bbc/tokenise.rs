//! Text to tokenised program and back.
//!
//! A tokenised program is a run of lines, each `&0D hi lo length text`, where hi and lo are
//! the line number, the length counts all of the line, and the text holds one byte a keyword.
//! After the last line come `&0D &FF`. Line numbers after GOTO, GOSUB, THEN, ELSE and RESTORE
//! are stored as `&8D` and three bytes.

use std::collections::BTreeMap;

use slowlight_isa::basic_tokens::{
    COND, KEYWORDS, Keyword, LINE_NUMBER, LINES, MID, NAME, PSEUDO, REST, START, decode_line,
    encode_line, keyword,
};

use super::Dialect;
use crate::Fault;

/// The longest text of a line: 255 bytes with its header of four.
const LONGEST: usize = 251;

fn fault(line: Option<u32>, message: impl Into<String>) -> Fault {
    Fault {
        message: message.into(),
        file: None,
        line,
        column: None,
    }
}

/// Tokenises program text. A line without a number is numbered ten on from the one before it (the
/// first is 10). A later line with the same number replaces the earlier one, as if typed.
///
/// # Errors
/// Name the line of the *text* (1-based): characters that BASIC has not, numbers and lines that
/// are too long, and a line that would replace another though one of both has no number.
pub fn tokenise(text: &str, _dialect: Dialect) -> Result<Vec<u8>, Fault> {
    let lines = text
        .split('\n')
        .map(|l| l.trim_end_matches('\r'))
        .enumerate()
        .filter(|(_, l)| !l.trim().is_empty());
    let mut program: BTreeMap<u16, TextLine> = BTreeMap::new();
    let mut last = 0;
    for (row, line) in lines {
        let row = row as u32 + 1;
        let start = line.trim_start();
        let digits = start.bytes().take_while(u8::is_ascii_digit).count();
        let (number, body) = start.split_at(digits);
        let numbered = digits > 0;
        let number = if numbered {
            number.parse().ok()
        } else {
            Some(last + 10)
        };
        let number = number
            .filter(|n| *n <= 32767)
            .and_then(|n: usize| u16::try_from(n).ok())
            .ok_or_else(|| fault(Some(row), "line numbers go from 0 to 32767"))?;
        last = usize::from(number);
        // As in posts to a bot, what Latin-1 has no letter for may be its number and 256.
        let is_odd = |c: &char| *c > '\u{1ff}' || *c < ' ' || *c == '\u{10d}';
        if let Some(odd) = body.chars().find(is_odd) {
            return Err(fault(
                Some(row),
                format!(
                    "BASIC's characters are Latin-1, or 256 further on: {odd:?} is none of them"
                ),
            ));
        }
        let latin: Vec<u8> = body.chars().map(|c| c as u32 as u8).collect();
        let tokens = tokenise_line(&latin, true);
        if tokens.len() > LONGEST {
            return Err(fault(
                Some(row),
                format!(
                    "line {number} is {} bytes long; {LONGEST} fit: split it",
                    tokens.len()
                ),
            ));
        }
        let line = TextLine {
            row,
            numbered,
            tokens,
        };
        if let Some(other) = program.insert(number, line)
            && !(other.numbered && numbered)
        {
            let other = other.row;
            return Err(fault(
                Some(row),
                format!(
                    "lines {other} and {row} of the text both come to be line {number}: a line without a number has that of the one before it, and 10"
                ),
            ));
        }
    }
    let mut out = Vec::new();
    for (number, TextLine { tokens, .. }) in program {
        let [hi, lo] = number.to_be_bytes();
        out.extend([0x0d, hi, lo, tokens.len() as u8 + 4]);
        out.extend(tokens);
    }
    out.extend([0x0d, 0xff]);
    Ok(out)
}

/// A line of program text.
struct TextLine {
    /// Which line of the text, from 1.
    row: u32,
    /// Whether the text gives its number.
    numbered: bool,
    tokens: Vec<u8>,
}

fn is_name(c: u8) -> bool {
    c.is_ascii_alphanumeric() || c == b'_' || c == b'`'
}

/// The keyword at the start of `rest`, perhaps abbreviated by a point, and its length there.
fn match_keyword(rest: &[u8]) -> Option<(&'static Keyword, usize)> {
    for k in KEYWORDS {
        let name = k.name.as_bytes();
        let same = name.iter().zip(rest).take_while(|(a, b)| a == b).count();
        if same == name.len() {
            let conditional = k.flags & COND != 0;
            if conditional && rest.get(same).is_some_and(|c| is_name(*c)) {
                return None;
            }
            return Some((k, same));
        }
        if same > 0 && rest.get(same) == Some(&b'.') {
            return Some((k, same + 1));
        }
    }
    None
}

/// The text of one line (no number) in tokens, as the machine's own routine does it.
///
/// `start`: does a statement start here? (In EVAL none does.)
pub(crate) fn tokenise_line(text: &[u8], mut start: bool) -> Vec<u8> {
    let mut out = Vec::with_capacity(text.len());
    // The number in front of a line makes the ROM look for more, until something ends that.
    let mut lines = start;
    let mut at = 0;
    while let Some(&c) = text.get(at) {
        let rest = text.get(at..).unwrap_or(&[]);
        let copied = match c {
            b'"' => 1 + rest.iter().skip(1).take_while(|c| **c != b'"').count() + 1,
            b'&' => {
                1 + rest
                    .iter()
                    .skip(1)
                    .take_while(|c| c.is_ascii_hexdigit() && !c.is_ascii_lowercase())
                    .count()
            }
            b'*' if start => rest.len(),
            b'0'..=b'9' | b'.' => {
                let digits = rest.iter().take_while(|c| c.is_ascii_digit()).count();
                let number = std::str::from_utf8(rest.get(..digits).unwrap_or(&[]))
                    .ok()
                    .and_then(|d| d.parse::<u16>().ok())
                    .filter(|n| *n <= 32767);
                if let (true, Some(n)) = (lines, number) {
                    out.push(LINE_NUMBER);
                    out.extend(encode_line(n));
                    at += digits;
                    continue;
                }
                start = false;
                rest.iter()
                    .take_while(|c| c.is_ascii_digit() || **c == b'.')
                    .count()
            }
            b'A'..=b'Z' => {
                if let Some((k, length)) = match_keyword(rest) {
                    at += length;
                    out.push(if start && k.flags & PSEUDO != 0 {
                        k.token + 0x40
                    } else {
                        k.token
                    });
                    if k.flags & MID != 0 {
                        start = false;
                        lines = false;
                    }
                    if k.flags & START != 0 {
                        start = true;
                        lines = false;
                    }
                    if k.flags & LINES != 0 {
                        lines = true;
                    }
                    let tail = text.get(at..).unwrap_or(&[]);
                    let verbatim = if k.flags & REST != 0 {
                        tail.len()
                    } else if k.flags & NAME != 0 {
                        tail.iter().take_while(|c| is_name(**c)).count()
                    } else {
                        0
                    };
                    out.extend(tail.iter().take(verbatim));
                    at += verbatim;
                    continue;
                }
                start = false;
                lines = false;
                rest.iter().take_while(|c| is_name(**c)).count()
            }
            b'a'..=b'z' | b'_' | b'`' => {
                start = false;
                lines = false;
                rest.iter().take_while(|c| is_name(**c)).count()
            }
            b':' => {
                start = true;
                lines = false;
                1
            }
            b' ' | b',' => 1,
            _ => {
                start = false;
                lines = false;
                1
            }
        };
        if c == b'"' || c == b'&' {
            start = false;
            lines = false;
        }
        out.extend(rest.iter().take(copied));
        at += copied.max(1);
    }
    out
}

/// One line of a tokenised program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct RawLine<'a> {
    pub number: u16,
    /// Where the line's text starts, from the program's first byte.
    pub offset: usize,
    pub text: &'a [u8],
}

/// Cuts a tokenised program into lines. Anything after `&0D &FF` (or a number above 32767) is ignored.
pub(crate) fn lines(program: &[u8]) -> Result<Vec<RawLine<'_>>, Fault> {
    let bad = |line: Option<u16>| fault(line.map(u32::from), "Bad program");
    let mut out: Vec<RawLine<'_>> = Vec::new();
    let mut at = 0;
    loop {
        let last = out.last().map(|l| l.number);
        if program.get(at) != Some(&0x0d) {
            return Err(bad(last));
        }
        let hi = *program.get(at + 1).ok_or_else(|| bad(last))?;
        if hi >= 0x80 {
            return Ok(out);
        }
        let (lo, length) = match (program.get(at + 2), program.get(at + 3)) {
            (Some(lo), Some(length)) if *length >= 4 => (*lo, usize::from(*length)),
            _ => return Err(bad(last)),
        };
        let text = program.get(at + 4..at + length).ok_or_else(|| bad(last))?;
        out.push(RawLine {
            number: u16::from_be_bytes([hi, lo]),
            offset: at + 4,
            text,
        });
        at += length;
    }
}

/// A tokenised program as text, one line a line, numbers first.
pub fn detokenise(program: &[u8]) -> Result<String, Fault> {
    let mut out = String::new();
    for line in lines(program)? {
        out.push_str(&line.number.to_string());
        detokenise_line(line.text, &mut out);
        out.push('\n');
    }
    Ok(out)
}

fn detokenise_line(text: &[u8], out: &mut String) {
    let mut quoted = false;
    let mut verbatim = false;
    let mut at = 0;
    while let Some(&c) = text.get(at) {
        at += 1;
        quoted ^= c == b'"';
        if c < 0x80 || quoted || verbatim {
            out.push(char::from(c));
        } else if let (LINE_NUMBER, Some(&[a, b, c])) = (c, text.get(at..at + 3)) {
            out.push_str(&decode_line([a, b, c]).to_string());
            at += 3;
        } else if let Some(k) = keyword(c) {
            out.push_str(k.name);
            verbatim = k.flags & REST != 0;
        } else {
            out.push(char::from(c));
        }
    }
}
