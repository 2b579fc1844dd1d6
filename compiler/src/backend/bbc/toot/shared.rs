//! Common subexpression elimination of literals: numbers that are shorter as variables.

use super::super::lines::Lines;
use super::super::pieces::{Piece, pieces};
use std::collections::BTreeMap;

/// What the variable of a number is called until it is named.
const NAME: &str = "number_";

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

/// Products with powers of two below 1 as quotients, which are as exact.
const HALVES: [(&str, &str); 5] = [
    ("*.5", "/2"),
    ("*.25", "/4"),
    ("*.125", "/8"),
    ("*.0625", "/16"),
    ("*.03125", "/32"),
];

/// A text with limits as numbers, and quotients for products.
fn plain(text: &str) -> String {
    let put = |piece| match piece {
        Piece::Name(name) => {
            let limit = LIMITS.iter().find(|(limit, _)| *limit == name);
            limit.map_or(name, |(_, number)| number)
        }
        Piece::Word(t) | Piece::Fixed(t) | Piece::Sign(t) => t,
        Piece::Space => " ",
    };
    let mut out: String = pieces(text).into_iter().map(put).collect();
    for (product, quotient) in HALVES {
        for zero in ["", "0"] {
            let product = product.replace('.', &format!("{zero}."));
            let parts: Vec<&str> = out.split(&product).collect();
            let mut joined = String::new();
            for (k, part) in parts.iter().enumerate() {
                let longer = part.starts_with(|c: char| c.is_ascii_digit() || "E^.".contains(c));
                match k {
                    0 => {}
                    _ if longer => joined.push_str(&product),
                    _ => joined.push_str(quotient),
                }
                joined.push_str(part);
            }
            out = joined;
        }
    }
    out
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
        for piece in pieces(text) {
            if let Piece::Word(word) = piece
                && is_number(word)
            {
                *met.entry(number(word)).or_default() += 1;
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
    let mut body = lines;
    body.each_text(|text| {
        let put = |piece| match piece {
            Piece::Word(word) if is_number(word) => names
                .get(&number(word))
                .cloned()
                .unwrap_or_else(|| number(word)),
            Piece::Name(t) | Piece::Word(t) | Piece::Fixed(t) | Piece::Sign(t) => t.to_owned(),
            Piece::Space => " ".to_owned(),
        };
        *text = pieces(text).into_iter().map(put).collect();
    });
    first.followed_by(body)
}
