//! Reads `.vm` text into commands whose names are not yet resolved.

use super::command::{Binary, STATICS};
use crate::Fault;

/// The memory segments of the VM language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Segment {
    Constant,
    Local,
    Argument,
    This,
    That,
    Static,
    Temp,
    Pointer,
}

impl Segment {
    /// The greatest index that the segment takes.
    const fn last(self) -> u16 {
        match self {
            Segment::Static => STATICS - 1,
            Segment::Temp => 7,
            Segment::Pointer => 1,
            _ => 32767,
        }
    }
}

/// A command as written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Written<'t> {
    Push(Segment, u16),
    Pop(Segment, u16),
    Binary(Binary),
    Neg,
    Not,
    Label(&'t str),
    Goto(&'t str),
    IfGoto(&'t str),
    Function(&'t str, u16),
    Call(&'t str, u16),
    Return,
}

/// A command and its line, counted from 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<'t> {
    pub line: u32,
    pub what: Written<'t>,
}

/// Reads the text of the file `name`; what is wrong goes to `faults`.
pub(super) fn parse<'t>(name: &str, text: &'t str, faults: &mut Vec<Fault>) -> Vec<Line<'t>> {
    let mut lines = Vec::new();
    let mut in_comment = false;
    for (number, line) in (1..).zip(text.lines()) {
        let code = strip_comments(line, &mut in_comment);
        let result = match code {
            Ok(code) => command(code),
            Err(message) => Err(message),
        };
        match result {
            Ok(Some(what)) => lines.push(Line { line: number, what }),
            Ok(None) => {}
            Err(message) => faults.push(fault(name, number, message)),
        }
    }
    lines
}

/// A fault at a line of a file.
pub(super) fn fault(file: &str, line: u32, message: String) -> Fault {
    Fault {
        message,
        file: Some(file.to_owned()),
        line: Some(line),
        column: None,
    }
}

/// What is left of a line without `// ...` and `/* ... */`, which may go on
/// over lines. A line with code on both sides of a comment is refused: the
/// two parts would have to be put together for nobody's benefit.
fn strip_comments<'t>(line: &'t str, in_comment: &mut bool) -> Result<&'t str, String> {
    let mut rest = line;
    let mut code = "";
    loop {
        if *in_comment {
            match rest.split_once("*/") {
                Some((_, after)) => {
                    *in_comment = false;
                    rest = after;
                }
                None => return Ok(code),
            }
        }
        let cut = match (rest.find("//"), rest.find("/*")) {
            (Some(line), Some(block)) if block < line => Some((block, true)),
            (Some(line), _) => Some((line, false)),
            (None, Some(block)) => Some((block, true)),
            (None, None) => None,
        };
        let (part, after) = match cut {
            Some((at, _)) => rest.split_at(at),
            None => (rest, ""),
        };
        if !part.trim().is_empty() {
            if !code.trim().is_empty() {
                return Err("a comment in the middle of a command".to_owned());
            }
            code = part;
        }
        match cut {
            Some((_, true)) => {
                *in_comment = true;
                rest = after.get(2..).unwrap_or("");
            }
            _ => return Ok(code),
        }
    }
}

/// Reads one line without comments; `None` if it is empty.
fn command(code: &str) -> Result<Option<Written<'_>>, String> {
    let mut words = code.split_whitespace();
    let Some(verb) = words.next() else {
        return Ok(None);
    };
    let written = match verb {
        "push" => {
            let (segment, index) = segment_and_index(verb, &mut words)?;
            Written::Push(segment, index)
        }
        "pop" => {
            let (segment, index) = segment_and_index(verb, &mut words)?;
            if segment == Segment::Constant {
                return Err("pop constant: a constant cannot be stored to".to_owned());
            }
            Written::Pop(segment, index)
        }
        "add" => Written::Binary(Binary::Add),
        "sub" => Written::Binary(Binary::Sub),
        "and" => Written::Binary(Binary::And),
        "or" => Written::Binary(Binary::Or),
        "eq" => Written::Binary(Binary::Eq),
        "gt" => Written::Binary(Binary::Gt),
        "lt" => Written::Binary(Binary::Lt),
        "neg" => Written::Neg,
        "not" => Written::Not,
        "label" => Written::Label(name(verb, words.next())?),
        "goto" => Written::Goto(name(verb, words.next())?),
        "if-goto" => Written::IfGoto(name(verb, words.next())?),
        "function" => {
            let name = name(verb, words.next())?;
            Written::Function(name, number(verb, "its count of locals", words.next())?)
        }
        "call" => {
            let name = name(verb, words.next())?;
            Written::Call(name, number(verb, "its count of arguments", words.next())?)
        }
        "return" => Written::Return,
        _ => return Err(format!("unknown command {}", shown(verb))),
    };
    match words.next() {
        Some(extra) => Err(format!("{} after a complete {verb}", shown(extra))),
        None => Ok(Some(written)),
    }
}

fn segment_and_index<'t>(
    verb: &str,
    words: &mut impl Iterator<Item = &'t str>,
) -> Result<(Segment, u16), String> {
    let word = words
        .next()
        .ok_or_else(|| format!("{verb} needs a segment and an index"))?;
    let segment = match word {
        "constant" => Segment::Constant,
        "local" => Segment::Local,
        "argument" => Segment::Argument,
        "this" => Segment::This,
        "that" => Segment::That,
        "static" => Segment::Static,
        "temp" => Segment::Temp,
        "pointer" => Segment::Pointer,
        _ => return Err(format!("unknown segment {}", shown(word))),
    };
    let index = number(verb, "an index", words.next())?;
    if index > segment.last() {
        return Err(format!(
            "{word} {index}: the last index of {word} is {}",
            segment.last()
        ));
    }
    Ok((segment, index))
}

fn number(verb: &str, what: &str, word: Option<&str>) -> Result<u16, String> {
    let word = word.ok_or_else(|| format!("{verb} needs {what}"))?;
    match word.parse::<u16>() {
        Ok(value) if value <= 32767 && word.starts_with(|c: char| c.is_ascii_digit()) => Ok(value),
        _ => Err(format!(
            "{verb} needs {what}, from 0 to 32767, not {}",
            shown(word)
        )),
    }
}

/// Names are letters, digits, `_`, `.`, `:` and `$`, and do not start with a digit.
fn name<'t>(verb: &str, word: Option<&'t str>) -> Result<&'t str, String> {
    let word = word.ok_or_else(|| format!("{verb} needs a name"))?;
    let is_part = |c: char| c.is_ascii_alphanumeric() || "_.:$".contains(c);
    if word.starts_with(|c: char| c.is_ascii_digit()) || !word.chars().all(is_part) {
        return Err(format!("{} is no name for {verb}", shown(word)));
    }
    Ok(word)
}

/// A word of the source for a message, cut where it is absurdly long.
fn shown(word: &str) -> String {
    let cut: String = word.chars().take(40).collect();
    if cut.len() < word.len() {
        format!("`{cut}...`")
    } else {
        format!("`{cut}`")
    }
}
