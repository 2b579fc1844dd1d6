//! `Math`, `Memory`, `Array`, `String` and `Sys`.

use super::{agreed, completed, error, program};
use slowlight_vm::hack::translate::{Options, translate};
use slowlight_vm::hack::vm::Program;

/// Edges of 16 bits, and of what is treated apart.
const EDGES: &[i32] = &[
    -32768, -32767, -16384, -182, -129, -128, -3, -2, -1, 0, 1, 2, 3, 4, 127, 128, 129, 181, 255,
    4096, 16383, 16384, 32766, 32767,
];

/// A body that tells `step`, a call of `i` and `j`, for all pairs of edges, and for
/// pairs at random, of all sizes.
fn for_pairs(step: &str) -> Vec<(String, String)> {
    let mut list = format!(
        "var Array edges; var int k, l; let edges = Array.new({});",
        EDGES.len()
    );
    for (k, edge) in EDGES.iter().enumerate() {
        let value = match edge {
            -32768 => "(-32767) - 1".to_owned(),
            edge => format!("{edge}"),
        };
        list += &format!("let edges[{k}] = {value};");
    }
    let count = EDGES.len();
    let body = format!(
        "{list}
        while (k < {count}) {{
            let l = 0;
            while (l < {count}) {{ do Main.step(edges[k], edges[l]); let l = l + 1; }}
            let k = k + 1;
        }}
        let k = 0;
        while (k < 600) {{
            let l = k & 7;
            do Main.step(Main.short(l), Main.short(k & 3));
            let k = k + 1;
        }}"
    );
    let step = format!(
        "function void step(int i, int j) {{ {step} return; }}
        function int short(int times) {{
            var int word;
            let word = Main.random();
            while (times > 0) {{ let word = word / 3; let times = times - 1; }}
            return word;
        }}"
    );
    program(&body, &step)
}

#[test]
fn products_quotients_and_the_like() {
    for step in [
        "do Main.note(i * j);",
        "if (~(j = 0)) { do Main.note(i / j); }",
        "do Main.note(Math.min(i, j));",
        "do Main.note(Math.max(i, j));",
        "do Main.note(Math.abs(i));",
        "if (~(i < 0)) { do Main.note(Math.sqrt(i)); }",
    ] {
        let words = agreed(&for_pairs(step)).words;
        assert!(words.iter().filter(|w| **w != 0).count() > 200, "{step}");
    }
}

#[test]
fn every_quotient_by_what_is_treated_apart() {
    for divisor in [2, 128] {
        let body = format!(
            "var int x, sum, k;
            let x = (-32767) - 1;
            while (k < 256) {{
                let sum = 0;
                let seed = 256;
                while (seed > 0) {{
                    let sum = sum + sum + sum + (x / {divisor});
                    let x = x + 1;
                    let seed = seed - 1;
                }}
                do Main.note(sum);
                let k = k + 1;
            }}"
        );
        agreed(&program(&body, ""));
    }
}

#[test]
fn arithmetic_that_fails() {
    assert_eq!(error("do Main.note(7 / next);"), Some(3));
    assert_eq!(error("do Main.note((-7) / next);"), Some(3));
    assert_eq!(error("do Main.note(Math.sqrt(-1));"), Some(4));
    assert_eq!(error("do Main.note(Math.sqrt((-32767) - 1));"), Some(4));
    assert_eq!(error("do Math.init();"), None);
}

#[test]
fn memory_at_random() {
    // 20 places for segments, each taken or given back as a random word says.
    let body = "var Array held; var int k, at, size;
        let held = Array.new(20);
        while (k < 20) { let held[k] = 0; let k = k + 1; }
        let k = 0;
        while (k < 900) {
            let at = Main.random() & 15;
            if (held[at] = 0) {
                let size = (Main.random() & 127) + 1;
                let held[at] = Memory.alloc(size);
                do Main.note(held[at]);
                do Memory.poke(held[at] + size - 1, -1);
            }
            else {
                do Memory.deAlloc(held[at]);
                let held[at] = 0;
            }
            let k = k + 1;
        }
        do Main.note(Memory.peek(held));";
    let words = agreed(&program(body, "")).words;
    assert!(words.iter().filter(|w| **w != 0).count() > 400);
}

#[test]
fn memory_that_fails() {
    assert_eq!(error("do Main.note(Memory.alloc(0));"), Some(5));
    assert_eq!(error("do Main.note(Memory.alloc(-5));"), Some(5));
    assert_eq!(error("do Main.note(Memory.alloc(14332));"), None);
    assert_eq!(error("do Main.note(Memory.alloc(14333));"), Some(6));
    assert_eq!(error("do Main.note(Memory.alloc(32767));"), Some(6));
    let twice = "do Main.note(Memory.alloc(11900)); do Main.note(Memory.alloc(4000));";
    assert_eq!(error(twice), Some(6));
    // To the last word, one more, and a hole of two segments that are not joined.
    let full = "var int a, b, c; let a = Memory.alloc(60); let b = Memory.alloc(9000);
        let c = Memory.alloc(5268); do Main.note(a); do Main.note(b); do Main.note(c);";
    let then = |more: &str| error(&format!("{full} {more}"));
    assert_eq!(then(""), None);
    assert_eq!(then("do Main.note(Memory.alloc(1));"), Some(6));
    let freed = "do Memory.deAlloc(b); do Memory.deAlloc(a);";
    assert_eq!(
        then(&format!("{freed} do Main.note(Memory.alloc(9001));")),
        Some(6)
    );
    assert_eq!(
        then(&format!(
            "{freed} do Main.note(Memory.alloc(9000)); do Main.note(Memory.alloc(60));"
        )),
        None
    );
    assert_eq!(error("do Main.note(Array.new(0));"), Some(2));
    let array = "var Array a; let a = Array.new(3); let a[2] = 5; do a.dispose();
        do Main.note(a); let a = Array.new(2); do Main.note(a);";
    assert_eq!(error(array), None);
    assert_eq!(
        error("do Memory.init(); do Main.note(Memory.alloc(3));"),
        None
    );
}

#[test]
fn strings() {
    let body = "var String s; var int k;
        let s = String.new(7);
        do Main.note(s); do Main.note(s.length());
        do s.setInt(0); do Main.tell(s);
        do s.setInt(-1); do Main.tell(s);
        do s.setInt(10); do Main.tell(s);
        do s.setInt(-1005); do Main.tell(s);
        do s.setInt(20030); do Main.tell(s);
        do s.setInt(32767); do Main.tell(s);
        do s.setInt((-32767) - 1); do Main.tell(s);
        do s.appendChar(57); do s.setCharAt(1, 49); do s.eraseLastChar(); do Main.tell(s);
        do s.appendChar(48); do Main.tell(s);
        while (k < 300) {
            do s.setInt(Main.random() / ((k & 3) * 30 + 1)); do Main.note(s.intValue());
            let k = k + 1;
        }
        do s.dispose();
        do Main.tell(\"12a4\"); do Main.tell(\"\"); do Main.tell(\"-\"); do Main.tell(\"--3\");
        do Main.tell(\"99999999\"); do Main.tell(\"-070\"); do Main.tell(\"/5\"); do Main.tell(\":5\");
        do Main.note(String.newLine()); do Main.note(String.backSpace());
        do Main.note(String.doubleQuote());";
    let tell = "function void tell(String s) {
            var int k;
            do Main.note(s.length());
            while (k < s.length()) { do Main.note(s.charAt(k)); let k = k + 1; }
            do Main.note(s.intValue());
            return;
        }";
    assert_eq!(agreed(&program(body, tell)).error, None);
}

#[test]
fn strings_that_fail() {
    let with = |rest: &str| {
        error(&format!(
            "var String s; let s = String.new(3); do s.appendChar(65); {rest} do Main.note(1);"
        ))
    };
    assert_eq!(error("do Main.note(String.new(-1));"), Some(14));
    assert_eq!(error("do Main.note(String.new(32766));"), Some(5));
    assert_eq!(error("do Main.note(String.new(0));"), None);
    assert_eq!(with(""), None);
    assert_eq!(with("do Main.note(s.charAt(1));"), Some(15));
    assert_eq!(with("do Main.note(s.charAt(-1));"), Some(15));
    assert_eq!(with("do s.setCharAt(1, 66);"), Some(16));
    assert_eq!(with("do s.setCharAt((-32767) - 1, 66);"), Some(16));
    assert_eq!(
        with("do s.appendChar(1); do s.appendChar(2); do s.appendChar(3);"),
        Some(17)
    );
    assert_eq!(
        with("do s.eraseLastChar(); do s.eraseLastChar();"),
        Some(18)
    );
    assert_eq!(with("do s.setInt(999);"), None);
    assert_eq!(with("do s.setInt(1000);"), Some(19));
    assert_eq!(with("do s.setInt(-100);"), Some(19));
}

#[test]
fn the_system_itself() {
    assert_eq!(error("do Sys.wait(0);"), None);
    assert_eq!(error("do Sys.wait(2);"), None);
    assert_eq!(error("do Sys.wait(-1);"), Some(1));
    for number in [0, 7, 10, 1005, 32767, -1, -300] {
        assert_eq!(error(&format!("do Sys.error({number});")), Some(number));
    }
    assert_eq!(error("do Sys.halt(); do Sys.error(1);"), None);
}

/// What is not called is not there, and what is never come to not initialised.
#[test]
fn a_program_has_what_it_calls() {
    let all = |body: &str, more: &str| -> (Vec<String>, usize) {
        let main = format!("class Main {{ function void main() {{ {body} return; }} {more} }}");
        let all = completed(&vec![("Main.jack".to_owned(), main)]);
        let lines = all.iter().filter(|(name, _)| name != "Main.vm");
        let lines = lines.flat_map(|(_, text)| text.lines());
        let names = lines.filter_map(|line| line.strip_prefix("function "));
        let first = |name: &str| name.split(' ').next().unwrap().to_owned();
        let program = Program::link(&all).unwrap();
        let words = translate(&program, Options::default()).unwrap().words;
        (names.map(first).collect(), words.len())
    };
    let functions = |body| all(body, "").0;
    assert_eq!(functions(""), ["Sys.halt", "Sys.init"]);
    assert_eq!(
        functions("do Math.abs(1);"),
        ["Math.abs", "Sys.halt", "Sys.init"]
    );
    let drawing = functions("do Screen.drawPixel(1, 2);");
    let strange = |f: &String| f.starts_with("Memory") || f.starts_with("Output");
    assert!(!drawing.iter().any(strange), "{drawing:?}");
    let printing = functions("do Output.printInt(5);");
    assert!(printing.contains(&"Output.makeFont".to_owned()));
    let strange = |f: &String| f.starts_with("Screen") || f == "Math.divide";
    assert!(!printing.iter().any(strange), "{printing:?}");

    let plain = all("do Screen.drawPixel(1, 2);", "");
    let dead = "function void never() { do Output.printInt(5 / 2); return; }";
    let (names, words) = all("do Screen.drawPixel(1, 2);", dead);
    assert!(names.contains(&"Output.makeFont".to_owned()));
    assert_eq!(words, plain.1, "what is never called takes no words");
}
