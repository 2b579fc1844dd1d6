//! A line of tokens into a statement.

use slowlight_isa::opcodes;

use super::expr::{Expr, Reader};
use super::lexer::{Lexeme, Token, Wrong, wrong};
use super::symbols::Symbols;

/// What a line says, apart from its label.
#[derive(Debug)]
pub(super) enum Action {
    /// `* = expr`
    Origin(Expr),
    /// `name = expr`
    Assign(usize, Expr),
    /// `.byte`
    Bytes(Vec<Datum>),
    /// `.word`
    Words(Vec<Expr>),
    /// `.res count, fill`
    Reserve(Expr, Option<Expr>),
    /// An instruction; the mnemonic is in lower case.
    Instruction(String, Operand),
}

/// One element of `.byte`.
#[derive(Debug)]
pub(super) enum Datum {
    Value(Expr),
    Text(Vec<u8>),
}

/// An operand as it is written.
#[derive(Debug)]
pub(super) enum Operand {
    None,
    Accumulator,
    Immediate(Expr),
    Address(Expr),
    AddressX(Expr),
    AddressY(Expr),
    Indirect(Expr),
    IndirectX(Expr),
    IndirectY(Expr),
}

/// A line: a label, an action, or both.
#[derive(Debug)]
pub(super) struct Statement {
    pub line: u32,
    /// Where the action starts, from 1.
    pub column: u32,
    pub label: Option<usize>,
    pub action: Option<Action>,
}

/// Names that other assemblers keep for themselves cannot be symbols.
pub(super) fn check_name(name: &str, column: u32) -> Result<(), Wrong> {
    let lower = name.to_ascii_lowercase();
    if name.starts_with('.') {
        wrong(
            column,
            format!("`{name}` is not a directive that can stand here"),
        )
    } else if matches!(lower.as_str(), "a" | "x" | "y" | "s") {
        wrong(
            column,
            format!("`{name}` is a register and cannot be a symbol"),
        )
    } else if opcodes::is_mnemonic(&lower) {
        wrong(
            column,
            format!("`{name}` is an instruction and cannot be a symbol"),
        )
    } else {
        Ok(())
    }
}

/// Parses one line's tokens; `None` where there are none.
pub(super) fn statement(
    tokens: &[Token<'_>],
    line: u32,
    end: u32,
    symbols: &mut Symbols,
) -> Result<Option<Statement>, Wrong> {
    let mut reader = Reader::new(tokens, end);
    if reader.at_end() {
        return Ok(None);
    }
    let label = match (reader.peek(), reader.peek_second()) {
        (Some(Lexeme::Name(name)), Some(Lexeme::Mark(':'))) => {
            let symbol = define(name, line, reader.column(), symbols)?;
            reader.skip();
            reader.skip();
            Some(symbol)
        }
        _ => None,
    };
    let column = reader.column();
    let action = if reader.at_end() {
        None
    } else {
        Some(action(&mut reader, line, symbols)?)
    };
    if !reader.at_end() {
        return wrong(
            reader.column(),
            "this does not belong to the statement before it",
        );
    }
    Ok(Some(Statement {
        line,
        column,
        label,
        action,
    }))
}

fn define(name: &str, line: u32, column: u32, symbols: &mut Symbols) -> Result<usize, Wrong> {
    check_name(name, column)?;
    let symbol = symbols.mention(name, line, column);
    match symbols.define(symbol, line, column) {
        Ok(()) => Ok(symbol),
        Err(first) => wrong(
            column,
            format!("`{name}` is already defined in line {first}"),
        ),
    }
}

fn action(reader: &mut Reader<'_, '_>, line: u32, symbols: &mut Symbols) -> Result<Action, Wrong> {
    let column = reader.column();
    let name = match (reader.peek(), reader.peek_second()) {
        (Some(Lexeme::Mark('*')), Some(Lexeme::Mark('='))) => {
            reader.skip();
            reader.skip();
            return Ok(Action::Origin(reader.expr(symbols, line)?));
        }
        (Some(Lexeme::Name(name)), Some(Lexeme::Mark('='))) => {
            let symbol = define(name, line, column, symbols)?;
            reader.skip();
            reader.skip();
            return Ok(Action::Assign(symbol, reader.expr(symbols, line)?));
        }
        (Some(Lexeme::Name(name)), _) => name.to_ascii_lowercase(),
        _ => {
            return wrong(
                column,
                "expected a label, an instruction, a directive or an assignment",
            );
        }
    };
    reader.skip();
    match name.as_str() {
        ".byte" => list(reader, |r| datum(r, line, symbols)).map(Action::Bytes),
        ".word" => list(reader, |r| r.expr(symbols, line)).map(Action::Words),
        ".res" => {
            let count = reader.expr(symbols, line)?;
            let fill = if reader.eat(',') {
                Some(reader.expr(symbols, line)?)
            } else {
                None
            };
            Ok(Action::Reserve(count, fill))
        }
        _ if opcodes::is_mnemonic(&name) => {
            let operand = operand(reader, line, symbols)?;
            Ok(Action::Instruction(name, operand))
        }
        _ if name.starts_with('.') => wrong(
            column,
            format!("unknown directive `{name}`; there are `.byte`, `.word` and `.res`"),
        ),
        _ => wrong(
            column,
            format!("unknown instruction `{name}` (a label needs a colon)"),
        ),
    }
}

fn list<'t, 'a, T>(
    reader: &mut Reader<'t, 'a>,
    mut one: impl FnMut(&mut Reader<'t, 'a>) -> Result<T, Wrong>,
) -> Result<Vec<T>, Wrong> {
    let mut all = vec![one(reader)?];
    while reader.eat(',') {
        let column = reader.column();
        let (element, here) = reader.watch_here(&mut one)?;
        if here {
            return wrong(
                column,
                "assemblers read `*` differently behind a comma: use a label",
            );
        }
        all.push(element);
    }
    Ok(all)
}

fn datum(reader: &mut Reader<'_, '_>, line: u32, symbols: &mut Symbols) -> Result<Datum, Wrong> {
    if let Some(Lexeme::Text(text)) = reader.peek() {
        reader.skip();
        return Ok(Datum::Text(text.bytes().collect()));
    }
    reader.expr(symbols, line).map(Datum::Value)
}

fn operand(
    reader: &mut Reader<'_, '_>,
    line: u32,
    symbols: &mut Symbols,
) -> Result<Operand, Wrong> {
    match reader.peek() {
        None => return Ok(Operand::None),
        Some(Lexeme::Name(name)) if name.eq_ignore_ascii_case("a") => {
            reader.skip();
            return Ok(Operand::Accumulator);
        }
        Some(Lexeme::Mark('#')) => {
            reader.skip();
            return reader.expr(symbols, line).map(Operand::Immediate);
        }
        Some(Lexeme::Mark('(')) => return indirect(reader, line, symbols),
        Some(_) => {}
    }
    let expr = reader.expr(symbols, line)?;
    Ok(if reader.eat_index("x") {
        Operand::AddressX(expr)
    } else if reader.eat_index("y") {
        Operand::AddressY(expr)
    } else {
        Operand::Address(expr)
    })
}

/// An operand that begins with a parenthesis is indirect, all of it: `(4)+1` is
/// taken as an address by some assemblers and refused by others.
fn indirect(
    reader: &mut Reader<'_, '_>,
    line: u32,
    symbols: &mut Symbols,
) -> Result<Operand, Wrong> {
    if !reader.is_indirect() {
        return wrong(
            reader.column(),
            "an operand that begins with `(` is indirect: its `)` must end it; for an address write `0+(...)`",
        );
    }
    reader.skip();
    let expr = reader.expr(symbols, line)?;
    if reader.eat_index("x") {
        return if reader.eat(')') {
            Ok(Operand::IndirectX(expr))
        } else {
            wrong(reader.column(), "expected `)`")
        };
    }
    if !reader.eat(')') {
        return wrong(reader.column(), "expected `)` or `,x)`");
    }
    Ok(if reader.eat_index("y") {
        Operand::IndirectY(expr)
    } else {
        Operand::Indirect(expr)
    })
}
