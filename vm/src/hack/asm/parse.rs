//! A line of assembly.

use super::instruction::{COMPUTE, LARGEST, computation, dest, jump};

/// What a line says.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Statement<'t> {
    Label(&'t str),
    Instruction(Value<'t>),
}

/// An instruction, known at once or by a symbol: `@name`.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Value<'t> {
    Word(u16),
    Symbol(&'t str),
}

/// Reads a line; `None` if there is nothing in it.
pub(super) fn statement(line: &str) -> Result<Option<Statement<'_>>, String> {
    let code = line.find("//").map_or(line, |at| line.split_at(at).0);
    let code = code.trim();
    if code.is_empty() {
        return Ok(None);
    }
    if let Some(rest) = code.strip_prefix('(') {
        let name = rest
            .strip_suffix(')')
            .ok_or_else(|| format!("a label ends in `)`: {}", shown(code)))?;
        return symbol(name.trim()).map(|name| Some(Statement::Label(name)));
    }
    let value = match code.strip_prefix('@') {
        Some(value) => address(value.trim())?,
        None => Value::Word(instruction(code)?),
    };
    Ok(Some(Statement::Instruction(value)))
}

/// What follows an `@`.
fn address(text: &str) -> Result<Value<'_>, String> {
    if is_number(text) {
        let value = text.parse().ok().filter(|value| *value <= LARGEST);
        let too_large = || format!("@{} is above {LARGEST}, the largest constant", cut(text));
        return value.map(Value::Word).ok_or_else(too_large);
    }
    symbol(text).map(Value::Symbol)
}

/// Only digits: what has anything else in it is a name, as the official assembler has it.
fn is_number(text: &str) -> bool {
    !text.is_empty() && text.chars().all(|c| c.is_ascii_digit())
}

fn symbol(name: &str) -> Result<&str, String> {
    let is_part = |c: char| c.is_ascii_alphanumeric() || "_.$:".contains(c);
    if !name.is_empty() && !is_number(name) && name.chars().all(is_part) {
        Ok(name)
    } else {
        Err(format!(
            "{} is no name: letters, digits, `_`, `.`, `$` and `:`, and not only digits",
            shown(name)
        ))
    }
}

/// `dest=comp;jump`, with the first or the last or both left out.
fn instruction(code: &str) -> Result<u16, String> {
    let packed: String = code.chars().filter(|c| !c.is_whitespace()).collect();
    let (to, rest) = match packed.split_once('=') {
        Some((to, rest)) => (Some(to), rest),
        None => (None, packed.as_str()),
    };
    // Nothing behind a `;` is no jump.
    let (what, condition) = match rest.split_once(';') {
        Some((what, condition)) => (what, Some(condition).filter(|c| !c.is_empty())),
        None => (rest, None),
    };
    let mut word = COMPUTE;
    word |= computation(what).ok_or_else(|| format!("unknown computation {}", shown(what)))?;
    if let Some(to) = to {
        word |= dest(to)
            .ok_or_else(|| format!("unknown destination {}: A, D and M, each once", shown(to)))?;
    }
    if let Some(condition) = condition {
        word |= jump(condition).ok_or_else(|| format!("unknown jump {}", shown(condition)))?;
    }
    if to.is_none() && condition.is_none() {
        return Err(format!("{} goes nowhere: no `=` and no jump", shown(code)));
    }
    Ok(word)
}

/// A part of the source for a message, cut where it is absurdly long.
fn shown(text: &str) -> String {
    format!("`{}`", cut(text))
}

fn cut(text: &str) -> String {
    let mut cut: String = text.chars().take(40).collect();
    if cut.len() < text.len() {
        cut.push_str("...");
    }
    cut
}
