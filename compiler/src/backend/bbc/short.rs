//! A program made short, which on these machines is quick and small at once:
//! one-letter names for what is used most, integers in the resident variables,
//! no spaces that BASIC II can do without, long lines. The parameter block
//! stays as it is.
//!
//! BASIC II keeps a list of variables for each first letter, in the order in
//! which they came, and looks through it at each use: the tenth of its letter
//! costs a thousand cycles more, each letter of a name sixty. So reals get the
//! 52 letters first, by how often they are used, and no letter twice before
//! all have been given.
//!
//! What is computed is the same, in the same order. Constants that are seldom
//! read are put in place where that takes less than a variable; where memory is
//! short, the others too, and those below 0.

use super::Style;
use super::lines::Lines;
use super::pieces::{LIMITS, Piece, pieces, written};
use super::terse::terse;
use std::collections::{BTreeMap, BTreeSet};

/// A line of tokens may hold 251 bytes; labels become longer than their marks.
const WIDTH: usize = 220;

/// How often what is read for a row or pass is read in a picture, at most: each
/// time a number in the text takes up to five thousand cycles more than a variable.
pub const SELDOM: u64 = 2_000;

/// What is known of a program beside its lines.
pub struct Known<'k> {
    /// Names of numbers that never change.
    pub constants: &'k BTreeSet<String>,
    /// Names of what is TRUE or FALSE.
    pub flags: &'k BTreeSet<String>,
    /// It did not fit as it is quickest.
    pub spare: bool,
    /// Nor without remarks.
    pub scant: bool,
}

/// Makes a program short; the names in `keep` stay.
pub fn short(lines: Lines, keep: &[String], known: &Known<'_>, style: Style) -> Lines {
    let spare = known.spare;
    // The rows to draw, which are named last, stand at the parameter block's end.
    let rows = keep.last().map_or(String::new(), |last| format!("{last}="));
    let (head, mut body) = lines.split_behind(&rows);
    let seldom = match style {
        Style::Small => u64::MAX,
        _ => SELDOM,
    };
    let unread = unread(&body, keep);
    let constants = in_place(&body, known.constants, seldom, spare);
    body.each_text(|text| *text = without(text, &constants));
    if spare {
        body.each_text(|text| *text = without_unread(text, &unread));
    }
    body.remove_empty();
    body.each_text(|text| *text = terse(text, known.flags, known.scant));
    if known.scant {
        with_short_calls(&mut body);
    }
    let names = given(&uses(&body), keep);
    body.each_text(|text| *text = written(text, &names));
    head.followed_by(body.joined(WIDTH))
}

/// Gives procedures and functions names of one letter, as far as there are letters.
fn with_short_calls(body: &mut Lines) {
    let mut called: BTreeSet<String> = BTreeSet::new();
    for text in body.texts() {
        called.extend(pieces(text).iter().filter_map(|piece| match piece {
            Piece::Fixed(name) if call(name).is_some() => Some((*name).to_owned()),
            _ => None,
        }));
    }
    let mut names: BTreeMap<String, String> = BTreeMap::new();
    for kind in CALLS {
        let long = |name: &&String| call(name).is_some_and(|(of, own)| of == kind && own.len() > 1);
        let mut free = ('a'..='z').map(|letter| format!("{kind}{letter}"));
        for name in called.iter().filter(long) {
            if let Some(short) = free.find(|short| !called.contains(short)) {
                names.insert(name.clone(), short);
            }
        }
    }
    body.each_text(|text| {
        let named = pieces(text).into_iter().map(|piece| match piece {
            Piece::Fixed(name) => names.get(name).map_or(name, String::as_str),
            Piece::Name(t) | Piece::Word(t) | Piece::Sign(t) => t,
            Piece::Space => " ",
        });
        *text = named.collect();
    });
}

/// How the names of procedures and functions begin.
const CALLS: [&str; 2] = ["PROC", "FN"];

/// Which of them a name is of, and what is its own.
fn call(name: &str) -> Option<(&'static str, &str)> {
    let of = CALLS.into_iter().find(|kind| name.starts_with(kind))?;
    Some((of, name.strip_prefix(of)?))
}

/// How often each name is met while the program runs, roughly. An array's name
/// ends in its bracket.
fn uses(body: &Lines) -> BTreeMap<String, u64> {
    let mut counts: BTreeMap<String, u64> = BTreeMap::new();
    for (text, weight) in body.weighted() {
        let all = pieces(text);
        for (k, piece) in all.iter().enumerate() {
            let Piece::Name(name) = piece else {
                continue;
            };
            let array = matches!(all.get(k + 1), Some(Piece::Sign("(")));
            let name = format!("{name}{}", if array { "(" } else { "" });
            let count = counts.entry(name).or_default();
            *count = count.saturating_add(weight);
        }
    }
    counts
}

/// Constants that take less memory where they are read than in a variable, and are
/// read so seldom: name and number.
fn in_place(
    body: &Lines,
    constants: &BTreeSet<String>,
    seldom: u64,
    spare: bool,
) -> BTreeMap<String, String> {
    let often = self::uses(body);
    let mut numbers: BTreeMap<String, String> = BTreeMap::new();
    let mut uses: BTreeMap<String, usize> = BTreeMap::new();
    let mut changed: BTreeSet<String> = BTreeSet::new();
    let mut signed: BTreeSet<String> = BTreeSet::new();
    for text in body.texts() {
        for statement in text.split(':') {
            let Some((name, number)) = statement.split_once('=') else {
                continue;
            };
            let plain = number
                .bytes()
                .all(|b| b.is_ascii_digit() || b"E.-".contains(&b));
            if !plain {
                changed.insert(name.to_owned());
            }
            let own = name.starts_with(|c: char| c.is_ascii_lowercase());
            if (own || LIMITS.contains(&name))
                && number.starts_with(|c: char| c.is_ascii_digit() || spare && c == '-')
                && pieces(name).len() == 1
                && plain
                && !name.ends_with('%')
                && numbers.insert(name.to_owned(), number.to_owned()).is_some()
            {
                changed.insert(name.to_owned());
            }
        }
        let all = pieces(text);
        for (k, piece) in all.iter().enumerate() {
            if let Piece::Name(name) = piece {
                *uses.entry((*name).to_owned()).or_default() += 1;
                // Two signs in a row read badly.
                if k > 0 && spare && matches!(all[k - 1], Piece::Sign("-")) {
                    signed.insert((*name).to_owned());
                }
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
        // its assignment the number and 3 more, each use 1 or 2; of many variables
        // those that are read seldom have two letters.
        let reads = uses.get(name).map_or(0, |n| n.saturating_sub(1));
        let letters = if spare { 2 } else { 1 };
        // Those of functions are read at each of their calls.
        let limit = LIMITS.contains(&name.as_str());
        let most = if limit { SELDOM } else { seldom };
        let two_signs = number.starts_with('-') && signed.contains(name);
        !changed.contains(name)
            && !two_signs
            && often.get(name).is_none_or(|often| *often <= most)
            && (constants.contains(name) || limit)
            && reads * number.len().saturating_sub(letters) < number.len() + 9 + 2 * letters
    });
    numbers
}

/// Variables that are assigned once and never read, as of a runtime's constants.
fn unread(body: &Lines, keep: &[String]) -> BTreeSet<String> {
    let mut met: BTreeMap<String, usize> = BTreeMap::new();
    // Two rounds: what only the unread are made of is not read either.
    let mut gone: BTreeSet<String> = BTreeSet::new();
    for _ in 0..2 {
        met.clear();
        for text in body.texts() {
            for piece in pieces(&without_unread(text, &gone)) {
                if let Piece::Name(name) = piece {
                    *met.entry(name.to_owned()).or_default() += 1;
                }
            }
        }
        let once = met.iter().filter(|(_, times)| **times == 1);
        // Of one capital are the picture's own.
        let own = |name: &str| name.len() < 3 && name.starts_with(|c: char| c.is_ascii_uppercase());
        let once = once.map(|(name, _)| name.clone());
        gone.extend(once.filter(|name| !own(name) && !keep.contains(name)));
    }
    gone
}

/// A line without assignments of those.
fn without_unread(text: &str, unread: &BTreeSet<String>) -> String {
    let plain = ["IF ", "REM", "DEF", "FOR ", "FN", "DIM", "\""];
    if plain.iter().any(|word| text.contains(word)) {
        return text.to_owned();
    }
    let kept = text.split(':').filter(|statement| {
        let name = statement.split_once('=').map(|(name, _)| name);
        !name.is_some_and(|name| unread.contains(name))
    });
    kept.collect::<Vec<_>>().join(":")
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

/// `TOP` is a keyword, so P is left out.
const LETTERS: &str = "efghijklmnopqrstuvwxyzACDEGIJKLMNOQSUVXYZabcdBFHRTW";

/// Names of one letter, then of two, whose first letters go round backwards:
/// those that are used most share their list last.
fn letters() -> impl Iterator<Item = String> {
    let one = LETTERS.chars().map(String::from);
    let second = ('a'..='z').chain('0'..='9');
    let two = second.flat_map(|b| LETTERS.chars().rev().map(move |a| format!("{a}{b}")));
    // No keyword begins with two letters of which the second is small.
    one.chain(two).chain((0..).map(|n| format!("z_{n}")))
}

/// The quickest names for those used most.
fn given(counts: &BTreeMap<String, u64>, keep: &[String]) -> BTreeMap<String, String> {
    let mut by_use: Vec<(&String, &u64)> = counts.iter().collect();
    by_use.sort_by_key(|(name, count)| (std::cmp::Reverse(**count), *name));
    let own = super::screen::OWN;
    let mut resident = ('A'..='Z').filter(|c| !own.contains(*c));
    let mut small: Vec<String> = letters().take(by_use.len() + LETTERS.len()).collect();
    let mut names = BTreeMap::new();
    for (name, _) in by_use {
        let plain = name.trim_end_matches('(');
        if keep.iter().any(|k| k == plain) {
            continue;
        }
        let int = plain.ends_with('%');
        let scalar = int && plain == name;
        // A capital with `%` is a resident variable.
        let capital = |n: &String| scalar && n.len() == 1 && n.as_str() < "a";
        let free =
            |n: &String| !capital(n) && !keep.contains(n) && !keep.contains(&format!("{n}%"));
        let letter = match scalar {
            true => resident.next().map(String::from),
            false => None,
        };
        let mut other = || {
            let at = small.iter().position(free)?;
            Some(small.remove(at))
        };
        if let Some(found) = letter.or_else(&mut other) {
            let sign = if int { "%" } else { "" };
            names.insert(name.clone(), format!("{found}{sign}"));
        }
    }
    names
}

#[cfg(test)]
mod tests;
