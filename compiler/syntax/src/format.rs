//! The formatter of `slowlight fmt`.
//!
//! Line breaks are the author's, but that an item begins a line; what stands on a line and how
//! far in is not.
//! Tokens and comments are laid out again in their order, so nothing can be
//! lost: one space around operators, none inside parentheses, two columns for
//! each line that holds something open, two more where a statement goes on.
//! Comments behind code, and the `is` of a scene's members, line up with those
//! of the lines above and below.

use super::cut::{self, Spanned};
use super::lexer::{self, Lexed};
use super::parser::parse;
use super::token::Token;
use crate::source::Diagnostic;
use std::collections::HashSet;

/// Columns of one step inwards.
const STEP: usize = 2;

/// The text of a scene as it should look, or what keeps it from being read.
///
/// Formatting twice is formatting once; tokens, comments and the tree stay.
pub fn format(text: &str, file: u16) -> Result<String, Vec<Diagnostic>> {
    let (_, diagnostics) = parse(text, file);
    if diagnostics.iter().any(Diagnostic::is_error) {
        return Err(diagnostics);
    }
    let lexed = lexer::lex(text, file);
    let mut layout = Layout::new(&lexed.tokens);
    for (piece, breaks) in pieces(text, &lexed) {
        layout.newlines(breaks);
        match piece {
            Piece::Comment(words) => layout.comment(words),
            Piece::Token(at) => layout.token(at),
        }
    }
    layout.newlines(1);
    let mut lines = layout.lines;
    align(&mut lines, |line| line.member);
    align(&mut lines, |line| line.comment);
    Ok(lines.into_iter().map(Line::finish).collect())
}

/// A token, by its index, or a comment.
enum Piece<'a> {
    Token(usize),
    Comment(&'a str),
}

/// Tokens and comments in their order, each with the number of line breaks in
/// front of it.
fn pieces<'a>(text: &str, lexed: &Lexed<'a>) -> Vec<(Piece<'a>, usize)> {
    let tokens = lexed.tokens.iter().enumerate();
    let mut all: Vec<_> = tokens
        .map(|(at, (_, span))| (*span, Piece::Token(at)))
        .chain(
            lexed
                .comments
                .iter()
                .map(|(words, span)| (*span, Piece::Comment(words))),
        )
        .collect();
    all.sort_by_key(|(span, _)| span.start);
    let mut end = 0;
    let spaced = all.into_iter().map(|(span, piece)| {
        let between = text.get(end..span.start as usize).unwrap_or("");
        end = span.end as usize;
        (piece, between.matches('\n').count())
    });
    spaced.collect()
}

/// A line of the result.
#[derive(Default)]
struct Line {
    text: String,
    /// Where in `text` the `is` of a scene's member stands.
    member: Option<usize>,
    /// Where in `text` a comment behind code stands.
    comment: Option<usize>,
}

impl Line {
    fn finish(self) -> String {
        self.text + "\n"
    }
}

/// Brings what `mark` finds in neighbouring lines to the same column.
fn align(lines: &mut [Line], mark: impl Fn(&Line) -> Option<usize>) {
    let column = |line: &Line| {
        mark(line)
            .and_then(|at| line.text.get(..at))
            .map(|t| t.chars().count())
    };
    for block in lines.chunk_by_mut(|a, b| column(a).is_some() && column(b).is_some()) {
        let widest = block.iter().filter_map(column).max().unwrap_or(0);
        for line in block {
            if let (Some(at), Some(wide)) = (mark(line), column(line)) {
                let missing = widest - wide;
                line.text.insert_str(at, &" ".repeat(missing));
                for later in [&mut line.member, &mut line.comment] {
                    *later = later.map(|l| if l >= at { l + missing } else { l });
                }
            }
        }
    }
}

/// An open bracket.
struct Open {
    /// The indent of its line.
    indent: usize,
    /// Whether what it closes is whole, as a scene's `each` is.
    is_whole: bool,
    /// How many lines are above its own.
    above: usize,
}

/// The result while it is being laid out.
struct Layout<'t, 'a> {
    tokens: &'t [Spanned<'a>],
    /// Indices of the tokens that begin items.
    begins: HashSet<usize>,
    open: Vec<Open>,
    /// At how many open brackets an `each` of a scene stands whose brace is to come.
    each: Option<usize>,
    /// Indices of the tokens that end such.
    ends: HashSet<usize>,
    /// Whether the next piece begins a line.
    fresh: bool,
    /// Whether the next token begins a statement, an argument, an item.
    starts: bool,
    indent: usize,
    line: Line,
    lines: Vec<Line>,
}

impl<'t, 'a> Layout<'t, 'a> {
    fn new(tokens: &'t [Spanned<'a>]) -> Self {
        let begins = cut::items(tokens).into_iter().scan(0, |at, item| {
            let begin = *at;
            *at += item.len();
            Some(begin)
        });
        Layout {
            tokens,
            begins: begins.collect(),
            open: Vec::new(),
            each: None,
            ends: HashSet::new(),
            fresh: true,
            starts: true,
            indent: 0,
            line: Line::default(),
            lines: Vec::new(),
        }
    }

    /// Ends the line where the author did; of several empty lines one stays.
    fn newlines(&mut self, breaks: usize) {
        if breaks > 0 && !self.line.text.is_empty() {
            self.lines.push(std::mem::take(&mut self.line));
            self.fresh = true;
        }
        if breaks > 1 && self.lines.last().is_some_and(|line| !line.text.is_empty()) {
            self.lines.push(Line::default());
        }
    }

    fn comment(&mut self, words: &str) {
        if self.fresh {
            self.begin_line(self.inside());
            self.line.text += words;
        } else {
            self.line.text += "  ";
            self.line.comment = Some(self.line.text.len());
            self.line.text += words;
        }
    }

    /// The indent of what stands here: inside what is open, and one step more
    /// where something goes on.
    fn inside(&self) -> usize {
        let base = self.open.last().map_or(0, |open| open.indent + STEP);
        if self.starts { base } else { base + STEP }
    }

    fn begin_line(&mut self, indent: usize) {
        self.indent = indent;
        self.line.text = " ".repeat(indent);
        self.fresh = false;
    }

    fn token(&mut self, at: usize) {
        let Some((token, _)) = self.tokens.get(at).copied() else {
            return;
        };
        if self.begins.contains(&at) {
            self.starts = true;
            // No two items share a line; what else breaks lines is the author's.
            self.newlines(1);
        }
        let closes = matches!(token, Token::Sym(")" | "]" | "}"));
        if self.fresh {
            let row = matches!(token, Token::Text(_)) && !self.open.is_empty();
            self.starts = self.starts || row;
            let indent = match self.open.last() {
                Some(open) if closes => open.indent,
                _ => self.inside(),
            };
            self.begin_line(indent);
        } else if self.spaced(at) {
            self.line.text.push(' ');
        }
        // A whole `each` on one line stands by itself.
        let is_within =
            (self.open.last()).is_some_and(|open| open.is_whole && open.above == self.lines.len());
        if token == Token::Word("is") && !is_within {
            self.line.member = Some(self.line.text.len());
        }
        self.line.text += token.parts().1;
        let behind = at.checked_sub(1);
        let mut ended = false;
        match token {
            Token::Word("each") if self.is_member(behind) => self.each = Some(self.open.len()),
            Token::Sym("(" | "[" | "{") => {
                // No block begins behind an operand.
                let each = self.each.filter(|_| token == Token::Sym("{"));
                let is_whole = each == Some(self.open.len()) && self.ends_operand(behind);
                if is_whole {
                    self.each = None;
                }
                self.open.push(Open {
                    indent: self.indent,
                    is_whole,
                    above: self.lines.len(),
                });
            }
            _ if closes => ended = self.open.pop().is_some_and(|open| open.is_whole),
            _ => {}
        }
        if ended {
            self.ends.insert(at);
        }
        // At the top only another item starts anew.
        let top = self.open.is_empty();
        self.starts = match token {
            Token::Sym("(" | "[" | "{") => true,
            _ if ended => true,
            Token::Sym("," | ";") if !top => true,
            _ => top && (self.begins.contains(&(at + 1)) || at + 1 == self.tokens.len()),
        };
    }

    /// Whether what stands behind the token at `at` is a member of a scene.
    fn is_member(&self, at: Option<usize>) -> bool {
        matches!(self.at(at), Some(Token::Sym("{" | "}" | ";")))
    }

    fn at(&self, at: Option<usize>) -> Option<Token<'a>> {
        self.tokens.get(at?).map(|t| t.0)
    }

    /// Whether an operand ends with the token at `at`. A name behind an operand
    /// is a word of the language (`x`, `inks`, `max`, `to`): none ends there.
    fn ends_operand(&self, at: Option<usize>) -> bool {
        let before = at.and_then(|at| at.checked_sub(1));
        let is_end = |at: Option<usize>| at.is_some_and(|at| self.ends.contains(&at));
        match self.at(at) {
            Some(Token::Sym("}")) if is_end(at) => false,
            Some(Token::Ident(_)) if is_end(before) => true,
            Some(Token::Ident(_)) => !matches!(
                self.at(before),
                Some(
                    Token::Ident(_)
                        | Token::Int(_)
                        | Token::Real(_)
                        | Token::Angle(_)
                        | Token::Sym(")" | "]" | "}")
                )
            ),
            Some(Token::Int(_) | Token::Real(_) | Token::Angle(_)) => true,
            Some(Token::Sym(sign)) => matches!(sign, ")" | "]" | "}"),
            Some(Token::Word(word)) => matches!(word, "true" | "false" | "none"),
            _ => false,
        }
    }

    /// Whether a space stands between the token at `at` and the one before.
    fn spaced(&self, at: usize) -> bool {
        let behind = at.checked_sub(1);
        let (Some(before), Some(token)) = (self.at(behind), self.at(Some(at))) else {
            return false;
        };
        match (before, token) {
            (Token::Sym("{"), Token::Sym("}")) => false,
            (_, Token::Sym(")" | "]" | "," | ";" | ":" | "." | "?" | "^")) => false,
            (Token::Sym("(" | "[" | "." | "^"), _) => false,
            (Token::Sym("-"), _) if self.is_sign(behind) => false,
            (_, Token::Sym("/")) => !self.is_ratio(at),
            (Token::Sym("/"), _) => !behind.is_some_and(|slash| self.is_ratio(slash)),
            (Token::Word("next") | Token::Item("fn"), Token::Sym("(")) => false,
            (_, Token::Sym("(" | "[")) => !self.ends_operand(behind),
            _ => true,
        }
    }

    /// Whether the `/` at `slash` makes a ratio of two ints that reads as one
    /// value: nothing in front or behind takes hold of one of them alone.
    fn is_ratio(&self, slash: usize) -> bool {
        let back = |by: usize| self.at(slash.checked_sub(by));
        let ints = (back(1), self.at(Some(slash + 1)));
        let holds = |token: Option<Token>| {
            let signs = matches!(token, Some(Token::Sym("*" | "/" | "^")));
            signs || matches!(token, Some(Token::Word("div" | "mod")))
        };
        let before = match back(2) {
            Some(Token::Sym("-")) => holds(back(3)),
            token => holds(token),
        };
        matches!(ints, (Some(Token::Int(_)), Some(Token::Int(_))))
            && !before
            && self.at(Some(slash + 2)) != Some(Token::Sym("^"))
    }

    /// Whether the `-` at `at` is a sign rather than an operator.
    fn is_sign(&self, at: Option<usize>) -> bool {
        !self.ends_operand(at.and_then(|at| at.checked_sub(1)))
    }
}
