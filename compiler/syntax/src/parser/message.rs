//! What the rules say of a wrong item, in the user's words: the place, at most
//! three expectations, and a way out where one can be guessed.

use super::Raw;
use crate::cut::Spanned;
use crate::source::{Diagnostic, Span};
use crate::token::Token;
use chumsky::error::RichPattern;

/// Where a rule failed.
pub struct Spot<'t> {
    text: &'t str,
    pub tokens: &'t [Spanned<'t>],
    /// Index of the token found; the length where the item ends instead.
    pub at: usize,
    /// What could have stood there: `` `;` ``, `an expression`.
    pub expected: Vec<String>,
}

/// The errors of one item, in the user's words.
///
/// At most one for each stretch between two `;`: behind an error the rules skip
/// to the next one, and what they say before it is a consequence.
pub fn translate<'t>(
    errors: &[Raw<'t>],
    text: &'t str,
    tokens: &'t [Spanned<'t>],
) -> Vec<Diagnostic> {
    let mut said = Vec::new();
    let mut last: Option<usize> = None;
    for error in errors {
        let at = tokens.partition_point(|(_, span)| span.start < error.span().start);
        let apart = last.is_none_or(|last| {
            let between = tokens.get(last..at).unwrap_or(&[]);
            between.iter().any(|(token, _)| *token == Token::Sym(";"))
        });
        if !apart {
            continue;
        }
        last = Some(at);
        let spot = Spot {
            text,
            tokens,
            at,
            expected: expectations(error),
        };
        // What the lexer could not read, it has reported.
        if spot.found() != Some(Token::Bad) && spot.before() != Some(Token::Bad) {
            said.push(spot.say());
        }
    }
    said
}

/// What could have stood there, the likeliest first.
fn expectations(error: &Raw) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    for pattern in error.expected() {
        let words = match pattern {
            RichPattern::Token(token) => format!("`{}`", token.parts().1),
            RichPattern::Label(label) => label.to_string(),
            RichPattern::Identifier(word) => format!("`{word}`"),
            RichPattern::EndOfInput => "the end of the item".into(),
            _ => continue,
        };
        if !all.contains(&words) {
            all.push(words);
        }
    }
    // An argument's name, a type's `?`: true, and of no help beside the rest.
    if all.iter().any(|words| words == "an expression") {
        all.retain(|words| words != "a name");
    }
    if all.len() > 1 {
        all.retain(|words| words != "`?`");
    }
    all.sort_by_key(|words| match words.as_str() {
        "an operator" => 3,
        "`,`" => 2,
        "the end of the item" => 4,
        words => usize::from(!words.starts_with('`')),
    });
    all
}

impl<'t> Spot<'t> {
    fn token(&self, at: Option<usize>) -> Option<Token<'t>> {
        self.tokens.get(at?).map(|t| t.0)
    }
    pub fn found(&self) -> Option<Token<'t>> {
        self.token(Some(self.at))
    }
    /// The token `back` places before the one found.
    pub fn behind(&self, back: usize) -> Option<Token<'t>> {
        self.token(self.at.checked_sub(back))
    }
    /// The token behind the one found.
    pub fn ahead(&self) -> Option<Token<'t>> {
        self.token(Some(self.at + 1))
    }
    pub fn before(&self) -> Option<Token<'t>> {
        self.behind(1)
    }
    pub fn expects(&self, words: &str) -> bool {
        self.expected.iter().any(|e| e == words)
    }

    /// The token found, or the end of the item.
    pub fn place(&self) -> Span {
        match self.tokens.get(self.at) {
            Some((_, span)) => *span,
            None => self.gap(),
        }
    }

    /// Directly behind the token before.
    pub fn gap(&self) -> Span {
        let before = self.at.checked_sub(1).and_then(|at| self.tokens.get(at));
        before.map_or(Span::default(), |(_, span)| Span {
            start: span.end,
            ..*span
        })
    }

    /// Whether the token found begins a line.
    pub fn on_new_line(&self) -> bool {
        let between = self.gap().end as usize..self.place().start as usize;
        self.text.get(between).is_some_and(|t| t.contains('\n'))
    }

    /// The word that the item begins with.
    pub fn item(&self) -> &'t str {
        match self.tokens.first() {
            Some((Token::Item(word), _)) => word,
            _ => "",
        }
    }

    fn say(&self) -> Diagnostic {
        let said = self.missing().or_else(|| self.mistaken());
        said.unwrap_or_else(|| self.plain())
    }

    /// `expected a, b or c, found d`.
    fn plain(&self) -> Diagnostic {
        let found = match self.found() {
            Some(token) => token.to_string(),
            None => "the end of the item".into(),
        };
        let shown: Vec<&str> = self.expected.iter().take(3).map(String::as_str).collect();
        let message = match shown.as_slice() {
            [] => format!("{found} cannot stand here"),
            [one] => format!("expected {one}, found {found}"),
            [first @ .., last] => format!("expected {} or {last}, found {found}", first.join(", ")),
        };
        let mut diagnostic = Diagnostic::error(self.place(), message);
        diagnostic.help = self.way_out();
        diagnostic
    }
}
