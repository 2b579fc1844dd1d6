//! Input that is large, deep or nonsense: no panic, no hang, few words.
//!
//! Depth is tried on the smallest stack that threads of the product get (2 MiB,
//! Rust's default): a recursion that follows the text would overflow it.

use super::*;
use crate::lexer::MAX_DIAGNOSTICS;
use crate::tree::{Expr, File};
use crate::{MAX_BYTES, MAX_DEPTH, decode, print, walk};
use proptest::prelude::*;

/// Parses, and holds what is true of every text.
fn parse_any(text: &str) -> (File, Vec<Diagnostic>) {
    let (file, diagnostics) = parse(text, 0);
    assert!(diagnostics.len() <= MAX_DIAGNOSTICS);
    for diagnostic in &diagnostics {
        assert!(
            text.get(diagnostic.span.range()).is_some(),
            "{diagnostic:?}"
        );
        assert!(!diagnostic.message.is_empty());
    }
    let mut deepest = 0;
    walk::roots(&file, &mut |expr| deepest = deepest.max(depth(expr, text)));
    assert!(deepest <= MAX_DEPTH);
    print::tree(&file);
    print::tokens(text);
    (file, diagnostics)
}

/// Levels of the tree; each part lies inside the text.
fn depth(expr: &Expr, text: &str) -> usize {
    assert!(text.get(expr.span.range()).is_some());
    let mut deepest = 0;
    walk::children(expr, &mut |child| deepest = deepest.max(depth(child, text)));
    deepest + 1
}

/// A text of about the greatest length: `part` over and over behind `lead`.
fn long(lead: &str, part: &str) -> String {
    lead.to_string() + &part.repeat((MAX_BYTES - lead.len()) / part.len())
}

#[test]
fn a_megabyte_of_anything_deep_is_one_diagnostic() {
    let parts = [
        "(",
        "[",
        "{",
        "f(",
        "a[",
        "-",
        "not ",
        "a+",
        "a^",
        "a.b",
        "a.b(c).",
        "[b]",
        "if ",
        "if a then ",
        "if a then b else ",
        "loop (a = ",
        "{let a = ",
        "(1,",
        "[1;",
        "next(",
        "-(",
        "a+(",
        "{spread a to {",
        "f each k in ",
        "f each k in 0 .. 1 {",
        "if let a = ",
    ];
    for part in parts {
        let text = long("const a = ", part);
        let (file, diagnostics) = parse_any(&text);
        let said = plain("", &diagnostics);
        assert_eq!(diagnostics.len(), 1, "{part}: {said}");
        assert!(said.contains("256"), "{part}: {said}");
        assert!(file.items.is_empty());
    }
    // Types nest too.
    for part in ["[", "fn(", "fn() -> "] {
        let (_, diagnostics) = parse_any(&long("fn f(a: ", part));
        assert_eq!(diagnostics.len(), 1, "{part}");
    }
    // Without an item around them they are one mistake as well.
    for part in [
        "(",
        ")",
        "{",
        "}",
        "a ",
        "1 ",
        ";",
        "let ",
        "if a then b else ",
    ] {
        let (_, diagnostics) = parse_any(&long("", part));
        assert_eq!(diagnostics.len(), 1, "{part}");
    }
}

#[test]
fn the_deepest_that_is_allowed_fits_the_stack() {
    let forms = [
        ("(", "1", ")"),
        ("-", "1", ""),
        ("1 ^ ", "1", ""),
        ("1 + ", "1", ""),
        ("[", "1", "]"),
        ("{", "1", "}"),
        ("f(", "1", ")"),
        ("f(a: ", "1", ")"),
        ("a[", "1", "]"),
        ("next(", "1", ")"),
        ("", "a", ".b"),
        ("", "a", "[1]"),
        ("if a then b else ", "1", ""),
        ("if ", "1", " then a else b"),
        ("if a then ", "1", " else b"),
        ("{ let a = ", "1", "; a }"),
        // Wrong at the bottom: recovery is as deep.
        ("(", "1 1", ")"),
        ("{ let a = ", "1 1", "; a }"),
        ("f(", "", ")"),
        ("f each k in 1 .. 2 { ", "1", " }"),
        ("f each k in ", "1", " .. 2 { 3 }"),
        ("f each k in 1 .. ", "2", " { 3 }"),
        ("f each k in {1} + ", "1", " .. {2} { 3 }"),
        ("f each k in 1 .. if a then b else ", "2", " { 3 }"),
        ("if a then f each k in 1 .. 2 { 3 } + ", "1", " else 2"),
    ];
    for (open, middle, close) in forms {
        // A level is at most three of what is counted, so a third always fits.
        let at = |n: usize| format!("const a = {}{middle}{};", open.repeat(n), close.repeat(n));
        let few = plain("", &parse_any(&at(80)).1);
        assert!(!few.contains("nests"), "{open}: {few}");
        for n in [240, 253, 254, 255, 256, 257] {
            parse_any(&at(n));
        }
    }
    let right = format!("const a = {}1{};", "(".repeat(255), ")".repeat(255));
    assert!(parse_any(&right).1.is_empty());
}

#[test]
fn what_is_long_but_not_deep_is_read() {
    let ladder: String = (0..100)
        .map(|n| format!("if a == {n} then b + c * d else "))
        .collect();
    let (_, diagnostics) = parse_any(&format!("const e = {ladder} 0;"));
    assert_eq!(plain("", &diagnostics), "");
    let (file, diagnostics) = parse_any(&format!("const a = [{}0];", "1, 2 + 3; ".repeat(20_000)));
    assert_eq!(plain("", &diagnostics), "");
    assert_eq!(file.items.len(), 1);
    let (file, diagnostics) = parse_any(&long("", "const a = 1;\n"));
    assert_eq!(plain("", &diagnostics), "");
    assert_eq!(file.items.len(), MAX_BYTES / 13);
}

#[test]
fn what_is_too_long_is_not_read() {
    let (file, diagnostics) = parse_any(&(long("", "const a = 1;\n") + "                "));
    assert!(file.items.is_empty());
    assert_eq!(diagnostics.len(), 1);
    assert!(diagnostics[0].message.contains("1048576"));
}

#[test]
fn many_mistakes_are_not_all_told() {
    for part in [
        "const a = 1 1;\n",
        "@ ",
        "1px ",
        "fn f( {",
        "const a = b < c < d;\n",
    ] {
        assert_eq!(
            parse_any(&long("", part)).1.len(),
            MAX_DIAGNOSTICS,
            "{part}"
        );
    }
}

#[test]
fn a_number_beyond_every_format_stays_finite() {
    let (file, diagnostics) = parse_any(&format!("const a = 1{}.5;", "0".repeat(400)));
    assert_eq!(diagnostics.len(), 1);
    assert!(!print::tree(&file).contains("inf"));
}

const SOUP: [&str; 80] = [
    "image", "param", "state", "const", "fn", "effect", "shape", "scene", "record", "map",
    "dither", "draw", "use", "if", "let", "then", "else", "loop", "next", "spread", "each", "and",
    "or", "not", "div", "mod", "true", "none", "is", "in", "where", "x", "y", "inks", "max", "to",
    "frame", "row", "a", "f", "vec3", "real", "1", "0.5", "90deg", "#ff0000", "\"##\"", "'#'", "(",
    ")", "[", "]", "{", "}", ",", ";", ":", ".", "?", "<", ">", "=", "+", "*", "/", "^", "-", "..",
    "->", "=>", "==", "<=", "//", "\n", "5.", "'", "\"", "&&", "é", "\0",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_text_parses(text in "\\PC{0,200}") {
        parse_any(&text);
    }

    #[test]
    fn any_bytes_parse(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        let (text, _) = decode(&bytes, 0);
        parse_any(&text);
    }

    #[test]
    fn any_soup_of_tokens_parses(words in proptest::collection::vec(0..SOUP.len(), 0..150)) {
        let text: Vec<&str> = words.iter().map(|word| SOUP[*word]).collect();
        parse_any(&text.join(" "));
    }

    #[test]
    fn any_mutation_of_a_scene_parses(
        scene in 0..SCENES.len(),
        from in any::<prop::sample::Index>(),
        length in 0..40usize,
        to in any::<prop::sample::Index>(),
        word in 0..SOUP.len(),
    ) {
        let mut text: Vec<char> = SCENES[scene].chars().collect();
        let from = from.index(text.len());
        let cut: Vec<char> = text.drain(from..(from + length).min(text.len())).collect();
        let to = to.index(text.len());
        // A piece moved elsewhere, and a word where it was.
        text.splice(to..to, cut);
        let from = from.min(text.len());
        text.splice(from..from, SOUP[word].chars());
        let text: String = text.into_iter().collect();
        parse_any(&text);
    }
}
