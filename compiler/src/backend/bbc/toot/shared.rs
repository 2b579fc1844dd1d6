//! Common subexpression elimination of literals: numbers that are shorter as variables.

use super::super::lines::Lines;
use super::super::pieces::{Piece, pieces};
use std::collections::BTreeMap;

/// What the variable of a number is called until it is named.
const NAME: &str = "number_";

/// The greatest int: the least is made of it, which no real variable may hold on the way.
pub const GREATEST: &str = "2147483647";

/// The runtime's limits, which are variables where these are quicker.
const LIMITS: [(&str, &str); 8] = [
    ("BIG", "1.7E38"),
    ("HALF", "1.7E38/2"),
    ("ROOT", "1E18"),
    ("TINY", "1E-15"),
    ("FAR", "1E33"),
    ("WIDE", "2147483648"),
    ("MIDWAY", ".5"),
    ("QUARTER", "PI/2"),
];

/// A text with limits as numbers.
fn plain(text: &str) -> String {
    let put = |piece| match piece {
        Piece::Name(name) => {
            let limit = LIMITS.iter().find(|(limit, _)| *limit == name);
            limit.map_or(name, |(_, number)| number)
        }
        Piece::Word(t) | Piece::Fixed(t) | Piece::Sign(t) => t,
        Piece::Space => " ",
    };
    pieces(text).into_iter().map(put).collect()
}

/// A number as it is shortest.
pub fn number(word: &str) -> String {
    let word = word
        .strip_prefix('0')
        .filter(|w| w.starts_with('.'))
        .unwrap_or(word);
    word.replace("E+", "E")
}

fn is_number(word: &str) -> bool {
    word.starts_with(|c: char| c.is_ascii_digit() || c == '.')
}

/// A text's pieces, an exponent below 0 with its number; and whether each is a number.
fn parts(text: &str) -> Vec<(String, bool)> {
    let mut out: Vec<(String, bool)> = Vec::new();
    for piece in pieces(text) {
        let (text, is_word) = match piece {
            Piece::Word(t) => (t, true),
            Piece::Name(t) | Piece::Fixed(t) | Piece::Sign(t) => (t, false),
            Piece::Space => (" ", false),
        };
        if let Some((last, true)) = out.last_mut()
            && (last.ends_with('E') && text == "-" || last.ends_with("E-") && is_word)
        {
            last.push_str(text);
            continue;
        }
        out.push((text.to_owned(), is_word && is_number(text)));
    }
    out
}

/// The lines with numbers that are met often in variables, which are set first.
pub fn shared(mut lines: Lines) -> Lines {
    lines.each_text(|text| {
        // What is read as data is not computed.
        if !text.starts_with("DATA") {
            *text = plain(text);
        }
    });
    let mut met: BTreeMap<String, usize> = BTreeMap::new();
    for text in lines.texts() {
        for (part, is_number) in parts(text) {
            if is_number && part != GREATEST {
                *met.entry(number(&part)).or_default() += 1;
            }
        }
    }
    // Each use takes one character, and `v=` and a colon more beside the number itself.
    let shorter = |(text, uses): &(String, usize)| text.len() * uses > uses + text.len() + 3;
    let mut names: BTreeMap<String, String> = BTreeMap::new();
    let mut first = Lines::of_weight(lines.weight);
    for (at, (text, _)) in met.into_iter().filter(shorter).enumerate() {
        let name = format!("{NAME}{at}");
        first.statement(format!("{name}={text}"), None);
        names.insert(text, name);
    }
    lines.each_text(|text| {
        let put = |(part, is_number): (String, bool)| match is_number {
            true => names
                .get(&number(&part))
                .cloned()
                .unwrap_or_else(|| number(&part)),
            false => part,
        };
        *text = parts(text).into_iter().map(put).collect();
    });
    first.followed_by(lines)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_are_met_often_are_variables() {
        let mut lines = Lines::default();
        for text in ["a=1E-5*b+0.5", "c=1E-5<d*0.25", "IF d<1E-5 THEN a=ROOT"] {
            lines.line(text, None);
        }
        let texts: Vec<String> = shared(lines).texts().map(str::to_owned).collect();
        assert_eq!(
            texts,
            [
                "number_0=1E-5",
                "a=number_0*b+.5",
                "c=number_0<d*.25",
                "IF d<number_0 THEN a=1E18"
            ]
        );
    }
}
