//! The rules of blocks and their statements, and of what goes on behind a
//! mistake: these are where one statement's loss is kept from the others.

use super::expression::comma;
use super::{Rule, contextual, name, semicolon, sign, skip, word};
use crate::source::Span;
use crate::token::Token;
use crate::tree::{Claim, Expr, ExprKind, Statement};
use chumsky::prelude::*;

/// `{ let a = b; c }`
pub fn block<'t>(expr: Rule<'t, Expr>) -> Rule<'t, Expr> {
    // Whatever stands there, a block reaches its brace: were it to fail, what
    // was reported inside it would be forgotten.
    let rest = skip().repeated().map_with(|(), e| error(e.span()));
    let result = expr
        .clone()
        .then_ignore(just(Token::Sym("}")).rewind())
        .recover_with(via_parser(rest));
    // A statement that cannot be read ends at its `;`.
    let broken = begins_statement().ignore_then(skip()).to(None);
    statement(expr)
        .map(Some)
        .recover_with(via_parser(broken))
        .repeated()
        .collect::<Vec<_>>()
        .map(|read| read.into_iter().flatten().collect())
        .then(result)
        .delimited_by(sign("{"), sign("}"))
        .map_with(|(statements, result), e| Expr {
            kind: ExprKind::Block {
                statements,
                result: Box::new(result),
            },
            span: e.span(),
        })
        .boxed()
}

/// Whether what stands here was meant as a statement; reads nothing.
fn begins_statement<'t>() -> Rule<'t, ()> {
    let ident = select! { Token::Ident(_) => () };
    let let_ = just(Token::Word("let")).ignored();
    let names = ident
        .then(ident.or_not())
        .ignore_then(just(Token::Sym("=")).ignored());
    choice((
        let_,
        just(Token::Word("spread")).ignored(),
        ident.ignore_then(let_),
        names,
    ))
    .rewind()
    .boxed()
}

/// `= expr ;`; where it cannot be read, what it belongs to stays.
pub fn body<'t>(expr: Rule<'t, Expr>) -> Rule<'t, Expr> {
    sign("=")
        .ignore_then(expr)
        .then_ignore(semicolon())
        .recover_with(via_parser(skip().map(error)))
        .boxed()
}

/// What stands in the tree for what could not be read.
pub fn error(span: Span) -> Expr {
    Expr {
        kind: ExprKind::Error,
        span,
    }
}

fn statement<'t>(expr: Rule<'t, Expr>) -> Rule<'t, Statement> {
    let binding = claim()
        .or_not()
        .then_ignore(word("let").labelled("`let`"))
        .then(name())
        .then(body(expr.clone()))
        .map(|((claim, name), value)| Statement::Let { claim, name, value });

    let shares = expr
        .clone()
        .then_ignore(sign(":"))
        .then(expr.clone())
        .boxed();
    let to = contextual("to")
        .ignore_then(comma(shares).delimited_by(sign("{"), sign("}")))
        .then_ignore(semicolon());
    let spread = word("spread")
        .ignore_then(expr)
        .then(to)
        .map_with(|(value, to), e| Statement::Spread {
            value,
            to,
            span: e.span(),
        });
    choice((binding.boxed(), spread.boxed())).boxed()
}

/// `frame`, `row` or `column`, where `let` follows; they are names elsewhere.
fn claim<'t>() -> Rule<'t, (Claim, Span)> {
    select! {
        Token::Ident("frame") => Claim::Frame,
        Token::Ident("row") => Claim::Row,
        Token::Ident("column") => Claim::Column,
    }
    .map_with(|claim, e| (claim, e.span()))
    .then_ignore(just(Token::Word("let")).rewind())
    .boxed()
}
