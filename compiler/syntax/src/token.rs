//! The words of the language, as `logos` cuts them out of the text.
//!
//! Reserved words are those that begin something (`fn`, `let`, `if`) or would
//! make an expression ambiguous (`and`, `mod`). Words that matter in one place
//! only (`x` and `inks` of an image, `max` of a loop, `to` of a spread, `frame`,
//! `row`, `column` before `let`) are ordinary identifiers everywhere else, so
//! `max(a, b)` can be a function and `x` a coordinate.
//!
//! A colour is `#` and what follows it, wherever it stands: no other token
//! begins with `#` outside quotes, so the lexer needs no memory of `inks`.

use logos::Logos;
use std::fmt;

/// Reserved words that begin an item.
pub const ITEMS: [&str; 13] = [
    "image", "param", "state", "const", "fn", "effect", "shape", "scene", "record", "map",
    "dither", "draw", "use",
];

/// The other reserved words.
pub const WORDS: [&str; 19] = [
    "if", "let", "then", "else", "loop", "next", "spread", "each", "and", "or", "not", "div",
    "mod", "true", "false", "none", "is", "in", "where",
];

/// Words that mean something in one place only, and are names elsewhere.
pub const PLACED: [&str; 6] = ["inks", "max", "to", "frame", "row", "column"];

/// Whether a text is one name, and no reserved word.
pub fn is_name(text: &str) -> bool {
    let mut tokens = Token::lexer(text);
    matches!(tokens.next(), Some(Ok(Token::Ident(name))) if name.len() == text.len())
}

/// A token; text is borrowed from the source.
#[derive(Logos, Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[logos(skip r"[ \t\r\n\f]+")]
pub enum Token<'a> {
    /// A name: `eye`, `vec3`, `max`.
    #[regex("[A-Za-z_][A-Za-z0-9_]*")]
    Ident(&'a str),
    /// A reserved word that begins an item.
    #[regex(
        "image|param|state|const|fn|effect|shape|scene|record|map|dither|draw|use",
        priority = 60
    )]
    Item(&'a str),
    /// Any other reserved word.
    #[regex(
        "if|let|then|else|loop|next|spread|each|and|or|not|div|mod|true|false|none|is|in|where",
        priority = 60
    )]
    Word(&'a str),
    /// Punctuation and operators.
    #[regex(r"[(){}\[\],;:.?<>=+*/^-]|\.\.|->|=>|==|!=|<=|>=")]
    Sym(&'a str),
    /// `12`
    #[regex("[0-9]+", priority = 8)]
    Int(&'a str),
    /// `0.5`
    #[regex(r"[0-9]+\.[0-9]+", priority = 8)]
    Real(&'a str),
    /// `90deg`, `0.25turn`, `1.57rad`
    #[regex(r"[0-9]+(\.[0-9]+)?(deg|turn|rad)", priority = 9)]
    Angle(&'a str),
    /// `#ff8000`; that there are six hexadecimal digits is checked after.
    #[regex("#[0-9A-Za-z_]*")]
    Colour(&'a str),
    /// A string with its quotes; there are no escapes.
    #[regex("\"[^\"\n]*\"", priority = 9)]
    Text(&'a str),
    /// A character with its quotes: `'#'`.
    #[regex("'[^\n\r]'", priority = 9)]
    Char(&'a str),
    /// `//` to the end of the line.
    #[regex("//[^\n]*", allow_greedy = true)]
    Comment(&'a str),

    // What follows never reaches the parser as it is: the lexer reports it and
    // puts the token in its place that was meant, where that can be known.
    /// `.5`
    #[regex(r"\.[0-9]+(deg|turn|rad)?")]
    LeadingPoint(&'a str),
    /// A number with letters behind it: `320x240`, `1e5`, `3px`.
    #[regex(r"[0-9]+(\.[0-9]+)?[A-Za-z_][A-Za-z0-9_]*", priority = 7)]
    NumberWord(&'a str),
    /// A string without its end.
    #[regex("\"[^\"\n]*", priority = 7)]
    OpenText(&'a str),
    /// A quoted something that is not one character.
    #[regex("'[^'\n]*'?", priority = 7)]
    BadChar(&'a str),
    /// An operator of other languages.
    #[regex(r"&&?|\|\|?|!|%|\*\*|<>|=<|===|[-+*/]=|/\*|\*/")]
    Foreign(&'a str),
    /// Characters that no token has.
    #[regex(r"[^\x00-\x7F]+")]
    Stray(&'a str),
    /// A place that could not be read; the parser stays silent about it.
    Bad,
}

impl Token<'_> {
    /// Whether it compares: `==` `!=` `<` `<=` `>` `>=`.
    pub fn is_comparison(self) -> bool {
        matches!(self, Token::Sym("==" | "!=" | "<" | "<=" | ">" | ">="))
    }

    /// What it is and how it is written, for `--emit tokens`.
    pub fn parts(&self) -> (&'static str, &str) {
        match self {
            Token::Ident(s) => ("name", s),
            Token::Item(s) => ("item", s),
            Token::Word(s) => ("word", s),
            Token::Sym(s) => ("sign", s),
            Token::Int(s) => ("int", s),
            Token::Real(s) => ("real", s),
            Token::Angle(s) => ("angle", s),
            Token::Colour(s) => ("colour", s),
            Token::Text(s) => ("string", s),
            Token::Char(s) => ("char", s),
            Token::Comment(s) => ("comment", s),
            Token::LeadingPoint(s)
            | Token::NumberWord(s)
            | Token::OpenText(s)
            | Token::BadChar(s)
            | Token::Foreign(s)
            | Token::Stray(s) => ("unread", s),
            Token::Bad => ("unread", ""),
        }
    }
}

/// As a message names it: ``the name `eye` ``, `` `then` ``.
impl fmt::Display for Token<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (_, text) = self.parts();
        match self {
            Token::Ident(_) => write!(f, "the name `{text}`"),
            Token::Int(_) | Token::Real(_) => write!(f, "the number `{text}`"),
            Token::Angle(_) => write!(f, "the angle `{text}`"),
            Token::Colour(_) => write!(f, "the colour `{text}`"),
            Token::Text(_) => write!(f, "the string `{text}`"),
            Token::Char(_) => write!(f, "the character `{text}`"),
            Token::Item(_) | Token::Word(_) => write!(f, "the word `{text}`"),
            Token::Bad => write!(f, "something unreadable"),
            _ => write!(f, "`{text}`"),
        }
    }
}
