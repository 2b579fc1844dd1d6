//! Statements as bytes: a token for each keyword, a letter for each variable, no spaces.

use super::super::lines::MARK;
use super::super::pieces::{Piece, pieces};
use super::super::screen::OWN;
use super::super::strings::NAME;
use super::shared::GREATEST;
use slowlight_isa::basic_tokens::KEYWORDS;
use std::collections::BTreeMap;

/// The character that stands for a byte in a post. What might be taken for a space, for nothing,
/// for a control character or for the beginning of a tag or of somebody's name is written as its
/// number and 256.
pub fn character(byte: u8) -> char {
    let plain = matches!(byte, b' '..=b'~' | 0xa1..=0xac | 0xae..=0xff);
    match plain && !b"#@".contains(&byte) {
        true => char::from(byte),
        false => char::from_u32(0x100 + u32::from(byte)).unwrap_or('?'),
    }
}

/// A keyword's token as it is posted.
pub fn token(name: &str) -> Option<char> {
    let found = KEYWORDS.iter().find(|keyword| keyword.name == name)?;
    Some(character(found.token))
}

/// Names by kind: variables, arrays, functions and procedures have each their own letters.
#[derive(Default)]
pub struct Letters(BTreeMap<String, String>);

/// What a name is sorted under: an array's with its bracket.
fn key(all: &[Piece<'_>], at: usize) -> Option<String> {
    match all.get(at)? {
        Piece::Name(name) => Some(match all.get(at + 1) {
            Some(Piece::Sign("(")) => format!("{name}("),
            _ => (*name).to_owned(),
        }),
        Piece::Word(word) if is_own(word) && all.get(at + 1) == Some(&Piece::Sign("%")) => {
            Some(format!("{word}%"))
        }
        Piece::Fixed(text) => {
            let kind = ["FN", "PROC"]
                .into_iter()
                .find(|kind| text.starts_with(kind))?;
            Some(format!("{kind} {}", text.strip_prefix(kind)?))
        }
        _ => None,
    }
}

fn is_own(word: &str) -> bool {
    word.len() == 1 && OWN.contains(word)
}

/// The kind of a key.
fn kind(key: &str) -> u8 {
    match key {
        _ if key.starts_with("FN ") => 1,
        _ if key.starts_with("PROC ") => 2,
        _ if key.ends_with('(') => 3,
        _ => 0,
    }
}

/// Names of one letter, then of two.
fn free() -> impl Iterator<Item = String> {
    let one = ('a'..='z').chain('A'..='Z').map(String::from);
    let two = ('a'..='z').flat_map(|a| ('a'..='z').map(move |b| format!("{a}{b}")));
    one.chain(two).chain((0..).map(|n| format!("z_{n}")))
}

impl Letters {
    /// Letters for all that some lines name, first for what is named most often. Variables of ints
    /// are reals, which are read no slower and have shorter names, but where there may be the
    /// least int: a real of that size is none to `AND` and `DIV`.
    pub fn of<'t>(texts: impl Iterator<Item = &'t str>) -> Letters {
        let mut met: BTreeMap<String, usize> = BTreeMap::new();
        let mut wide = false;
        for text in texts {
            let all = pieces(text);
            wide |= all.contains(&Piece::Word(GREATEST));
            for key in (0..all.len()).filter_map(|at| key(&all, at)) {
                if !key.starts_with(NAME) {
                    *met.entry(key).or_default() += 1;
                }
            }
        }
        let mut by_use: Vec<(String, usize)> = met.into_iter().collect();
        by_use.sort_by_key(|(key, uses)| (std::cmp::Reverse(*uses), key.clone()));
        let mut given = BTreeMap::new();
        for of in 0..=3 {
            let own = by_use.iter().filter(|(key, _)| kind(key) == of);
            let letter = |((key, _), letter): (&(String, usize), String)| {
                let is_int = wide && key.trim_end_matches('(').ends_with('%');
                let sign = if is_int { "%" } else { "" };
                (key.clone(), format!("{letter}{sign}"))
            };
            given.extend(own.zip(free()).map(letter));
        }
        Letters(given)
    }

    fn name(&self, key: &str) -> &str {
        self.0.get(key).map_or("z", String::as_str)
    }
}

/// A line as it is posted; labels are left as they are.
pub fn encoded(text: &str, letters: &Letters, strings: &[Option<Vec<u8>>]) -> String {
    let all: Vec<Piece<'_>> = pieces(text)
        .into_iter()
        .filter(|piece| *piece != Piece::Space)
        .collect();
    let mut out = String::new();
    let mut at = 0;
    let mut then = false;
    while let Some(piece) = all.get(at) {
        let (written, used) = one(&all, at, letters, strings);
        at += used;
        if *piece == Piece::Word("THEN") || *piece == Piece::Word("ELSE") {
            let label = matches!(all.get(at), Some(Piece::Fixed(t)) if t.starts_with(MARK));
            if *piece == Piece::Word("ELSE") {
                out.push_str(&written);
            }
            if label {
                out.extend(token("GOTO"));
            } else {
                then = *piece == Piece::Word("THEN");
            }
            continue;
        }
        let (before, next) = (out.chars().last(), written.chars().next());
        if then {
            then = false;
            if next.is_some_and(|next| needs_then(before, next)) {
                out.extend(token("THEN"));
            }
        } else if let (Some(before), Some(next)) = (before, next)
            && before.is_ascii_alphanumeric()
            && (next.is_ascii_alphanumeric() || next == '.')
        {
            out.push(' ');
        }
        out.push_str(&written);
    }
    out
}

/// Whether what follows a condition would be taken for more of it, or is no statement by
/// itself.
fn needs_then(before: Option<char>, next: char) -> bool {
    let before = before.unwrap_or(' ');
    match next {
        '=' | '?' | '!' | '$' | '(' | '-' => true,
        next if next.is_ascii_alphanumeric() => match before {
            '0'..='9' => next == 'E' || next.is_ascii_digit(),
            before => before.is_ascii_alphanumeric() || before == '_',
        },
        _ => false,
    }
}

/// What stands for the piece at a place, and how many pieces it is.
fn one(
    all: &[Piece<'_>],
    at: usize,
    letters: &Letters,
    strings: &[Option<Vec<u8>>],
) -> (String, usize) {
    let Some(piece) = all.get(at) else {
        return (String::new(), 1);
    };
    if let Piece::Name(name) = piece
        && let Some(number) = name.strip_prefix(NAME)
    {
        let bytes = number.parse().ok().and_then(|k: usize| strings.get(k));
        let bytes = bytes.and_then(Option::as_ref).into_iter().flatten();
        let inner: String = bytes.map(|b| character(*b)).collect();
        return (format!("\"{inner}\""), 1);
    }
    match (piece, key(all, at)) {
        (Piece::Name(_), Some(key)) => (letters.name(&key).to_owned(), 1),
        (Piece::Word(_), Some(key)) => (letters.name(&key).to_owned(), 2),
        (Piece::Fixed(_), Some(key)) => {
            let (kind, _) = key.split_once(' ').unwrap_or((&key, ""));
            let first: String = token(kind).into_iter().collect();
            (format!("{first}{}", letters.name(&key)), 1)
        }
        (Piece::Fixed(text), None) => match text.strip_prefix("DATA") {
            Some(items) => {
                let first: String = token("DATA").into_iter().collect();
                (format!("{first}{}", items.trim_start()), 1)
            }
            None => ((*text).to_owned(), 1),
        },
        (Piece::Word(word), None) => {
            for (more, signs) in [("$(", 3), ("$", 2), ("", 1)] {
                let follows = match signs {
                    3 => all.get(at + 1..at + 3) == Some(&[Piece::Sign("$"), Piece::Sign("(")]),
                    2 => all.get(at + 1) == Some(&Piece::Sign("$")),
                    _ => true,
                };
                if follows && let Some(found) = token(&format!("{word}{more}")) {
                    return (found.to_string(), signs);
                }
            }
            ((*word).to_owned(), 1)
        }
        (Piece::Sign(sign), _) => ((*sign).to_owned(), 1),
        (Piece::Name(name), None) => ((*name).to_owned(), 1),
        (Piece::Space, _) => (String::new(), 1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statements_are_tokens_and_letters() {
        for (text, posted) in [
            ("IF hit<0 THEN hit=1", "ça<0a=1"),
            ("IF X%<hit THEN hit=X% AND 3", "ça<bƌb=aƀ3"),
            ("IF hit THEN \u{1}7\u{1}", "çaå\u{1}7\u{1}"),
            ("IF h<0 THEN h=1 ELSE \u{1}7\u{1}", "ça<0a=1Ƌå\u{1}7\u{1}"),
            ("VDU 19,1,4;0;", "ï19,1,4;0;"),
            ("one=ASC MID$(two,1)", "a=ƗÁb,1)"),
            ("DEF FNdiv(a,b)", "Ý¤a(a,b)"),
            ("DATA 1,2", "Ü1,2"),
        ] {
            let letters = Letters::of([text].into_iter());
            assert_eq!(encoded(text, &letters, &[]), posted);
        }
    }
}
