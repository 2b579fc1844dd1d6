//! A line of tokens into its statements.

use slowlight_isa::opcodes::{self, Mode};

use super::Dialect;
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

/// Parses one line's tokens: one statement, or several where the dialect has them.
pub(super) fn line(
    tokens: &[Token<'_>],
    line: u32,
    end: u32,
    dialect: Dialect,
    symbols: &mut Symbols,
    found: &mut Vec<Statement>,
) -> Result<(), Wrong> {
    if dialect == Dialect::Common {
        found.extend(statement(Reader::new(tokens, end, dialect), line, symbols)?);
        return Ok(());
    }
    let mut rest = tokens;
    while !rest.is_empty() {
        let separator = rest.iter().position(|t| t.what == Lexeme::Mark(':'));
        let (first, behind) = rest.split_at(separator.unwrap_or(rest.len()));
        let end = behind.first().map_or(end, |t| t.column);
        found.extend(statement(Reader::new(first, end, dialect), line, symbols)?);
        rest = behind.get(1..).unwrap_or_default();
    }
    Ok(())
}

/// The label at the start of a statement, if there is one.
fn label(
    reader: &mut Reader<'_, '_>,
    line: u32,
    symbols: &mut Symbols,
) -> Result<Option<usize>, Wrong> {
    let (name, tokens) = match (reader.dialect, reader.peek(), reader.peek_second()) {
        (Dialect::Common, Some(Lexeme::Name(name)), Some(Lexeme::Mark(':'))) => (*name, 2),
        (Dialect::Beebasm, Some(Lexeme::Name(name)), _) => match name.strip_prefix('.') {
            Some(name) => (name, 1),
            None => return Ok(None),
        },
        _ => return Ok(None),
    };
    let symbol = define(name, line, reader.column(), symbols)?;
    for _ in 0..tokens {
        reader.skip();
    }
    Ok(Some(symbol))
}

/// Parses one statement; `None` where there is none.
fn statement(
    mut reader: Reader<'_, '_>,
    line: u32,
    symbols: &mut Symbols,
) -> Result<Option<Statement>, Wrong> {
    if reader.at_end() {
        return Ok(None);
    }
    let label = label(&mut reader, line, symbols)?;
    let column = reader.column();
    let action = if reader.at_end() {
        None
    } else {
        action(&mut reader, line, symbols)?
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
    if name.is_empty() {
        return wrong(column, "expected a label's name behind the dot");
    }
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

/// What a word means that is no instruction.
#[derive(Clone, Copy)]
pub(super) enum Directive {
    Origin,
    Bytes,
    Words,
    Reserve,
    Save,
}

/// The directive of a name in lower case.
pub(super) fn directive(name: &str, dialect: Dialect) -> Option<Directive> {
    Some(match (dialect, name) {
        (Dialect::Common, ".byte") | (Dialect::Beebasm, "equb" | "equs") => Directive::Bytes,
        (Dialect::Common, ".word") | (Dialect::Beebasm, "equw") => Directive::Words,
        (Dialect::Common, ".res") | (Dialect::Beebasm, "skip") => Directive::Reserve,
        (Dialect::Beebasm, "org") => Directive::Origin,
        (Dialect::Beebasm, "save") => Directive::Save,
        _ => return None,
    })
}

/// What the statement does; `None` where that is nothing.
fn action(
    reader: &mut Reader<'_, '_>,
    line: u32,
    symbols: &mut Symbols,
) -> Result<Option<Action>, Wrong> {
    let column = reader.column();
    let beebasm = reader.dialect == Dialect::Beebasm;
    let name = match (reader.peek(), reader.peek_second()) {
        (Some(Lexeme::Mark('*')), Some(Lexeme::Mark('='))) if !beebasm => {
            reader.skip();
            reader.skip();
            return Ok(Some(Action::Origin(reader.expr(symbols, line)?)));
        }
        (Some(Lexeme::Name(name)), Some(Lexeme::Mark('='))) => {
            let symbol = define(name, line, column, symbols)?;
            reader.skip();
            reader.skip();
            return Ok(Some(Action::Assign(symbol, reader.expr(symbols, line)?)));
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
    if let Some(directive) = directive(&name, reader.dialect) {
        return direct(directive, reader, line, symbols);
    }
    let name = opcodes::usual_name(&name).to_owned();
    match name.as_str() {
        _ if opcodes::is_mnemonic(&name) => {
            let operand = operand(reader, line, symbols)?;
            let shifts = opcodes::find(&name, Mode::Accumulator).is_some();
            match operand {
                Operand::None if beebasm && shifts => {
                    wrong(column, format!("beebasm wants `{name} a` here"))
                }
                operand => Ok(Some(Action::Instruction(name, operand))),
            }
        }
        _ if beebasm => wrong(
            column,
            format!("unknown instruction or directive `{name}` (a label begins with a dot)"),
        ),
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

/// The rest of a directive.
fn direct(
    directive: Directive,
    reader: &mut Reader<'_, '_>,
    line: u32,
    symbols: &mut Symbols,
) -> Result<Option<Action>, Wrong> {
    Ok(Some(match directive {
        Directive::Origin => Action::Origin(reader.expr(symbols, line)?),
        Directive::Bytes => Action::Bytes(list(reader, |r| datum(r, line, symbols))?),
        Directive::Words => Action::Words(list(reader, |r| r.expr(symbols, line))?),
        Directive::Reserve => {
            let count = reader.expr(symbols, line)?;
            let filled = reader.dialect == Dialect::Common && reader.eat(',');
            let fill = filled.then(|| reader.expr(symbols, line)).transpose()?;
            Action::Reserve(count, fill)
        }
        Directive::Save => {
            // A file's name, then addresses: they must be right, and that is all.
            if let Some(Lexeme::Text(_)) = reader.peek() {
                reader.skip();
                if !reader.eat(',') {
                    return wrong(reader.column(), "expected `,` and where the file begins");
                }
            }
            reader.expr(symbols, line)?;
            while reader.eat(',') {
                reader.expr(symbols, line)?;
            }
            return Ok(None);
        }
    }))
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
