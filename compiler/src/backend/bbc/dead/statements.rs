//! What statements of a line are: where control leaves them, what they read and write.

use crate::backend::bbc::lines::Label;
use crate::backend::bbc::pieces::{Piece, pieces};
use std::collections::BTreeSet;

/// The statements up to the first call, head or end of a loop, and that one.
pub fn cut(plain: &str) -> Option<(&str, &str)> {
    let mut from = 0;
    for statement in plain.split(':') {
        let to = from + statement.len();
        if ["PROC", "FOR ", "NEXT"]
            .iter()
            .any(|word| statement.starts_with(word))
        {
            return Some((plain.get(..to)?, statement));
        }
        from = to + 1;
    }
    None
}

/// What counts the turns of a loop, given what stands behind its FOR.
pub fn counts(turn: &str) -> &str {
    turn.split_once('=').map_or("", |(name, _)| name)
}

/// The name of the procedure that a text begins with the call of.
pub fn called(text: &str) -> Option<&str> {
    match pieces(text).first() {
        Some(Piece::Fixed(name)) if name.starts_with("PROC") => text.get(..name.len()),
        _ => None,
    }
}

/// The last of some statements, and what stands before it.
pub fn last(statements: &str) -> Option<(&str, &str)> {
    let from = statements.rfind([':', ' ']).map_or(0, |at| at + 1);
    let (front, last) = statements.split_at_checked(from)?;
    (!last.is_empty()).then_some((front, last))
}

/// The end of a loop that a way leaves, `turn%=1:NEXT turn%:`, and what stands before it.
pub fn loop_end(way: &str) -> (&str, &str) {
    let ends = || {
        let (sets, of) = way.strip_suffix(':')?.rsplit_once(":NEXT ")?;
        let (front, set) = last(sets)?;
        (set.split_once('=')?.0 == of).then_some(front.len())
    };
    way.split_at(ends().unwrap_or(way.len()))
}

/// The variable of a statement that sets a flag.
pub fn flag(statement: &str) -> Option<&str> {
    let (name, value) = statement.split_once('=')?;
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '%';
    let lone = name.starts_with(|c: char| c.is_ascii_lowercase()) && name.chars().all(plain);
    let of = value.strip_prefix("NOT ").unwrap_or(value);
    let other = of.ends_with('%') && of.chars().all(plain);
    (lone && (["TRUE", "FALSE"].contains(&value) || other)).then_some(name)
}

/// Whether control never goes on behind some statements.
pub fn leaves(text: &str) -> bool {
    let last = text.rsplit(':').next().unwrap_or(text);
    let ends = ["GOTO ", "ENDPROC", "END", "="];
    Label::last_of(last).is_some_and(|(before, _)| before.is_empty())
        || !text.contains("IF ") && ends.iter().any(|word| last.starts_with(word))
}

/// What is written behind some statements, where something is written before; what
/// they read that is not is noted.
pub fn written(
    text: &str,
    before: &BTreeSet<String>,
    reads: &mut BTreeSet<String>,
) -> BTreeSet<String> {
    let mut writes = before.clone();
    let arms = text.split(" THEN ").flat_map(|t| t.split(" ELSE "));
    let one = arms.clone().count() == 1;
    for statement in arms.flat_map(|t| t.split(':')) {
        let (to, from) = match statement.split_once('=') {
            Some((name, value)) if is_name(name) => (Some(name), value),
            _ => (None, statement),
        };
        for piece in pieces(from) {
            if let Piece::Name(name) = piece
                && !(one && writes.contains(name))
            {
                reads.insert(name.to_owned());
            }
        }
        if let Some(name) = to.filter(|_| one) {
            writes.insert(name.to_owned());
        }
    }
    writes
}

pub fn is_name(text: &str) -> bool {
    matches!(pieces(text).as_slice(), [Piece::Name(_)])
}
