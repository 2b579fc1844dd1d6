//! The rules of expressions.
//!
//! Every alternative is known by its first token (or, for a named argument, by
//! its first two), so that no text is read twice and time stays linear.

use super::super::tree::{AngleUnit, Argument, BinaryOp, Counter, Each, Expr, ExprKind, UnaryOp};
use super::block::block;
use super::{Raw, Rule, Tokens, contextual, name, sign, word};
use crate::source::Span;
use crate::token::Token;
use chumsky::pratt::{infix, left, postfix, prefix, right};
use chumsky::prelude::*;

/// An expression. Loosest first: `or`, `and`, `not`, comparisons, `+ -`,
/// `* / mod div`, unary `-`, `^`; then calls, fields and indexing.
pub fn expression<'t>() -> Rule<'t, Expr> {
    recursive(
        |expr: Recursive<dyn Parser<'t, Tokens<'t>, Expr, extra::Err<Raw<'t>>>>| {
            let expr: Rule<'t, Expr> = expr.boxed();
            operators(operand(expr.clone()), expr)
        },
    )
    .boxed()
}

/// The operators around operands.
fn operators<'t>(operand: Rule<'t, Expr>, expr: Rule<'t, Expr>) -> Rule<'t, Expr> {
    let method = sign(".")
        .ignore_then(name())
        .then(arguments(expr.clone()).or_not())
        .labelled("an operator");
    let index = comma(expr)
        .delimited_by(sign("["), sign("]"))
        .labelled("an operator");
    operand
        .pratt((
            postfix(9, method, |base, (name, args), e| {
                let base = Box::new(base);
                let kind = match args {
                    Some(args) => ExprKind::Method {
                        receiver: base,
                        name,
                        args,
                    },
                    None => ExprKind::Field { base, name },
                };
                Expr {
                    kind,
                    span: e.span(),
                }
            }),
            postfix(9, index, |base, indices, e| {
                let base = Box::new(base);
                Expr {
                    kind: ExprKind::Index { base, indices },
                    span: e.span(),
                }
            }),
            infix(right(8), power(), |a, op, b, e| binary(a, op, b, e.span())),
            prefix(7, minus(), |op, a, e| unary(op, a, e.span())),
            infix(left(6), product(), |a, op, b, e| binary(a, op, b, e.span())),
            infix(left(5), sum(), |a, op, b, e| binary(a, op, b, e.span())),
            infix(left(4), comparison(), |a, op, b, e| {
                binary(a, op, b, e.span())
            }),
            prefix(3, not(), |op, a, e| unary(op, a, e.span())),
            infix(left(2), and(), |a, op, b, e| binary(a, op, b, e.span())),
            infix(left(1), or(), |a, op, b, e| binary(a, op, b, e.span())),
        ))
        .boxed()
}

fn binary(a: Expr, op: BinaryOp, b: Expr, span: Span) -> Expr {
    let kind = ExprKind::Binary(op, Box::new(a), Box::new(b));
    Expr { kind, span }
}

fn unary(op: UnaryOp, a: Expr, span: Span) -> Expr {
    let kind = ExprKind::Unary(op, Box::new(a));
    Expr { kind, span }
}

fn power<'t>() -> Rule<'t, BinaryOp> {
    just(Token::Sym("^"))
        .to(BinaryOp::Pow)
        .labelled("an operator")
        .boxed()
}

fn product<'t>() -> Rule<'t, BinaryOp> {
    select! {
        Token::Sym("*") => BinaryOp::Mul,
        Token::Sym("/") => BinaryOp::Div,
        Token::Word("mod") => BinaryOp::Mod,
        Token::Word("div") => BinaryOp::IntDiv,
    }
    .labelled("an operator")
    .boxed()
}

fn sum<'t>() -> Rule<'t, BinaryOp> {
    select! {
        Token::Sym("+") => BinaryOp::Add,
        Token::Sym("-") => BinaryOp::Sub,
    }
    .labelled("an operator")
    .boxed()
}

fn comparison<'t>() -> Rule<'t, BinaryOp> {
    select! {
        Token::Sym("==") => BinaryOp::Eq,
        Token::Sym("!=") => BinaryOp::Ne,
        Token::Sym("<") => BinaryOp::Lt,
        Token::Sym("<=") => BinaryOp::Le,
        Token::Sym(">") => BinaryOp::Gt,
        Token::Sym(">=") => BinaryOp::Ge,
    }
    .labelled("an operator")
    .boxed()
}

fn and<'t>() -> Rule<'t, BinaryOp> {
    just(Token::Word("and"))
        .to(BinaryOp::And)
        .labelled("an operator")
        .boxed()
}

fn or<'t>() -> Rule<'t, BinaryOp> {
    just(Token::Word("or"))
        .to(BinaryOp::Or)
        .labelled("an operator")
        .boxed()
}

fn minus<'t>() -> Rule<'t, UnaryOp> {
    just(Token::Sym("-"))
        .to(UnaryOp::Neg)
        .labelled("an expression")
        .boxed()
}

fn not<'t>() -> Rule<'t, UnaryOp> {
    just(Token::Word("not"))
        .to(UnaryOp::Not)
        .labelled("an expression")
        .boxed()
}

/// One or more, with commas between.
pub fn comma<'t, T: 't>(rule: Rule<'t, T>) -> Rule<'t, Vec<T>> {
    rule.separated_by(sign(",")).at_least(1).collect().boxed()
}

/// `(a, b, far: c)`, perhaps empty.
fn arguments<'t>(expr: Rule<'t, Expr>) -> Rule<'t, Vec<Argument>> {
    name()
        .then_ignore(sign(":"))
        .or_not()
        .then(expr)
        .map(|(name, value)| Argument { name, value })
        .separated_by(sign(","))
        .collect()
        .delimited_by(sign("("), sign(")"))
        .labelled("an operator")
        .boxed()
}

/// What operators stand between.
fn operand<'t>(expr: Rule<'t, Expr>) -> Rule<'t, Expr> {
    let parenthesised = comma(expr.clone())
        .delimited_by(sign("("), sign(")"))
        .map_with(|mut parts, e| match parts.pop() {
            // `(a)` is just `a`, at its own place.
            Some(only) if parts.is_empty() => only,
            last => {
                parts.extend(last);
                Expr {
                    kind: ExprKind::Tuple(parts),
                    span: e.span(),
                }
            }
        });
    choice((
        named(expr.clone()),
        literal(),
        parenthesised.boxed(),
        table(expr.clone()),
        conditional(expr.clone()),
        repetition(expr.clone()),
        next(expr.clone()),
        block(expr),
    ))
    .labelled("an expression")
    .boxed()
}

/// `a`, `a(b)`, `a each k in 0 .. 9 { b }`
fn named<'t>(expr: Rule<'t, Expr>) -> Rule<'t, Expr> {
    let each = counter(expr.clone())
        .then(block(expr.clone()))
        .labelled("an operator")
        .boxed();
    name()
        .then(arguments(expr).or_not())
        .then(each.or_not())
        .map_with(|((name, args), each), e| {
            let kind = match (args, each) {
                (args, Some((counter, body))) => ExprKind::Each(Box::new(Each {
                    name,
                    args: args.unwrap_or_default(),
                    counter,
                    body,
                })),
                (Some(args), None) => ExprKind::Call { name, args },
                (None, None) => ExprKind::Name(name.text),
            };
            Expr {
                kind,
                span: e.span(),
            }
        })
        .boxed()
}

/// `each k in 0 .. 9`
pub fn counter<'t>(expr: Rule<'t, Expr>) -> Rule<'t, Counter> {
    word("each")
        .ignore_then(name())
        .then_ignore(word("in"))
        .then(expr.clone())
        .then_ignore(sign(".."))
        .then(expr)
        .map_with(|((name, low), high), e| Counter {
            name,
            low,
            high,
            span: e.span(),
        })
        .boxed()
}

fn literal<'t>() -> Rule<'t, Expr> {
    select! {
        Token::Int(text) => ExprKind::Int(number(text)),
        Token::Real(text) => ExprKind::Real(number(text)),
        Token::Angle(text) => angle(text),
        Token::Word("true") => ExprKind::Bool(true),
        Token::Word("false") => ExprKind::Bool(false),
        Token::Word("none") => ExprKind::None,
    }
    .map_with(|kind, e| Expr {
        kind,
        span: e.span(),
    })
    .boxed()
}

/// The lexer has reported what is too large; the tree stays finite.
fn number(text: &str) -> f64 {
    text.parse().unwrap_or(0.0f64).min(f64::MAX)
}

fn angle(text: &str) -> ExprKind {
    let units = [
        ("deg", AngleUnit::Deg),
        ("turn", AngleUnit::Turn),
        ("rad", AngleUnit::Rad),
    ];
    for (suffix, unit) in units {
        if let Some(digits) = text.strip_suffix(suffix) {
            return ExprKind::Angle(number(digits), unit);
        }
    }
    ExprKind::Error
}

/// `[a, b; c, d]`
fn table<'t>(expr: Rule<'t, Expr>) -> Rule<'t, Expr> {
    comma(expr)
        .separated_by(sign(";"))
        .at_least(1)
        .collect()
        .delimited_by(sign("["), sign("]"))
        .map_with(|rows, e| Expr {
            kind: ExprKind::Table(rows),
            span: e.span(),
        })
        .boxed()
}

/// `if c then a else b`, `if let n = c then a else b`
fn conditional<'t>(expr: Rule<'t, Expr>) -> Rule<'t, Expr> {
    let binding = word("let").ignore_then(name()).then_ignore(sign("="));
    word("if")
        .ignore_then(binding.or_not())
        .then(expr.clone())
        .then_ignore(word("then"))
        .then(expr.clone())
        .then_ignore(word("else"))
        .then(expr)
        .map_with(|(((binding, condition), yes), no), e| Expr {
            kind: ExprKind::If {
                binding,
                condition: Box::new(condition),
                yes: Box::new(yes),
                no: Box::new(no),
            },
            span: e.span(),
        })
        .boxed()
}

/// `loop (a = 1, b = 2) max 12 { .. } else e`
fn repetition<'t>(expr: Rule<'t, Expr>) -> Rule<'t, Expr> {
    let carried = name().then_ignore(sign("=")).then(expr.clone()).boxed();
    word("loop")
        .ignore_then(comma(carried).delimited_by(sign("("), sign(")")))
        .then_ignore(contextual("max"))
        .then(expr.clone())
        .then(block(expr.clone()))
        .then_ignore(word("else"))
        .then(expr)
        .map_with(|(((carried, max), body), otherwise), e| Expr {
            kind: ExprKind::Loop {
                carried,
                max: Box::new(max),
                body: Box::new(body),
                otherwise: Box::new(otherwise),
            },
            span: e.span(),
        })
        .boxed()
}

/// `next(a, b)`
fn next<'t>(expr: Rule<'t, Expr>) -> Rule<'t, Expr> {
    word("next")
        .ignore_then(comma(expr).delimited_by(sign("("), sign(")")))
        .map_with(|values, e| Expr {
            kind: ExprKind::Next(values),
            span: e.span(),
        })
        .boxed()
}
