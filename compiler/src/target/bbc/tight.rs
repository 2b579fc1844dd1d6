//! A program made small, for a machine that cannot hold it as it reads best:
//! one-letter names for what is used most, integers in the resident variables,
//! which cost no memory, no spaces that BASIC II can do without, long lines, and
//! constants in place where that is shorter than a variable. The parameter
//! block stays as it is.
//!
//! What is computed is the same, in the same order.

use super::lines::{Lines, MARK};
use std::collections::{BTreeMap, BTreeSet};

/// A line of tokens may hold 251 bytes; labels become longer than their marks.
const WIDTH: usize = 220;

/// Keywords that need no space behind them, whatever follows. (`MOD E%` would
/// be `MODE`.)
const FREE: &[&str] = &[
    "IF", "THEN", "ELSE", "AND", "OR", "NOT", "TO", "FOR", "DIV", "GCOL", "PLOT", "MODE", "VDU",
    "DIM", "READ", "GOTO", "PRINT",
];

/// A piece of a statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Piece<'t> {
    /// A name in small letters, with `%` if it has it.
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
fn pieces<'t>(text: &'t str) -> Vec<Piece<'t>> {
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
                (word, Piece::Word)
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
        Piece::Name(name) => letters && !name.ends_with('%'),
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

/// Makes a program small; the names in `keep` stay.
pub fn tight(lines: Lines, keep: &[String]) -> Lines {
    let (head, mut body) = lines.split_behind("REM rows to draw");
    let constants = in_place(&body);
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    body.each_text(|text| *text = without(text, &constants));
    body.remove_empty();
    body.each_text(|text| {
        for piece in pieces(text) {
            if let Piece::Name(name) = piece
                && !keep.iter().any(|k| k == name)
            {
                *counts.entry(name.to_owned()).or_default() += 1;
            }
        }
    });
    let names = short(&counts, keep);
    body.each_text(|text| *text = written(text, &names));
    head.followed_by(body.joined(WIDTH))
}

/// A statement with short names and few spaces.
fn written(text: &str, names: &BTreeMap<String, String>) -> String {
    let all = pieces(text);
    let mut out = String::new();
    for (k, piece) in all.iter().enumerate() {
        match piece {
            Piece::Name(name) => out.push_str(names.get(*name).map_or(*name, String::as_str)),
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

/// Constants that cost less where they are read than in a variable: name and number.
fn in_place(body: &Lines) -> BTreeMap<String, String> {
    let mut numbers: BTreeMap<String, String> = BTreeMap::new();
    let mut uses: BTreeMap<String, usize> = BTreeMap::new();
    let mut changed: BTreeSet<String> = BTreeSet::new();
    for text in body.texts() {
        for statement in text.split(':') {
            if let Some((name, number)) = statement.split_once('=')
                && name.starts_with(|c: char| c.is_ascii_lowercase())
                && number.starts_with(|c: char| c.is_ascii_digit())
                && pieces(name).len() == 1
                && number
                    .bytes()
                    .all(|b| b.is_ascii_digit() || b"E.-".contains(&b))
                && !name.ends_with('%')
                && numbers.insert(name.to_owned(), number.to_owned()).is_some()
            {
                changed.insert(name.to_owned());
            }
        }
        for piece in pieces(text) {
            if let Piece::Name(name) = piece {
                *uses.entry(name.to_owned()).or_default() += 1;
            }
        }
        // What is read or counted is no constant.
        for word in ["READ ", "FOR "] {
            for (at, _) in text.match_indices(word) {
                if let Some(Piece::Name(name)) = pieces(&text[at + word.len()..]).first() {
                    changed.insert((*name).to_owned());
                }
            }
        }
    }
    numbers.retain(|name, number| {
        // One use is the assignment. A variable takes an entry of about 8 bytes,
        // its assignment the number and 3 more, each use 1 or 2.
        let reads = uses.get(name).map_or(0, |n| n.saturating_sub(1));
        !changed.contains(name)
            && constant_name(name)
            && reads * (number.len() - 1) < number.len() + 11
    });
    numbers
}

/// Whether a name is one that [`super::names`] gives to constants.
fn constant_name(name: &str) -> bool {
    name.strip_prefix('c')
        .is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit() || c == '_'))
}

/// A statement with those constants in place, their assignments left out.
fn without(text: &str, constants: &BTreeMap<String, String>) -> String {
    if text.contains('"') || text.contains("REM") {
        return text.to_owned();
    }
    let kept = text.split(':').filter(|statement| {
        let name = statement.split_once('=').map(|(name, _)| name);
        !name.is_some_and(|n| constants.contains_key(n))
    });
    let text = kept.collect::<Vec<_>>().join(":");
    let put = |piece| match piece {
        Piece::Name(name) => constants.get(name).map_or(name, String::as_str).to_owned(),
        Piece::Word(t) | Piece::Fixed(t) | Piece::Sign(t) => t.to_owned(),
        Piece::Space => " ".to_owned(),
    };
    pieces(&text).into_iter().map(put).collect()
}

/// The shortest names for those used most.
fn short(counts: &BTreeMap<String, usize>, keep: &[String]) -> BTreeMap<String, String> {
    let mut by_use: Vec<(&String, &usize)> = counts.iter().collect();
    by_use.sort_by_key(|(name, count)| (std::cmp::Reverse(**count), *name));
    // I% R% X% Y% have their own use; `@%` formats numbers.
    let resident = ('A'..='Z').filter(|c| !"IRXY".contains(*c));
    let mut resident = resident.map(|c| format!("{c}%"));
    let letters = || {
        let one = ('a'..='z').map(String::from);
        let second = || ('a'..='z').chain('0'..='9');
        let two = ('a'..='z').flat_map(move |a| second().map(move |b| format!("{a}{b}")));
        let three = (0..).map(|n| format!("z_{n}"));
        one.chain(two).chain(three)
    };
    let (mut reals, mut ints) = (letters(), letters());
    let free = |name: &String| !keep.contains(name);
    let mut names = BTreeMap::new();
    for (name, _) in by_use {
        let found = if name.ends_with('%') {
            let mut small = (&mut ints).map(|n| n + "%");
            resident.next().or_else(|| small.find(free))
        } else {
            reals.find(free)
        };
        if let Some(found) = found {
            names.insert(name.clone(), found);
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spaces_stay_where_basic_needs_them() {
        let none = BTreeMap::new();
        for (text, small) in [
            ("IF a<1E5 THEN =a ELSE =0", "IFa<1E5 THEN=a ELSE=0"),
            (
                "IF b%>88 THEN c%=b% ELSE c%=2 DIV 3",
                "IFb%>88THENc%=b%ELSEc%=2DIV3",
            ),
            ("q%=n% MOD E%:r%=n% MOD 7", "q%=n%MOD E%:r%=n%MOD 7"),
            (
                "IF NOT done AND TRUE THEN \u{1}4\u{1}",
                "IFNOTdone ANDTRUE THEN\u{1}4\u{1}",
            ),
            (
                "IF ABS(a)<HALF THEN =x EOR 2 EOR y",
                "IFABS(a)<HALF THEN=x EOR 2 EOR y",
            ),
            (
                "PRINT \"a  b\":REM as  it is",
                "PRINT\"a  b\":REM as  it is",
            ),
        ] {
            assert_eq!(written(text, &none), small);
        }
    }

    #[test]
    fn short_names_keep_out_of_each_others_way() {
        let counts = [("long_one", 9), ("count%", 5), ("other%", 2), ("rare", 1)];
        let counts = counts.map(|(name, n)| (name.to_owned(), n)).into();
        let names = short(&counts, &["a".to_owned()]);
        let found: Vec<&str> = counts
            .keys()
            .filter_map(|n| names.get(n))
            .map(String::as_str)
            .collect();
        assert_eq!(found, ["A%", "b", "B%", "c"]);
    }
}
