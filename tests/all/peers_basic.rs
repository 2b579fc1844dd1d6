//! The recorded texts of small BASIC programs, held against the genuine BASIC II under jsbeeb.

#[path = "../../vm/src/bbc/tests/cases.rs"]
mod cases;

use crate::peers_jsbeeb::{hex, jsbeeb};
use cases::{Case, SUBJECTS, cases};
use serde_json::json;
use slowlight_vm::bbc::{Dialect, tokenise};
use std::path::Path;

/// What is printed, without control codes but line feeds, what belongs to them, and the prompt.
fn plain(text: &str) -> String {
    let mut kept = String::new();
    let mut chars = text.chars();
    while let Some(c) = chars.next() {
        let parameters = match c as u32 {
            1 | 17 | 22 => 1,
            18 | 31 => 2,
            28 | 29 => 4,
            19 | 25 => 5,
            24 => 8,
            23 => 9,
            _ => 0,
        };
        if c == '\n' || (c >= ' ' && c != '\u{7f}') {
            kept.push(c);
        }
        chars.by_ref().take(parameters).for_each(drop);
    }
    kept.strip_suffix('>').map(str::to_owned).unwrap_or(kept)
}

/// A program without the lines that are a number alone: to type one takes that line away.
fn typed(program: &str) -> String {
    let text = |l: &&str| !l.trim().bytes().all(|c| c.is_ascii_digit());
    let lines: Vec<&str> = program.lines().filter(text).collect();
    lines.join("\n")
}

/// A program as its file has it.
fn written(case: &Case<'_>, prints: &str) -> String {
    let mut text = format!("== {}\n{}", case.name, case.program);
    if !case.input.is_empty() {
        text.push_str(&format!("-- input\n{}\n", case.input.join("\n")));
    }
    text.push_str("-- prints\n");
    for line in prints.split('\n') {
        text.push_str(&format!("|{line}|\n"));
    }
    text
}

/// With UPDATE_ROM_TEXTS=1 in the environment, writes the files instead.
#[test]
fn the_recorded_texts_are_the_roms() {
    let update = std::env::var_os("UPDATE_ROM_TEXTS").is_some();
    let mut wrong = Vec::new();
    for (subject, text) in SUBJECTS {
        let list = cases(text);
        let programs: Vec<_> = list.iter().map(|c| json!([c.program, c.input])).collect();
        let result = jsbeeb(&[json!({ "programs": programs })]).remove(0);
        let texts = result["texts"].as_array().expect("texts");
        assert_eq!(texts.len(), list.len());
        let stored = result["tokens"].as_array().expect("tokens");
        for (case, stored) in list.iter().zip(stored) {
            let tokens = tokenise(&typed(case.program), Dialect::Micro).expect("a program");
            if stored != &hex(&tokens) {
                wrong.push(format!("{subject}, {}: other tokens", case.name));
            }
        }
        let mut file = String::new();
        for (case, text) in list.iter().zip(texts) {
            let prints = plain(text.as_str().expect("a text"));
            if prints != case.prints {
                wrong.push(format!("{subject}, {}", case.name));
            }
            file.push_str(&written(case, &prints));
        }
        if update {
            let root = Path::new(env!("CARGO_MANIFEST_DIR"));
            let path = root.join("vm/src/bbc/tests/rom").join(subject);
            std::fs::write(path.with_extension("txt"), file).expect("a file");
        }
    }
    assert!(
        wrong.is_empty() || update,
        "the ROM has another text: {wrong:#?}"
    );
}
