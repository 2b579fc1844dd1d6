//! Text to tokens.
//!
//! Total: what cannot be read is reported, and replaced by what was meant
//! (`&&` by `and`, `.5` by a number) or by [`Token::Bad`], about which the
//! parser stays silent. Comments are kept beside the tokens for the formatter.

use super::token::Token;
use crate::source::{Diagnostic, Span};
use logos::Logos;

/// The longest text that is read, in bytes.
pub const MAX_BYTES: usize = 1 << 20;

/// After so many diagnostics the rest is not worth reading.
pub const MAX_DIAGNOSTICS: usize = 50;

const STRAY: &str = "cannot stand here";

/// What the lexer makes of a text.
#[derive(Clone, Debug, Default)]
pub struct Lexed<'a> {
    /// The tokens that the parser sees, in order.
    pub tokens: Vec<(Token<'a>, Span)>,
    /// The comments, `//` included, in order.
    pub comments: Vec<(&'a str, Span)>,
    /// What was wrong.
    pub diagnostics: Vec<Diagnostic>,
}

/// Bytes as they come from a file to text: what is not UTF-8 is reported at its
/// place and replaced by U+FFFD. Spans refer to the text answered. A mark of
/// byte order at the start is taken off.
pub fn decode(bytes: &[u8], file: u16) -> (String, Vec<Diagnostic>) {
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let mut text = String::with_capacity(bytes.len());
    let mut diagnostics = Vec::new();
    for chunk in bytes.utf8_chunks() {
        text.push_str(chunk.valid());
        if chunk.invalid().is_empty() {
            continue;
        }
        let start = text.len();
        text.push(char::REPLACEMENT_CHARACTER);
        // One report: a file in another encoding has one cause, not hundreds.
        if diagnostics.is_empty() {
            let at = Span::new(file, start, text.len());
            diagnostics.push(
                Diagnostic::error(at, "the file is not UTF-8 here")
                    .label(format!("byte {:#04x}", chunk.invalid()[0]))
                    .help("save the scene as UTF-8; outside comments it needs ASCII only"),
            );
        }
    }
    (text, diagnostics)
}

/// Cuts `text` into tokens.
pub fn lex(text: &str, file: u16) -> Lexed<'_> {
    let mut out = Lexed::default();
    if text.len() > MAX_BYTES {
        out.diagnostics.push(
            Diagnostic::error(
                Span::new(file, 0, 0),
                format!(
                    "the scene has {} bytes; at most {MAX_BYTES} are read",
                    text.len()
                ),
            )
            .help("split it with `use`"),
        );
        return out;
    }
    let mut lexer = Token::lexer(text);
    while let Some(token) = lexer.next() {
        let range = lexer.span();
        let span = Span::new(file, range.start, range.end);
        match token {
            Ok(Token::Comment(text)) => out.comments.push((text.trim_end(), span)),
            // `5.` is an int and a point that no field name follows.
            Ok(Token::Sym(".")) if out.ends_with_int(span) && !begins_name(lexer.remainder()) => {
                out.trailing_point(text, span);
            }
            Ok(token) => out.accept(token, span),
            Err(()) => out.stray(lexer.slice(), span),
        }
        if out.diagnostics.len() >= MAX_DIAGNOSTICS {
            break;
        }
    }
    out
}

fn begins_name(rest: &str) -> bool {
    rest.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
}

impl<'a> Lexed<'a> {
    /// Takes a token in, mending what can be mended.
    fn accept(&mut self, token: Token<'a>, span: Span) {
        match token {
            Token::Int(digits) | Token::Real(digits) => {
                if !digits.parse::<f64>().is_ok_and(f64::is_finite) {
                    self.report(span, "this number is too large for any format", None);
                }
                self.tokens.push((token, span));
            }
            Token::Colour(text) => {
                let digits = text.get(1..).unwrap_or("");
                let hexadecimal = digits.bytes().all(|b| b.is_ascii_hexdigit());
                if !matches!(digits.len(), 3 | 6) || !hexadecimal {
                    let help = "write `#` and six hexadecimal digits, or three: `#ff8000`, `#f80`";
                    self.report(span, format!("`{text}` is not a colour"), Some(help.into()));
                }
                self.tokens.push((token, span));
            }
            Token::LeadingPoint(text) => {
                let behind = self.tokens.last().is_some_and(|(token, last)| {
                    last.end == span.start
                        && matches!(token, Token::Ident(_) | Token::Sym(")" | "]"))
                });
                if behind {
                    let help = "the parts of a vector are `.x`, `.y` and `.z`";
                    self.report(span, "a part has a name, not a number", Some(help.into()));
                    return self.tokens.push((Token::Bad, span));
                }
                self.digits_around_point(span, format!("0{text}"));
                let digits = text.get(1..).unwrap_or("0");
                self.tokens
                    .push(match digits.ends_with(|c: char| c.is_ascii_digit()) {
                        true => (Token::Real(digits), span),
                        false => (Token::Angle(digits), span),
                    });
            }
            Token::NumberWord(text) => self.number_word(text, span),
            Token::OpenText(_) => {
                let help = "a string ends with `\"` on the line where it begins";
                self.report(span, "this string has no end", Some(help.into()));
                self.tokens.push((Token::Bad, span));
            }
            Token::BadChar(_) => {
                let help = "write one character between `'` and `'`, or a string between `\"`";
                self.report(
                    span,
                    "a character literal holds one character",
                    Some(help.into()),
                );
                self.tokens.push((Token::Char("'?'"), span));
            }
            Token::Foreign(text) => self.foreign(text, span),
            Token::Stray(text) => self.stray(text, span),
            _ => self.tokens.push((token, span)),
        }
    }

    fn report(&mut self, span: Span, message: impl Into<String>, help: Option<String>) {
        let mut diagnostic = Diagnostic::error(span, message);
        diagnostic.help = help;
        self.diagnostics.push(diagnostic);
    }

    fn digits_around_point(&mut self, span: Span, better: String) {
        let help = format!("write `{better}`");
        self.report(
            span,
            "a number has digits on both sides of its point",
            Some(help),
        );
    }

    /// Whether the last token is an int that ends where `span` starts.
    fn ends_with_int(&self, span: Span) -> bool {
        matches!(self.tokens.last(), Some((Token::Int(_), last)) if last.end == span.start)
    }

    fn trailing_point(&mut self, text: &'a str, point: Span) {
        if let Some((token, span)) = self.tokens.last_mut() {
            let whole = span.to(point);
            let digits = text.get(span.range()).unwrap_or("0");
            *span = whole;
            *token = Token::Real(digits);
            self.digits_around_point(whole, format!("{digits}.0"));
        }
    }

    fn number_word(&mut self, text: &'a str, span: Span) {
        let split = text
            .find(|c: char| c.is_ascii_alphabetic() || c == '_')
            .unwrap_or(text.len());
        let (number, word) = text.split_at(split);
        let height = word.strip_prefix('x').unwrap_or("-");
        let help = if height.bytes().all(|b| b.is_ascii_digit()) {
            let all = format!("{number} x {height}");
            format!("set them apart: `{}`", all.trim_end())
        } else if matches!(word, "degrees" | "d" | "turns" | "t" | "r" | "radians") {
            let unit = match word.as_bytes().first() {
                Some(b'd') => "deg",
                Some(b't') => "turn",
                _ => "rad",
            };
            format!("the units of an angle are `deg`, `turn` and `rad`: `{number}{unit}`")
        } else if word.starts_with(['e', 'E']) {
            "numbers have no exponent; write the digits, or a power: `2^10`".into()
        } else {
            "put a sign or a space between them; the units of an angle are `deg`, `turn` and `rad`"
                .into()
        };
        let message = format!("the number `{number}` runs into `{word}`");
        self.report(span, message, Some(help));
        self.tokens.push((Token::Bad, span));
    }

    fn foreign(&mut self, text: &'a str, span: Span) {
        let (token, instead) = match text {
            "&&" | "&" => (Token::Word("and"), "`and`"),
            "||" | "|" => (Token::Word("or"), "`or`"),
            "!" => (Token::Word("not"), "`not`"),
            "%" => (Token::Word("mod"), "`mod`"),
            "**" => (Token::Sym("^"), "`^`"),
            "<>" => (Token::Sym("!="), "`!=`"),
            "=<" => (Token::Sym("<="), "`<=`"),
            "===" => (Token::Sym("=="), "`==`"),
            "/*" | "*/" => {
                let help = "a comment runs from `//` to the end of its line";
                self.report(
                    span,
                    "there are no comments between `/*` and `*/`",
                    Some(help.into()),
                );
                return self.tokens.push((Token::Bad, span));
            }
            _ => {
                let help = "give the new value a name of its own: `let next_one = ...;`";
                self.report(
                    span,
                    format!("`{text}` would change a value; values never change"),
                    Some(help.into()),
                );
                return self.tokens.push((Token::Bad, span));
            }
        };
        let help = format!("write {instead}");
        self.report(
            span,
            format!("`{text}` is not a sign of this language"),
            Some(help),
        );
        self.tokens.push((token, span));
    }

    /// Characters that no token has.
    fn stray(&mut self, text: &'a str, span: Span) {
        let first = text.chars().next().unwrap_or('\0');
        let (token, help) = match first {
            '\u{d7}' => (Token::Ident("x"), "write the letter `x`"),
            '\u{2212}' | '\u{2013}' | '\u{2014}' => (Token::Sym("-"), "write `-`"),
            '\u{2264}' => (Token::Sym("<="), "write `<=`"),
            '\u{2265}' => (Token::Sym(">="), "write `>=`"),
            '\u{2260}' => (Token::Sym("!="), "write `!=`"),
            '\u{2192}' => (Token::Sym("->"), "write `->`"),
            '\u{b0}' => (Token::Bad, "write `deg` behind the number"),
            '\u{201c}' | '\u{201d}' | '\u{201e}' => (Token::Bad, "write the plain quote `\"`"),
            '\u{2018}' | '\u{2019}' => (Token::Bad, "write the plain quote `'`"),
            c if c.is_alphabetic() => (Token::Bad, "names are made of a-z, A-Z, 0-9 and `_`"),
            _ => (Token::Bad, "remove it"),
        };
        let shown: String = text.chars().take(12).flat_map(char::escape_debug).collect();
        // Neighbours are one mistake.
        match self.diagnostics.last_mut() {
            Some(last) if last.span.end == span.start && last.message.ends_with(STRAY) => {
                last.span.end = span.end;
            }
            _ => self.report(span, format!("`{shown}` {STRAY}"), Some(help.into())),
        }
        // One unreadable stretch is one token: the parser need not count them.
        match self.tokens.last() {
            Some((Token::Bad, _)) if token == Token::Bad => {}
            _ => self.tokens.push((token, span)),
        }
    }
}
