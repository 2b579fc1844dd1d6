//! Tokens to tree.
//!
//! The file is cut into items ([`super::cut`]) and each is parsed alone by the
//! rules of [`item`] and [`expression`]. What `chumsky` says of a wrong item is
//! put into the user's words by [`message`]. Inside an item the parser goes on
//! behind the next `;` of the same depth, so that one `let` costs one `let`.

mod between;
mod block;
mod expression;
mod guess;
mod item;
mod message;

use super::cut::{self, Spanned};
use super::lexer::{self, MAX_DIAGNOSTICS};
use super::token::Token;
use super::tree::{File, Item, Name};
use crate::source::{Diagnostic, Span};
use chumsky::input::MappedInput;
use chumsky::prelude::*;

/// What the rules read: the tokens of one item.
type Tokens<'t> = MappedInput<'t, Token<'t>, Span, &'t [Spanned<'t>]>;
/// What a rule says when it fails.
type Raw<'t> = Rich<'t, Token<'t>, Span>;
/// A rule of the grammar that makes a `T`.
type Rule<'t, T> = Boxed<'t, 't, Tokens<'t>, T, extra::Err<Raw<'t>>>;

/// Places are the compiler's own: a rule's span can go into the tree as it is.
impl chumsky::span::Span for Span {
    type Context = u16;
    type Offset = u32;

    fn new(file: u16, range: std::ops::Range<u32>) -> Self {
        Span {
            file,
            start: range.start,
            end: range.end.max(range.start),
            within: None,
            effect: None,
        }
    }
    fn context(&self) -> u16 {
        self.file
    }
    fn start(&self) -> u32 {
        self.start
    }
    fn end(&self) -> u32 {
        self.end
    }
}

/// Reads a scene. Total: it always answers a tree, whose unreadable parts are
/// left out or stand as `Error`, each with its diagnostic.
///
/// `file` is the number of the text in [`crate::source::Sources`].
pub fn parse(text: &str, file: u16) -> (File, Vec<Diagnostic>) {
    let lexed = lexer::lex(text, file);
    let mut diagnostics = lexed.diagnostics;
    let mut items = Vec::new();
    let rule = item::item();
    let mut between = false;
    // Items that were left open: what follows the next one may be their ends.
    let mut unclosed = 0usize;
    for tokens in cut::items(&lexed.tokens) {
        if diagnostics.len() >= MAX_DIAGNOSTICS {
            break;
        }
        if !matches!(tokens.first(), Some((Token::Item(_), _))) {
            // A stretch without items is one mistake.
            if !between && unclosed == 0 {
                diagnostics.extend(between::not_an_item(tokens));
            }
            between = true;
            unclosed = unclosed.saturating_sub(1);
            continue;
        }
        between = false;
        items.extend(one(&rule, text, tokens, &mut diagnostics));
        unclosed += usize::from(cut::unpaired(tokens).is_some());
    }
    let file = File { items };
    diagnostics.extend(super::check::check(&file));
    diagnostics.sort_by_key(|d| (d.span.start, d.span.end));
    diagnostics.truncate(MAX_DIAGNOSTICS);
    (file, diagnostics)
}

/// Reads one item.
fn one<'t>(
    rule: &Rule<'t, Item>,
    text: &str,
    tokens: &'t [Spanned<'t>],
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Item> {
    if let Some(deep) = cut::too_deep(tokens) {
        diagnostics.push(deep);
        return None;
    }
    let unpaired = cut::unpaired(tokens);
    let (_, last) = tokens.last()?;
    let end = Span {
        start: last.end,
        ..*last
    };
    let (item, errors) = rule
        .parse(tokens.split_token_span(end))
        .into_output_errors();
    match unpaired {
        // The brackets are the cause; what the rules say is the consequence.
        Some(unpaired) => diagnostics.push(unpaired),
        None => diagnostics.extend(message::translate(&errors, text, tokens)),
    }
    item
}

/// A sign, as a rule without a value.
fn sign<'t>(text: &'static str) -> Rule<'t, ()> {
    just(Token::Sym(text)).ignored().boxed()
}

/// A reserved word.
fn word<'t>(text: &'static str) -> Rule<'t, ()> {
    just(Token::Word(text)).ignored().boxed()
}

/// An identifier that is a word of the language in this one place.
fn contextual<'t>(text: &'static str) -> Rule<'t, ()> {
    just(Token::Ident(text)).ignored().boxed()
}

fn name<'t>() -> Rule<'t, Name> {
    select! { Token::Ident(text) => text }
        .map_with(|text, e| Name {
            text: text.to_string(),
            span: e.span(),
        })
        .labelled("a name")
        .boxed()
}

/// A `;`. Where it is missing but the statement is over, it is reported and
/// the statement kept.
fn semicolon<'t>() -> Rule<'t, ()> {
    let over = choice((
        end(),
        just(Token::Word("let")).ignored(),
        just(Token::Word("spread")).ignored(),
        just(Token::Word("each")).ignored(),
        just(Token::Sym("}")).ignored(),
    ))
    .rewind();
    sign(";").recover_with(via_parser(over)).boxed()
}

/// Skips at least one token: to behind the next `;` of this depth, or to the
/// closing bracket or the end of the item.
fn skip<'t>() -> Rule<'t, Span> {
    let nested = recursive(
        |nested: Recursive<dyn Parser<'t, Tokens<'t>, (), extra::Err<Raw<'t>>>>| {
            let inside = nested
                .or(any()
                    .filter(|t| !matches!(t, Token::Sym("(" | ")" | "[" | "]" | "{" | "}")))
                    .ignored())
                .repeated();
            choice((
                inside.clone().delimited_by(sign("("), sign(")")),
                inside.clone().delimited_by(sign("["), sign("]")),
                inside.delimited_by(sign("{"), sign("}")),
            ))
            .boxed()
        },
    );
    let plain = any()
        .filter(|t| !matches!(t, Token::Sym("(" | ")" | "[" | "]" | "{" | "}" | ";")))
        .ignored();
    let some = nested.or(plain).repeated().at_least(1);
    let something = some.then_ignore(sign(";").or_not()).or(sign(";"));
    something.map_with(|(), e| e.span()).boxed()
}
