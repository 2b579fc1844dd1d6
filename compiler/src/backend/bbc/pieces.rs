//! Statements cut into names, words and signs, and written again with other
//! names and without the spaces that BASIC II can do without.

use super::lines::MARK;
use std::collections::BTreeMap;

/// Keywords that need no space behind them, whatever follows. (`MOD E%` would
/// be `MODE`.)
const FREE: &[&str] = &[
    "IF", "THEN", "ELSE", "AND", "OR", "NOT", "TO", "FOR", "DIV", "GCOL", "PLOT", "MODE", "VDU",
    "DIM", "READ", "GOTO", "PRINT", "ABS", "INT", "SGN", "SQR",
];

/// Variables of the runtime, which are in capitals.
pub const LIMITS: &[&str] = &[
    "BIG", "HALF", "ROOT", "TINY", "FAR", "WIDE", "MIDWAY", "QUARTER",
];

/// A piece of a statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Piece<'t> {
    /// A variable's name, with `%` if it has it.
    Name(&'t str),
    /// Capitals, digits and `.`: keywords, numbers, resident variables.
    Word(&'t str),
    /// A string, a label, a remark: not to be changed.
    Fixed(&'t str),
    /// A space.
    Space,
    /// Any other sign.
    Sign(&'t str),
}

/// Cuts statements into pieces.
pub fn pieces<'t>(text: &'t str) -> Vec<Piece<'t>> {
    let mut all = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let run = |is: fn(char) -> bool| rest.find(|c| !is(c)).unwrap_or(rest.len());
        let closed = |end: char| rest.get(1..).and_then(|r| r.find(end)).map(|at| at + 2);
        let (length, kind): (usize, fn(&'t str) -> Piece<'t>) = match first {
            '"' => (closed('"').unwrap_or(rest.len()), Piece::Fixed),
            MARK => (closed(MARK).unwrap_or(rest.len()), Piece::Fixed),
            _ if rest.starts_with("REM") || rest.starts_with("DATA") => (rest.len(), Piece::Fixed),
            // The name of a function is the runtime's.
            _ if rest.starts_with("FN") || rest.starts_with("PROC") => {
                (run(|c| c.is_ascii_alphanumeric() || c == '_'), Piece::Fixed)
            }
            'a'..='z' => {
                let name = run(|c| c.is_ascii_alphanumeric() || c == '_');
                let sign = rest.get(name..).is_some_and(|r| r.starts_with('%'));
                (name + usize::from(sign), Piece::Name)
            }
            'A'..='Z' | '0'..='9' | '.' => {
                let word = run(|c| c.is_ascii_uppercase() || c.is_ascii_digit() || c == '.');
                let own = rest.get(..word).is_some_and(|w| LIMITS.contains(&w));
                (word, if own { Piece::Name } else { Piece::Word })
            }
            ' ' => (1, |_| Piece::Space),
            _ => (first.len_utf8(), Piece::Sign),
        };
        let (piece, behind) = rest.split_at_checked(length.max(1)).unwrap_or((rest, ""));
        all.push(kind(piece));
        rest = behind;
    }
    all
}

/// Whether the space between two pieces is needed.
fn apart(before: Option<&Piece<'_>>, behind: Option<&Piece<'_>>) -> bool {
    let (Some(before), Some(behind)) = (before, behind) else {
        return false;
    };
    let letters = matches!(behind, Piece::Name(_) | Piece::Word(_))
        || matches!(behind, Piece::Fixed(text) if !text.starts_with(['"', MARK]));
    match before {
        // `DIM p% 3`: nothing else has a number behind a name.
        Piece::Name(name) => {
            let number =
                matches!(behind, Piece::Word(w) if w.starts_with(|c: char| c.is_ascii_digit()));
            letters && (number || !name.ends_with('%'))
        }
        Piece::Word(word) if FREE.contains(word) => false,
        // BASIC II takes an exponent's E, and all letters behind it, for a name.
        Piece::Word(word)
            if word.starts_with(|c: char| c.is_ascii_digit()) && word.contains('E') =>
        {
            letters
        }
        // An E behind a number would be its exponent.
        Piece::Word(word) if word.starts_with(|c: char| c.is_ascii_digit() || c == '.') => {
            matches!(behind, Piece::Word(next) if next.starts_with(|c: char| c == 'E' || !c.is_ascii_uppercase()))
        }
        Piece::Word(_) => letters,
        Piece::Fixed(text) => letters && !text.ends_with(['"', MARK]),
        Piece::Space | Piece::Sign(_) => false,
    }
}

/// Whether a THEN may be left out: BASIC goes on with whatever stands behind a
/// condition. A line number and a function's result need it, and so does what might
/// be taken for more of the condition's last number.
fn goes_without(condition: &str, behind: Option<&Piece<'_>>, next: Option<char>) -> bool {
    let starts = match behind {
        Some(Piece::Name(_) | Piece::Word(_)) => true,
        Some(Piece::Fixed(text)) => text.starts_with("PROC"),
        _ => false,
    };
    let Some(next) = next.filter(|c| starts && c.is_ascii_alphabetic()) else {
        return false;
    };
    match condition.chars().last() {
        Some(c) if c.is_ascii_digit() => !next.eq_ignore_ascii_case(&'E'),
        Some(c) => ")% ".contains(c),
        None => false,
    }
}

/// A statement with short names and few spaces.
pub fn written(text: &str, names: &BTreeMap<String, String>) -> String {
    let all = pieces(text);
    let named = |k: usize| {
        let name = match all.get(k)? {
            Piece::Name(name) => *name,
            Piece::Word(t) | Piece::Fixed(t) | Piece::Sign(t) => return Some(*t),
            Piece::Space => return None,
        };
        let array = matches!(all.get(k + 1), Some(Piece::Sign("(")));
        let found = match array {
            true => names.get(&format!("{name}(")),
            false => names.get(name),
        };
        Some(found.map_or(name, String::as_str))
    };
    let mut out = String::new();
    for k in 0..all.len() {
        match &all[k] {
            Piece::Word("THEN")
                if goes_without(
                    &out,
                    all.get(k + 2),
                    named(k + 2).and_then(|t| t.chars().next()),
                ) => {}
            Piece::Name(_) => out.push_str(named(k).unwrap_or_default()),
            Piece::Word(t) | Piece::Fixed(t) | Piece::Sign(t) => out.push_str(t),
            Piece::Space => {
                let before = k.checked_sub(1).and_then(|k| all.get(k));
                // A name that became a resident variable ends in `%` as before.
                if apart(before, all.get(k + 1)) {
                    out.push(' ');
                }
            }
        }
    }
    out
}

/// About how long a statement becomes with short names and few spaces.
pub fn short_length(text: &str) -> usize {
    let length = |piece: &Piece<'_>| match piece {
        Piece::Name(_) => 2,
        Piece::Space => 0,
        Piece::Fixed(t) if t.starts_with(MARK) => 4,
        Piece::Word(t) | Piece::Fixed(t) | Piece::Sign(t) => t.len(),
    };
    pieces(text).iter().map(length).sum()
}

/// How deep brackets stand inside each other.
pub fn depth(text: &str) -> usize {
    let (mut now, mut most) = (0usize, 0);
    for c in text.chars() {
        match c {
            '(' => now += 1,
            ')' => now = now.saturating_sub(1),
            _ => {}
        }
        most = most.max(now);
    }
    most
}
