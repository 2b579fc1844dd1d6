//! Input that nobody would write: it must end, with an answer.

use super::super::{FAULTS, NESTING};
use super::compiled;
use proptest::prelude::*;

const MEGABYTE: usize = 1 << 20;

/// The one fault of a class whose function returns this expression.
fn fault_of(expression: &str) -> String {
    let text = format!("class Main {{ function int f(int x) {{ return {expression}; }} }}");
    let faults = compiled(&[("Main.jack", &text)]).unwrap_err();
    assert_eq!(faults.len(), 1);
    assert_eq!(faults[0].line, Some(1));
    faults[0].message.clone()
}

#[test]
fn a_megabyte_of_brackets() {
    for open in ["(", "[", "{", "-", "~", "x[", "x(", "Math.abs(", "-(", ")"] {
        let many = open.repeat(MEGABYTE / open.len());
        assert!(compiled(&[("Main.jack", &many)]).is_err());
        fault_of(&many);
    }
    for open in ["if (x) {", "while (x) {", "if (x) { } else {", "{", "}"] {
        let many = open.repeat(MEGABYTE / open.len());
        let text = format!("class Main {{ function int f(int x) {{ {many}");
        assert!(compiled(&[("Main.jack", &text)]).is_err());
    }
}

#[test]
fn nesting_has_a_limit_and_reaches_it() {
    let nested = |depth: usize| format!("{}x{}", "(".repeat(depth), ")".repeat(depth));
    let text = |expression: &str| {
        format!("class Main {{ function int f(int x) {{ return {expression}; }} }}")
    };
    // One level is the statement's.
    let most = usize::try_from(NESTING).unwrap() - 1;
    assert!(compiled(&[("Main.jack", &text(&nested(most)))]).is_ok());
    assert!(fault_of(&nested(most + 1)).contains("nested more than 256 levels"));
}

#[test]
fn faults_are_counted() {
    let one_line = "let nothing = 1;\n".repeat(1000);
    let text = format!("class Main {{ function void f() {{ {one_line} return; }} }}");
    let faults = compiled(&[("Main.jack", &text)]).unwrap_err();
    assert_eq!(faults.len(), FAULTS);
    let many = "function void f(".repeat(1000);
    let faults = compiled(&[("Main.jack", &format!("class Main {{ {many}"))]).unwrap_err();
    assert_eq!(faults.len(), FAULTS);
    let faults = compiled(&[("Main.jack", &"# a ".repeat(1000))]).unwrap_err();
    assert_eq!(faults.len(), FAULTS);
}

#[test]
fn binary_files_are_a_few_faults() {
    let text = "\0\u{1}\u{2}\u{7f}ELF\0\0\u{fffd}\u{fffd}".to_string() + &"\0".repeat(1000);
    let faults = compiled(&[("Main.jack", &text)]).unwrap_err();
    assert_eq!(faults.len(), 2);
    assert_eq!(
        faults[0].message,
        "the character `\\0` has no place in Jack"
    );
    assert_eq!(faults[1].column, Some(8));
}

#[test]
fn what_a_segment_cannot_number_is_refused() {
    let names = |count: u32| -> String {
        let names: Vec<_> = (0..count).map(|i| format!("v{i}")).collect();
        names.join(", ")
    };
    let text = |count| {
        let names = names(count);
        format!("class Main {{ function void f() {{ var int {names}; return; }} }}")
    };
    let code = compiled(&[("Main.jack", &text(32_767))]).unwrap();
    assert!(code[0].text.starts_with("function Main.f 32767\n"));
    assert!(compiled(&[("Main.jack", &text(32_768))]).is_err());
    let long = "a".repeat(32_768);
    assert!(fault_of(&format!("\"{long}\"")).contains("longer than 32767"));
}

#[test]
fn long_flat_programs_compile() {
    let sum = "+ x ".repeat(MEGABYTE / 4);
    let text = format!("class Main {{ function int f(int x) {{ return x {sum}; }} }}");
    let code = compiled(&[("Main.jack", &text)]).unwrap();
    assert_eq!(code[0].text.matches("add\n").count(), MEGABYTE / 4);
}

/// A program with all of the language, to be damaged.
const WHOLE: &str = "class Main {
    field int x, y; static Array all; static boolean on;
    constructor Main new(int a) { let x = a; return this; }
    method int get(int i) {
        var String s; var char c;
        let s = \"text\"; // comment
        if (~(i < 0) & on) { let c = s.charAt(i); } else { let all[i] = all[all[x]]; }
        while (i > -1) { let i = i - 1 * 2 / 3; do draw(this, null); }
        return (x + y) | i;
    }
    method void draw(Main m, int k) { do m.draw(Main.new(1), k = 2); return; }
}";

fn fragment() -> impl Strategy<Value = &'static str> {
    prop::sample::select(vec![
        "class",
        "Main",
        "{",
        "}",
        "(",
        ")",
        "[",
        "]",
        ";",
        ",",
        ".",
        "=",
        "let",
        "do",
        "if",
        "else",
        "while",
        "return",
        "var",
        "int",
        "field",
        "static",
        "method",
        "function",
        "constructor",
        "void",
        "this",
        "null",
        "true",
        "x",
        "all",
        "0",
        "32767",
        "32768",
        "\"s\"",
        "\"",
        "/*",
        "*/",
        "//",
        "\n",
        "-",
        "~",
        "+",
        "*",
        "&",
        "é",
        "Math",
        "abs",
    ])
}

/// Compiles, and checks that every fault has a place inside the text.
fn survives(text: &str) -> Result<(), TestCaseError> {
    match compiled(&[("Main.jack", text)]) {
        Ok(code) => prop_assert_eq!(code.len(), 1),
        Err(faults) => {
            prop_assert!(!faults.is_empty());
            let lines = u32::try_from(text.split('\n').count()).unwrap();
            for fault in faults {
                prop_assert!((1..=lines).contains(&fault.line.unwrap()));
                prop_assert!(fault.column.unwrap() >= 1);
            }
        }
    }
    Ok(())
}

proptest! {
    #[test]
    fn random_text(text in "\\PC{0,200}") {
        survives(&text)?;
    }

    #[test]
    fn random_fragments(words in prop::collection::vec(fragment(), 0..80)) {
        survives(&words.join(" "))?;
        survives(&format!("class Main {{ function int f() {{ {} return 1; }} }}", words.join(" ")))?;
    }

    #[test]
    fn damaged_programs(
        cuts in prop::collection::vec((0..WHOLE.len(), 0..30_usize, fragment()), 1..4)
    ) {
        let mut text = WHOLE.to_string();
        for (at, length, with) in cuts {
            let at = at.min(text.len());
            let end = (at + length).min(text.len());
            if text.is_char_boundary(at) && text.is_char_boundary(end) {
                text.replace_range(at..end, with);
            }
        }
        survives(&text)?;
    }
}

#[test]
fn the_program_to_damage_is_sound() {
    assert!(compiled(&[("Main.jack", WHOLE)]).is_ok());
}
