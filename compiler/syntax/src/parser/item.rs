//! The rules of items.

use super::super::tree::{
    Binding, Expr, Facet, Function, Image, InkColour, Item, ItemKind, Member, Name, Param, Type,
    TypeKind,
};
use super::block::{body, error};
use super::expression::{comma, counter, expression};
use super::{Raw, Rule, Tokens, contextual, name, semicolon, sign, skip, word};
use crate::source::Span;
use crate::token::Token;
use chumsky::prelude::*;

/// Any item, from its word to its end.
pub fn item<'t>() -> Rule<'t, Item> {
    let expr = expression();
    choice((
        image(expr.clone()),
        param(expr.clone()),
        state(expr.clone()),
        constant(expr.clone()),
        function(expr.clone()),
        effect(expr.clone()),
        shape(expr.clone()),
        scene(expr.clone()),
        record(),
        map(expr.clone()),
        dither(expr.clone()),
        draw(expr),
        include(),
    ))
    .map_with(|kind, e| Item {
        kind,
        span: e.span(),
    })
    .then_ignore(end())
    .boxed()
}

fn begins<'t>(text: &'static str) -> Rule<'t, ()> {
    just(Token::Item(text)).ignored().boxed()
}

/// `image 320 x 240 inks black, #ff0000;`
fn image<'t>(expr: Rule<'t, Expr>) -> Rule<'t, ItemKind> {
    let ink = select! {
        Token::Ident(text) => text,
        Token::Colour(text) => text,
    }
    .map_with(|text, e| InkColour {
        text: text.to_string(),
        span: e.span(),
    })
    .labelled("a colour")
    .boxed();
    begins("image")
        .ignore_then(expr.clone())
        .then_ignore(contextual("x"))
        .then(expr)
        .then_ignore(contextual("inks"))
        .then(comma(ink))
        .then_ignore(semicolon())
        .map(|((width, height), inks)| {
            ItemKind::Image(Image {
                width,
                height,
                inks,
            })
        })
        .boxed()
}

/// `param eye: vec3 = (0, 0, 3) in (..) .. (..);`
fn param<'t>(expr: Rule<'t, Expr>) -> Rule<'t, ItemKind> {
    let value = expr
        .clone()
        .then(range(expr).or_not())
        .then_ignore(semicolon())
        .recover_with(via_parser(skip().map(|span| (error(span), None))));
    declared("param")
        .then(value)
        .map(|((name, ty), (value, range))| {
            ItemKind::Param(Param {
                name,
                ty,
                value,
                range,
                next: None,
            })
        })
        .boxed()
}

/// `state eye: vec3 = (0, 0, 3) in (..) .. (..) -> eye + (0, 0, 1);`
fn state<'t>(expr: Rule<'t, Expr>) -> Rule<'t, ItemKind> {
    let value = expr
        .clone()
        .then(range(expr.clone()).or_not())
        .then_ignore(sign("->"))
        .then(expr)
        .then_ignore(semicolon())
        .recover_with(via_parser(
            skip().map(|span| ((error(span), None), error(span))),
        ));
    declared("state")
        .then(value)
        .map(|((name, ty), ((value, range), next))| {
            ItemKind::Param(Param {
                name,
                ty,
                value,
                range,
                next: Some(Box::new(next)),
            })
        })
        .boxed()
}

/// `param eye: vec3 =`
fn declared<'t>(word: &'static str) -> Rule<'t, (Name, Type)> {
    begins(word)
        .ignore_then(name())
        .then_ignore(sign(":"))
        .then(ty())
        .then_ignore(sign("="))
        .boxed()
}

/// `in (..) .. (..)`
fn range<'t>(expr: Rule<'t, Expr>) -> Rule<'t, (Expr, Expr)> {
    word("in")
        .ignore_then(expr.clone())
        .then_ignore(sign(".."))
        .then(expr)
        .boxed()
}

/// `const bayer4 = [0, 24; 36, 12];`
fn constant<'t>(expr: Rule<'t, Expr>) -> Rule<'t, ItemKind> {
    begins("const")
        .ignore_then(name())
        .then(body(expr))
        .map(|(name, value)| ItemKind::Const { name, value })
        .boxed()
}

/// What functions, effects and dithers begin with.
type Head = ((Name, Vec<Binding>), Type);

/// `name(a: T, ...) -> T`
fn head<'t>(expr: Rule<'t, Expr>) -> Rule<'t, Head> {
    name()
        .then(bindings(expr))
        .then_ignore(sign("->"))
        .then(ty())
        .boxed()
}

fn whole((((name, params), result), body): (Head, Expr)) -> Function {
    Function {
        name,
        params,
        result,
        body,
    }
}

/// `fn name(..) -> T = expr;`
fn function<'t>(expr: Rule<'t, Expr>) -> Rule<'t, ItemKind> {
    begins("fn")
        .ignore_then(head(expr.clone()))
        .then(body(expr))
        .map(|parts| ItemKind::Fn(whole(parts)))
        .boxed()
}

/// `dither name(v: real, x: int, y: int) -> ink = expr;`
fn dither<'t>(expr: Rule<'t, Expr>) -> Rule<'t, ItemKind> {
    begins("dither")
        .ignore_then(head(expr.clone()))
        .then(body(expr))
        .map(|parts| ItemKind::Dither(whole(parts)))
        .boxed()
}

/// `effect name(..) -> T else expr = expr;`
fn effect<'t>(expr: Rule<'t, Expr>) -> Rule<'t, ItemKind> {
    begins("effect")
        .ignore_then(head(expr.clone()))
        .then_ignore(word("else"))
        .then(expr.clone())
        .then(body(expr))
        .map(|((head, otherwise), body)| ItemKind::Effect {
            function: whole((head, body)),
            otherwise,
        })
        .boxed()
}

/// `shape name(..) { f(p) = expr; bound = expr; }`
fn shape<'t>(expr: Rule<'t, Expr>) -> Rule<'t, ItemKind> {
    let facet = name()
        .then(name().delimited_by(sign("("), sign(")")).or_not())
        .then(body(expr.clone()))
        .map(|((name, argument), body)| Facet {
            name,
            argument,
            body,
        });
    begins("shape")
        .ignore_then(name())
        .then(bindings(expr))
        .then(
            facet
                .repeated()
                .collect()
                .delimited_by(sign("{"), sign("}")),
        )
        .map(|((name, params), facets)| ItemKind::Shape {
            name,
            params,
            facets,
        })
        .boxed()
}

/// `scene name { shape is tag; .. }`
fn scene<'t>(expr: Rule<'t, Expr>) -> Rule<'t, ItemKind> {
    begins("scene")
        .ignore_then(name())
        .then(members(expr))
        .map(|(name, members)| ItemKind::Scene { name, members })
        .boxed()
}

/// `{ shape is tag; each k in 0 .. 9 { .. } .. }`
fn members<'t>(expr: Rule<'t, Expr>) -> Rule<'t, Vec<Member>> {
    recursive(
        |members: Recursive<dyn Parser<'t, Tokens<'t>, Vec<Member>, extra::Err<Raw<'t>>>>| {
            let tag = word("is").ignore_then(expr.clone()).or_not();
            let broken = skip().map(|span| Member::One {
                shape: error(span),
                tag: None,
            });
            let one = expr
                .clone()
                .then(tag)
                .then_ignore(semicolon())
                .map(|(shape, tag)| Member::One { shape, tag });
            let each = counter(expr)
                .then(members)
                .map(|(counter, members)| Member::Each { counter, members })
                .labelled("an expression");
            choice((each.boxed(), one.boxed()))
                .recover_with(via_parser(broken))
                .repeated()
                .collect()
                .delimited_by(sign("{"), sign("}"))
        },
    )
    .boxed()
}

/// `record name { field: T, .. }`
fn record<'t>() -> Rule<'t, ItemKind> {
    begins("record")
        .ignore_then(name())
        .then(comma(field()).delimited_by(sign("{"), sign("}")))
        .map(|(name, fields)| ItemKind::Record { name, fields })
        .boxed()
}

/// `map name { "##" "#." } where '#' => 1, '.' => 0;`
fn map<'t>(expr: Rule<'t, Expr>) -> Rule<'t, ItemKind> {
    let row = select! { Token::Text(text) => text }
        .map_with(|text, e| (unquoted(text).to_string(), e.span()))
        .labelled("a string");
    let cell = select! { Token::Char(text) => text }
        .map(|text| text.chars().nth(1).unwrap_or('?'))
        .labelled("a character")
        .then_ignore(sign("=>"))
        .then(expr)
        .boxed();
    begins("map")
        .ignore_then(name())
        .then(
            row.repeated()
                .at_least(1)
                .collect()
                .delimited_by(sign("{"), sign("}")),
        )
        .then_ignore(word("where"))
        .then(comma(cell))
        .then_ignore(semicolon())
        .map(|((name, rows), cells)| ItemKind::Map { name, rows, cells })
        .boxed()
}

/// `draw (x, y) = expr;`
fn draw<'t>(expr: Rule<'t, Expr>) -> Rule<'t, ItemKind> {
    let axes = name().then_ignore(sign(",")).then(name());
    begins("draw")
        .ignore_then(axes.delimited_by(sign("("), sign(")")))
        .then(body(expr))
        .map(|((x, y), body)| ItemKind::Draw { x, y, body })
        .boxed()
}

/// `use "file.scn";`
fn include<'t>() -> Rule<'t, ItemKind> {
    let path = select! { Token::Text(text) => text }
        .map_with(|text, e| (unquoted(text).to_string(), e.span()))
        .labelled("a string");
    begins("use")
        .ignore_then(path)
        .then_ignore(semicolon())
        .map(|(path, path_span): (String, Span)| ItemKind::Use { path, path_span })
        .boxed()
}

fn unquoted(text: &str) -> &str {
    let text = text.strip_prefix('"').unwrap_or(text);
    text.strip_suffix('"').unwrap_or(text)
}

/// `(a: T, b: T = expr)`, perhaps empty.
fn bindings<'t>(expr: Rule<'t, Expr>) -> Rule<'t, Vec<Binding>> {
    binding(expr)
        .separated_by(sign(","))
        .collect()
        .delimited_by(sign("("), sign(")"))
        .boxed()
}

/// `a: T`, `a: T = expr`
fn binding<'t>(expr: Rule<'t, Expr>) -> Rule<'t, Binding> {
    field()
        .then(sign("=").ignore_then(expr).or_not())
        .map(|(field, default)| Binding { default, ..field })
        .boxed()
}

/// `a: T`
fn field<'t>() -> Rule<'t, Binding> {
    name()
        .then_ignore(sign(":"))
        .then(ty())
        .map(|(name, ty)| Binding {
            name,
            ty,
            default: None,
        })
        .boxed()
}

/// `real`, `[T]`, `fn(T) -> T`, `T?`
fn ty<'t>() -> Rule<'t, Type> {
    recursive(
        |ty: Recursive<dyn Parser<'t, Tokens<'t>, Type, extra::Err<Raw<'t>>>>| {
            let ty: Rule<'t, Type> = ty.boxed();
            let named = select! {
                Token::Ident(text) => text,
                Token::Item("shape") => "shape",
                Token::Item("scene") => "scene",
                Token::Item("map") => "map",
            }
            .map(|text| TypeKind::Name(text.to_string()));
            let table = ty
                .clone()
                .delimited_by(sign("["), sign("]"))
                .map(|of| TypeKind::Table(Box::new(of)));
            let function = begins("fn")
                .ignore_then(
                    ty.clone()
                        .separated_by(sign(","))
                        .collect()
                        .delimited_by(sign("("), sign(")")),
                )
                .then_ignore(sign("->"))
                .then(ty)
                .map(|(from, to)| TypeKind::Function(from, Box::new(to)));
            choice((named, table, function))
                .map_with(|kind, e| Type {
                    kind,
                    span: e.span(),
                })
                .labelled("a type")
                .foldl_with(sign("?").repeated(), |of, (), e| Type {
                    kind: TypeKind::Optional(Box::new(of)),
                    span: e.span(),
                })
        },
    )
    .boxed()
}
