//! One line of text into tokens. A comment ends the line.

use super::Dialect;

/// A piece of a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Lexeme<'a> {
    /// A number or a character's code.
    Number(i64),
    /// A symbol, mnemonic or register; directives keep their dot.
    Name(&'a str),
    /// A string's text.
    Text(&'a str),
    /// `<<`
    ShiftLeft,
    /// `>>`
    ShiftRight,
    /// Any of `( ) + - * / & | ^ < > , # : =`
    Mark(char),
}

/// A lexeme and the column where it starts, from 1.
#[derive(Clone, Debug)]
pub(super) struct Token<'a> {
    pub what: Lexeme<'a>,
    pub column: u32,
}

/// What is wrong on a line, and from which column.
#[derive(Debug)]
pub(super) struct Wrong {
    pub column: u32,
    pub message: String,
}

pub(super) fn wrong<T>(column: u32, message: impl Into<String>) -> Result<T, Wrong> {
    Err(Wrong {
        column,
        message: message.into(),
    })
}

/// The largest number that can be written: what fits 32 bits.
const LARGEST: i64 = 0xFFFF_FFFF;

struct Lexer<'a> {
    rest: &'a str,
    column: u32,
    dialect: Dialect,
}

impl<'a> Lexer<'a> {
    /// Takes the longest prefix of characters that `wanted` accepts.
    fn take(&mut self, wanted: impl Fn(char) -> bool) -> &'a str {
        let end = self.rest.find(|c| !wanted(c)).unwrap_or(self.rest.len());
        self.split(end)
    }

    /// Takes `end` bytes, which must end at a character's border.
    fn split(&mut self, end: usize) -> &'a str {
        let (head, tail) = self.rest.split_at_checked(end).unwrap_or((self.rest, ""));
        self.rest = tail;
        self.column += head.chars().count() as u32;
        head
    }

    fn skip(&mut self) {
        let mut chars = self.rest.chars();
        if chars.next().is_some() {
            self.rest = chars.as_str();
            self.column += 1;
        }
    }

    fn number(&mut self, radix: u32, start: u32) -> Result<i64, Wrong> {
        let digits = self.take(|c| c.is_ascii_alphanumeric());
        match i64::from_str_radix(digits, radix) {
            Ok(n) if n <= LARGEST => Ok(n),
            Ok(_) => wrong(start, "this number does not fit 32 bits"),
            Err(_) if digits.len() > 8 && digits.chars().all(|c| c.is_digit(radix)) => {
                wrong(start, "this number does not fit 32 bits")
            }
            Err(_) => wrong(start, format!("`{digits}` is not a number in base {radix}")),
        }
    }

    fn character(&mut self, start: u32) -> Result<i64, Wrong> {
        self.skip();
        let mut chars = self.rest.chars();
        match (chars.next(), chars.next()) {
            (Some(c), Some('\'')) if (' '..='~').contains(&c) && c != '\'' => {
                self.split(2);
                Ok(i64::from(u32::from(c)))
            }
            _ => wrong(
                start,
                "expected one printable ASCII character in quotes, as 'c'",
            ),
        }
    }

    fn text(&mut self, start: u32) -> Result<&'a str, Wrong> {
        self.skip();
        let text = self.take(|c| c != '"');
        if self.rest.is_empty() {
            return wrong(start, "this string has no closing quote");
        }
        self.skip();
        if text.chars().all(|c| (' '..='~').contains(&c)) {
            Ok(text)
        } else {
            wrong(start, "a string may hold printable ASCII characters only")
        }
    }

    fn lexeme(&mut self, first: char) -> Result<Lexeme<'a>, Wrong> {
        let start = self.column;
        let beebasm = self.dialect == Dialect::Beebasm;
        let what = match first {
            '&' if beebasm => {
                self.skip();
                Lexeme::Number(self.number(16, start)?)
            }
            '|' | '^' | '/' if beebasm => {
                return wrong(start, format!("beebasm has no operator {first:?} on bits"));
            }
            '0'..='9' => Lexeme::Number(self.number(10, start)?),
            '$' => {
                self.skip();
                Lexeme::Number(self.number(16, start)?)
            }
            '%' => {
                self.skip();
                Lexeme::Number(self.number(2, start)?)
            }
            '\'' => Lexeme::Number(self.character(start)?),
            '"' => Lexeme::Text(self.text(start)?),
            'a'..='z' | 'A'..='Z' | '_' | '.' => {
                let dotless = |c: char| c.is_ascii_alphanumeric() || c == '_';
                let length = 1 + self
                    .rest
                    .get(1..)
                    .map_or(0, |r| r.find(|c| !dotless(c)).unwrap_or(r.len()));
                Lexeme::Name(self.split(length))
            }
            '<' | '>' if self.rest.starts_with("<<") || self.rest.starts_with(">>") => {
                self.split(2);
                if first == '<' {
                    Lexeme::ShiftLeft
                } else {
                    Lexeme::ShiftRight
                }
            }
            '(' | ')' | '+' | '-' | '*' | '/' | '&' | '|' | '^' | '<' | '>' | ',' | '#' | ':'
            | '=' => {
                self.skip();
                Lexeme::Mark(first)
            }
            other => return wrong(start, format!("unexpected character {other:?}")),
        };
        Ok(what)
    }
}

/// The tokens of a line up to its comment.
pub(super) fn tokens(line: &str, dialect: Dialect) -> Result<Vec<Token<'_>>, Wrong> {
    let mut lexer = Lexer {
        rest: line,
        column: 1,
        dialect,
    };
    let mut found = Vec::new();
    loop {
        lexer.take(char::is_whitespace);
        let column = lexer.column;
        match lexer.rest.chars().next() {
            None | Some(';') => return Ok(found),
            Some('\\') if dialect == Dialect::Beebasm => return Ok(found),
            Some(first) => {
                let what = lexer.lexeme(first)?;
                found.push(Token { what, column });
            }
        }
    }
}
