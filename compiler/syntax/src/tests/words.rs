//! The lists of words, held against the lexer that reads them.

use crate::token::{ITEMS, PLACED, Token, WORDS, is_name};
use logos::Logos;

const LEXER: &str = include_str!("../token.rs");

fn only(text: &str) -> Option<Token<'_>> {
    let mut tokens = Token::lexer(text);
    tokens.next()?.ok().filter(|_| tokens.next().is_none())
}

#[test]
fn the_lists_have_the_lexer_s_words() {
    // What its patterns spell out.
    let patterns = LEXER.lines().map(str::trim);
    let patterns = patterns.filter_map(|line| line.strip_prefix('"')?.strip_suffix("\","));
    let spelt =
        patterns.filter(|p| p.contains('|') && p.chars().all(|c| c == '|' || c.is_alphabetic()));
    let spelt: Vec<&str> = spelt.flat_map(|p| p.split('|')).collect();
    let listed: Vec<&str> = ITEMS.into_iter().chain(WORDS).collect();
    assert_eq!(spelt, listed);
    assert!(ITEMS.iter().all(|w| only(w) == Some(Token::Item(w))));
    assert!(WORDS.iter().all(|w| only(w) == Some(Token::Word(w))));
    assert!(PLACED.iter().all(|w| only(w) == Some(Token::Ident(w))));
}

#[test]
fn names_are_what_is_no_reserved_word() {
    for good in ["a", "max", "_", "vec3", "lets"] {
        assert!(is_name(good), "{good}");
    }
    for bad in [
        "", " a", "a ", "let", "draw", "3a", "a-b", "\u{e9}", "a.b", "// a",
    ] {
        assert!(!is_name(bad), "{bad}");
    }
}
