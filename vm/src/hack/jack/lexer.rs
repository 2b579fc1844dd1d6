//! Text to tokens. A token borrows its text; its place is where it begins.

use super::{Faults, LARGEST, Place};

/// The reserved words, by their spelling.
pub(super) const KEYWORDS: [&str; 21] = [
    "class",
    "constructor",
    "function",
    "method",
    "field",
    "static",
    "var",
    "int",
    "char",
    "boolean",
    "void",
    "true",
    "false",
    "null",
    "this",
    "let",
    "do",
    "if",
    "else",
    "while",
    "return",
];

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Token<'a> {
    /// One of [`KEYWORDS`].
    Keyword(&'a str),
    /// One of `{ } ( ) [ ] . , ; + - * / & | < > = ~`.
    Symbol(char),
    /// 0 to 32767.
    Integer(u16),
    /// What stands between the quotes.
    Text(&'a str),
    Name(&'a str),
    /// After the last token, for ever.
    End,
}

impl Token<'_> {
    /// The token as a message shows it, cut to a readable length.
    pub(super) fn shown(self) -> String {
        match self {
            Token::Keyword(word) => format!("`{word}`"),
            Token::Name(word) => format!("`{}`", cut(word)),
            Token::Symbol(symbol) => format!("`{symbol}`"),
            Token::Integer(value) => format!("`{value}`"),
            Token::Text(text) => format!("\"{}\"", cut(text)),
            Token::End => "the end of the file".to_string(),
        }
    }
}

/// At most 40 characters of a name or text, for messages.
pub(super) fn cut(text: &str) -> String {
    match text.char_indices().nth(40) {
        Some((end, _)) => format!("{}...", text.get(..end).unwrap_or_default()),
        None => text.to_string(),
    }
}

/// All tokens with their places; the last is [`Token::End`]. Characters that
/// belong to no token are reported and left out.
pub(super) fn tokens<'a>(text: &'a str, faults: &mut Faults) -> Vec<(Token<'a>, Place)> {
    let mut lexer = Lexer {
        rest: text.strip_prefix('\u{feff}').unwrap_or(text),
        place: Place { line: 1, column: 1 },
    };
    let mut tokens = Vec::new();
    while !faults.full() {
        let (token, place) = lexer.next(faults);
        tokens.push((token, place));
        if token == Token::End {
            break;
        }
    }
    tokens
}

struct Lexer<'a> {
    rest: &'a str,
    place: Place,
}

impl<'a> Lexer<'a> {
    fn next(&mut self, faults: &mut Faults) -> (Token<'a>, Place) {
        loop {
            self.skip_blanks(faults);
            let place = self.place;
            let Some(first) = self.rest.chars().next() else {
                return (Token::End, place);
            };
            let token = match first {
                'a'..='z' | 'A'..='Z' | '_' => {
                    let word = self.take_while(|c| c.is_ascii_alphanumeric() || c == '_');
                    if KEYWORDS.contains(&word) {
                        Token::Keyword(word)
                    } else {
                        Token::Name(word)
                    }
                }
                '0'..='9' => {
                    let digits = self.take_while(|c| c.is_ascii_digit());
                    Token::Integer(integer(digits, place, faults))
                }
                '"' => self.text(place, faults),
                '{' | '}' | '(' | ')' | '[' | ']' | '.' | ',' | ';' | '+' | '-' | '*' | '/'
                | '&' | '|' | '<' | '>' | '=' | '~' => {
                    self.take(first.len_utf8());
                    Token::Symbol(first)
                }
                _ => {
                    let shown = first.escape_debug();
                    faults.add(
                        place,
                        format!("the character `{shown}` has no place in Jack"),
                    );
                    // A binary file is one fault, not thousands.
                    self.take_while(|c| !c.is_ascii_graphic());
                    self.take_while(|c| c == first);
                    if faults.full() {
                        return (Token::End, place);
                    }
                    continue;
                }
            };
            return (token, place);
        }
    }

    /// Over white space and comments.
    fn skip_blanks(&mut self, faults: &mut Faults) {
        loop {
            self.take_while(char::is_whitespace);
            if self.rest.starts_with("//") {
                self.take_while(|c| c != '\n');
            } else if self.rest.starts_with("/*") {
                let place = self.place;
                // The star that opens a comment cannot close it: `/*/` is open.
                let body = self.rest.get(2..).unwrap_or_default();
                match body.find("*/") {
                    Some(length) => self.take(length + 4),
                    None => {
                        faults.add(place, "this comment has no end: write `*/`");
                        self.take(self.rest.len())
                    }
                };
            } else {
                return;
            }
        }
    }

    /// A string constant: it ends on its own line and knows no escapes.
    fn text(&mut self, place: Place, faults: &mut Faults) -> Token<'a> {
        self.take(1);
        let text = self.take_while(|c| c != '"' && c != '\n' && c != '\r');
        if self.rest.starts_with('"') {
            self.take(1);
        } else {
            faults.add(place, "this string has no closing `\"` on its line");
        }
        Token::Text(text)
    }

    fn take_while(&mut self, belongs: impl Fn(char) -> bool) -> &'a str {
        let end = self.rest.find(|c| !belongs(c)).unwrap_or(self.rest.len());
        self.take(end)
    }

    /// Takes so many bytes (whole characters), and moves the place over them.
    fn take(&mut self, bytes: usize) -> &'a str {
        let (taken, rest) = self.rest.split_at_checked(bytes).unwrap_or((self.rest, ""));
        for c in taken.chars() {
            if c == '\n' {
                self.place.line += 1;
                self.place.column = 1;
            } else {
                self.place.column += 1;
            }
        }
        self.rest = rest;
        taken
    }
}

/// The value of a row of digits.
fn integer(digits: &str, place: Place, faults: &mut Faults) -> u16 {
    match digits.parse() {
        Ok(value) if value <= LARGEST => value,
        _ => {
            let shown = cut(digits);
            faults.add(
                place,
                format!("{shown} is more than 32767; for -32768 write ~32767"),
            );
            0
        }
    }
}
