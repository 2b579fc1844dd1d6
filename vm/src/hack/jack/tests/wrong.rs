//! Wrong programs: what is said, and where.

use super::{shown, snapshot, warned};

/// Each text as class Main in Main.jack.
fn report(texts: &[&str]) -> String {
    let shown: Vec<_> = texts
        .iter()
        .map(|text| shown(&[("Main.jack", text)]))
        .collect();
    for report in &shown {
        assert!(report.contains("\n-- Main.jack:"), "accepted: {report}");
    }
    shown.join("\n")
}

/// Each text as the body of a function of Main, with a few things in scope.
fn report_bodies(bodies: &[&str]) -> String {
    let texts: Vec<_> = bodies
        .iter()
        .map(|body| {
            format!(
                "class Main {{ field int f; static Main s; method void m(int a) {{ return; }}\n\
                 function void g() {{ var int i; var Array a;\n\
                 {body}\nreturn; }} }}"
            )
        })
        .collect();
    let texts: Vec<_> = texts.iter().map(String::as_str).collect();
    report(&texts)
}

#[test]
fn characters() {
    let texts = [
        "class Main { # }",
        "class Main { é",
        "class Main { /* no end",
        "class Main { /*/",
        "class Main { function int f() { return \"no end; }\n }",
        "class Main { function int f() { return 32768; } }",
        "class Main { function int f() { return 99999999999999999999999999999999999999999999999; } }",
        "class Main { function String f() { return \"\u{10000}\"; } }",
    ];
    snapshot("wrong_characters", &report(&texts));
}

#[test]
fn declarations() {
    let texts = [
        "",
        "// nothing",
        "Class Main { }",
        "class main { }",
        "class Main",
        "class Main { function void f() { return; }",
        "class Main { } class Other { }",
        "class Main { int x; }",
        "class Main { field x; }",
        "class Main { field int x y; }",
        "class Main { function void f() { return; } static int x; }",
        "class Main { function f() { return; } }",
        "class Main { function void f(x) { return; } }",
        "class Main { function void f(int x,) { return; } }",
        "class Main { function void f(int x { return; } }",
        "class Main { function void while() { return; } }",
        "class Main { function void f() { return; var int x; } }",
        "class Main { field int x; static boolean x; }",
        "class Main { function void f(int x) { var int x; return; } }",
        "class Main { function void f() { return; } method int f() { return 1; } }",
        "class Main { constructor int new() { return this; } }",
        "class Main { constructor Main new() { return 1; } }",
        "class Main { constructor Main new() { return; } }",
        "class Main { constructor Main new() { return this + 0; } }",
        "class Main { function void f() { return 1; } function int g() { return; } }",
        "class Main { function void f( { return; } function void g() { retrun; } }",
    ];
    snapshot("wrong_declarations", &report(&texts));
}

#[test]
fn falling_through() {
    let texts = [
        "class Main { function void f() { } }",
        "class Main { function int f() { while (true) { return 1; }\n} }",
        "class Main { function int f() { if (true) { return 1; }\n} }",
        "class Main { function int f() { if (true) { return 1; } else { do Sys.halt(); }\n} }",
        "class Main { function int f() { return 1; do Sys.halt();\n} }",
    ];
    snapshot("wrong_paths", &report(&texts));
}

#[test]
fn statements() {
    let bodies = [
        "i = 1;",
        "let 1 = 2;",
        "let this = 2;",
        "let i + 1;",
        "let i = ;",
        "let i = 1",
        "let i[1 = 1;",
        "let a[] = 1;",
        "let j = 1;",
        "let j[0] = 1;",
        "let i = j;",
        "let i = j[0];",
        "let Math = 1;",
        "let m = 1;",
        "let f = 1;",
        "let i = f + this;",
        "if i { }",
        "if (i) let i = 1;",
        "if (i) { } else if (i) { }",
        "else { }",
        "while () { }",
        "do i;",
        "do g() + 1;",
        "return 1;",
        "return 1, 2;",
        ";",
        "let i = (1;",
        "let i = 1 ++ 2;",
        "let i = 1 2;",
        "let i = !i;",
    ];
    snapshot("wrong_statements", &report_bodies(&bodies));
}

#[test]
fn calls() {
    let bodies = [
        "do g();",
        "do m(1);",
        "do nothing();",
        "do Main.nothing();",
        "do Main.m(1);",
        "do Main.g(1);",
        "do s.m();",
        "do s.m(1, 2);",
        "do s.g();",
        "do s.nothing();",
        "do i.m();",
        "do f.m();",
        "do a.new(1);",
        "do Array.new();",
        "do Array.dispose();",
        "do String.appendChar(1);",
        "do Math.max(1);",
        "do Screen.drawLine(1, 2, 3);",
        "do Output.printString(\"a\", \"b\");",
        "do s.m(j, Main.m(k));",
        "do s.;",
        "do s.m(1,);",
        "do s.m(1;",
        "do this.m(1);",
    ];
    let method = "class Main { function void g() { return; }\n\
                  method void m() { do g(); do h(); do m(1); return; } }";
    let text = report_bodies(&bodies) + "\n" + &report(&[method]);
    snapshot("wrong_calls", &text);
}

#[test]
fn several_files() {
    let programs: [&[(&str, &str)]; 5] = [
        &[
            ("a/Main.jack", "class Main { }"),
            ("b/Main.jack", "class Main { }"),
        ],
        &[("Other.jack", "class Main { }")],
        &[
            (
                "Math.jack",
                "class Math { function int abs(int a) { return a; } }",
            ),
            (
                "Main.jack",
                "class Main { function int f() { return 2 * 3 / Math.max(1, 2); } }",
            ),
        ],
        &[
            ("Memory.jack", "class Memory { }"),
            (
                "String.jack",
                "class String { constructor String new() { return \"a\"; } }",
            ),
        ],
        // A syntax error anywhere, and what depends on that class is not judged.
        &[
            ("A.jack", "class A { function void f() { return } }"),
            (
                "B.jack",
                "class B { function void g() { do A.f(1); let x = 1; return; } }",
            ),
        ],
    ];
    let shown: Vec<_> = programs.iter().map(|files| shown(files)).collect();
    snapshot("wrong_programs", &shown.join("\n"));
}

/// What is compiled all the same, and the call that a program may or may not come to.
#[test]
fn what_is_only_warned_of() {
    let text = "class Main { field Nothing a, b; static Main s;
        function Gone f(Lost x) {
            var Away y;
            do Other.g(1);
            do Memory.free(1);
            do y.m();
            return x.n(s.g());
        }
        method int g() { return 1; }
    }";
    let (compiled, warnings) = warned(&[("Main.jack", text)]);
    let said: Vec<String> = warnings.iter().map(ToString::to_string).collect();
    let reached = "the program ends with an error if it comes to this call";
    assert_eq!(
        said,
        [
            "Main.jack:1:20: there is no class `Nothing`".to_owned(),
            "Main.jack:2:18: there is no class `Gone`".to_owned(),
            "Main.jack:2:25: there is no class `Lost`".to_owned(),
            "Main.jack:3:17: there is no class `Away`".to_owned(),
            format!("Main.jack:4:16: there is no variable and no class `Other`: {reached}"),
            format!("Main.jack:5:23: class `Memory` has no subroutine `free`: {reached}"),
        ]
    );
    let code = &compiled.unwrap()[0].text;
    let calls: Vec<&str> = code.lines().filter(|l| l.starts_with("call")).collect();
    assert_eq!(
        calls,
        [
            "call Other.g 1",
            "call Memory.free 1",
            "call Away.m 1",
            "call Main.g 1",
            "call Lost.n 2"
        ]
    );
}
